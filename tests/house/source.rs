//! Rust source as tokens.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// Identifiers and single punctuation characters (`::` is one token), without
/// comments and literals.
pub fn tokens(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    flatten(source.parse().unwrap(), &mut found);
    found
}

fn flatten(stream: TokenStream, found: &mut Vec<String>) {
    for tree in stream {
        match tree {
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Brace => ["{", "}"],
                    Delimiter::Bracket => ["[", "]"],
                    _ => ["(", ")"],
                };
                found.push(open.to_owned());
                flatten(group.stream(), found);
                found.push(close.to_owned());
            }
            TokenTree::Literal(_) => {}
            one => match (one.to_string(), found.last_mut()) {
                (one, Some(last)) if one == ":" && last == ":" => {
                    last.push(':');
                }
                (one, _) => found.push(one),
            },
        }
    }
}
