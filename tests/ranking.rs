//! Capacities in any intensity measure, stripes and censored samples, run as
//! a user runs them: from a suite to a ranking, a table of counts, a fit.
//!
//! Fits, likelihoods and lines are compared with SciPy, statsmodels and
//! mpmath elsewhere; here the commands must agree with each other, and one
//! value with `fixtures/oracles`.

use std::fs;

use libm::{exp, log, sin, tan};
use serde_json::Value;

use super::compare::near;
use super::support::{answer as text, close, folder, json, refused};

/// Six records of a few cycles each, their index with magnitude and
/// distance, and the table of their IDA.
fn suite(name: &str) -> crate::support::Place {
    let place = folder(name, &[]);
    let mut index = String::from("file,units,dt_s,mw,rrup_km\n");
    for k in 0..6 {
        let period = 0.4 + 0.15 * f64::from(k);
        let wave = |i: i32| {
            let t = 0.02 * f64::from(i);
            let turn = std::f64::consts::TAU * t / period;
            0.2 * sin(turn) * exp(-0.3 * (t - 3.0) * (t - 3.0))
        };
        let samples: Vec<String> =
            (0..300).map(|i| wave(i).to_string()).collect();
        let file = format!("wave{k}.txt");
        fs::write(place.join(&file), samples.join("\n") + "\n").unwrap();
        let (mw, km) = (6.0 + 0.2 * f64::from(k), 10 + (k * 7) % 11);
        index += &format!("{file},g,0.02,{mw},{km}\n");
    }
    fs::write(place.join("suite.csv"), index).unwrap();
    text(
        &place,
        "ida --alpha 0.2 --p 2 --suite suite.csv --step-im 0.1 --out ida.csv",
    );
    place
}

/// Values of a sample file.
fn values(sample: &str) -> Vec<f64> {
    let lines = sample.lines().filter(|line| !line.starts_with('#'));
    let cell = |line: &str| line.split('#').next().unwrap().trim().to_owned();
    lines.map(|line| cell(line).parse().unwrap()).collect()
}

#[test]
fn capacities_in_any_measure_are_those_in_pga_scaled_by_record() {
    let place = suite("ranking-measures");
    let capacities = |im: &str| {
        let by = format!("--im {im} --suite suite.csv");
        let by = if im == "pga" { "--im pga".into() } else { by };
        values(&text(
            &place,
            &format!("capacities --ida ida.csv {by} --at 1 --out -"),
        ))
    };
    let pga = capacities("pga");
    let records =
        json(&place, "records suite.csv --intensity --periods 0.5,1");
    let of = |record: usize, key: &str| {
        records["intensity"][record][key].as_f64().unwrap()
    };
    let spectrum = |record: usize, period: usize| {
        let all = &records["intensity"][record]["spectral_acceleration_g"];
        all[period].as_f64().unwrap()
    };
    let uplift = tan(0.2);
    for (im, power, value) in [
        (
            "arias",
            2,
            &(|k| of(k, "arias_intensity_m_s")) as &dyn Fn(usize) -> f64,
        ),
        ("sa:1", 1, &|k| spectrum(k, 1)),
        ("avgsa:0.5,1", 1, &|k| (spectrum(k, 0) * spectrum(k, 1)).sqrt()),
        ("column:rrup_km", 1, &|k| (10 + (k * 7) % 11) as f64),
    ] {
        for (k, own) in capacities(im).into_iter().enumerate() {
            let scale = pga[k] * uplift / of(k, "pga_g");
            let expected =
                (if power == 2 { scale * scale } else { scale }) * value(k);
            // Arias by the first power is some tens of per cent off.
            near(format!("{im} of {k}"), own, expected, 1e-12 * expected);
        }
    }
    let said = refused(&place, "capacities --ida ida.csv --im sa:1");
    assert!(said.contains("expected --suite"), "{said}");
    let said = refused(
        &place,
        "capacities --ida ida.csv --im column:vs30 --suite suite.csv",
    );
    assert!(said.contains("column vs30: found no such column"), "{said}");
    let said = refused(&place, "capacities --ida ida.csv --im sa:-1");
    assert!(said.contains("expected one of pga, pgv"), "{said}");
    // An oscillator's steps would fill any memory.
    let short = "capacities --ida ida.csv --suite suite.csv --im sa:1e-9";
    let said = refused(&place, short);
    assert!(said.contains("expected at least 0.001 s"), "{said}");
}

#[test]
fn a_ranking_tells_the_dispersion_of_the_fits_and_the_slopes() {
    let place = suite("ranking-rank");
    let words = "rank --ida ida.csv --suite suite.csv --at 1 --im pga \
                 --im pgv --im sa:1 --magnitude mw --distance rrup_km \
                 --bootstrap 200";
    let out = json(&place, words);
    assert_eq!((&out["n"], &out["censored"]), (&6.into(), &0.into()));
    assert_eq!(out["set_aside"]["files"], 0);
    for (row, im) in ["pga", "pgv", "sa:1"].into_iter().enumerate() {
        let by = if row < 2 { "" } else { "--suite suite.csv" };
        let sample = text(
            &place,
            &format!("capacities --ida ida.csv --im {im} {by} --at 1 --out -"),
        );
        fs::write(place.join("sample.txt"), &sample).unwrap();
        let fit = json(&place, "fragility fit --sample sample.txt");
        let fit = &fit["fitted"];
        let own = &out["measures"][row];
        let beta = &own["dispersion"];
        close(&beta["point"], fit["dispersion"].as_f64().unwrap(), 1e-11);
        close(&own["median"], fit["median"].as_f64().unwrap(), 1e-11);
        let (low, high) = (&beta["low"], &beta["high"]);
        assert!(low.as_f64() < high.as_f64());
        // Least squares by the normal equations.
        let y: Vec<f64> = values(&sample).iter().map(|x| log(*x)).collect();
        let slope = |x: &[f64]| {
            let mean = |v: &[f64]| v.iter().sum::<f64>() / 6.0;
            let (mx, my) = (mean(x), mean(&y));
            let pairs = x.iter().zip(&y);
            let cross: f64 = pairs.map(|(x, y)| (x - mx) * (y - my)).sum();
            cross / x.iter().map(|x| (x - mx) * (x - mx)).sum::<f64>()
        };
        let mw: Vec<f64> = (0..6).map(|k| 6.0 + 0.2 * f64::from(k)).collect();
        let km = (0..6).map(|k| log(f64::from(10 + (k * 7) % 11)));
        let km: Vec<f64> = km.collect();
        close(&own["slopes"][0]["slope"], slope(&mw), 1e-9);
        close(&own["slopes"][1]["slope"], slope(&km), 1e-9);
    }
    assert_eq!(out["measures"][0]["ratio_to_first"]["point"], 1.0);
    // Arias intensity goes with the square of a motion: its root is ranked.
    let by = "--ida ida.csv --suite suite.csv --at 1 --im arias";
    let sample = text(&place, &format!("capacities {by} --out -"));
    fs::write(place.join("sample.txt"), sample).unwrap();
    let fit = json(&place, "fragility fit --sample sample.txt");
    let root = 0.5 * fit["fitted"]["dispersion"].as_f64().unwrap();
    let ranked = json(&place, &format!("rank {by} --bootstrap 20"));
    close(&ranked["measures"][0]["dispersion"]["point"], root, 1e-11);
    // The drawing has every measure, and the numbers of the table.
    text(&place, &format!("{words} --plot rank.svg"));
    let drawn = fs::read_to_string(place.join("rank.svg")).unwrap();
    for tick in ["PGA", "PGV", "SA(1)"] {
        assert!(drawn.contains(tick), "{tick}");
    }
    let said = refused(&place, &format!("{words} --plot ida.csv"));
    assert!(said.contains("is read: expected another file"), "{said}");
    let one = text(&place, &format!("{words} --threads 1"));
    assert_eq!(one, text(&place, &format!("{words} --threads 2")));
    assert!(one.contains("Slope on ln distance: P-value"), "{one}");
}

#[test]
fn stripes_count_what_the_curves_tell_and_the_counts_are_fitted() {
    let place = suite("ranking-stripes");
    let words = "stripes --ida ida.csv --levels 1:6:0.25 --at 1";
    let out = json(&place, &format!("{words} --counts counts.csv"));
    let pga = values(&text(
        &place,
        "capacities --ida ida.csv --at 1 --point first --out -",
    ));
    for stripe in out["stripes"].as_array().unwrap() {
        let im = stripe["intensity"].as_f64().unwrap();
        let reached = pga.iter().filter(|capacity| **capacity <= im).count();
        let exceeded = stripe["exceeded"].as_u64();
        assert_eq!(exceeded.is_some(), stripe["open"] == 0, "{stripe}");
        let Some(exceeded) = exceeded else { continue };
        // A curve may turn back below the level above its first crossing.
        assert!(exceeded as usize <= reached, "{stripe}");
        assert!(stripe["overturned"].as_u64().unwrap() <= exceeded);
        assert_eq!(
            stripe["n"].as_u64().unwrap() + stripe["open"].as_u64().unwrap(),
            6
        );
    }
    let last = out["stripes"].as_array().unwrap().last().unwrap();
    assert!(last["exceeded"].as_u64().unwrap() > 0, "{last}");
    let fit = json(&place, "fragility counts --counts counts.csv");
    assert!(fit["fitted"]["median"].as_f64().unwrap() > 1.0);
}

/// Half of the records are run up to an intensity of 2.
#[test]
fn records_that_were_not_run_so_far_are_fitted_as_their_capacities_are() {
    let place = suite("ranking-open");
    let ida = fs::read_to_string(place.join("ida.csv")).unwrap();
    let im = |line: &str| line.split(',').nth(5)?.parse::<f64>().ok();
    let kept = |line: &&str| {
        let odd = ["wave1", "wave3", "wave5"];
        let is_odd = odd.iter().any(|name| line.starts_with(name));
        !(is_odd && im(line) > Some(2.0))
    };
    let lines: Vec<&str> = ida.lines().filter(kept).collect();
    fs::write(place.join("ida.csv"), lines.join("\n") + "\n").unwrap();
    let words = "stripes --ida ida.csv --levels 2:6:0.5 --at 0.5";
    let out = json(&place, &format!("{words} --counts counts.csv"));
    let last = out["stripes"].as_array().unwrap().last().unwrap();
    assert!(last["open"].as_u64() > Some(0), "{last}");
    assert_eq!(last["exceeded"], Value::Null);
    let fit = json(&place, "fragility counts --counts counts.csv");
    let all = "fragility fit --ida ida.csv --at 0.5 --point monotone";
    let all = &json(&place, all)["levels"][0];
    for name in ["median", "dispersion"] {
        let own = all["fitted"][name].as_f64().unwrap();
        close(&fit["fitted"][name], own, 0.05);
    }
    assert!(fit["open"].as_u64() > Some(0));
}

#[test]
fn counts_agree_with_statsmodels() {
    let place = folder("ranking-counts", &[]);
    let rows = "intensity,exceeded,n\n0.2,0,40\n0.3,0,40\n0.4,0,40\n0.6,4,40\n\
                0.7,6,40\n0.8,13,40\n0.9,12,40\n1,16,40\n";
    fs::write(place.join("baker.csv"), rows).unwrap();
    let out = json(&place, "fragility counts --counts baker.csv");
    // Row `baker` of fixtures/oracles/censored.csv.
    close(&out["median"]["point"], 1.076_115_794_292_683_3, 1e-11);
    close(&out["dispersion"]["high"], 0.650_025_363_947_763, 1e-9);
    for (rows, words) in [
        ("intensity,exceeded,n\n1,3,2\n", "stripe 1, 3 of 2 at 1"),
        (
            "intensity,exceeded,n\n1,x,2\n",
            "wrong.csv:2: found `x` in column exceed",
        ),
        ("intensity,k,n\n1,1,2\n", "expected `intensity,exceeded,n`"),
        (
            "intensity,record,event,exceeded,schema\n1,a,,2,1\n",
            "wrong.csv:2: found `2` in column exceeded: expected 1 or 0",
        ),
        (
            "intensity,record,event,exceeded,schema\n1,a,X,0,1\n1,b,,0,1\n",
            "wrong.csv:3: found `` in column event: expected the earthquake",
        ),
        (
            "intensity,exceeded,n\n1,0,2\n2,2,2\n",
            "every stripe up to 1 has no exceedance and every one from 2 on",
        ),
        (
            "intensity,exceeded,n\n0.1,0,20\n0.2,0,20\n0.4,5,20\n",
            "wrong.csv: only the stripe at 0.4 has both",
        ),
        (
            "intensity,exceeded,n\n0.1,0,20\n0.2,0,20\n",
            "no record exceeded the level at any intensity",
        ),
        (
            "intensity,exceeded,n\n0.1,20,20\n0.2,20,20\n",
            "every record exceeded the level at every intensity",
        ),
        (
            "intensity,exceeded,n\n0.1,5,20\n0.2,4,20\n0.4,2,20\n",
            "do not rise with the intensity",
        ),
        (
            "intensity,record\n0.1,a\n",
            "expected `intensity,record,exceeded`, and, if known, `event`",
        ),
        (
            "intensity,record,exceeded\n0.1,=1+1,0\n",
            "wrong.csv:2: found `=1+1` in column record: expected a name",
        ),
        (
            "intensity,record,exceeded\n0.1,a\u{7},0\n",
            "in column record: expected a name without a control character",
        ),
        (
            "intensity,exceeded,n\n0.1,5,\"20\n",
            "wrong.csv: a cell that begins with a quote on line 2 has no",
        ),
    ] {
        fs::write(place.join("wrong.csv"), rows).unwrap();
        let said = refused(&place, "fragility counts --counts wrong.csv");
        assert!(said.contains(words), "{said}");
    }
}

/// Without the earthquakes and the schema number, and in another order.
#[test]
fn outcomes_need_three_columns() {
    let place = folder("ranking-outcomes", &[]);
    let rows = [(1, 0), (2, 0), (3, 1), (4, 0), (5, 1), (6, 1)];
    let table = |head: &str, row: &dyn Fn((i32, i32)) -> String| {
        let rows = rows.map(row).concat();
        fs::write(place.join("o.csv"), format!("{head}\n{rows}")).unwrap();
        json(&place, "fragility counts --counts o.csv --bootstrap 20")
    };
    let long = table("intensity,record,event,exceeded,schema", &|(im, k)| {
        format!("{im},r{im},,{k},1\n")
    });
    let short = table("record,exceeded,intensity", &|(im, k)| {
        format!("r{im},{k},{im}\n")
    });
    assert_eq!(long, short);
}

#[test]
fn names_of_choices_are_read_in_any_case() {
    let place = suite("ranking-case");
    let rank = "rank --ida ida.csv --suite suite.csv --at 1 --bootstrap 20";
    let one = text(&place, &format!("{rank} --im pga --im sa:1"));
    assert_eq!(one, text(&place, &format!("{rank} --im PGA --im SA:1")));
    let stripes = "stripes --ida ida.csv --levels 2";
    let one = text(&place, &format!("{stripes} --im pgv"));
    assert_eq!(one, text(&place, &format!("{stripes} --im PGV")));
}

#[test]
fn a_sample_that_makes_no_fit_or_a_weak_one_is_told() {
    let place = folder("ranking-weak", &[]);
    let write = |text: &str| fs::write(place.join("s.txt"), text).unwrap();
    write(">3\n>4\n>5\n");
    let said = refused(&place, "fragility fit --sample s.txt");
    assert!(said.contains("all 3 values are censored: expected"), "{said}");
    write("2\n>3\n>2.5\n>1.5\n");
    let fit = json(&place, "fragility fit --sample s.txt");
    let remark = fit["remarks"][0].as_str().unwrap();
    assert!(remark.contains("rest on one observation"), "{remark}");
    let shown = text(&place, "fragility fit --sample s.txt");
    assert!(shown.contains("rest on one observation"), "{shown}");
    write("2\n3\n>2.5\n");
    let fit = json(&place, "fragility fit --sample s.txt");
    assert_eq!(fit["remarks"].as_array().unwrap().len(), 0);
}

#[test]
fn censored_values_enter_by_their_own_limits() {
    let place = folder("ranking-censored", &[]);
    // The sample of fixtures/oracles/censored.py.
    let exact = "1.05\n1.12\n1.2\n1.21\n1.33\n1.41\n1.5\n1.52\n1.6\n1.75\n\
                 1.8\n1.93\n2.2\n2.4\n2.45\n3.1\n3.8\n";
    let limits = ">1.25\n> 1.7\n>2.0 # a record\n>4.0\n>3\n>0.9\n";
    let write = |name: &str, text: String| {
        fs::write(place.join(name), text).unwrap();
    };
    write("own.txt", format!("{exact}{limits}"));
    write("inf.txt", format!("{exact}inf\ninf\ninf\ninf\ninf\ninf\n"));
    let csv = include_str!("../fixtures/oracles/censored.csv");
    let mut rows = csv.lines();
    let row = rows.find(|line| line.starts_with("own-limits-1")).unwrap();
    let expected: f64 = row.split(',').nth(3).unwrap().parse().unwrap();
    // A quarter is censored: nothing lies above the 95 % quantile.
    for method in ["censored", "mle"] {
        let fit = "fragility fit --sample own.txt --shift 1 --method";
        let out = json(&place, &format!("{fit} {method}"));
        close(&out["fitted"]["dispersion"], expected, 1e-11);
        assert_eq!(out["n_limited"], 6);
        // The median lies above some limits: it is open.
        assert_eq!(out["im50"], Value::Null);
    }
    // The risk of a censored sample is that of the same fit.
    write(
        "hazard.csv",
        "intensity,annual_frequency\n1.1,0.1\n9,0.001\n".into(),
    );
    let own = "risk --hazard hazard.csv --sample own.txt";
    let out = json(&place, &format!("{own} --shift 1"));
    let fit = json(&place, "fragility fit --sample own.txt --shift 1");
    for (row, key) in [(0, "fitted"), (1, "unshifted")] {
        let found =
            &out["fragilities"][row]["fitted"]["records"]["dispersion"];
        close(found, fit[key]["dispersion"].as_f64().unwrap(), 1e-12);
    }
    let said = refused(&place, &format!("{own} --shift min"));
    assert!(said.contains("own.txt: 6 values censored"), "{said}");
    let common =
        json(&place, "fragility fit --sample inf.txt --method censored");
    let beta = common["fitted"]["dispersion"].as_f64().unwrap();
    assert!(beta > 0.5, "{common}");
    assert_eq!(
        (&common["n_censored"], &common["n_limited"]),
        (&6.into(), &0.into())
    );
    let said = refused(&place, "fragility fit --sample inf.txt");
    assert!(said.contains("infinite"), "{said}");
    write("wrong.txt", "1\n>x\n".into());
    let said = refused(&place, "fragility fit --sample wrong.txt");
    assert!(said.contains("wrong.txt:2: found `>x`"), "{said}");
}

#[test]
fn censored_records_of_a_table_are_written_with_their_limit() {
    let place = suite("ranking-limits");
    let table = fs::read_to_string(place.join("ida.csv")).unwrap();
    // The first record is run up to no more than 1.3.
    let keeps = |line: &&str| {
        let cells: Vec<&str> = line.split(',').collect();
        let im = cells[5].parse::<f64>().unwrap_or(0.0);
        cells[0] != "wave0" || im <= 1.3
    };
    let cut: Vec<&str> = table.lines().filter(keeps).collect();
    fs::write(place.join("cut.csv"), cut.join("\n") + "\n").unwrap();
    let sample = text(&place, "capacities --ida cut.csv --at 1 --out -");
    let line = sample.lines().find(|line| line.starts_with('>')).unwrap();
    assert!(line.ends_with("# wave0"), "{sample}");
    let limit = line[1..].split('#').next().unwrap().trim();
    let limit: f64 = limit.parse().unwrap();
    assert!(limit > 1.15 && limit <= 1.3, "{line}");
}
