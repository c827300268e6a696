//! How often the files of a suite are read, on how many threads.

use std::fmt::Write as _;

use super::support::{at2, folder, motion, refused};

/// Ten pairs. A study uses one record of each.
fn pairs() -> Vec<(String, String)> {
    let file = |k: usize| {
        let samples = motion(9.0 + k as f64 / 20.0).repeat(80);
        let end = if k.is_multiple_of(2) { "000" } else { "090" };
        let name = format!("suite/r{:02}-{end}.at2", k / 2);
        (name, at2("0.02", samples.len(), &samples))
    };
    (0..20).map(file).collect()
}

/// A parent accounts for the bytes that its children read.
#[cfg(target_os = "linux")]
#[test]
fn each_file_is_read_once_or_twice_if_it_is_used_again() {
    use std::process::Command;

    let files = pairs();
    let all: usize = files.iter().map(|(_, text)| text.len()).sum();
    let files: Vec<_> = files.iter().map(|(n, t)| (&**n, &**t)).collect();
    let place = folder("opens", &files);
    let account = |arguments: &str| {
        let shell = "\"$0\" \"$@\" >/dev/null; cat /proc/$$/io";
        let out = Command::new("sh")
            .args(["-c", shell, env!("CARGO_BIN_EXE_rocking")])
            .args(arguments.split_whitespace())
            .current_dir(&*place)
            .output()
            .unwrap();
        let text = String::from_utf8(out.stdout).unwrap();
        let read = text.lines().find_map(|line| line.strip_prefix("rchar: "));
        read.map(|read| read.parse::<usize>().unwrap())
    };
    // Some systems keep no account.
    let Some(nothing) = account("--version") else { return };
    let ida = "ida --alpha 0.3 --p 4 --suite suite --step-im 9 --out o.csv";
    for (how, most) in [
        ("--threads 1", 1.0),
        ("--threads 2", 1.0),
        ("--threads 2 --block-samples 1", 1.5),
        ("--threads 2 --block-samples 1 --component both", 2.0),
    ] {
        let read = account(&format!("{ida} {how}")).unwrap() - nothing;
        let share = read as f64 / all as f64;
        assert!(share > most - 0.1 && share < most + 0.1, "{how}: {share}");
    }
}

/// The first fault of the order is reported, however many threads read, and
/// all of them by `records`.
#[test]
fn faults_do_not_depend_on_threads_or_blocks() {
    let whole = motion(9.0);
    let good = at2("0.02", whole.len(), &whole);
    let cut = &good[..good.len() - 7];
    let missing = at2("0.02", whole.len(), &whole[..140]);
    let slow = at2("0.04", whole.len(), &whole.repeat(40));
    let files = [
        ("suite/a.at2", &*slow),
        ("suite/b.at2", &good),
        ("suite/c.at2", &missing),
        ("suite/d.at2", cut),
        ("suite/e.txt", "0.1\nNaN\n"),
    ];
    let place = folder("faults", &files);
    let mut index = String::from("file,npts\nb.at2,150\nb.at2,151\n");
    writeln!(index, "d.at2,\nno.at2,").unwrap();
    std::fs::write(place.join("suite/i.csv"), index).unwrap();
    let said = |suite: &str, how: &str| {
        let ida = format!("ida --alpha 0.1 --p 3 --suite {suite} --out o.csv");
        refused(&place, &format!("{ida} {how}"))
    };
    for (suite, expected) in [("suite", "a.at2"), ("suite/i.csv", "b.at2")] {
        let one = said(suite, "--threads 1");
        assert!(one.contains(expected), "{one}");
        for how in ["--threads 2", "--threads 5 --block-samples 1"] {
            assert_eq!(said(suite, how), one, "{suite} {how}");
        }
    }
}
