//! The page that recomputes, where a compiler for its engine is.

use std::fs;
use std::process::{Command, Stdio};

use crate::failure::{At as _, Failure};
use crate::terminal::note;
use rocking_report::lab;

/// Compiles the engine, and prints the path of the packed file.
const BUILD: &str = "validation/web/build";

/// The page; none where `validation/web/build` says that something is missing.
pub fn made() -> Result<Option<Vec<u8>>, Failure> {
    note(BUILD);
    let built = Command::new(BUILD).stderr(Stdio::inherit()).output();
    let built = built.at(BUILD)?;
    if !built.status.success() {
        note(&format!("{} is left as it is", lab::LAB));
        return Ok(None);
    }
    let path = String::from_utf8_lossy(&built.stdout).trim().to_owned();
    let engine = fs::read_to_string(&path).at(&path)?;
    Ok(Some(lab::page(&engine)?.into_bytes()))
}
