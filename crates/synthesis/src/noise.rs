//! Processing of a motion after its synthesis.

use std::f64::consts::PI;

use rocking::stop;

/// Sampling interval of every synthetic record.
pub(super) const DT_S: f64 = 0.01;

/// High-pass filter of Rezaeian and Der Kiureghian (2008, Eq. 9): the
/// acceleration of a critically damped oscillator of corner frequency
/// `corner_hz` pushed by `samples`, integrated exactly for samples joined by
/// straight lines. Velocity and displacement then return to zero.
pub(super) fn high_pass(samples: &mut [f64], corner_hz: f64) {
    let w = 2.0 * PI * corner_hz;
    let decay = libm::exp(-w * DT_S);
    let (mut x, mut v) = (0.0, 0.0);
    stop::point();
    let Some(mut previous) = samples.first().copied() else { return };
    for sample in samples.iter_mut().skip(1) {
        let slope = (*sample - previous) / DT_S;
        let rate = slope / (w * w);
        let offset = (previous - 2.0 * slope / w) / (w * w);
        let c1 = x - offset;
        let c2 = v - rate + w * c1;
        x = decay * (c1 + c2 * DT_S) + offset + rate * DT_S;
        v = decay * (c2 - w * (c1 + c2 * DT_S)) + rate;
        previous = *sample;
        *sample -= w * (2.0 * v + w * x);
    }
}

/// Removes the end velocity by a raised cosine over the whole record and
/// rounds to a millionth of g, so that the decimal text of a sample reads
/// back to the same number.
pub(super) fn settle(samples: &mut [f64]) {
    let n = samples.len() as f64 - 1.0;
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else {
        return;
    };
    let ends = 0.5 * (first + last);
    let end_velocity = samples.iter().fold(-ends, |s, a| s + a);
    for (i, a) in samples.iter_mut().enumerate() {
        let bump = 1.0 - libm::cos(2.0 * PI * i as f64 / n);
        *a = ((*a - end_velocity * bump / n) * 1e6).round() / 1e6;
    }
}

/// Corner frequency of the high-pass filter for magnitude `mw` (Dabaghi and
/// Der Kiureghian 2014), in Hz.
pub(super) fn corner_hz(mw: f64) -> f64 {
    libm::exp10(1.4071 - 0.3452 * mw)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draws::Deviates;

    #[test]
    fn high_pass_answers_a_step_as_the_closed_form_does() {
        // Constant push 1: x'' = exp(-w t) (1 - w t).
        let mut samples = vec![1.0; 500];
        high_pass(&mut samples, 0.2);
        let w = 2.0 * PI * 0.2;
        for (i, a) in samples.iter().enumerate() {
            let t = i as f64 * DT_S;
            let exact = libm::exp(-w * t) * (1.0 - w * t);
            assert!((a - exact).abs() < 1e-12, "{i}: {a} {exact}");
        }
    }

    #[test]
    fn settled_samples_end_at_rest_and_read_back() {
        let mut samples = Deviates::new("settle", 0).normals(4000);
        settle(&mut samples);
        let ends = 0.5 * (samples[0] + samples[3999]);
        let velocity = samples.iter().fold(-ends, |s, a| s + a) * DT_S;
        assert!(velocity.abs() < 1e-5, "{velocity}");
        for a in samples {
            let text = format!("{a:.6}");
            assert_eq!(text.parse::<f64>().expect("number"), a);
        }
    }
}
