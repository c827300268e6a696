//! The proof: declared cases, what they are compared with, and the verdict
//! on each. Nothing here knows the study.

// What only methods left out of a page need.
#![cfg_attr(target_family = "wasm", allow(dead_code, unused_imports))]

pub mod arithmetic;
pub mod cases;
pub mod edge;
pub mod engine;
pub mod methods;
pub mod naive;
pub mod oracles;
#[cfg(not(target_family = "wasm"))]
pub mod published;
mod pulse;
mod references;
pub mod scene;
pub mod trials;
pub mod verdict;
