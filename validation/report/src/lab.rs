//! The page that recomputes: the engine as WebAssembly, what the compiled
//! program gives beside it, and the script that asks.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, anyhow};
use lzma_rust2::{LzmaOptions, LzmaWriter, Write as _};
use rayon::prelude::*;
use rocking_draw::page::STYLE;
use rocking_proof::cases::load_all;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

/// The file beside the page of the report.
pub const LAB: &str = "lab.html";

const PAGE: &str = include_str!("lab/page.html");
const OWN_STYLE: &str = include_str!("lab/page.css");
const SCRIPT: &str = include_str!("lab/page.js");

/// The engine as `web/build` makes it.
pub struct Engine {
    /// What unpacks it: a WebAssembly module, as gzip.
    pub unpacker: Vec<u8>,
    /// A WebAssembly module, as LZMA.
    pub packed: Vec<u8>,
}

/// What the compiled program gives.
#[derive(Serialize)]
struct Native {
    cases: BTreeMap<String, Due>,
    /// Cases that take too long in a browser.
    left: Vec<String>,
}

/// The result of a case.
#[derive(Serialize)]
struct Due {
    bits: String,
    /// Name and first value of its first quantity.
    name: String,
    first: String,
}

#[derive(Deserialize)]
struct Listed {
    id: String,
}

#[derive(Deserialize)]
struct Found {
    bits: String,
    holds: bool,
    checks: Vec<Check>,
}

#[derive(Deserialize)]
struct Check {
    quantity: String,
    observed: Vec<String>,
}

/// Asks the engine, compiled for this machine.
fn ask<T: for<'a> Deserialize<'a>>(question: &serde_json::Value) -> Result<T> {
    let answer = rocking_web::answer(&question.to_string());
    serde_json::from_str(&answer).with_context(|| answer)
}

fn native() -> Result<Native> {
    let listed: Vec<Listed> = ask(&serde_json::json!({ "ask": "cases" }))?;
    let run = |listed: &Listed| {
        let id = listed.id.clone();
        let question = serde_json::json!({ "ask": "case", "id": id });
        let found: Found = ask(&question)?;
        if !found.holds {
            return Err(anyhow!("the case {id} fails"));
        }
        let first = found.checks.into_iter().next();
        let first = first.with_context(|| format!("{id} gives nothing"))?;
        let due = Due {
            bits: found.bits,
            name: first.quantity,
            first: first.observed.into_iter().next().unwrap_or_default(),
        };
        Ok((id, due))
    };
    let cases: BTreeMap<String, Due> =
        listed.par_iter().map(run).collect::<Result<_>>()?;
    let left = load_all()?.into_iter().map(|case| case.id);
    let left = left.filter(|id| !cases.contains_key(id)).collect();
    Ok(Native { cases, left })
}

/// The page with an engine.
///
/// # Errors
/// Where a declared case gives no answer or fails.
pub fn page(engine: &Engine) -> Result<String> {
    let style = format!("{STYLE}{OWN_STYLE}");
    let hash = |text: &str| base64(&Sha256::digest(text));
    let policy = format!(
        "default-src 'none'; script-src 'sha256-{}' 'wasm-unsafe-eval'; \
         worker-src blob:; style-src 'sha256-{}'; base-uri 'none'; \
         form-action 'none'",
        hash(SCRIPT),
        hash(&style)
    );
    let native = packed(&serde_json::to_vec(&native()?)?)?;
    let parts = [
        ("{policy}", policy),
        ("{style}", style),
        ("{version}", env!("CARGO_PKG_VERSION").to_owned()),
        ("{native}", base64(&native)),
        ("{unpacker}", base64(&engine.unpacker)),
        ("{engine}", base64(&engine.packed)),
        ("{script}", SCRIPT.to_owned()),
    ];
    Ok(parts.iter().fold(PAGE.to_owned(), |page, (place, part)| {
        page.replacen(place, part, 1)
    }))
}

/// LZMA, as the engine is packed.
fn packed(bytes: &[u8]) -> Result<Vec<u8>> {
    let options = LzmaOptions::with_preset(9);
    let failed = |error| anyhow!("LZMA: {error:?}");
    let mut writer = LzmaWriter::new_use_header(Vec::new(), &options, None)
        .map_err(failed)?;
    writer.write_all(bytes).map_err(failed)?;
    writer.finish().map_err(failed)
}

/// The engine that a page holds, as it stands there.
#[must_use]
pub fn engine_of(page: &str) -> Option<Engine> {
    let part = |name: &str| {
        let (_, rest) = page.split_once(&format!("id=\"{name}\">"))?;
        from_base64(rest.split_once("</script>")?.0)
    };
    Some(Engine { unpacker: part("unpacker")?, packed: part("engine")? })
}

const ALPHABET: &[u8; 64] =
    b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Base64 (RFC 4648, section 4).
fn base64(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
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

fn from_base64(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut word, mut bits) = (0_u32, 0);
    for own in text.trim_end_matches('=').bytes() {
        let value = ALPHABET.iter().position(|c| *c == own)?;
        word = word << 6 | value as u32;
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits & 0xff) as u8);
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vectors of RFC 4648, section 10.
    #[test]
    fn base64_goes_there_and_back() {
        let vectors = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (bytes, text) in vectors {
            assert_eq!(base64(bytes.as_bytes()), text);
            assert_eq!(from_base64(text).unwrap(), bytes.as_bytes());
        }
        assert_eq!(from_base64("Zm9?"), None);
    }
}
