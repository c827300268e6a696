//! Every figure from made-up numbers: bytes, form, size, layout.

mod made_up;

use super::Figure;

/// Writes each demonstration figure where `ROCKING_FIGURES` says, to be
/// looked at.
#[test]
fn writes_them_to_be_looked_at() {
    let Ok(folder) = std::env::var("ROCKING_FIGURES") else { return };
    for figure in made_up::all() {
        let name = &figure.heading().name;
        let svg = figure.svg().unwrap();
        std::fs::write(format!("{folder}/{name}.svg"), svg).unwrap();
    }
}
