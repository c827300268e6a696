//! The page that recomputes: the engine as WebAssembly, the results of the
//! compiled program, and the script that compares them.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, anyhow};
use rayon::prelude::*;
use rocking_draw::page::STYLE;
use rocking_proof::cases::load_all;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest as _, Sha256};

/// The file beside the page of the report.
pub const LAB: &str = "lab.html";

const PAGE: &str = include_str!("lab/page.html");
const OWN_STYLE: &str = include_str!("lab/page.css");
const SCRIPT: &str = include_str!("lab/page.js");

#[derive(Deserialize)]
struct CaseId {
    id: String,
}

/// The result of a case.
#[derive(Serialize, Deserialize)]
struct CaseBits {
    #[serde(skip_serializing)]
    holds: bool,
    bits: String,
    quantity: String,
    first: String,
}

/// Calls the engine, compiled for this machine.
fn ask<T: for<'a> Deserialize<'a>>(question: &Value) -> Result<T> {
    let answer = rocking_web::answer(&question.to_string());
    serde_json::from_str(&answer).with_context(|| answer)
}

/// The results of the compiled program, and the cases that take too long in a
/// browser.
fn native() -> Result<Value> {
    let listed: Vec<CaseId> = ask(&json!({ "ask": "cases" }))?;
    let run = |listed: &CaseId| {
        let id = listed.id.clone();
        let question = json!({ "ask": "case", "id": id });
        let found: CaseBits = ask(&question)?;
        if !found.holds {
            return Err(anyhow!("the case {id} fails"));
        }
        Ok((id, found))
    };
    let cases: BTreeMap<_, _> =
        listed.par_iter().map(run).collect::<Result<_>>()?;
    let left = load_all()?.into_iter().map(|case| case.id);
    let left: Vec<_> = left.filter(|id| !cases.contains_key(id)).collect();
    Ok(json!({ "cases": cases, "left": left }))
}

/// The page with an engine, as text from `validation/web/build`.
///
/// # Errors
/// If a reference case gives no answer or fails.
pub fn page(engine: &str) -> Result<String> {
    let style = format!("{STYLE}{OWN_STYLE}");
    let hash = |text: &str| base64(&Sha256::digest(text));
    let policy = format!(
        "default-src 'none'; script-src 'sha256-{}' 'wasm-unsafe-eval'; \
         worker-src blob:; style-src 'sha256-{}'; base-uri 'none'; \
         form-action 'none'",
        hash(SCRIPT),
        hash(&style)
    );
    // In the markup a `<` could end the element.
    let native = native()?.to_string().replace('<', "\\u003c");
    let parts = [
        ("{policy}", policy),
        ("{style}", style),
        ("{version}", env!("CARGO_PKG_VERSION").to_owned()),
        ("{native}", native),
        ("{engine}", engine.to_owned()),
        ("{script}", SCRIPT.to_owned()),
    ];
    Ok(parts.iter().fold(PAGE.to_owned(), |page, (place, part)| {
        page.replacen(place, part, 1)
    }))
}

/// Base64 (RFC 4648, section 4), as a content security policy names hashes.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] =
        b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let byte = |k| u32::from(*group.get(k).unwrap_or(&0));
        let word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let place = (word >> (18 - 6 * k) & 63) as usize;
            let padded = k > group.len();
            text.push(if padded { '=' } else { ALPHABET[place] as char });
        }
    }
    text
}
