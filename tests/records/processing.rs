//! What is done to records on request, and recorded motions that ship.

use std::path::Path;

use rocking::accelerogram::Accelerogram;
use rocking_common::suites::inputs;
use rocking_records::{Processing, ReadOptions};
use sha2::{Digest as _, Sha256};

use super::{answer, failure, folder, json};

fn fixture(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name)
}

/// The same zeros, filter and directions by SciPy; `high_pass.py` has the
/// settings.
#[test]
fn the_high_pass_is_scipys() {
    let text =
        std::fs::read_to_string(fixture("oracles/high_pass.csv")).unwrap();
    let cells: Vec<(&str, f64)> = text
        .lines()
        .skip(1)
        .map(|line| line.split_once(',').unwrap())
        .map(|(raw, filtered)| (raw, filtered.parse().unwrap()))
        .collect();
    let raw = cells.iter().filter_map(|(raw, _)| raw.parse().ok()).collect();
    let raw = Accelerogram::try_new("x", 0.02, raw).unwrap();
    assert_eq!(raw.samples_g().len(), 200);
    let found = Processing::try_new(true, Some(0.8)).unwrap();
    let found = found.apply(&raw).unwrap();
    assert_eq!(found.samples_g().len(), cells.len());
    let pairs = found.samples_g().iter().zip(&cells);
    let off = pairs.fold(0.0, |off: f64, (a, (_, b))| off.max((a - b).abs()));
    // Rounding, 950 steps twice through two sections: samples of 0.3 g.
    assert!(off <= 1e-13, "{off:e}");
    let wrong = Processing::try_new(false, Some(0.8)).unwrap();
    let wrong = wrong.apply(&raw).unwrap();
    let pairs = wrong.samples_g().iter().zip(&cells);
    assert!(pairs.map(|(a, (_, b))| (a - b).abs()).any(|d| d > 1e-4));
}

#[test]
fn the_ridgecrest_records_are_the_originals_and_are_read() {
    let path = fixture("records/ridgecrest.zip");
    // What MANIFEST.toml says of the files as the package has them.
    let sums = [
        (
            "CICCC.RAW",
            "36f3e1828cc6753d74713b141a453ea361b4c31cfe813a248f18711ae4ac98e0",
        ),
        (
            "CICLC.v1",
            "ca29380a432a15142814322eec1a0bf199b15016a0e98548bdfcbba4ed9c0079",
        ),
        (
            "CITOW2.RAW",
            "15fd29c135fd54a2c155c2ab17535bec53e550168931661d48fd853f6c005a1d",
        ),
    ];
    let file = std::fs::File::open(&path).unwrap();
    let mut archive = zip::ZipArchive::new(file).unwrap();
    assert_eq!(archive.len(), sums.len());
    for (name, sum) in sums {
        let mut hash = Sha256::new();
        std::io::copy(&mut archive.by_name(name).unwrap(), &mut hash).unwrap();
        assert_eq!(format!("{:x}", hash.finalize()), sum, "{name}");
    }
    let suite = inputs::read_suite(&path, ReadOptions::default()).unwrap();
    // Points and maxima as the files' own headers state them.
    let stated = [
        ("CICCC:1_90_Deg", 35430, 0.567),
        ("CICCC:2_360_Deg", 35402, 0.471),
        ("CICLC:1_90_Deg", 31932, 0.344),
        ("CICLC:2_360_Deg", 32080, 0.511),
        ("CITOW2:1_90_Deg", 35562, 0.437),
        ("CITOW2:2_360_Deg", 35540, 0.386),
    ];
    assert_eq!(suite.members().len(), stated.len());
    for (member, (name, count, pga_g)) in suite.members().iter().zip(stated) {
        let motion = &member.accelerogram;
        assert_eq!(motion.name(), name);
        assert_eq!(member.format.name, "cosmos");
        assert_eq!(motion.dt_s(), 0.01);
        assert_eq!(motion.samples_g().len(), count);
        assert!((motion.pga_g() - pga_g).abs() <= 0.0005, "{name}");
    }
    assert_eq!((suite.both().len(), suite.set_aside().all().len()), (3, 3));
}

#[test]
fn a_drawing_and_the_words_go_with_the_processing() {
    let zip = fixture("records/ridgecrest.zip");
    let zip = zip.to_str().unwrap();
    let folder = folder("processing", &[]);
    let out =
        answer(&folder, &format!("records {zip} --demean --high-pass 0.1"));
    assert!(out.contains(" mean removed; Butterworth high-pass"));
    let json = json(&folder, &format!("records {zip} --json --high-pass 0.1"));
    let words = json["processing"].as_str().unwrap();
    assert!(words.contains("60 s of zeros"), "{words}");
    let error = failure(&folder, &format!("records {zip} --plot x.svg"));
    assert!(error.contains("--plot: 6 records: expected one"), "{error}");
    let error = failure(&folder, &format!("records {zip} --high-pass -1"));
    assert!(error.contains("corner -1 Hz: expected a positive"), "{error}");
    let wave: String = (0..3000)
        .map(|i| 0.01 * f64::from(i))
        .map(|t| format!("{t:.2},{:.6}\n", 0.3 * libm::sin(6.0 * t)))
        .collect();
    let wave = format!("t_s,a_g\n{wave}");
    std::fs::write(folder.join("wave.csv"), wave).unwrap();
    answer(&folder, "records wave.csv --plot wave.svg");
    let svg = std::fs::read_to_string(folder.join("wave.svg")).unwrap();
    assert!(svg.contains("Response spectrum") && svg.len() < 150_000);
}
