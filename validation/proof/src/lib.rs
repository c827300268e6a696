//! The proof: reference cases, their references and oracles, and the verdicts.
//! This crate does not depend on the study.

// On a page, items that only omitted methods use are dead code.
#![cfg_attr(target_family = "wasm", allow(dead_code, unused_imports))]

pub mod arithmetic;
pub mod cases;
pub mod edge;
pub mod engine;
pub mod methods;
pub mod naive;
pub mod oracles;
mod pulse;
mod references;
pub mod scene;
pub mod trials;
pub mod verdict;
