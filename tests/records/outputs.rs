//! What becomes of remarks, of places to write to, and of tables that are
//! read again.

use std::io::Write as _;
use std::path::Path;
use std::process::Stdio;

use super::{AT2, answer, failure, folder, json, outcome, refused, support};

/// Exit status, standard output and standard error of the program, with
/// `input` as its standard input.
pub fn rocking(
    folder: &Path,
    arguments: &str,
    input: &str,
) -> (i32, String, String) {
    let mut child = support::rocking(folder, arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that refuses its arguments closes its input.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    outcome(child.wait_with_output().unwrap())
}

/// A wave of `cycles` with an offset (both in g), as two columns.
fn wave(cycles: f64, offset_g: f64) -> String {
    let row = |i: u32| {
        let t = 0.01 * f64::from(i);
        let a = 0.3 * libm::sin(cycles * std::f64::consts::PI * t);
        format!("{t:.2},{:.6}\n", a + offset_g)
    };
    format!("t_s,a_g\n{}", (0..801).map(row).collect::<String>())
}

const IDA: &str = "ida --alpha 0.1 --p 3";

#[test]
fn remarks_travel_to_every_result() {
    let (clean, offset) = (wave(2.0, 0.0), wave(3.0, 0.1));
    let files: [(&str, &[u8]); 2] =
        [("a_E.csv", clean.as_bytes()), ("b_E.csv", offset.as_bytes())];
    let folder = folder("remarks", &files);
    let ida = format!("{IDA} --suite . --out ida.out");
    let out = answer(&folder, &ida);
    let words = "mean is 25.0 % of PGA: instrument offset? PGA is \
                4.000e-1 g, and 3.000e-1 g without the mean (--demean)";
    assert!(out.contains("\nRecords with remarks ") && out.contains(words));
    let table = std::fs::read_to_string(folder.join("ida.out")).unwrap();
    let of_b = table.lines().find(|line| line.starts_with("b_E,")).unwrap();
    assert!(of_b.contains(",end-velocity offset,,0.92,"), "{of_b}");
    let json = json(&folder, &format!("{ida} --json"));
    assert_eq!(json["remarks"]["codes"][0]["code"], "offset");
    assert_eq!(json["version"], env!("CARGO_PKG_VERSION"));
    assert!(json["commit"].as_str().is_some_and(|c| !c.is_empty()));
    let respond = "respond --alpha 0.1 --p 3 --record b_E.csv";
    let (status, out, _) = rocking(&folder, respond, "");
    assert!(status == 0 && out.contains(words), "{out}");
    // The table is no record, and would be set aside.
    std::fs::remove_file(folder.join("ida.out")).unwrap();
    for command in [&*ida, respond, "records b_E.csv"] {
        let strict = format!("{command} --strict");
        let error = failure(&folder, &strict);
        assert!(error.contains("--strict: remarks on 1 of "), "{error}");
    }
    let strict = format!("{ida} --strict --demean --high-pass 0.1");
    assert_eq!(rocking(&folder, &strict, "").0, 0);
    // A folder's file whose direction nothing tells; an index chooses it.
    let offset = folder.join("b_E.csv");
    std::fs::rename(offset, folder.join("b.csv")).unwrap();
    let error = failure(&folder, &strict);
    let words = "1 of 2 records (direction 1); b: direction: neither the";
    assert!(error.contains(words), "{error}");
    std::fs::write(folder.join("index.csv"), "file\na_E.csv\nb.csv").unwrap();
    let strict = strict.replace("--suite .", "--suite index.csv");
    assert_eq!(rocking(&folder, &strict, "").0, 0);
}

/// Two horizontal channels and a vertical one in one file.
#[test]
fn both_components_of_one_file_are_kept() {
    let channel = |number: usize, name: &str| {
        format!(
            "Corrected accelerogram     Nowhere\n\
             Chan  {number}: {name}\n\
             \x20   8 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)\n\
             \x20     .000     1.000  -200.000   300.000  -400.000   500.000  -980.665     7.000\n\
             /&  ----------  End of data for channel  {number}  ----------\n"
        )
    };
    let text = ["90 Deg", "Up", "360 Deg"];
    let text: String =
        text.iter().enumerate().map(|(i, d)| channel(i + 1, d)).collect();
    let folder = folder("channels", &[("x.v2", text.as_bytes())]);
    let both = format!("{IDA} --suite . --component both --out ida.out");
    let out = answer(&folder, &both);
    assert!(out.contains(" of 2 records"), "{out}");
}

#[test]
fn an_input_is_never_an_output() {
    let index = "file,units,dt_s\nx.AT2,,\n";
    let files: [(&str, &[u8]); 2] =
        [("x.AT2", AT2.as_bytes()), ("index.csv", index.as_bytes())];
    let folder = folder("input", &files);
    let commands = [
        format!("{IDA} --suite index.csv --out index.csv"),
        format!("{IDA} --suite index.csv --out ./x.AT2"),
        format!("{IDA} --suite . --out x.AT2"),
        "records x.AT2 --plot x.AT2".to_owned(),
        "respond --alpha 0.1 --p 3 --record x.AT2 --history x.AT2".to_owned(),
    ];
    for command in commands {
        let error = refused(&folder, &command);
        assert!(error.contains("is read: expected another"), "{error}");
    }
    for (file, bytes) in files {
        assert_eq!(std::fs::read(folder.join(file)).unwrap(), bytes);
    }
    // Reported before the work, which would take an hour.
    let command = format!("{IDA} --suite x.AT2 --step-im 1e-5 --out no/x");
    let error = failure(&folder, &command);
    assert!(error.contains("cannot write no/x"), "{error}");
    let command = format!("{IDA} --suite x.AT2 --step-im 1e-9 --out x");
    let error = failure(&folder, &command);
    assert!(error.contains("1.0e11 levels up to the highest IM"), "{error}");
}

#[test]
fn a_file_that_a_table_names_is_an_input() {
    let files: [(&str, &[u8]); 3] = [
        ("sample.txt", b"0.3\n0.5\n0.4\n"),
        ("blocks.csv", b"alpha,p,sample\n0.2,3,sample.txt\n"),
        ("hazard.csv", b"pga_g,annual_frequency\n0.1,0.01\n0.5,0.001\n"),
    ];
    let folder = folder("named-input", &files);
    let risk = "risk --blocks blocks.csv --hazard hazard.csv";
    let error = refused(&folder, &format!("{risk} --plot sample.txt"));
    assert!(error.contains("is read: expected another"), "{error}");
    assert_eq!(std::fs::read(folder.join("sample.txt")).unwrap(), files[0].1);
}

#[cfg(unix)]
#[test]
fn two_outputs_never_go_to_one_file() {
    let folder = folder("two-outputs", &[("x.AT2", AT2.as_bytes())]);
    std::fs::write(folder.join("old"), "old").unwrap();
    std::os::unix::fs::symlink("old", folder.join("link")).unwrap();
    std::os::unix::fs::symlink("new", folder.join("dangling")).unwrap();
    // It would take an hour.
    let ida = format!("{IDA} --suite x.AT2 --step-im 1e-5");
    let respond = "respond --alpha 0.1 --p 3 --record x.AT2";
    for (one, other) in [("old", "link"), ("new", "dangling"), ("-", "-")] {
        for command in [
            format!("{ida} --out {one} --forces {other}"),
            format!("{respond} --history {one} --plot {other}"),
        ] {
            let error = refused(&folder, &command);
            let words = format!(
                "cannot write {other}: another output goes there: expected \
                 a file of its own"
            );
            assert!(error.contains(&words), "{command}: {error}");
        }
    }
    assert_eq!(std::fs::read(folder.join("old")).unwrap(), b"old");
    assert!(!folder.join("new").exists());
}

/// From one record to a fragility, through pipes.
#[test]
fn tables_and_samples_know_what_they_are() {
    let waves = [wave(2.0, 0.0), wave(3.0, 0.0), wave(5.0, 0.0)];
    let files: Vec<(&str, &[u8])> = ["a.csv", "b.csv", "c.csv"]
        .into_iter()
        .zip(&waves)
        .map(|(name, text)| (name, text.as_bytes()))
        .collect();
    let folder = folder("tables", &files);
    let ida = format!("{IDA} --suite . --out -");
    let (status, table, error) = rocking(&folder, &ida, "");
    assert_eq!(status, 0, "{error}");
    assert!(error.starts_with("The block overturns under "), "{error}");
    let capacities = "capacities --ida - --at 1 --out -";
    let (status, sample, error) = rocking(&folder, capacities, &table);
    assert_eq!((status, error.as_str()), (0, ""));
    assert!(sample.starts_with("# Sample of PGA/(g tan alpha) at EDP 1, "));
    assert!(sample.contains("# alpha 0.1 rad, p 3 rad/s, eta 0.92, "));
    let fit = "fragility fit --sample - --shift 1";
    assert_eq!(rocking(&folder, fit, &sample).0, 0);
    let fits = "fragility fit --ida - --at 0.5,1 --shift 1 --json";
    let (status, fits, error) = rocking(&folder, fits, &table);
    assert_eq!((status, error.as_str()), (0, ""));
    let fits: serde_json::Value = serde_json::from_str(&fits).unwrap();
    let one = rocking(&folder, &format!("{fit} --json"), &sample).1;
    let one: serde_json::Value = serde_json::from_str(&one).unwrap();
    assert_eq!(fits["levels"].as_array().unwrap().len(), 2);
    for key in ["n", "fitted", "im50", "unshifted"] {
        assert_eq!(fits["levels"][1][key], one[key], "{key}");
    }
    // Tables of two analyses are not one.
    let other = ida.replace("--p 3", "--p 3 --eta 0.85");
    let (_, other, _) = rocking(&folder, &other, "");
    let rows = other.lines().skip(1).map(|row| row.replacen(',', "2,", 1));
    let mixed = table.clone() + &rows.collect::<Vec<_>>().join("\n");
    let (status, _, error) = rocking(&folder, capacities, &mixed);
    assert_eq!(status, 2);
    assert!(error.contains(": eta is 0.85: expected 0.92, as on"), "{error}");
    // Pairs are made by the records' names, whatever the order.
    let mut lines: Vec<&str> = sample.lines().collect();
    let last = lines.len() - 1;
    lines.swap(2, last);
    let write = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
    };
    write("one.txt", &sample);
    write("two.txt", &(lines.join("\n") + "\n"));
    let compare = "compare --a one.txt --b two.txt";
    let out = answer(&folder, compare);
    assert!(out.starts_with("The ratio a/b is centred at 1 "), "{out}");
    write("two.txt", &sample.replace("# a\n", "# z\n"));
    let error = failure(&folder, compare);
    assert!(error.contains("record a is not in the other sample"), "{error}");
    let place = sample.lines().position(|line| line.ends_with("# a")).unwrap();
    assert!(error.contains(&format!("one.txt:{}: ", place + 1)), "{error}");
    write("two.txt", &sample.replace("EDP 1,", "EDP 0.5,"));
    let error = failure(&folder, compare);
    assert!(error.contains("as the other file"), "{error}");
}

/// A cause is reported once, with the number of its files.
#[test]
fn one_line_a_cause() {
    let names: Vec<String> = (0..12).map(|i| format!("{i:02}.txt")).collect();
    let files: Vec<(&str, &[u8])> =
        names.iter().map(|n| (n.as_str(), &b"0.1\n0.2\n"[..])).collect();
    let folder = folder("causes", &files);
    let error = failure(&folder, "records .");
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(error.contains("--dt") && error.contains("and 11 more files"));
    let (status, ..) = rocking(&folder, "records . --dt 0.01 --units g", "");
    assert_eq!(status, 0);
    for device in ["/dev/zero", "."] {
        let error = failure(&folder, &format!("capacities --ida {device}"));
        assert!(error.contains("expected one, or - for"), "{error}");
    }
    let error = failure(&folder, "records /dev/zero");
    assert!(error.contains("a device or pipe: expected a file"), "{error}");
}
