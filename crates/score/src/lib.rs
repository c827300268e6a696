//! Compares the answers of any rocking code with certified values, and names
//! the mistake that explains the differences.
//!
//! The data set is `fixtures/benchmark`; its README describes the quantities
//! and the computation of the certified values. The command line and the
//! Python package both call this crate.
//!
//! ```
//! use std::path::Path;
//! use rocking_score::{Answers, CodeVerdict, own_answers, score};
//! let csv = "scene,quantity,value\nfree-half,fate,rocked\n";
//! let few = Answers::parse(csv, Path::new("answers.csv"))?;
//! assert_eq!(score(&few).diagnosis.verdict, CodeVerdict::TooFew);
//! assert_eq!(score(&own_answers()?).diagnosis.verdict, CodeVerdict::None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![deny(missing_docs)]

mod answers;
mod deviations;
mod diagnosis;
mod own;
mod reference;
mod score;

pub use answers::Answers;
pub use diagnosis::{CodeVerdict, Diagnosis, Explanation, Mistake, diagnose};
pub use own::{OwnResponse, answers_of, own_answers};
pub use reference::{
    INPUTS, Item, Problem, Reference, SCENES, SceneExcitation, Value,
    reference,
};
pub use score::{Code, LevelScore, QuantityScore, Score, codes, score};
