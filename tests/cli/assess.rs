//! `rocking assess`: its numbers are those of separate commands, and the
//! frequency is that of a quadrature made here.

use std::fs;
use std::path::Path;

use libm::{exp, log, pow};
use rocking_common::files::{SUMS, is_whole};
use serde_json::Value;

use crate::compare::near;
use crate::support::{answer, at2, folder, json, motion, refused_with, run};

const HAZARD: &str = "pga_g,annual_frequency\n\
                      0.05,0.04\n0.2,0.005\n0.5,6e-4\n1,8e-5\n3,1e-6\n";

const OBJECTS: &str = "id,width_m,height_m,eta,friction,limit_ratio\n\
                       stele,0.35,1.4,,5,\nvase,0.2,0.8,0.9,9,\n\
                       case,0.6,2,,,0.5\ncrate,0.5,0.9,,0.2,\n";

/// A folder with four objects, one of which slides, a hazard curve and eight motions.
fn scene(name: &str) -> crate::support::Place {
    let place =
        folder(name, &[("objects.csv", OBJECTS), ("hazard.csv", HAZARD)]);
    fs::create_dir(place.join("suite")).unwrap();
    for k in 0..8 {
        let samples = motion(4.0 + 1.7 * f64::from(k));
        let text = at2("0.02", samples.len(), &samples);
        fs::write(place.join(format!("suite/r{k}.at2")), text).unwrap();
    }
    place
}

/// The normal distribution by Simpson's rule.
fn normal_cdf(z: f64) -> f64 {
    let n = 1600;
    let step = (z + 12.0) / f64::from(n);
    let density = |x: f64| exp(-0.5 * x * x);
    let sum: f64 = (0..=n)
        .map(|k| {
            let weight = match k {
                0 => 1.0,
                _ if k == n => 1.0,
                _ if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * density(-12.0 + step * f64::from(k))
        })
        .sum();
    sum * step / 3.0 / (2.0 * std::f64::consts::PI).sqrt()
}

/// Mean annual frequency of a shifted lognormal fragility under the curve:
/// the integral of F |dH| over H itself between the points, by Simpson's
/// rule in ln H, and F of the last point beyond it.
fn frequency(shift: f64, median: f64, dispersion: f64) -> f64 {
    let fragility = |x: f64| match x > shift {
        true => normal_cdf(log((x - shift) / (median - shift)) / dispersion),
        false => 0.0,
    };
    let rows = HAZARD.lines().skip(1).map(|line| {
        let (x, h) = line.split_once(',').unwrap();
        (x.parse::<f64>().unwrap(), h.parse::<f64>().unwrap())
    });
    let points: Vec<(f64, f64)> = rows.collect();
    let mut sum = 0.0;
    for pair in points.windows(2) {
        let ((x0, h0), (x1, h1)) = (pair[0], pair[1]);
        let k = log(h0 / h1) / log(x1 / x0);
        // The kink at the shift parts the piece.
        let cut = shift.clamp(x0, x1);
        let (from, to) = (log(cut), log(x1));
        let n = 1000;
        let step = (to - from) / f64::from(n);
        let at = |i: i32| {
            let x = exp(from + step * f64::from(i));
            fragility(x) * k * h0 * pow(x / x0, -k)
        };
        let inner: f64 = (1..n)
            .map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) })
            .sum();
        sum += (at(0) + inner + at(n)) * step / 3.0;
    }
    let last = points[points.len() - 1];
    sum + fragility(last.0) * last.1
}

fn object<'a>(found: &'a Value, id: &str) -> &'a Value {
    let all = found["objects"].as_array().unwrap();
    all.iter().find(|one| one["id"] == id).unwrap()
}

/// The answer without the error of the model.
fn alone(object: &Value) -> &Value {
    let all = object["alternatives"].as_array().unwrap();
    let is_alone = |one: &&Value| {
        one["assumption"].as_str().unwrap().starts_with("records alone")
    };
    all.iter().find(is_alone).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn assessed(place: &Path) -> Value {
    json(
        place,
        "assess --objects objects.csv --suite suite --hazard hazard.csv \
         --bootstrap 50 --out page",
    )
}

#[test]
fn frequencies_are_those_of_another_quadrature() {
    let place = scene("assess-hazard");
    let found = assessed(&place);
    for id in ["stele", "vase", "case"] {
        let one = object(&found, id);
        let alone = alone(one);
        let parts = ["shift", "median", "dispersion"];
        let parts = parts.map(|key| number(&alone["records"][key]));
        let expected = frequency(parts[0], parts[1], parts[2]);
        let own = number(&alone["annual_frequency"]["point"]);
        near(id, own / expected, 1.0, 1e-9);
        near(id, number(&alone["median_im"]["point"]), parts[1], 1e-12);
        // The error of the model makes weaker motions dangerous, and its
        // range the interval wider.
        let total = number(&one["annual_frequency"]["point"]);
        assert!(total > own, "{id}: {total} of {own}");
        let width = |of: &Value| {
            let [low, high] =
                ["low", "high"].map(|k| number(&of["annual_frequency"][k]));
            log(high / low)
        };
        assert!(width(one) > 0.9 * width(alone), "{id}");
        let own = total;
        let years = 1.0 - exp(-50.0 * own);
        near(id, number(&one["probability"]["point"]), years, 1e-12);
        let parts = one["contributions"].as_array().unwrap().iter();
        let sum: f64 =
            parts.map(|part| number(&part["annual_frequency"])).sum();
        assert!(sum <= own && sum > 0.9 * own, "{id}: {sum} of {own}");
    }
    // The rank is that of the frequencies.
    let all = found["objects"].as_array().unwrap().iter();
    let all: Vec<f64> =
        all.map(|one| number(&one["annual_frequency"]["point"])).collect();
    assert!(all.is_sorted_by(|a, b| a >= b), "{all:?}");
}

#[test]
fn numbers_are_those_of_separate_commands() {
    let place = scene("assess-apart");
    let found = assessed(&place);
    let place: &Path = &place;
    for (id, size, eta, at) in [
        ("stele", "--width-m 0.35 --height-m 1.4", "0.92", "inf"),
        ("vase", "--width-m 0.2 --height-m 0.8", "0.9", "inf"),
        ("case", "--width-m 0.6 --height-m 2", "0.92", "0.5"),
    ] {
        let one = object(&found, id);
        answer(
            place,
            &format!(
                "ida {size} --eta {eta} --suite suite --refine 1e-4 --out {id}.csv"
            ),
        );
        answer(
            place,
            &format!("capacities --ida {id}.csv --at {at} --out {id}.txt"),
        );
        let risk = json(
            place,
            &format!(
                "risk --hazard hazard.csv --sample {id}.txt --shift 1 {size} \
             --bootstrap 50 --model-dispersion 0 --model-bias 1"
            ),
        );
        let row = &risk["fragilities"][0];
        let one = alone(one);
        for name in ["median", "dispersion", "shift"] {
            let [own, other] = [&one["records"], &row["fitted"]["records"]]
                .map(|law| number(&law[name]));
            near(name, own / other, 1.0, 1e-12);
        }
        let sampling = &row["sampling"];
        for (own, other) in [
            ("point", &row["annual_frequency_truncation_lower"]),
            ("low", &sampling["annual_frequency_low"]),
            ("high", &sampling["annual_frequency_high"]),
        ] {
            let own = number(&one["annual_frequency"][own]);
            near(id, own / number(other), 1.0, 1e-12);
        }
    }
    // The page shows them, and the files beside it are those that it names.
    let page = fs::read_to_string(place.join("page/index.html")).unwrap();
    for file in fs::read_dir(place.join("page")).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        let named = format!("href=\"{name}\"");
        let own = ["index.html", SUMS].contains(&&*name);
        assert_eq!(page.contains(&named), !own, "{name}");
    }
    assert!(is_whole(&place.join("page")).unwrap());
    let vase = object(&found, "vase");
    let median = number(&vase["median_im"]["point"]);
    let shown = format!("{:.2e}", median).parse::<f64>().unwrap().to_string();
    assert!(page.contains(&format!("{shown} (")), "no {shown}");
    let sliding = found["not_rocking"].as_array().unwrap();
    let [crate_] = &sliding[..] else { panic!("{sliding:?}") };
    assert_eq!(crate_["id"], "crate");
    assert_eq!(crate_["friction_share"], 1.0, "tan(alpha) is above 0.2");
    assert!(page.contains("Objects that slide first"));
}

#[test]
fn objects_together_are_counted_record_by_record() {
    let place = scene("assess-together");
    let found = assessed(&place);
    let text = fs::read_to_string(place.join("page/capacities.csv"));
    let text = text.unwrap();
    // Of each record the intensities of the three objects, ascending.
    let mut records: std::collections::BTreeMap<&str, Vec<f64>> =
        Default::default();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[5], "true", "each record damages each object");
        records.entry(cells[1]).or_default().push(cells[4].parse().unwrap());
    }
    for values in records.values_mut() {
        values.sort_by(f64::total_cmp);
    }
    for (k, row) in found["together"].as_array().unwrap().iter().enumerate() {
        let shift = number(&row["records"]["shift"]);
        let logs: Vec<f64> =
            records.values().map(|v| log(v[k] - shift)).collect();
        let mean = logs.iter().sum::<f64>() / logs.len() as f64;
        let median = shift + exp(mean);
        // The file has ten digits.
        near("median", number(&row["records"]["median"]), median, 1e-9);
    }
}

#[test]
fn what_is_no_assessment_is_refused() {
    let place = scene("assess-refused");
    let place: &Path = &place;
    let write = |name: &str, text: &str| {
        fs::write(place.join(name), text).unwrap();
    };
    write("limit.csv", "id,alpha,p,limit_ratio\na,0.2,3,1.5\n");
    write("floor.csv", "id,alpha,p,floor\na,0.2,3,attic\n");
    write("name.csv", "id,alpha,p\n@vase,0.2,3\n");
    write("two.csv", "id,alpha,p\na,0.2,-3\na,0.1,3\n");
    write("unit.csv", "intensity,annual_frequency\n0.1,0.1\n1,1e-3\n");
    let assess = "assess --suite suite --bootstrap 20 --out page";
    for (more, words) in [
        (
            "--objects limit.csv",
            "limit.csv:2: limit_ratio is \"1.5\": expected",
        ),
        ("--objects floor.csv", "floor.csv:2: floor attic"),
        ("--objects objects.csv --target 100", "--hazard"),
        ("--objects objects.csv --target 2e6 --hazard hazard.csv", "target 2"),
        (
            "--objects objects.csv --target -1 --hazard hazard.csv",
            "--target -1",
        ),
        ("--objects objects.csv --sliding-share 1", "sliding share 1"),
        (
            "--objects two.csv",
            "two.csv:2: p is \"-3\": expected a positive number\n\
             two.csv:3: a is already on line 2: expected a unique label\n",
        ),
        ("--alpha 0.2 --p 3 --hazard unit.csv", "hazard curve in"),
        ("", "--objects"),
    ] {
        refused_with(place, &format!("{assess} {more}"), words);
    }
    // A folder that is not empty stays as it is.
    fs::create_dir(place.join("kept")).unwrap();
    write("kept/a.txt", "kept");
    let kept = "assess --suite suite --alpha 0.2 --p 3 --out kept";
    refused_with(place, kept, "kept");
}

#[test]
fn a_rigid_building_changes_nothing() {
    let place = scene("assess-floor");
    let place: &Path = &place;
    let write = |name: &str, text: &str| {
        fs::write(place.join(name), text).unwrap();
    };
    write(
        "floors.csv",
        "name,period_s,damping,height_ratio\n\
                         rigid,0.001,0.05,1\nroof,0.5,0.05,1.4\n",
    );
    write(
        "on.csv",
        "id,width_m,height_m,floor\n\
                     ground,0.2,0.8,\nrigid,0.2,0.8,rigid\n\
                     roof,0.2,0.8,roof\n",
    );
    let (status, out, error) = run(
        place,
        "assess --objects on.csv --floors floors.csv --suite suite \
         --bootstrap 20 --out page --json",
    );
    assert_eq!(status, 0, "{error}");
    let found: Value = serde_json::from_str(&out).unwrap();
    let capacity = |id: &str| {
        let one = object(&found, id);
        number(&one["median_im"]["point"])
    };
    // Without a shift on a floor the fits differ, the intensities do not.
    near("rigid", capacity("rigid") / capacity("ground"), 1.0, 0.1);
    assert!(capacity("roof") < 0.9 * capacity("ground"));
}

#[test]
fn two_records_are_too_few() {
    let place = scene("assess-two");
    for k in 2..8 {
        fs::remove_file(place.join(format!("suite/r{k}.at2"))).unwrap();
    }
    let words = "assess --objects objects.csv --suite suite --out out";
    refused_with(&place, words, "2 records: expected at least 3");
}
