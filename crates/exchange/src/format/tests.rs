//! Each trap that the readers were found to set.

use rocking::block::Block;
use rocking::integrator::Model;
use rocking_records::intensity::Intensity;
use rocking_statistics::{Lognormal, normal};

use super::*;
use crate::fragility::{LimitState, unit_intensity};
use rocking_procedures::ModelError;

/// A block whose fragility in its own PGA or PGV has a shift or none.
fn one(intensity: Intensity, shift: f64) -> BlockFragility {
    let block = Block::try_new(0.15, 3.0).unwrap();
    let factor = unit_intensity(intensity, &block, Model::Nonlinear, 9.80665);
    // Ordinary records, p = 3 rad/s: median 2.51 above the shift.
    let fitted = Lognormal::try_new(shift, libm::log(2.51), 0.713).unwrap();
    BlockFragility {
        id: Id::of(&block).unwrap(),
        block,
        eta: Some(0.92),
        im: intensity.name().parse().unwrap(),
        limit_states: vec![LimitState {
            name: "overturning".parse().unwrap(),
            fragility: fitted.scaled(factor).unwrap(),
        }],
        origin: "86 capacities of \"A & B\"".into(),
        model_error: ModelError::none(),
    }
}

fn law(intensity: Intensity, shift: f64) -> Lognormal {
    one(intensity, shift).limit_states[0].fragility
}

fn nrml(intensity: Intensity, shift: f64) -> String {
    nrml::FORMAT.texts(&[one(intensity, shift)]).unwrap().main
}

/// The number of an attribute.
fn attribute(text: &str, name: &str) -> f64 {
    let from = text.split(&format!(" {name}=\"")).nth(1).unwrap();
    from.split('"').next().unwrap().parse().unwrap()
}

/// Numbers of an element, or of a part of a cell.
fn numbers(text: &str, separator: char) -> Vec<f64> {
    text.split(separator).map(|word| word.trim().parse().unwrap()).collect()
}

fn element(text: &str, name: &str) -> Vec<f64> {
    let from = text.split(&format!("<{name} ")).nth(1).unwrap();
    let inside = from.split_once('>').unwrap().1;
    numbers(inside.split('<').next().unwrap(), ' ')
}

/// OpenQuake's probability of a continuous function (scientific.py, 3.26.2).
fn continuous(text: &str, im: f64) -> f64 {
    let [mean, deviation, least, most, none] =
        ["mean", "stddev", "minIML", "maxIML", "noDamageLimit"]
            .map(|name| attribute(text, name));
    let variance = deviation * deviation;
    let sigma = libm::log(variance / (mean * mean) + 1.0).sqrt();
    let scale = mean * mean / (variance + mean * mean).sqrt();
    let raised = im.min(most).max(least);
    if raised <= none {
        return 0.0;
    }
    normal::cdf(libm::log(raised / scale) / sigma)
}

/// Straight lines between points, as numpy.interp makes them.
fn interpolated(xs: &[f64], ps: &[f64], im: f64) -> f64 {
    let after = xs.partition_point(|x| *x <= im);
    if after == 0 {
        return ps[0];
    }
    if after == xs.len() {
        return ps[after - 1];
    }
    let share = (im - xs[after - 1]) / (xs[after] - xs[after - 1]);
    ps[after - 1] + share * (ps[after] - ps[after - 1])
}

/// Forty intensities from nothing to twice the 98 % quantile.
fn intensities(fragility: &Lognormal) -> impl Iterator<Item = f64> {
    let end = 2.0 * fragility.quantile(0.98);
    (0..40).map(move |k| end * f64::from(k) / 39.0)
}

#[test]
fn openquake_s_mean_and_deviation_are_of_the_intensity_not_its_logarithm() {
    let text = nrml(Intensity::Pga, 0.0);
    let fragility = law(Intensity::Pga, 0.0);
    let (mut worst, mut wrong) = (0.0f64, 0.0f64);
    let taken_for_mean = text
        .replace(
            &format!("mean=\"{}\"", attribute(&text, "mean")),
            &format!("mean=\"{}\"", fragility.median()),
        )
        .replace(
            &format!("stddev=\"{}\"", attribute(&text, "stddev")),
            &format!("stddev=\"{}\"", fragility.dispersion()),
        );
    for im in intensities(&fragility) {
        let expected = fragility.cdf(im);
        worst = worst.max((continuous(&text, im) - expected).abs());
        let read = continuous(&taken_for_mean, im);
        wrong = wrong.max((read - expected).abs());
    }
    // What the range cuts off, and nine digits.
    assert!(worst < 1.01 * TAIL, "{worst:e}");
    // Median and dispersion written as they are.
    assert!(wrong > 0.05, "{wrong:e}");
}

#[test]
fn openquake_s_least_level_is_not_above_its_no_damage_limit() {
    let text = nrml(Intensity::Pga, 0.0);
    let (least, none) =
        (attribute(&text, "minIML"), attribute(&text, "noDamageLimit"));
    assert!(least <= none && none > 0.0);
    assert_eq!(continuous(&text, 0.5 * none), 0.0);
    // Above it the limit is ignored, and no damage becomes some.
    let raised = text.replace("minIML=\"", "minIML=\"1");
    assert!(attribute(&raised, "minIML") > none);
    assert!(continuous(&raised, 0.5 * none) > 0.05);
}

#[test]
fn a_shift_is_written_to_openquake_as_points_since_a_limit_only_cuts() {
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let text = nrml(intensity, 1.0);
        assert!(text.contains("format=\"discrete\""));
        let (xs, ps) = (element(&text, "imls"), element(&text, "poes"));
        let unit = if intensity == Intensity::Pgv { 100.0 } else { 1.0 };
        let fragility = law(intensity, 1.0).scaled(unit).unwrap();
        let mut worst = 0.0f64;
        let mut cut = 0.0f64;
        // The lognormal of the same median and 84 % quantile, cut.
        let beta = libm::log(fragility.quantile(0.841) / fragility.median());
        let two = libm::log(fragility.median());
        let two = Lognormal::try_new(0.0, two, beta).unwrap();
        for im in intensities(&fragility) {
            let read = interpolated(&xs, &ps, im);
            worst = worst.max((read - fragility.cdf(im)).abs());
            let limited =
                if im < fragility.shift() { 0.0 } else { two.cdf(im) };
            cut = cut.max((limited - fragility.cdf(im)).abs());
        }
        assert!(worst < TOLERANCE, "{intensity:?}: {worst:e}");
        assert!(cut > 20.0 * TOLERANCE, "{intensity:?}: {cut:e}");
        assert_eq!((ps[0], ps[ps.len() - 1]), (0.0, 1.0));
        let none = attribute(&text, "noDamageLimit");
        assert!((none / fragility.shift() - 1.0).abs() < 1e-8);
    }
}

#[test]
fn names_are_those_that_every_reader_takes() {
    for refused in ["", "BLOCK/p3.0/a0.15", "a.b", "a-b", "a b", "ä", "a#b"] {
        assert!(refused.parse::<Id>().is_err(), "{refused}");
    }
    assert!("x".repeat(75).parse::<Id>().is_ok());
    assert!("x".repeat(76).parse::<Id>().is_err());
    let named = |alpha, p| Id::of(&Block::try_new(alpha, p).unwrap()).unwrap();
    let id = named(0.15, 3.0);
    assert_eq!(id.to_string(), "block_a0_15_p3");
    assert_eq!(id.to_string().parse::<Id>().unwrap(), id);
    // A name with all digits that would be too long is none.
    assert!(Id::of(&Block::try_new(1e-90, 3.0).unwrap()).is_err());
    // Blocks that differ in the last digit have names that differ.
    assert_ne!(id, named(0.15, 3.0f64.next_up()));
}

#[test]
fn each_reader_has_its_own_unit_of_velocity() {
    let median = law(Intensity::Pgv, 0.0).median();
    let text = nrml(Intensity::Pgv, 0.0);
    let half = continuous(&text, 100.0 * median);
    assert!((half - 0.5).abs() < 1e-8, "{half}");
    assert!(text.contains("imt=\"PGV\""));
    let at = |format: &ExchangeFormat| {
        let all = [one(Intensity::Pgv, 0.0)];
        format.texts(&all).unwrap().main
    };
    let (pelicun, pact) = (at(&pelicun::FORMAT), at(&pact::FORMAT));
    let metres = crate::table::number(median);
    let law = format!("lognormal,{metres},0.713,");
    assert!(pelicun.contains(&format!(",mps,0,1,{law}")), "{pelicun}");
    let law_and_end = format!(",PGV,m/s,yes,{metres},0.713\n");
    assert!(pact.contains(&law_and_end), "{pact}");
}

#[test]
fn pelicun_takes_a_shift_as_a_polyline_from_nothing_to_certainty() {
    let shifted = one(Intensity::Pga, 1.0);
    let fragility = shifted.limit_states[0].fragility;
    let texts = pelicun::FORMAT.texts(std::slice::from_ref(&shifted)).unwrap();
    let row = texts.main.lines().nth(1).unwrap();
    let cells = crate::table::cells(row);
    assert_eq!(cells[2..7].join(" "), {
        "Peak Ground Acceleration g 0 1 multilinear_CDF"
    });
    let (xs, ps) = cells[7].split_once('|').unwrap();
    let (xs, ps) = (numbers(xs, ','), numbers(ps, ','));
    assert_eq!((ps[0], ps[ps.len() - 1]), (0.0, 1.0));
    for list in [&xs, &ps] {
        assert!(list.windows(2).all(|w| w[1] - w[0] > 1e-8));
    }
    for im in intensities(&fragility) {
        let error = interpolated(&xs, &ps, im) - fragility.cdf(im);
        assert!(error.abs() < TOLERANCE, "{im}: {error:e}");
    }
    let json = texts.beside.unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let damage = &json[&cells[0]]["LimitStates"]["LS1"]["DS1"];
    assert_eq!(damage["Description"], "overturning");
    // Points that pelicun cannot distinguish are refused.
    let narrow = Lognormal::try_new(0.1, -16.0, 0.1).unwrap();
    let mut shifted = shifted;
    shifted.limit_states[0].fragility = narrow;
    let error = pelicun::FORMAT.texts(&[shifted]);
    assert!(matches!(error, Err(ExchangeError::Narrow { .. })));
}

#[test]
fn pact_is_refused_a_shift_and_csv_tells_all() {
    let shifted = [one(Intensity::Pga, 1.0)];
    let error = pact::FORMAT.texts(&shifted).unwrap_err();
    assert!(matches!(error, ExchangeError::Shifted { .. }));
    let csv = csv::FORMAT.texts(&shifted).unwrap().main;
    let rows: Vec<Vec<String>> =
        csv.lines().map(crate::table::cells).collect();
    let cell = |name: &str| {
        let column = rows[0].iter().position(|head| head == name).unwrap();
        rows[1][column].clone()
    };
    assert_eq!(cell("shift"), crate::table::number(libm::tan(0.15)));
    assert_eq!((cell("unit"), cell("eta")), ("g".into(), "0.92".into()));
    assert_eq!(cell("origin"), "86 capacities of \"A & B\"");
}

#[test]
fn what_xml_would_read_as_its_own_is_escaped() {
    let text = nrml(Intensity::Pga, 0.0);
    assert!(text.contains("of &quot;A &amp; B&quot;</description>"));
}

/// A block with limit states at these medians above the shift 1 or none.
fn several(shift: f64, states: &[(f64, f64)]) -> BlockFragility {
    let states = states.iter().zip(["rocks", "leans", "falls"]);
    let states = states.map(|((median, beta), name)| LimitState {
        name: name.parse().unwrap(),
        fragility: Lognormal::try_new(shift, libm::log(*median), *beta)
            .unwrap(),
    });
    let limit_states = states.collect();
    BlockFragility { limit_states, ..one(Intensity::Pga, 0.0) }
}

#[test]
fn limit_states_stand_in_one_function_and_one_row() {
    for shift in [0.0, 1.0] {
        let block = several(shift, &[(0.4, 0.6), (0.9, 0.6), (1.6, 0.6)]);
        let blocks = [block.clone()];
        let text = nrml::FORMAT.texts(&blocks).unwrap().main;
        assert!(text.contains("<limitStates>rocks leans falls</limit"));
        for state in &block.limit_states {
            let from = format!(" ls=\"{}\"", state.name);
            let from = text.split(&from).nth(1).unwrap();
            for im in intensities(&state.fragility) {
                let read = if shift > 0.0 {
                    let ps = from.split(['>', '<']).nth(1).unwrap();
                    let xs = element(&text, "imls");
                    interpolated(&xs, &numbers(ps, ' '), im)
                } else {
                    let ranges = text.split("<params").next().unwrap();
                    continuous(&format!("{ranges}{from}"), im)
                };
                let error = (read - state.fragility.cdf(im)).abs();
                assert!(error < TOLERANCE, "{} {im}: {error:e}", state.name);
            }
        }
        let texts = pelicun::FORMAT.texts(&blocks).unwrap();
        let rows: Vec<Vec<String>> =
            texts.main.lines().map(crate::table::cells).collect();
        assert_eq!((rows[0].len(), rows[1].len()), (18, 18));
        let json: serde_json::Value =
            serde_json::from_str(&texts.beside.unwrap()).unwrap();
        let states = &json[block.id.to_string()]["LimitStates"];
        assert_eq!(states["LS3"]["DS3"]["Description"], "falls");
    }
}

#[test]
fn limit_states_that_cross_are_refused_where_the_reader_takes_differences() {
    // At a score of ln(0.9)/0.1 both have the probability 0.147.
    let block = several(1.0, &[(0.9, 0.7), (1.0, 0.8)]);
    for format in ExchangeFormat::ALL.iter().filter(|f| !f.may_cross) {
        let error = format.texts(std::slice::from_ref(&block)).unwrap_err();
        let words = error.to_string();
        assert!(
            words.contains("leans is more probable than rocks"),
            "{words}"
        );
    }
    assert!(csv::FORMAT.texts(&[block]).is_ok());
    let backwards = several(1.0, &[(1.0, 0.7), (0.9, 0.7)]);
    let error = nrml::FORMAT.texts(&[backwards]);
    assert!(matches!(error, Err(ExchangeError::Crossing { .. })));
    let mixed = [several(0.0, &[(1.0, 0.5)]), one(Intensity::Pga, 0.0)];
    let error = nrml::FORMAT.texts(&mixed);
    assert!(matches!(error, Err(ExchangeError::Mixed { .. })));
    let none = several(1.0, &[]);
    let error = csv::FORMAT.texts(&[none]);
    assert!(matches!(error, Err(ExchangeError::NoState { .. })));
}

#[test]
fn spectral_accelerations_go_where_the_reader_has_them() {
    let with = |im: &str| {
        let im = im.parse().unwrap();
        [BlockFragility { im, ..one(Intensity::Pga, 0.0) }]
    };
    let texts = |format: &ExchangeFormat, im| format.texts(&with(im));
    let nrml = |im| texts(&nrml::FORMAT, im).map(|texts| texts.main);
    assert!(nrml("sa:1").unwrap().contains(" imt=\"SA(1.0)\""));
    assert!(nrml("avgsa:0.5,1").unwrap().contains(" imt=\"AvgSA\""));
    let pelicun = texts(&pelicun::FORMAT, "sa:0.5").unwrap().main;
    assert!(pelicun.contains(",Spectral Acceleration|0.5,g,0,1,lognormal,"));
    for (format, im) in [
        (&nrml::FORMAT, "column:x"),
        (&nrml::FORMAT, "cav"),
        (&pelicun::FORMAT, "avgsa:0.5,1"),
        (&pact::FORMAT, "sa:1"),
    ] {
        let error = texts(format, im).unwrap_err();
        assert!(error.to_string().contains(im), "{error}");
    }
    let csv = texts(&csv::FORMAT, "avgsa:0.5,1").unwrap().main;
    assert!(csv.contains(",\"avgsa:0.5,1\",g,"), "{csv}");
}

#[test]
fn a_description_does_not_grow_with_the_number_of_blocks() {
    let block = one(Intensity::Pga, 0.0);
    let of = |k: usize, origin: String| BlockFragility {
        id: format!("block_{k}").parse().unwrap(),
        origin,
        ..block.clone()
    };
    let length = |blocks: &[BlockFragility]| {
        let text = nrml::FORMAT.texts(blocks).unwrap().main;
        let from = text.split("<description>").nth(1).unwrap();
        from.split('<').next().unwrap().len()
    };
    let same: Vec<_> = (0..1000).map(|k| of(k, "one sweep".into())).collect();
    assert_eq!(length(&same), "one sweep".len());
    let others: Vec<_> =
        (0..1000).map(|k| of(k, format!("sample {k}"))).collect();
    assert_eq!(length(&others), "sample 0; and 999 other origins".len());
}

/// With the error of the model every format holds the total, and says its
/// parts. The unshifted total has dispersion sqrt(0.713^2 + 0.2^2) = 0.74052.
#[test]
fn the_error_of_the_model_is_in_every_format() {
    let with = |shift| BlockFragility {
        model_error: ModelError::default(),
        ..one(Intensity::Pga, shift)
    };
    let text =
        |format: &ExchangeFormat, shift| format.texts(&[with(shift)]).unwrap();
    let law = law(Intensity::Pga, 0.0);
    let row = text(&pact::FORMAT, 0.0).main;
    let cells: Vec<&str> = row.lines().nth(1).unwrap().split(',').collect();
    let [median, beta] = [5, 6].map(|k| cells[k].parse::<f64>().unwrap());
    assert!((median / law.median() - 1.0).abs() < 1e-8);
    assert!((beta - 0.740_519).abs() < 1e-5, "{beta}");
    let pelicun = text(&pelicun::FORMAT, 0.0);
    assert!(pelicun.main.contains(&format!(",lognormal,{}", cells[5])));
    for words in [pelicun.beside.unwrap(), text(&nrml::FORMAT, 1.0).main] {
        let parts = "model bias 1 (0.77 to 1.3), model dispersion 0.2";
        assert!(words.contains(parts) && words.contains("Wittich"));
        assert!(words.contains("dispersion 0.713 above"), "{words}");
    }
    // Points of the total: some objects are damaged below the shift.
    let nrml = text(&nrml::FORMAT, 1.0).main;
    let (levels, curve) = (element(&nrml, "imls"), element(&nrml, "poes"));
    let shift = super::tests::law(Intensity::Pga, 1.0).shift();
    let below = interpolated(&levels, &curve, shift);
    // SciPy: P(exp(0.2 Z) (1 + 2.51 exp(0.713 Z1)) < 1).
    assert!((below - 9.663e-4).abs() < 1e-5, "{below}");
    let error = pact::FORMAT.texts(&[with(1.0)]).unwrap_err();
    assert!(matches!(error, ExchangeError::Shifted { .. }));
}
