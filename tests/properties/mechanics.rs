//! What must hold for any block and any motion, on random ones.

use proptest::prelude::*;

use rocking::excitation::{Excitation, Pulse, PulseKind};
use rocking::integrator::{
    Model, Outcome, Overturning, Response, Scene, respond,
};

use super::CASES;
use super::drawn::{body, config, record, samples};
use super::running::{
    UNTIL_S, close, interval_s, is_clear, observe, run, scene, under,
};

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

    /// Zeros before a motion delay it; zeros after it change nothing.
    #[test]
    fn holds_under_zeros_around_the_motion(
        body in body(), samples in samples(), zeros in 1..40_usize
    ) {
        // A jump at the ends would become a ramp over one interval.
        let mut whole = vec![0.0];
        whole.extend(&samples);
        whole.push(0.0);
        let dt_s = 1.0 / 64.0;
        let mut later = vec![0.0; zeros];
        later.extend(&whole);
        let mut longer = whole.clone();
        longer.extend(vec![0.0; zeros]);
        let one = under(body, &record(dt_s, &whole));
        let padded = under(body, &record(dt_s, &longer));
        let shifted = under(body, &record(dt_s, &later));
        let shift_s = dt_s * zeros as f64;
        // Both may end by observation, at another phase of the motion.
        let resolved = is_clear(&one) && is_clear(&shifted);
        prop_assume!(resolved && is_clear(&padded));
        let condition = one.condition_number.unwrap_or(1.0);
        let tolerance = 1e-13 * condition.max(1.0);
        prop_assume!(tolerance < 1e-6);
        for other in [&padded, &shifted] {
            let gap = (one.peak_ratio - other.peak_ratio).abs();
            let ends = one.outcome.is_overturned();
            prop_assert_eq!(ends, other.outcome.is_overturned());
            prop_assert!(
                ends || gap <= tolerance,
                "peak ratio with zeros: got {}, expected {} within \
                 {tolerance:e}: off by {gap:e}",
                other.peak_ratio,
                one.peak_ratio
            );
        }
        prop_assert!(close(
            one.uplift_time_s, shifted.uplift_time_s, shift_s, 1e-12
        ));
        prop_assert!(close(
            one.uplift_time_s, padded.uplift_time_s, 0.0, 0.0
        ));
    }

    /// Halving the interval of a motion that is linear between its samples
    /// leaves the motion as it is.
    #[test]
    fn holds_when_the_interval_is_halved(
        body in body(), dt_s in interval_s(), samples in samples()
    ) {
        // Multiples of 2^-20 g, so that midpoints are exact.
        let round = |a: &f64| (a * 1_048_576.0).round() / 1_048_576.0;
        let coarse: Vec<f64> = samples.iter().map(round).collect();
        let mut fine = Vec::new();
        for pair in coarse.windows(2) {
            fine.extend([pair[0], 0.5 * (pair[0] + pair[1])]);
        }
        fine.push(coarse[coarse.len() - 1]);
        let one = under(body, &record(dt_s, &coarse));
        let two = under(body, &record(0.5 * dt_s, &fine));
        prop_assume!(is_clear(&one) && is_clear(&two));
        let condition = one.condition_number.unwrap_or(1.0);
        let tolerance = 1e-13 * condition.max(100.0);
        prop_assume!(tolerance < 1e-6);
        let fates = (one.outcome.is_overturned(), two.outcome.is_overturned());
        prop_assert_eq!(fates.0, fates.1);
        let gap = (one.peak_ratio - two.peak_ratio).abs();
        prop_assert!(
            fates.0 || gap <= tolerance,
            "peak ratio at half the interval: got {}, expected {} within \
             {tolerance:e}: off by {gap:e}",
            two.peak_ratio,
            one.peak_ratio
        );
        prop_assert!(close(
            one.uplift_time_s, two.uplift_time_s, 0.0, 1e-12
        ));
    }

    /// In free motion each impact is slower than the one before, by eta: no
    /// energy comes from nowhere.
    #[test]
    fn holds_loss_of_energy_in_free_motion(
        body in body(), ratio in 0.01..0.98_f64
    ) {
        let scene =
            Scene { initial_ratio: ratio, ..scene(body, Excitation::Free) };
        let response = respond(&scene, &observe()).unwrap();
        prop_assert!(!response.outcome.is_overturned());
        // Without loss a later peak may be larger, by rounding of the energy
        // over its slope there.
        let slope = body.alpha_rad * body.alpha_rad * (1.0 - ratio);
        let rounding = 16.0 * f64::EPSILON / slope;
        let later = if body.eta < 0.99 { 4.0 * f64::EPSILON } else { rounding };
        prop_assert!((response.peak_ratio - ratio).abs() <= later);
        for pair in response.impacts.windows(2) {
            let expected = body.eta * pair[0].speed_before_rad_s;
            let gap = (pair[1].speed_before_rad_s - expected).abs();
            prop_assert!(gap <= 1e-13 * pair[0].speed_before_rad_s);
        }
    }

    /// A pulse of any kind: mirrored by a negative factor, and never NaN.
    #[test]
    fn holds_mirror_symmetry_of_pulses(
        body in body(), kind in 0..7_usize,
        amplitude in 0.05..2.0_f64, duration_s in 0.1..3.0_f64
    ) {
        let omega_rad_s = 6.0 / duration_s;
        let period_s = duration_s;
        let kind = [
            PulseKind::OneSine { amplitude, omega_rad_s },
            PulseKind::HalfSine { amplitude, omega_rad_s },
            PulseKind::OneCosine { amplitude, omega_rad_s },
            PulseKind::Rectangle { amplitude, duration_s },
            PulseKind::Triangle { amplitude, duration_s },
            PulseKind::RickerSymmetric { amplitude, period_s, cycles: 3.0 },
            PulseKind::MavroeidisPapageorgiou {
                velocity: amplitude * duration_s / 6.0,
                frequency_hz: 1.0 / duration_s,
                gamma: 1.8,
                phase_rad: 0.7,
            },
        ][kind];
        let pulse = Pulse::try_new(kind).unwrap();
        let mirrored = pulse.scaled(-1.0).unwrap();
        let one = run(body, Excitation::Pulse(&pulse));
        let other = run(body, Excitation::Pulse(&mirrored));
        prop_assert!(!one.peak_ratio.is_nan());
        prop_assert_eq!(one.peak_ratio.to_bits(), other.peak_ratio.to_bits());
        prop_assert_eq!(one.impacts, other.impacts);
    }
}
