//! What must hold for any block and any motion, on random ones.

use proptest::prelude::*;

use rocking::excitation::{Excitation, Pulse, PulseName, PulseParameter as P};
use rocking::integrator::{Model, Outcome, Overturning, Response};

use super::CASES;
use super::drawn::{body, config, record, samples};
use super::running::{UNTIL_S, interval_s, run, under};

proptest! {
    #![proptest_config(config(CASES))]

    /// Ground motion times -1 gives rotation times -1, to the last bit.
    #[test]
    fn holds_mirror_symmetry(
        body in body(), dt_s in interval_s(), samples in samples()
    ) {
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        let one = under(body, &record(dt_s, &samples));
        let other = under(body, &record(dt_s, &mirrored));
        let bits = |r: &Response| {
            (r.peak_ratio.to_bits(), r.fate_margin.to_bits(), r.work)
        };
        prop_assert_eq!(bits(&one), bits(&other));
        prop_assert_eq!(&one.impacts, &other.impacts);
        prop_assert_eq!(one.rest_time_s, other.rest_time_s);
        match (one.outcome, other.outcome) {
            (
                Outcome::Overturned { time_s: a, side: s },
                Outcome::Overturned { time_s: b, side: t },
            ) => {
                prop_assert_eq!(a.to_bits(), b.to_bits());
                prop_assert_eq!(s.sign(), -t.sign());
            }
            (a, b) => prop_assert_eq!(a, b),
        }
        prop_assert_eq!(one.history.len(), other.history.len());
        for (a, b) in one.history.iter().zip(&other.history) {
            prop_assert_eq!(a.rotation_rad, -b.rotation_rad);
            prop_assert_eq!(a.velocity_rad_s, -b.velocity_rad_s);
        }
    }

    /// No panic, no NaN, and what is said of a run fits together.
    #[test]
    fn holds_order_among_times_and_peaks(
        body in body(), dt_s in interval_s(), samples in samples()
    ) {
        let response = under(body, &record(dt_s, &samples));
        for number in [
            Some(response.peak_ratio),
            Some(response.fate_margin),
            response.error_estimate,
            response.rest_error_s,
            response.overturning_error_s,
            response.condition_number,
        ].into_iter().flatten() {
            prop_assert!(!number.is_nan());
        }
        let limit = match body.overturning {
            Overturning::Alpha => 1.0,
            Overturning::HalfPi => 1.6 / body.alpha_rad,
        };
        if let Outcome::Rocked { peak_ratio } = response.outcome {
            prop_assert!(peak_ratio > 0.0 && peak_ratio < limit);
            prop_assert_eq!(peak_ratio, response.peak_ratio);
        }
        let highest = response.history.iter()
            .map(|point| point.rotation_rad.abs() / body.alpha_rad)
            .fold(0.0, f64::max);
        prop_assert!(
            response.outcome.is_overturned()
                || highest <= response.peak_ratio * (1.0 + 1e-9) + 1e-15
        );
        let impacts = &response.impacts;
        prop_assert!(impacts.is_sorted_by(|a, b| a.time_s <= b.time_s));
        let uplift_s = response.uplift_time_s.unwrap_or(0.0);
        let end_s = match response.outcome {
            Outcome::Overturned { time_s, .. } => time_s,
            _ => response.rest_time_s.unwrap_or(UNTIL_S),
        };
        for impact in impacts {
            prop_assert!(impact.speed_before_rad_s >= 0.0);
            prop_assert!(impact.time_s >= uplift_s);
            prop_assert!(impact.time_s <= end_s);
        }
        let pga_g = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
        let threshold = match body.model {
            Model::Nonlinear => libm::tan(body.alpha_rad),
            Model::Linearized => body.alpha_rad,
        };
        let moves = response.outcome != Outcome::NoUplift;
        if (pga_g / threshold - 1.0).abs() > 1e-12 {
            prop_assert_eq!(moves, pga_g > threshold);
        }
    }

    /// A pulse of any kind: mirrored by a negative factor, and never NaN.
    #[test]
    fn holds_mirror_symmetry_of_pulses(
        body in body(), name in 0..PulseName::ALL.len(),
        amplitude in 0.05..2.0_f64, duration_s in 0.1..3.0_f64
    ) {
        let kind = PulseName::ALL[name].kind(|parameter| {
            Ok::<_, ()>(match parameter {
                P::Amplitude => amplitude,
                P::Omega => 6.0 / duration_s,
                P::Duration | P::Period => duration_s,
                P::Cycles => 3.0,
                P::Velocity => amplitude * duration_s / 6.0,
                P::Frequency => 1.0 / duration_s,
                P::Gamma => 1.8,
                P::Phase => 0.7,
            })
        }).unwrap();
        let pulse = Pulse::try_new(kind).unwrap();
        let mirrored = pulse.scaled(-1.0).unwrap();
        let one = run(body, Excitation::Pulse(&pulse));
        let other = run(body, Excitation::Pulse(&mirrored));
        prop_assert!(!one.peak_ratio.is_nan());
        prop_assert_eq!(one.peak_ratio.to_bits(), other.peak_ratio.to_bits());
        prop_assert_eq!(one.impacts, other.impacts);
    }
}
