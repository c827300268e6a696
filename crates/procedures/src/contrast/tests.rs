use libm::{exp, log};
use rocking_statistics::normal;

use super::*;

const INF: f64 = f64::INFINITY;
const DRAWS: Draws = Draws { replicates: 2000, seed: 0 };

fn sample(values: &[f64]) -> CensoredSample {
    CensoredSample::try_new(values, &[]).unwrap()
}

fn of<'a>(
    sample: &'a CensoredSample,
    events: &'a [String],
) -> ContrastSample<'a, String> {
    ContrastSample { sample, records: &[], events }
}

/// Quantiles of a lognormal of median 1.
fn quantiles(n: u32, dispersion: f64) -> Vec<f64> {
    let z = |i| normal::quantile((f64::from(i) + 0.5) / f64::from(n));
    (0..n).map(|i| exp(dispersion * z(i))).collect()
}

fn labels(count: usize, each: usize) -> Vec<String> {
    (0..count * each).map(|i| (i / each).to_string()).collect()
}

/// Half the width of ln(ratio).
fn half_width(found: &Contrast) -> f64 {
    let ratio = found.median_ratio.as_ref().unwrap();
    let (low, high) = ratio.estimate.interval().unwrap().ends();
    0.5 * log(high / low)
}

#[test]
fn the_interval_is_that_of_two_medians() {
    let (a, b) = (quantiles(400, 0.4), quantiles(100, 0.6));
    let twice: Vec<f64> = a.iter().map(|x| 2.0 * x).collect();
    let (a, b) = (sample(&twice), sample(&b));
    let found = contrast(of(&a, &[]), of(&b, &[]), DRAWS).unwrap();
    let point = found.median_ratio.as_ref().unwrap().estimate.value();
    assert!((point - 2.0).abs() < 1e-3, "{point}");
    // A median of n normal variates has the variance pi/2 s^2/n; a bootstrap
    // of a median finds it roughly.
    let variance = 0.16 / 400.0 + 0.36 / 100.0;
    let expected = 1.96 * (0.5 * std::f64::consts::PI * variance).sqrt();
    let share = half_width(&found) / expected;
    assert!((0.8..1.25).contains(&share), "{share}");
    let p_value = found.kolmogorov_smirnov.p_value.unwrap();
    assert!(p_value < 1e-6, "{p_value}");
    assert_eq!(found.kolmogorov_smirnov.up_to, None);
}

/// Records of an earthquake in both samples are drawn together: a ratio of 2
/// in each earthquake is a ratio of 2 in every draw.
#[test]
fn an_earthquake_of_both_samples_is_drawn_for_both() {
    let values = quantiles(40, 0.5);
    let twice: Vec<f64> = values.iter().map(|x| 2.0 * x).collect();
    let (a, b) = (sample(&twice), sample(&values));
    let own = labels(40, 1);
    let other: Vec<String> =
        own.iter().map(|e| format!("other {e}")).collect();
    let same = contrast(of(&a, &own), of(&b, &own), DRAWS).unwrap();
    // No draw moves it.
    let ratio = same.median_ratio.unwrap().estimate;
    assert_eq!((ratio.value(), ratio.interval()), (2.0, None));
    let apart = contrast(of(&a, &own), of(&b, &other), DRAWS).unwrap();
    assert!(half_width(&apart) > 0.2);
}

#[test]
fn records_of_one_earthquake_count_as_one() {
    let base = quantiles(12, 0.5);
    let thrice: Vec<f64> = base.iter().flat_map(|x| [*x; 3]).collect();
    let (few, many) = (sample(&base), sample(&thrice));
    let other = sample(&quantiles(400, 0.5));
    let ask = |a, events: &[String]| {
        contrast(of(a, events), of(&other, &[]), DRAWS).unwrap()
    };
    let (by_event, records) = (ask(&many, &labels(12, 3)), ask(&few, &[]));
    // Medians of three equal values each.
    let share = half_width(&by_event) / half_width(&records);
    assert!((share - 1.0).abs() < 0.1, "{share}");
    assert!(half_width(&ask(&many, &[])) < 0.8 * half_width(&records));
    let p_value = by_event.kolmogorov_smirnov.p_value;
    assert_eq!(p_value, Err(ContrastError::Dependent));
    let drawn = by_event.a.drawn.to_string();
    assert_eq!(drawn, "36 records of 12 earthquakes; unit: earthquake");
    let label = labels(1, 12);
    let (one, other) = (|| of(&few, &label), || of(&other, &[]));
    for (a, b) in [(one(), other()), (other(), one())] {
        let ratio = contrast(a, b, DRAWS).unwrap().median_ratio.unwrap();
        assert_eq!(ratio.estimate.interval(), None);
        let remark = ratio.remark.unwrap().to_string();
        assert_eq!(remark, "no intervals: 1 earthquake, fewer than 8");
    }
}

#[test]
fn censored_values_leave_open_what_they_do() {
    let limits = [None, None, None, Some(2.2)];
    let a = CensoredSample::try_new(&[1.0, 2.0, 3.0, INF], &limits).unwrap();
    let b = sample(&[1.0, 2.0, 3.0, 4.0]);
    let ask = |a: &CensoredSample| contrast(of(a, &[]), of(&b, &[]), DRAWS);
    let found = ask(&a).unwrap();
    // Above 2.2 nothing is known about the fourth record.
    let distance = &found.kolmogorov_smirnov;
    assert_eq!((distance.distance, distance.up_to), (0.0, Some(2.2)));
    assert_eq!((found.a.censored, found.a.median), (1, None));
    assert_eq!(found.median_ratio, Err(ContrastError::Open));
    let found = ask(&sample(&[1.0, 1.5, 1.7, 3.0, INF])).unwrap();
    let ratio = found.median_ratio.unwrap();
    // Three or more of five draws are censored in 1 of 17.
    assert!(ratio.open > 80 && ratio.open < 160, "{}", ratio.open);
    let remark = ratio.remark.unwrap().to_string();
    assert_eq!(remark, "intervals are rough: 4 records, fewer than 8");
}

#[test]
fn what_makes_no_contrast_is_refused() {
    let (good, zero) = (sample(&[1.0, 2.0]), sample(&[1.0, 0.0]));
    let many = sample(&vec![1.0; 3001]);
    let names = ["x".to_owned(), "y".to_owned()];
    let twice = ["x".to_owned(), "x".to_owned()];
    let places = ["1".to_owned(), "2".to_owned()];
    let named = |records| ContrastSample { records, ..of(&good, &[]) };
    let ask = |a: ContrastSample<'_, String>,
               b: ContrastSample<'_, String>| {
        contrast(a, b, DRAWS).map(|_| ()).map_err(|e| e.to_string())
    };
    let refused = [
        (ask(of(&zero, &[]), of(&good, &[])), "value 2 is 0: expected"),
        (ask(of(&many, &[]), of(&good, &[])), "3001 values: expected"),
        (ask(of(&good, &names[..1]), of(&good, &[])), "1 earthquakes for 2"),
        (ask(named(&names), named(&names)), "record x is in both samples"),
        (ask(of(&good, &[]), named(&twice)), "record x occurs twice in a"),
    ];
    for (found, expected) in refused {
        let error = found.unwrap_err();
        assert!(error.starts_with(expected), "{error}");
    }
    assert_eq!(ask(named(&places), named(&places)), Ok(()));
    let draws = Draws { replicates: 1, seed: 0 };
    let found = contrast(of(&good, &[]), of(&good, &[]), draws);
    assert!(matches!(found, Err(ContrastError::Draws(_))));
}
