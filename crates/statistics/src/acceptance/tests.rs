use super::*;
use crate::lilliefors::LillieforsTable;
use crate::streams::{Streams, standard_normal};

fn normals(n: usize, index: u64) -> Vec<f64> {
    let mut stream = Streams::new("acceptance, test", 0).stream(index);
    (0..n).map(|_| standard_normal(&mut stream)).collect()
}

#[test]
fn every_level_keeps_the_level_of_the_test() {
    let (n, count, replicates) = (30, 12, 4000_u64);
    let levels: Vec<_> = (0..count).map(|k| normals(n, k)).collect();
    let (critical, _) =
        LillieforsTable::embedded().critical_value(n, 0.05).unwrap();
    let band =
        NullBand::simulate(&levels, critical, replicates, "t", 0).unwrap();
    let average = mean(&band.shares);
    // Levels hardly correlated: 48000 decisions, binomial to a factor.
    let deviation = (0.05 * 0.95 / (replicates as f64 * count as f64)).sqrt();
    assert!((average - 0.95).abs() < 5.0 * deviation, "{average}");
}

#[test]
fn correlation_widens_the_band() {
    let base = normals(40, 0);
    let apart: Vec<_> = (0..20).map(|k| normals(40, k)).collect();
    let together: Vec<_> = (0..20)
        .map(|k| {
            let noise = normals(40, k);
            base.iter().zip(noise).map(|(a, b)| a + 0.1 * b).collect()
        })
        .collect();
    let spread = |levels: &[Vec<f64>]| {
        let band = NullBand::simulate(levels, 0.1385, 2000, "t", 1).unwrap();
        let shares = Sample::try_new(&band.shares).unwrap();
        let (low, high) = band.central(0.95).unwrap().ends();
        assert!(low < high || shares.sum_of_squares() == 0.0);
        (shares.sum_of_squares() / 1999.0).sqrt()
    };
    // Independent levels: sqrt(0.05 0.95/20) = 0.049; one level: 0.218.
    assert!((spread(&apart) - 0.049).abs() < 0.01);
    assert!(spread(&together) > 0.12);
}

#[test]
fn bad_levels_are_refused() {
    let refused = |levels: &[Vec<f64>]| {
        NullBand::simulate(levels, 0.1, 10, "t", 0).unwrap_err()
    };
    assert_eq!(refused(&[]), AcceptanceError::Empty);
    let error = refused(&[normals(10, 0), normals(9, 1)]);
    assert!(matches!(error, AcceptanceError::Lengths { level: 2, .. }));
    let error = refused(&[normals(10, 0), vec![1.0; 10]]);
    assert!(matches!(error, AcceptanceError::Scores { level: 2, .. }));
}

#[test]
fn many_levels_at_once_are_decided_as_one_by_one() {
    let streams = Streams::new("many levels", 0);
    let mut levels: Vec<Vec<f64>> = (0..101)
        .map(|index| {
            let mut stream = streams.stream(index);
            (0..77)
                .map(|_| {
                    let z = standard_normal(&mut stream);
                    z + 0.15 * z * z
                })
                .collect()
        })
        .collect();
    levels[40][3] = f64::INFINITY;
    let table = crate::lilliefors::LillieforsTable::embedded();
    let (critical, _) = table.critical_value(77, 0.05).unwrap();
    let found = distances(&levels);
    let is_accepted = |d: &&f64| **d <= critical;
    let accepted = levels
        .iter()
        .filter_map(|level| Sample::try_new(level).ok())
        .filter(|level| {
            let statistic = crate::lilliefors::Statistic::try_new(level);
            statistic.unwrap().d <= critical
        })
        .count();
    assert!(found.len() == 101 && found[40].is_nan());
    assert_eq!(found.iter().filter(is_accepted).count(), accepted);
    // The levels are a mixture of both decisions.
    assert!((20..80).contains(&accepted), "{accepted}");
    assert!(distances(&[]).is_empty());
}

#[test]
fn a_triangle_gives_its_correlations_back() {
    let levels: Vec<_> = (0..6).map(|k| normals(30, k)).collect();
    // The last level is the first once more.
    let levels = [&levels[..], &levels[..1]].concat();
    let scores = scores(&levels).unwrap();
    let dot = |a: &[f64], b: &[f64]| {
        a.iter().zip(b).fold(0.0, |sum, (x, y)| x.mul_add(*y, sum))
    };
    let root = root(&scores);
    for (j, row) in root.iter().enumerate() {
        for (k, other) in root.iter().enumerate() {
            let terms = row.iter().zip(other);
            let found = terms.fold(0.0, |sum, (a, b)| sum + a * b);
            assert!(
                (found - dot(&scores[j], &scores[k])).abs() < 1e-12,
                "{j} {k}"
            );
        }
    }
    assert!(root[6][6].abs() < 1e-12);
}

/// Quantiles of type 7, as R has them by default: of five values those at
/// 25 and 75 % are the second and the fourth.
#[test]
fn the_central_part_of_shares_is_that_of_r() {
    let band = NullBand { shares: vec![1.0, 0.25, 0.75, 0.0, 0.5] };
    assert_eq!(band.central(0.5).unwrap().ends(), (0.25, 0.75));
    let (low, high) = band.central(0.9).unwrap().ends();
    assert!((low - 0.05).abs() < 1e-15 && (high - 0.95).abs() < 1e-15);
}
