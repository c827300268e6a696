//! Counts of unresolved analyses. First overturnings among them are evaluated
//! again in wider arithmetic, and the effect of wrong ones on capacities is
//! bounded.

use rayon::prelude::*;
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{self, Analysis, IdaCurve, IdaPoint, Resurrections};
use rocking::integrator::{
    Arithmetic, CertifiedFate, Certify, Scene, certify,
};
use rocking_common::findings::Reevaluation;

/// Certainty of outcomes and peaks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certainty {
    /// Levels and refined ends that double precision does not resolve.
    pub unresolved: usize,
    /// First overturnings, scanned and refined, among them.
    pub reevaluated: Reevaluation,
    /// Largest relative change of a 16, 50 or 84 % overturning intensity of
    /// a block if every first overturning that was wrong in double
    /// precision, or is resolved by no arithmetic, moves to the next level
    /// that overturns.
    pub largest_shift: f64,
}

fn count(out: &mut Reevaluation, fate: &CertifiedFate) {
    out.all += 1;
    out.wrong_in_double += usize::from(fate.wrong_in_double());
    let by = match fate.by {
        _ if !fate.resolved => &mut out.unresolved,
        Arithmetic::Double => &mut out.resolved_by_double,
        Arithmetic::DoubleDouble => &mut out.resolved_by_double_double,
        Arithmetic::Octuple => &mut out.resolved_by_octuple,
    };
    *by += 1;
}

/// Counts the analyses of the curves `runs[a][r]` of `analyses[a]` and
/// `records[r]` that double precision does not resolve, and evaluates the
/// first overturnings among them again in wider arithmetic.
///
/// # Errors
/// If a level cannot be run again.
pub fn certainty(
    analyses: &[Analysis],
    records: &[NormalisedRecord],
    runs: &[Vec<IdaCurve>],
) -> anyhow::Result<Certainty> {
    let mut out = Certainty::default();
    for (analysis, curves) in analyses.iter().zip(runs) {
        out.unresolved +=
            curves.iter().flat_map(levels).filter(is_open).count();
        let open: Vec<(usize, IdaPoint)> = curves
            .iter()
            .enumerate()
            .flat_map(|(r, curve)| levels(curve).map(move |p| (r, p)))
            .filter(|(_, p)| is_open(p) && p.outcome.is_overturned())
            .collect();
        let fates: Vec<CertifiedFate> = open
            .par_iter()
            .map(|(r, point)| again(analysis, &records[*r], point))
            .collect::<anyhow::Result<_>>()?;
        let first = |curve: &IdaCurve| {
            curve.overturning.map_or(f64::INFINITY, |first| first.im())
        };
        let found: Vec<f64> = curves.iter().map(first).collect();
        let mut flipped = found.clone();
        for ((r, point), fate) in open.iter().zip(&fates) {
            count(&mut out.reevaluated, fate);
            if fate.wrong_in_double() || !fate.resolved {
                flipped[*r] = next(analysis, &records[*r], point)?;
            }
        }
        out.largest_shift = out.largest_shift.max(shift(found, flipped));
    }
    Ok(out)
}

fn is_open(point: &IdaPoint) -> bool {
    !point.resolution.resolved
}

/// Every level of a curve, the bisected end among them.
fn levels(curve: &IdaCurve) -> impl Iterator<Item = IdaPoint> {
    let refined = curve.overturning.and_then(|first| first.refined);
    curve.points.iter().copied().chain(refined)
}

/// The outcome of a level in the precision that it needs.
fn again(
    analysis: &Analysis,
    record: &NormalisedRecord,
    point: &IdaPoint,
) -> anyhow::Result<CertifiedFate> {
    let block = rocking::block::Block::try_new(
        point.slenderness_rad,
        analysis.block.frequency_rad_s(),
    )?;
    let record = ScaledRecord::to_pga(record, point.pga_g);
    let excitation = Excitation::Record(record);
    let scene = Scene {
        model: analysis.model,
        overturning: analysis.overturning,
        ..Scene::new(block, analysis.restitution, excitation)
    };
    Ok(certify(&scene, &Certify::default())?)
}

/// The next level above a first overturning that overturns.
fn next(
    analysis: &Analysis,
    record: &NormalisedRecord,
    point: &IdaPoint,
) -> anyhow::Result<f64> {
    let further = Analysis {
        resurrections: Some(Resurrections::Multiple(3.0)),
        refine: None,
        ..*analysis
    };
    let curve = ida::curve(record, &further)?;
    let above = curve.points.iter().chain(&curve.above);
    let next = above
        .filter(|other| other.im > point.im)
        .find(|other| other.outcome.is_overturned());
    Ok(next.map_or(f64::INFINITY, |point| point.im))
}

/// Largest relative change of the 16, 50 and 84 % of two samples.
fn shift(mut found: Vec<f64>, mut flipped: Vec<f64>) -> f64 {
    found.sort_by(f64::total_cmp);
    flipped.sort_by(f64::total_cmp);
    let change = |share: f64| {
        let k = (share * found.len() as f64) as usize;
        let (a, b) = (found.get(k)?, flipped.get(k)?);
        Some(if a == b { 0.0 } else { (b / a - 1.0).abs() })
    };
    let changes = [0.16, 0.5, 0.84].into_iter().filter_map(change);
    changes.fold(0.0, |largest, x| if x <= largest { largest } else { x })
}

#[cfg(test)]
mod tests {
    use rocking::accelerogram::Accelerogram;
    use rocking::block::{Block, Restitution};
    use rocking::integrator::Overturning;

    use super::*;

    /// A triangular lobe, bisected to the last bit: double precision
    /// cannot resolve its end.
    #[test]
    fn an_open_fate_is_resolved_and_hardly_moves_anything() {
        let samples =
            (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
        let record = Accelerogram::try_new("lobe", 0.01, samples.collect());
        let records = [NormalisedRecord::new(&record.unwrap())];
        let block = Block::try_new(0.1, 3.0).unwrap();
        let eta = Restitution::constant(0.92).unwrap();
        let analysis = Analysis {
            refine: Some(f64::MIN_POSITIVE),
            overturning: Overturning::HalfPi,
            ..Analysis::paper(block, eta)
        };
        let runs = ida::curves(&records, &[analysis], &ida::Batch::default())
            .unwrap();
        let found = certainty(&[analysis], &records, &runs).unwrap();
        let ends = found.reevaluated;
        assert!(found.unresolved > 0 && ends.all > 0, "{found:?}");
        assert!(ends.unresolved == 0, "{found:?}");
        let by = ends.resolved_by_double + ends.resolved_by_double_double;
        assert_eq!(by, ends.all, "{found:?}");
        // The next level of the grid overturns as well.
        assert!(found.largest_shift < 0.1, "{found:?}");
        // Nothing is open at the study's own refinement.
        let analysis = Analysis { refine: Some(1e-4), ..analysis };
        let runs = ida::curves(&records, &[analysis], &ida::Batch::default())
            .unwrap();
        let found = certainty(&[analysis], &records, &runs).unwrap();
        assert_eq!(found, Certainty::default());
    }

    #[test]
    fn quantiles_that_move_are_seen() {
        let found = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let mut flipped = found.clone();
        flipped[3] = 8.0;
        // Sorted: 1 2 3 5 6 8; the median goes from 4 to 5.
        assert!((shift(found.clone(), flipped) - 1.0 / 3.0).abs() < 1e-15);
        assert!(shift(found.clone(), found).abs() < 1e-300);
    }
}
