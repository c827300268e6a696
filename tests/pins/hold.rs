//! A pin: a text of this program's own results, in this folder.

use std::fs;
use std::path::Path;

/// Folder for what is found; `rocking accept` sets it.
const ACCEPT: &str = "ROCKING_ACCEPT";

/// Fails where these lines are not the pin `name`. Where `rocking accept`
/// runs the test, it gets the lines instead, and shows how they differ.
#[track_caller]
pub fn hold(name: &str, lines: &[String]) {
    let found = lines.join("\n") + "\n";
    if let Some(folder) = std::env::var_os(ACCEPT) {
        fs::write(Path::new(&folder).join(name), found).unwrap();
        return;
    }
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = own.ancestors().map(|root| root.join("tests/pins"));
    let path = folders.find(|folder| folder.is_dir()).unwrap().join(name);
    let pinned = fs::read_to_string(&path)
        .unwrap_or_else(|error| panic!("tests/pins/{name}: {error}"));
    assert!(
        found == pinned,
        "tests/pins/{name} has\n{pinned}\nfound\n{found}\nIf the change is \
         meant, `cargo run --release -- accept` renews all pins."
    );
}
