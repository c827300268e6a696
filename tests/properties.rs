//! What must hold for any block, any motion, any analysis and any sample, on
//! random ones. Cases are drawn from a fixed seed, so a failure repeats.

use proptest::collection::vec;
use proptest::prelude::*;

use rocking::block::{Block, Restitution};
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, curve};
use rocking_statistics::{ExtendedSample, QuantileType};

#[path = "properties/drawn.rs"]
mod drawn;
#[path = "properties/mechanics.rs"]
mod mechanics;
#[path = "properties/running.rs"]
mod running;

use drawn::{body, config, record, samples};

/// Cases of each property of the mechanics.
const CASES: u32 = 192;

proptest! {
    #![proptest_config(config(48))]

    /// An IDA rises from the onset, ends at the first overturning, and has a
    /// capacity at every level: first <= median <= last, and the monotone
    /// companion rises with the level.
    #[test]
    fn holds_order_among_capacities(body in body(), samples in samples()) {
        prop_assume!(samples.iter().any(|a| *a != 0.0));
        let block = Block::try_new(body.alpha_rad, body.p_rad_s).unwrap();
        let restitution = Restitution::constant(0.92).unwrap();
        let analysis = Analysis {
            grid: Grid::Im { step: 0.25 },
            model: body.model,
            highest_im: 12.0,
            ..Analysis::paper(block, restitution)
        };
        let record = NormalisedRecord::new(&record(0.02, &samples));
        let ida = curve(&record, &analysis).unwrap();
        prop_assert!(ida.points.is_sorted_by(|a, b| a.im < b.im));
        let overturned =
            ida.points.iter().filter(|p| p.outcome.is_overturned()).count();
        prop_assert_eq!(overturned, usize::from(ida.overturning.is_some()));
        let mut vertices = vec![(1.0, 0.0)];
        let above = ida.standing().filter(|point| point.im > 1.0);
        vertices.extend(above.map(|point| (point.im, point.edp())));
        let end_im = ida.overturning.map(|first| first.im());
        let response = ResponseCurve::try_new(&vertices, end_im).unwrap();
        let mut before = 0.0;
        for level in (1..=20).map(|k| 0.05 * f64::from(k)) {
            let crossings = response.crossings(level).unwrap();
            prop_assert_eq!(crossings.all().len() % 2, 1);
            let im = |rule| crossings.capacity(rule).im();
            let [first, median, last] = [
                InversionRule::First,
                InversionRule::Median,
                InversionRule::Last,
            ].map(im);
            prop_assert!(first <= median && median <= last);
            let companion = im(InversionRule::Monotone);
            prop_assert!(companion >= before, "{companion} {before}");
            before = companion;
        }
    }
}

proptest! {
    #![proptest_config(config(256))]

    /// Quantiles of every type rise with the probability, stay within the
    /// sample and do not depend on its order.
    #[test]
    fn holds_order_among_quantiles(
        values in vec(
            prop_oneof![8 => -9.0..9.0_f64, 1 => Just(f64::INFINITY)],
            1..40,
        ),
        mut probabilities in vec(0.0..=1.0_f64, 2..6),
    ) {
        let sample = ExtendedSample::try_new(&values).unwrap();
        let mut turned = values.clone();
        turned.reverse();
        let reversed = ExtendedSample::try_new(&turned).unwrap();
        probabilities.sort_by(f64::total_cmp);
        for number in 1..=9 {
            let kind = QuantileType::try_new(number).unwrap();
            let quantiles: Vec<f64> = probabilities
                .iter()
                .map(|p| kind.extended_quantile(&sample, *p).unwrap())
                .collect();
            prop_assert!(quantiles.is_sorted(), "{number}: {quantiles:?}");
            let within = |q: &f64| {
                *q >= sample.sorted()[0]
                    && *q <= sample.sorted()[values.len() - 1]
            };
            prop_assert!(quantiles.iter().all(within));
            for (p, q) in probabilities.iter().zip(&quantiles) {
                let other = kind.extended_quantile(&reversed, *p).unwrap();
                prop_assert_eq!(q.to_bits(), other.to_bits());
            }
        }
    }
}
