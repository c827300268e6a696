//! Reference cases: the claim, the method that computes it, the expected
//! values and their tolerances. This module holds data and knows no physics.
//!
//! # Files of cases
//!
//! A file in `cases` is a family. A `[[case]]` states only what differs from
//! the defaults. Its values come from these layers; a later one overrides an
//! earlier one:
//!
//! 1. `cost = "quick"`, for every case;
//! 2. `[family.default]`, for every case of the file;
//! 3. `[family.method.NAME]`, for every case of the file with that method;
//! 4. the keys of the case.
//!
//! Keys of `source`, `expect`, `expect.values`, `input`, `tolerance` and
//! `tolerance.bounds` are inherited one by one. Every other value replaces
//! the inherited one as a whole: a bound, a list such as `reject`, a table
//! inside `input`. A case with its own `source.cite` inherits neither `where`
//! nor `note`; a case with its own `tolerance.basis` inherits no `because`.
//! `tolerance.without` lists quantities whose inherited bound is dropped,
//! because the motion of the case lacks them. The verdict refuses a quantity
//! without a bound and a bound without a quantity.
//!
//! A value that equals the inherited one is refused. So is a default that no
//! case inherits.
//!
//! # Entries
//!
//! `entries = ["A-1", "B-2"]` declares one case for each of these entries of a
//! reference. The entry becomes `input.entry`; in lower case it is the name.
//! `entries = [["A-1", "Claim."]]` gives each entry a claim of its own.
//!
//! # Computed bounds
//!
//! `absolute` and `relative` take a number, or
//! `{ attainable = 100, of = ["peak"], least = 1e-13 }`: 100 times the largest
//! of the listed errors that a careful double-precision code made on the
//! entry, rounded to two digits, but at least `least`. The errors are
//! `impact-times`, `impact-speeds`, `peak` and `alpha-time`;
//! `fixtures/references/trajectories.json` has them as `attainable_float64`.
//! An error that is missing there counts as 0, because the motion lacks the
//! quantity. `{attainable}` in `because` shows the largest of the four.

mod attainable;
mod case;
mod defaults;
mod load;
pub mod pinned;
mod wrong;

pub use case::{
    Bound, Case, CaseSource, Cost, EvidenceKind, Expect, Family, OracleKind,
    Tolerance, ToleranceBasis, Values,
};
pub use load::{FAMILIES, load_all, load_family};
pub use wrong::WrongModel;
