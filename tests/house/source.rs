//! Rust source as tokens, and which module a path leads to.

/// Identifiers, lifetimes without their tick, and single punctuation
/// characters (`::` is one token), without comments, strings and character
/// literals.
pub fn tokens(source: &str) -> Vec<String> {
    let chars: Vec<char> = source.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let rest = &chars[at..];
        let starts = |text: &str| {
            text.chars().enumerate().all(|(k, c)| rest.get(k) == Some(&c))
        };
        if starts("//") {
            at += length_until(rest, "\n", 2);
        } else if starts("/*") {
            at += length_until(rest, "*/", 2);
        } else if let Some(length) = string_length(rest) {
            at += length;
        } else if rest[0].is_alphanumeric() || rest[0] == '_' {
            let word = |c: &&char| c.is_alphanumeric() || **c == '_';
            let text: String = rest.iter().take_while(word).collect();
            at += text.chars().count();
            tokens.push(text);
        } else if starts("::") {
            tokens.push("::".to_owned());
            at += 2;
        } else {
            if !rest[0].is_whitespace() {
                tokens.push(rest[0].to_string());
            }
            at += 1;
        }
    }
    tokens
}

fn to_chars(text: &str) -> Vec<char> {
    text.chars().collect()
}

/// Length up to and with the first `end` at or after `from`.
fn length_until(chars: &[char], end: &str, from: usize) -> usize {
    let end = to_chars(end);
    (from..chars.len())
        .find(|&at| chars[at..].starts_with(&end))
        .map_or(chars.len(), |at| at + end.len())
}

/// Length of the string or character literal that begins here.
fn string_length(chars: &[char]) -> Option<usize> {
    let prefix = chars.iter().take_while(|c| "bcr".contains(**c)).count();
    let raw = chars[..prefix].contains(&'r');
    let rest = &chars[prefix..];
    let hashes = rest.iter().take_while(|c| **c == '#').count();
    if raw && rest.get(hashes) == Some(&'"') {
        let end = format!("\"{}", "#".repeat(hashes));
        return Some(prefix + length_until(rest, &end, hashes + 1));
    }
    match rest.first() {
        Some('"') => Some(prefix + quoted_length(rest, '"')),
        // 'a' or '\n' is a character, 'a without an end a lifetime.
        Some('\'') if rest.get(1) == Some(&'\\') => {
            Some(prefix + quoted_length(rest, '\''))
        }
        Some('\'') if rest.get(2) == Some(&'\'') => Some(prefix + 3),
        _ => None,
    }
}

fn quoted_length(chars: &[char], quote: char) -> usize {
    let mut at = 1;
    while at < chars.len() && chars[at] != quote {
        at += if chars[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// Top-level modules that a file of the core names, by `crate::name` or by a
/// `super::` that leaves its own top-level module. `depth` is the number of
/// modules that the file lies in: 1 for `src/block.rs`.
///
/// A grouped `crate::{..}` comes out as `{`, which is no module.
pub fn named_modules(tokens: &[String], depth: usize) -> Vec<String> {
    let mut named = Vec::new();
    // Levels of braces at which inline modules were opened.
    let mut inline: Vec<usize> = Vec::new();
    let mut braces = 0;
    let mut at = 0;
    let token = |at: usize| tokens.get(at).map_or("", String::as_str);
    while at < tokens.len() {
        match token(at) {
            "{" => {
                if at >= 2 && token(at - 2) == "mod" {
                    inline.push(braces);
                }
                braces += 1;
            }
            "}" => {
                braces -= 1;
                if inline.last() == Some(&braces) {
                    inline.pop();
                }
            }
            "crate" if token(at + 1) == "::" => {
                named.push(token(at + 2).to_owned());
            }
            "super" => {
                let mut steps = 1;
                while token(at + 1) == "::" && token(at + 2) == "super" {
                    steps += 1;
                    at += 2;
                }
                if steps >= depth + inline.len() && token(at + 1) == "::" {
                    named.push(token(at + 2).to_owned());
                }
            }
            _ => {}
        }
        at += 1;
    }
    named
}

/// Whether the tokens hold this sequence.
pub fn holds(tokens: &[String], sequence: &[&str]) -> bool {
    tokens.windows(sequence.len()).any(|window| window == sequence)
}

#[test]
fn tokens_leave_out_text() {
    let source = "let a = 'b'; // crate::no\nf(\"crate::no\", r#\"\"x\"#)\
                  ; g('\\'', b\"\\\"\") /* unsafe */ fn h<'c>() crate::yes";
    let expected = "let a = ; f ( , ) ; g ( , ) fn h < ' c > ( ) crate :: yes";
    assert_eq!(tokens(source).join(" "), expected);
}

#[test]
fn supers_are_counted_from_inline_modules() {
    let source = "use super::super::far; use super::near; use crate::{a};
        mod tests { use super::near; use super::super::super::out; }
        use super::super::last;";
    let named = named_modules(&tokens(source), 2);
    assert_eq!(named, ["far", "{", "out", "last"]);
}
