//! The gate in one program, so that it is linked once: `cargo test --test
//! gate house::` runs the house rules alone. Each file stands on its own.
//! `tests/cases.rs` has a test for each declared case, and `tests/memory.rs`
//! counts the memory of its whole program.

#[path = "cli.rs"]
mod cli;
#[path = "compare.rs"]
mod compare;
#[path = "exchange.rs"]
mod exchange;
#[path = "house.rs"]
mod house;
#[path = "law.rs"]
mod law;
#[path = "names.rs"]
mod names;
#[path = "page.rs"]
mod page;
#[path = "proof.rs"]
mod proof;
#[path = "properties.rs"]
mod properties;
#[path = "ranking.rs"]
mod ranking;
#[path = "readers.rs"]
mod readers;
#[path = "records.rs"]
mod records;
#[path = "reproducibility.rs"]
mod reproducibility;
#[path = "results.rs"]
mod results;
#[path = "samples.rs"]
mod samples;
#[path = "stop.rs"]
mod stop;
#[path = "study.rs"]
mod study;
#[path = "support.rs"]
mod support;
#[path = "trials.rs"]
mod trials;
