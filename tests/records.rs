//! Readers and suites on files: real ones where they are, small ones of our
//! own everywhere.

use std::path::PathBuf;

use rocking::record::{ReadOptions, Suite, SuiteOptions};
use rocking::units::STANDARD_GRAVITY_M_S2;

fn real(index: &str) -> Option<PathBuf> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
    let path = root.join("../shared/records").join(index);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: no real records at ../shared/records");
    None
}

fn options() -> SuiteOptions {
    SuiteOptions { read: ReadOptions::default(), sha256_hex: None }
}

#[test]
fn real_suites_meet_their_index() {
    // Reading a suite checks count, PGA and PGV of every file against the
    // index, to 1e-4 relative.
    for (index, pairs) in [("ordinary.csv", 86), ("pulse.csv", 44)] {
        let Some(path) = real(index) else { return };
        let suite = Suite::read(&path, &options()).unwrap();
        assert_eq!(suite.members().len(), 2 * pairs);
        assert_eq!(suite.study_components().count(), pairs);
        assert_eq!(suite.other_components().count(), pairs);
        assert_eq!(suite.both().len(), pairs);
        for member in suite.members() {
            let motion = &member.accelerogram;
            assert!(motion.pga_g() > 0.14, "{}", member.file);
            assert!(motion.pgv_m_s(STANDARD_GRAVITY_M_S2) > 0.0);
            assert!(member.attributes.contains_key("event"));
        }
    }
}
