//! The command line on bad input, at the edge of uplift, and as a program
//! among others: exit status, messages, files, pipes, threads.

use std::fs;
use std::io;
use std::process::Stdio;

use rocking::excitation::{PulseName, PulseParameter};
use serde_json::Value;

#[path = "cli/assess.rs"]
mod assess;
#[path = "cli/diff.rs"]
mod diff;
#[path = "cli/grazing.rs"]
mod grazing;
#[path = "cli/limits.rs"]
mod limits;
#[path = "cli/means.rs"]
mod means;
#[path = "cli/opens.rs"]
mod opens;
#[path = "cli/order.rs"]
mod order;
#[path = "cli/plots.rs"]
mod plots;
#[cfg(unix)]
#[path = "cli/stopped.rs"]
mod stopped;
#[path = "cli/sweep.rs"]
mod sweep;
#[path = "cli/tables.rs"]
mod tables;
#[path = "cli/texts.rs"]
mod texts;
#[path = "cli/validate.rs"]
mod validate;

use super::support::{
    self, answer, at2, close, folder, json, motion, refused, refused_for,
    rocking,
};

const BLOCK: &str = "--alpha 0.1 --p 3";

#[test]
fn broken_records_give_one_message_and_no_file() {
    let whole = motion(9.0);
    let good = at2("0.02", whole.len(), &whole);
    let cut = &good[..good.len() - 7];
    let missing = at2("0.02", whole.len(), &whole[..140]);
    let with_nan = "0.1\n0.2\nNaN\n0.1\n";
    let backwards = at2("-0.02", whole.len(), &whole);
    let cases: [(&str, &str, &[&str]); 6] = [
        ("cut.at2", cut, &["cut.at2", ":34:"]),
        ("missing.at2", &missing, &["missing.at2", "140", "150"]),
        ("empty.at2", "", &["empty.at2", "empty"]),
        ("blank.at2", "\n \n", &["blank.at2"]),
        ("backwards.at2", &backwards, &["backwards.at2", "-0.02"]),
        ("nan.txt", with_nan, &["nan.txt", ":3:", "NaN"]),
    ];
    for (name, text, mentions) in cases {
        let place = folder(name, &[("one.at2", &good), (name, text)]);
        let dt = if name == "nan.txt" { "--dt 0.01 --units g" } else { "" };
        let respond = format!(
            "respond {BLOCK} --record {name} {dt} --history history.csv --json"
        );
        refused_for(&place, &respond, mentions);
        if name == "nan.txt" {
            // A folder takes only files that say their own interval.
            continue;
        }
        let ida = format!("ida {BLOCK} --suite . --out ida.csv");
        refused_for(&place, &ida, &mentions[..1]);
        let study = "study --ordinary . --pulse . --out report";
        refused_for(&place, study, &mentions[..1]);
    }
}

#[test]
fn bad_numbers_are_refused_with_their_flag() {
    let text = at2("0.02", 150, &motion(9.0));
    let place = folder("numbers", &[("s/a.at2", &text), ("c.txt", "1\n2\n")]);
    let sine = "--pulse one-sine --amplitude-m-s2 1.5 --omega-rad-s 12";
    for (arguments, name) in [
        ("respond --alpha -0.1 --p 3 --free --initial-ratio 0.5", "-0.1"),
        ("respond --alpha NaN --p 3 --free --initial-ratio 0.5", "NaN"),
        ("respond --alpha 0.1 --p 0 --free --initial-ratio 0.5", "0"),
        ("respond --alpha 0.1 --p 3 --free --initial-ratio 1", "ratio 1"),
        ("respond --alpha 0.1 --p 3 --free --initial-ratio inf", "ratio inf"),
        ("respond --alpha 0.1 --p 3 --record c.txt --dt -0.01", "-0.01"),
        ("respond --alpha 0.1 --p 3 --record c.txt", "c.txt"),
        ("ida --alpha 0.1 --p 3 --suite s --step-g 0 --out o.csv", "0"),
        ("ida --alpha 0.1 --p 3 --suite s --step-im NaN --out o.csv", "NaN"),
        ("ida --alpha 0.1 --p 3 --suite s --threads 0 --out o.csv", "0"),
        ("study --engine scalar --isa baseline --out report", "--isa"),
        ("study --eta 1.1 --out report", "1.1"),
        ("study --refine -1 --out report", "-1"),
    ] {
        let error = refused(&place, arguments);
        assert!(error.contains(name), "{arguments}: {error}");
    }
    for (flag, value) in [
        ("--eta", "0"),
        ("--eta", "1.01"),
        ("--gravity", "-9.81"),
        ("--im", "0"),
        ("--im", "NaN"),
        ("--pga", "-0.2"),
        ("--scale", "inf"),
        ("--until", "-1"),
    ] {
        let arguments = format!("respond {BLOCK} {sine} {flag} {value}");
        let error = refused(&place, &arguments);
        assert!(error.contains(value), "{arguments}: {error}");
    }
}

#[test]
fn unknown_flags_are_refused_by_every_command() {
    let place = folder("flags", &[]);
    let help = answer(&place, "--help");
    let commands = texts::subcommands(&help);
    assert!(commands.len() >= 11, "{commands:?}");
    for command in commands {
        let error = refused(&place, &format!("{command} --no-such 1"));
        assert!(error.contains("--no-such"), "{command}: {error}");
    }
    assert!(refused(&place, "no-such-command").contains("no-such-command"));
}

#[test]
fn a_flag_that_the_pulse_does_not_use_is_refused() {
    let place = folder("pulses", &[]);
    for pulse in PulseName::ALL {
        let chosen = format!("respond {BLOCK} --pulse {pulse}");
        let used = pulse.parameters();
        let given: String =
            used.iter().map(|flag| format!(" --{flag} 1.5")).collect();
        let response = json(&place, &format!("{chosen}{given} --json"));
        assert!(response["outcome"].is_string(), "{pulse}");
        for flag in PulseParameter::ALL {
            let without = given.replace(&format!(" --{flag} 1.5"), "");
            let arguments = if !used.contains(&flag) {
                format!("{chosen}{given} --{flag} 1.5")
            } else if flag.default_value().is_none() {
                format!("{chosen}{without}")
            } else {
                continue;
            };
            refused_for(&place, &arguments, &[flag.name(), pulse.name()]);
        }
    }
    for (arguments, flag) in [
        ("--free --initial-ratio 0.5 --gamma 2", "--gamma"),
        ("--free --initial-ratio 0.5 --im 2", "--im"),
        ("--free --initial-ratio 0.5 --dt 0.01", "--dt"),
        ("--pulse triangle --duration-s 1 --units g", "--units"),
        ("--free --initial-ratio 0.5 --im-kind pgv", "--im"),
        ("--record x.at2 --scale 2 --im-kind pgv", "--im"),
        ("--pulse triangle --duration-s 1 --initial-ratio 0.5", "--initial"),
        ("--pulse triangle --duration-s 1 --record x.at2", "--record"),
    ] {
        let error = refused(&place, &format!("respond {BLOCK} {arguments}"));
        assert!(error.contains(flag), "{arguments}: {error}");
    }
}

#[test]
fn uplift_begins_just_above_intensity_one() {
    // The record peaks at one sample, t = 0.4 s.
    let peak: Vec<f64> =
        (0..60).map(|i| 0.03 * f64::from(20 - (i - 20_i32).abs())).collect();
    let text = at2("0.02", peak.len(), &peak);
    let place = folder("uplift", &[("peak.at2", &text)]);
    // Half a period of the sine is over at t = 0.5 s, its peak at half.
    let sine = "--pulse half-sine --amplitude-m-s2 3 --omega-rad-s \
                6.283185307179586";
    for (excitation, peak_s) in [("--record peak.at2", 0.4), (sine, 0.25)] {
        for alpha in ["0.05", "0.2500001"] {
            for model in ["nonlinear", "linearized"] {
                let at = |im: &str| {
                    let arguments = format!(
                        "respond --alpha {alpha} --p 2.1 --model {model} \
                         {excitation} --im {im} --json"
                    );
                    json(&place, &arguments)
                };
                let still = at("1");
                // At the threshold itself the doubles decide.
                assert_eq!(still["counts_as"], "no-uplift", "{excitation}");
                assert_eq!(still["peak_ratio"], 0.0);
                assert_eq!(still["uplift_time_s"], Value::Null);
                let moved = at("1.000000001");
                let uplift_s = moved["uplift_time_s"].as_f64().unwrap();
                assert!((uplift_s - peak_s).abs() < 1e-4, "{uplift_s}");
                assert!(uplift_s < peak_s + 1e-12, "{uplift_s}");
                assert!(moved["peak_ratio"].as_f64().unwrap() > 0.0);
            }
        }
    }
}

#[test]
fn a_block_may_be_given_by_its_size() {
    let place = folder("size", &[]);
    let sine = "--pulse one-sine --amplitude-m-s2 3 --omega-rad-s 12 --json";
    let by_size =
        json(&place, &format!("respond --width-m 0.3 --height-m 1.5 {sine}"));
    // atan(0.3/1.5).
    close(&by_size["scene"]["alpha_rad"], 0.197_395_559_849_880_77, 1e-15);
    for half in ["--width-m 0.3", "--height-m 1.5", "--alpha 0.2 --width-m 1"]
    {
        let _ = refused(&place, &format!("respond {half} {sine}"));
    }
}

#[test]
fn json_is_json_and_says_no_more_than_was_asked_for() {
    let text = at2("0.02", 150, &motion(9.0));
    let samples = "1.2\n1.5\n1.31\n2.2\n1.9\n1.05\n3.1\n1.44\n1.6\n2.6\n";
    let other = "1.3\n1.4\n1.3\n2.4\n1.8\n1.15\n3.3\n1.4\n1.7\ninf\n";
    let place = folder(
        "json",
        &[
            ("s/a.at2", &text),
            ("a.txt", samples),
            ("b.txt", other),
            ("named.txt", "1.3 # x\ninf # y\n2.4 # z\n"),
        ],
    );
    let sine = "--pulse one-sine --omega-rad-s 12 --amplitude-m-s2";
    for scene in [
        format!("{BLOCK} {sine} 0.5"),
        format!("{BLOCK} {sine} 1.5"),
        format!("{BLOCK} {sine} 1.5 --until 0.3"),
        format!("{BLOCK} {sine} 1.5 --certify"),
        format!("{BLOCK} {sine} 1.5 --until 0.3 --certify"),
        format!("{BLOCK} {sine} 9"),
        format!("{BLOCK} {sine} 9 --overturn half-pi --model linearized"),
        format!("{BLOCK} --free --initial-ratio 0.9 --eta 1 --until 9"),
        format!("{BLOCK} --free --initial-ratio 0.9 --eta housner"),
        format!("{BLOCK} --record s/a.at2 --im 3 --im-kind pgv"),
    ] {
        let response = json(&place, &format!("respond {scene} --json"));
        let overturned = response["counts_as"] == "overturned";
        assert_eq!(response["overturning_time_s"].is_null(), !overturned);
        assert_eq!(response["edp"].is_null(), overturned, "{scene}");
        let certified = scene.contains("--certify");
        assert_eq!(response["certified"].is_null(), !certified, "{scene}");
        assert!(response["forces"].is_null());
    }
    for arguments in [
        "ida --alpha 0.1 --p 3 --suite s --out ida.csv",
        "capacities --curve 1:0,1.1:0.2,1.2:0.5 --overturning 1.7",
        "fragility fit --sample a.txt --shift 1",
        "fragility transform --im50 1.05 --beta 0.5 --shift 1 --c 1",
        "lilliefors --sample a.txt --log",
        "lilliefors --critical-values --n 10 --replicates 500",
        "sample --sample b.txt --at 0.5,1",
        "compare --a named.txt --b named.txt",
        "contrast --a a.txt --b b.txt --bootstrap 20",
    ] {
        let text = answer(&place, &format!("{arguments} --json"));
        let _: Value = serde_json::from_str(&text).unwrap();
        assert!(!text.contains("NaN") && !text.contains("nan"), "{arguments}");
        let people = answer(&place, arguments);
        assert!(!people.contains("NaN"), "{arguments}: {people}");
    }
}

/// Observation that ends at the time of overturning which the program printed
/// itself, or next to it.
#[test]
fn an_end_at_the_overturning_is_unresolved_and_certified() {
    let place = folder("until", &[]);
    let scene = format!(
        "respond {BLOCK} --pulse one-sine --omega-rad-s 12 \
         --amplitude-m-s2 9 --json"
    );
    let whole = json(&place, &scene);
    assert_eq!(whole["outcome"], "overturned");
    let time_s = whole["overturning_time_s"].as_f64().unwrap();
    let mut fates = Vec::new();
    for (until_s, is_clear) in [
        (time_s * (1.0 - 1e-10), true),
        (time_s.next_down(), false),
        (time_s, false),
        (time_s.next_up(), false),
        (time_s * (1.0 + 1e-10), true),
    ] {
        let cut = format!("{scene} --until {until_s} --certify");
        let found = json(&place, &cut);
        let clear = &found["certificate"]["clear"];
        assert_eq!(clear.as_bool(), Some(is_clear), "{cut}");
        let fate = found["certified"]["outcome"].as_str().unwrap();
        fates.push(fate.to_owned());
        if !is_clear {
            assert_eq!(found["outcome"], "unresolved");
            assert_eq!(found["certificate"]["least"]["decision"], "end");
            assert_eq!(found["certified"]["resolved_for_inputs"], false);
        }
    }
    assert_eq!(
        (fates[0].as_str(), fates[4].as_str()),
        ("rocked", "overturned")
    );
    // Overturned once and for all.
    assert!(fates.is_sorted_by_key(|fate| fate == "overturned"), "{fates:?}");
}

#[test]
fn threads_and_engine_do_not_change_a_byte() {
    let motions: Vec<(String, String)> = (0..9)
        .map(|i| {
            let name = format!("suite/{i}.at2");
            (name, at2("0.02", 150, &motion(4.0 + f64::from(i))))
        })
        .collect();
    let files: Vec<(&str, &str)> =
        motions.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let place = folder("engines", &files);
    let ida = |name: &str, how: &str| {
        let out = answer(
            &place,
            &format!(
                "ida --alpha 0.15 --p 4 --suite suite --step-im 0.1 \
                 {how} --out {name}.csv --json"
            ),
        );
        let table = fs::read(place.join(format!("{name}.csv"))).unwrap();
        (out, table)
    };
    let mut tables = Vec::new();
    for order in ["", " --order 4", " --order 6", " --order 8"] {
        let (summary, table) = ida("1", &format!("--threads 1{order}"));
        assert!(table.len() > 2_000, "{summary}");
        for (name, how) in [
            ("2", "--threads 2"),
            ("5", "--threads 5"),
            ("baseline", "--isa baseline --threads 1"),
            ("scalar", "--engine scalar --threads 2"),
            ("each", "--block-samples 1"),
            ("blocks", "--block-samples 301"),
        ] {
            let (other, same) = ida(name, &format!("{how}{order}"));
            let other = other.replace(&format!("{name}.csv"), "1.csv");
            assert_eq!(other, summary);
            assert!(same == table, "{how}{order}");
        }
        tables.push(table);
    }
    // An order is kept: its error shows.
    tables.dedup();
    assert_eq!(tables.len(), 4);
}

#[test]
fn a_closed_pipe_ends_quietly() {
    let place = folder("pipe", &[]);
    let sine = "--pulse one-sine --amplitude-m-s2 1.5 --omega-rad-s 12";
    for arguments in [
        format!("respond {BLOCK} {sine} --json"),
        format!("respond {BLOCK} {sine}"),
        "capacities --curve 1:0,1.1:0.2 --json".to_owned(),
        "--help".to_owned(),
    ] {
        let (reader, writer) = io::pipe().unwrap();
        drop(reader);
        let child = rocking(&place, &arguments)
            .stdout(writer)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments}");
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(error, "", "{arguments}");
    }
}

#[test]
fn a_file_that_cannot_be_written_is_said_and_leaves_nothing() {
    let text = at2("0.02", 150, &motion(9.0));
    let place = folder("unwritable", &[("s/a.at2", &text)]);
    fs::create_dir(place.join("taken.csv")).unwrap();
    for out in ["absent/ida.csv", "taken.csv"] {
        let ida = format!("ida {BLOCK} --suite s --out {out}");
        refused_for(&place, &ida, &[out]);
        let history =
            format!("respond {BLOCK} --record s/a.at2 --im 2 --history {out}");
        refused_for(&place, &history, &[out]);
    }
}
