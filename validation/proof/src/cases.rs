//! Declared cases: what is claimed, by which method it is computed, what is
//! expected and how far off it may be. Data only; nothing here knows physics.
//!
//! # Files of cases
//!
//! A file in `cases` is a family. Each `[[case]]` in it states what sets it apart, and
//! inherits the rest. It has, from weak to strong:
//!
//! 1. `cost = "quick"` and `status = { expect = "pass" }`, as every case;
//! 2. `[family.default]`, as every case of the file;
//! 3. `[family.method.NAME]`, as every case of the file with that method;
//! 4. its own keys.
//!
//! Keys of `source`, `expect`, `expect.values`, `input`, `tolerance` and
//! `tolerance.bounds` are inherited one by one. Every other value replaces
//! the inherited one as a whole: a bound, a list such as `reject`, a table
//! inside `input`. Words stay with what they explain: a case with another
//! `source.cite` inherits no `where` and no `note`, one with another
//! `tolerance.basis` no `because`. `tolerance.without` lists quantities of
//! which the case takes no inherited bound, because its motion lacks them. So
//! every quantity of a method has a bound, and every bound a quantity: the
//! verdict refuses the rest.
//!
//! A value that equals the inherited one is refused, and so is a default that
//! no case inherits.
//!
//! # Entries
//!
//! `entries = ["A-1", "B-2"]` declares one case for each of these entries of a
//! reference. The entry is its `input.entry`, and in lower case its name.
//! `entries = [["A-1", "Claim."]]` gives each entry a claim of its own.
//!
//! # Computed bounds
//!
//! `absolute` and `relative` take a number, or
//! `{ attainable = 100, of = ["peak"], least = 1e-13 }`: 100 times what a
//! careful double-precision code was off by on the entry, the largest of the
//! errors listed, to two digits and never less than `least`. The errors are
//! `impact-times`, `impact-speeds`, `peak` and `alpha-time`; they stand in
//! `fixtures/references/trajectories.json` as `attainable_float64`. An error
//! that is not listed there counts as 0, because the motion lacks the
//! quantity. `{attainable}` in `because` shows the largest of the four.

mod attainable;
mod case;
mod defaults;
mod error;
mod load;
pub mod pinned;
mod wrong;

pub use case::{
    Bound, Case, CaseSource, Cost, EvidenceKind, Expect, Family, OracleKind,
    Status, Tolerance, ToleranceBasis, Values,
};
pub use error::{CaseError, CaseFault};
pub use load::{FAMILIES, load_all, load_family};
pub use wrong::WrongModel;
