//! What reading takes in memory: no more than 64 MiB for 1 MiB of anything.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use peak_alloc::PeakAlloc;

#[path = "../fuzz/targets.rs"]
mod targets;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

const MIB: usize = 1 << 20;

/// Beginnings that lead a reader on, and what then goes on for 1 MiB.
fn hostile() -> Vec<(String, Vec<u8>)> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus");
    let mut seeds = vec![(String::new(), Vec::new())];
    for (target, _) in targets::TARGETS {
        for entry in fs::read_dir(corpus.join(target)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.display().to_string();
            if name.contains("valid-") || name.contains("announces") {
                seeds.push((name, fs::read(path).unwrap()));
            }
        }
    }
    let columns: String = (0..1000).map(|i| format!("c{i},")).collect();
    seeds.push(("columns".to_owned(), format!("file,{columns}\n").into()));
    let long = "n".repeat(64);
    seeds.push(("names".to_owned(), format!("{long},file\n").into()));
    let empty = format!("x{}\n", ",".repeat(1001));
    let fills: [&[u8]; 15] = [
        b"0,0\n",
        b"1,",
        b"-1",
        b"1.",
        b"\xe9",
        b"\"\"",
        b"   .1000000E-02  -.2000000E-02   .3000000E-02   .4000000E-02  -.5000000E-02\n",
        b"10 acceleration pts, units=cm/sec2, Format=(8F10.3)\n",
        b"10 points of accel data equally spaced at .02 sec, in cm/sec2. (8f10.3)\n     1.000     1.000     1.000     1.000     1.000     1.000     1.000     1.000\n     1.000     1.000\n",
        b"a,0.01\n",
        empty.as_bytes(),
        b"\n",
        b"0\n",
        b"1 ",
        b"1,2\n",
    ];
    let mut inputs = Vec::new();
    for (name, seed) in &seeds {
        // After a valid header, what a sample or a line costs.
        let fills = if seed.is_empty() { &fills[..] } else { &fills[9..] };
        for fill in fills {
            let mut bytes = seed.clone();
            while bytes.len() < MIB {
                bytes.extend(*fill);
            }
            bytes.truncate(MIB);
            let with = String::from_utf8_lossy(&fill[..fill.len().min(20)]);
            inputs.push((format!("{name} and {with:?}"), bytes));
        }
    }
    inputs
}

/// Whether a target is meant for such a file: `any` for all of them.
fn meant(target: &str, name: &str) -> bool {
    let own = name.contains(&format!("corpus/{target}/"));
    own || !name.contains("corpus/")
}

#[test]
fn a_megabyte_takes_no_more_than_sixty_four() {
    let mut most: BTreeMap<&str, (usize, String)> = BTreeMap::new();
    for (name, bytes) in hostile() {
        for (target, _) in targets::TARGETS {
            if !meant(target, &name) {
                continue;
            }
            let before = ALLOCATOR.current_usage();
            ALLOCATOR.reset_peak_usage();
            let _ = targets::run(target, &bytes);
            let used = ALLOCATOR.peak_usage() - before;
            let most = most.entry(*target).or_default();
            if used > most.0 {
                *most = (used, name.clone());
            }
        }
    }
    for (target, (used, name)) in &most {
        println!("{target}: {} MiB for {name}", used / MIB);
    }
    assert_eq!(most.len(), targets::TARGETS.len());
    assert!(most.values().all(|(used, _)| *used <= 64 * MIB));
}
