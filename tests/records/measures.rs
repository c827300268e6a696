//! Intensity measures and velocity pulses of files.

use rayon::prelude::*;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::Suite;
use rocking_records::intensity::velocity_pulse::{candidates, pulse};

use super::{answer, folder, json, options, real, refused};

/// The pulse periods of the index are those of Shahi and Baker's own list,
/// for motions turned and processed by their database.
#[test]
fn pulse_periods_of_real_pairs_are_those_of_the_list() {
    let mut counts = Vec::new();
    for index in ["pulse.csv", "ordinary.csv"] {
        let Some(path) = real(index) else { return };
        let suite = Suite::read(&path, &options()).unwrap();
        // Every seventh pair: all of them take 45 s of two processors. Of
        // fewer than ten ordinary pairs, one pulse is more than the tenth
        // allowed below.
        let pairs: Vec<_> = suite.both().into_iter().step_by(7).collect();
        let found: Vec<(Option<f64>, Option<f64>)> = pairs
            .par_iter()
            .map(|(study, other)| {
                let pair = (&study.accelerogram, &other.accelerogram);
                let all = candidates(pair.0, pair.1, STANDARD_GRAVITY_M_S2);
                let all = all.expect("a pair of one interval");
                let own = pulse(&all).map(|c| c.period_s);
                (
                    own,
                    study.attributes_by_name()["pulse_period_s"].parse().ok(),
                )
            })
            .collect();
        let pairs = found.len();
        let pulses = found.iter().filter(|(own, _)| own.is_some()).count();
        let mut ratios: Vec<f64> = found
            .iter()
            .filter_map(|(own, listed)| Some((*own)? / (*listed)?))
            .collect();
        counts.push((pulses, pairs));
        println!("{index}: {pulses} of {pairs} pairs have a pulse");
        if ratios.is_empty() {
            continue;
        }
        ratios.sort_by(f64::total_cmp);
        let near = |r: &&f64| (1.0 / 1.2..=1.2).contains(*r);
        let near = ratios.iter().filter(near).count();
        let median = ratios[ratios.len() / 2];
        println!(
            "periods over the listed ones: median {median:.3}, {near} of {} \
             within 20 %",
            ratios.len()
        );
        assert!((median - 1.0).abs() < 0.02);
        assert!(10 * near >= 9 * ratios.len());
    }
    // Nearly all of the pulse-type pairs, and few of the ordinary ones.
    assert!(10 * counts[0].0 >= 9 * counts[0].1, "{counts:?}");
    assert!(10 * counts[1].0 <= counts[1].1, "{counts:?}");
}

/// One cycle of 2 s, one value a line; its velocity peaks at 0.31 m/s for
/// 0.1 g.
fn cycle(scale: f64) -> String {
    let line = |i: u32| {
        let t = 0.01 * f64::from(i) - 3.0;
        let moves = (0.0..2.0).contains(&t);
        let shape = libm::cos(std::f64::consts::PI * t);
        format!("{:.7}\n", if moves { scale * shape } else { 0.0 })
    };
    (0..1000).map(line).collect()
}

/// A folder with a pair, `suite.csv`, `one.txt` and `other.txt`.
fn pair(name: &str) -> crate::support::Place {
    let (one, other) = (cycle(0.2), cycle(0.1));
    let index = "file,units,dt_s,pair\n\
                 one.txt,g,0.01,a\nother.txt,g,0.01,a\n";
    let files: [(&str, &[u8]); 3] = [
        ("suite.csv", index.as_bytes()),
        ("one.txt", one.as_bytes()),
        ("other.txt", other.as_bytes()),
    ];
    folder(name, &files)
}

#[test]
fn measures_and_pulses_of_a_pair_are_listed() {
    let folder = pair("measures");
    let listed = "records suite.csv --intensity --rotd 50,100 --periods 0.5,1 \
                  --pulses";
    let own = json(&folder, "records suite.csv --intensity --p 3");
    let json = json(&folder, listed);
    let first = &json["intensity"][0];
    assert!((first["pga_g"].as_f64().unwrap() - 0.2).abs() < 1e-6);
    assert_eq!(json["periods_s"][1], 1.0);
    let rotated = &json["intensity"][3];
    assert_eq!(
        (&rotated["of"], &rotated["component"]),
        (&"a".into(), &"RotD50".into())
    );
    // The second is half the first: RotD50 is sqrt(1.25) |cos| of it.
    let median = rotated["pga_g"].as_f64().unwrap();
    assert!((median / 0.2 - f64::sqrt(1.25 / 2.0)).abs() < 0.01, "{median}");
    let largest = &json["intensity"][4];
    assert_eq!(largest["component"], "RotD100");
    let largest = largest["pga_g"].as_f64().unwrap();
    assert!((largest / 0.2 - f64::sqrt(1.25)).abs() < 1e-4, "{largest}");
    let sa = own["intensity"][0]["spectral_acceleration_g"].as_array();
    let logs = sa.unwrap().iter().map(|g| libm::log(g.as_f64().unwrap()));
    let mean = libm::exp(logs.sum::<f64>() / 12.0);
    let average = own["intensity"][0]["average_sa_g"].as_f64().unwrap();
    assert!((average / mean - 1.0).abs() < 1e-12, "{average} {mean}");
    assert_eq!(own["periods_s"][0], 0.3142);
    assert!(first["average_sa_g"].is_null());
    let pulses = json["velocity_pulses"].as_array().unwrap();
    let pulse = pulses.iter().find(|row| row["pulse"] == true).unwrap();
    let period = pulse["period_s"].as_f64().unwrap();
    assert!((period - 2.0).abs() < 0.4, "{period}");
    // Samples in g are half as many m/s2 where gravity is half as strong.
    let half = "records suite.csv --pulses --gravity 4.903325";
    let half = super::json(&folder, half);
    let fast = |of: &serde_json::Value| {
        of["velocity_pulses"][0]["pgv_m_s"].as_f64().unwrap()
    };
    assert!((fast(&json) / fast(&half) - 2.0).abs() < 1e-12);
    let out = answer(
        &folder,
        "records --intensity --pulses --dt 0.01 --units g one.txt other.txt",
    );
    for word in ["Arias intensity (m/s)", "RotD50", "geometric mean", "pulses"]
    {
        assert!(out.contains(word), "{word} not in {out}");
    }
}

#[test]
fn a_displacement_of_a_drifting_baseline_is_remarked() {
    // A hundredth of g too much: 0.5 a t^2 is 19.6 m after 20 s.
    let text = "0.01\n".repeat(2000);
    let folder = folder("drift", &[("raw.txt", text.as_bytes())]);
    let words = "records raw.txt --intensity --dt 0.01 --units g";
    let listed = |own: &str| answer(&folder, &format!("{words} {own}"));
    let drift = "PGD 19.6 m: no baseline correction; see --high-pass";
    assert!(listed("").contains(drift), "{}", listed(""));
    let json = json(&folder, words);
    let remarks = json["remarks"].as_array().unwrap();
    assert!(remarks.iter().any(|r| r["code"] == "drift"), "{remarks:?}");
    assert!(!listed("--high-pass 0.5").contains("drift"));
}

#[test]
fn what_cannot_be_asked_for_is_refused() {
    let folder = pair("refused-measures");
    for (own, word) in [
        ("--pulses", "two components"),
        ("--periods 1", "--intensity"),
        ("--intensity --p 0", "--p 0: expected 0.001 to 1000"),
        ("--intensity --p 3 --periods 1", "cannot be used"),
        ("--intensity --periods -1", "period -1"),
        ("--intensity --periods 0", "period 0"),
    ] {
        let words = format!("records one.txt --dt 0.01 --units g {own}");
        let error = refused(&folder, &words);
        assert!(error.contains(word), "{error}");
    }
}
