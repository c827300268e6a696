//! Suites written as files, and read back.

use rocking::accelerogram::Accelerogram;
use rocking_common::suites::inputs;
use rocking_records::ReadOptions;

use super::support::suites;
use super::{answer, folder, refused};

#[test]
fn exported_suites_are_read_back_bit_for_bit() {
    let folder = folder("export", &[]);
    answer(&folder, "suite export --out out");
    for (name, pairs) in ["ordinary", "pulse"].into_iter().zip(suites()) {
        let path = folder.join("out").join(format!("{name}.csv"));
        let suite = inputs::read_suite(&path, ReadOptions::default()).unwrap();
        let own = pairs.iter().flat_map(|pair| &pair.components);
        let bits = |m: &Accelerogram| -> Vec<u64> {
            m.samples_g().iter().map(|a| a.to_bits()).collect()
        };
        assert_eq!(suite.members().len(), 2 * pairs.len());
        for (member, motion) in suite.members().iter().zip(own) {
            assert_eq!(&member.accelerogram, motion);
            assert_eq!(bits(&member.accelerogram), bits(motion));
        }
        assert_eq!(suite.both().len(), pairs.len());
        for ((study, _), pair) in suite.both().iter().zip(pairs) {
            assert_eq!(study.accelerogram, pair.components[0]);
            let mw: f64 = study.attributes_by_name()["mw"].parse().unwrap();
            assert_eq!(mw, pair.scenario.mw);
        }
    }
    // Once more into the same folder, which is no longer empty.
    let again = "suite export --out out --suite out/pulse.csv";
    let error = refused(&folder, again);
    assert!(error.contains("cannot write out"), "{error}");
    // One of one's own, and a file changed behind the index's back.
    answer(&folder, "suite export --out mine --suite out/pulse.csv");
    let same = |a: &str, b: &str| {
        std::fs::read(folder.join(a)).unwrap()
            == std::fs::read(folder.join(b)).unwrap()
    };
    assert!(same("out/pulse.csv", "mine/pulse.csv"));
    let file = folder.join("mine/pulse/pulse-01-a.at2");
    let text = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, text.replacen("E-0", "E+0", 1)).unwrap();
    let index = folder.join("mine/pulse.csv");
    let error = inputs::read_suite(&index, ReadOptions::default());
    let error = error.unwrap_err().to_string();
    assert!(error.contains("has sha256"), "{error}");
    answer(&folder, "suite export --out x --suite out/pulse.csv --demean");
    let text = std::fs::read_to_string(folder.join("x/pulse.csv")).unwrap();
    assert!(text.contains(",processing,") && text.contains("mean removed"));
    let error = refused(&folder, "suite export --out y --demean");
    assert!(error.contains("--demean is not used without --suite"));
}
