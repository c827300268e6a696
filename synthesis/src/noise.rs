//! Modulated, filtered white noise and what is done to it afterwards.

use std::f64::consts::PI;

use rocking::stop;

/// Sampling interval of every synthetic record.
pub(super) const DT_S: f64 = 0.01;

/// Linearly varying filter of constant damping.
#[derive(Clone, Copy, Debug)]
pub(super) struct Filter {
    /// Filter frequency at `mid_s`, in Hz.
    pub(super) mid_hz: f64,
    /// Rate of change of the filter frequency, in Hz/s.
    pub(super) slope_hz_s: f64,
    /// Damping ratio.
    pub(super) damping: f64,
    /// Time at which the frequency is `mid_hz`, in s.
    pub(super) mid_s: f64,
    /// The frequency varies between these two times only, in s.
    pub(super) between_s: (f64, f64),
}

impl Filter {
    /// Filter frequency at time `t`, not below 0.3 Hz, in Hz.
    pub(super) fn frequency_hz(&self, t: f64) -> f64 {
        let (first, last) = self.between_s;
        let t = if t < first {
            first
        } else if t > last {
            last
        } else {
            t
        };
        let hz = self.mid_hz + self.slope_hz_s * (t - self.mid_s);
        if hz > 0.3 { hz } else { 0.3 }
    }
}

/// Filtered noise of unit variance: the sum of the answers of one damped
/// oscillator a sample, each with the frequency of its own instant, divided
/// by the standard deviation of that sum (Rezaeian and Der Kiureghian 2008,
/// Eqs. 3, 5 and 8). An answer is followed until it has decayed to 1e-5.
pub(super) fn filtered_noise(noise: &[f64], filter: &Filter) -> Vec<f64> {
    let n = noise.len();
    let mut sum = vec![0.0; n];
    let mut variance = vec![0.0; n];
    let ratio = (1.0 - filter.damping * filter.damping).sqrt();
    for (i, u) in noise.iter().enumerate() {
        stop::point();
        let omega = 2.0 * PI * filter.frequency_hz(i as f64 * DT_S);
        let decay = filter.damping * omega;
        let steps = (11.513 / (decay * DT_S)).ceil();
        let last =
            if steps < (n - i) as f64 { i + steps as usize } else { n - 1 };
        let shrink = libm::exp(-decay * DT_S);
        let (sin, cos) = libm::sincos(omega * ratio * DT_S);
        let (turn_re, turn_im) = (shrink * cos, shrink * sin);
        let (mut re, mut im) = (omega / ratio, 0.0);
        for k in i + 1..=last {
            (re, im) =
                (re * turn_re - im * turn_im, re * turn_im + im * turn_re);
            sum[k] += im * u;
            variance[k] += im * im;
        }
    }
    for (x, v) in sum.iter_mut().zip(&variance) {
        if *v > 0.0 {
            *x /= v.sqrt();
        }
    }
    sum
}

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

/// Arias-type energy: pi/2 times the integral of the squared samples.
pub(super) fn energy(samples: &[f64]) -> f64 {
    0.5 * PI * DT_S * samples.iter().fold(0.0, |s, a| a.mul_add(*a, s))
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
    use crate::draws::Stream;

    #[test]
    fn filtered_noise_has_unit_variance_and_the_filter_frequency() {
        let filter = Filter {
            mid_hz: 3.0,
            slope_hz_s: 0.0,
            damping: 0.1,
            mid_s: 0.0,
            between_s: (0.0, 1.0),
        };
        let z = Stream::new("filter", 0).normals(200_000);
        let x = filtered_noise(&z, &filter);
        let n = x.len() as f64;
        let variance = x.iter().fold(0.0, |s, a| s + a * a) / n;
        assert!((variance - 1.0).abs() < 0.02, "{variance}");
        // The rate of upward zero crossings of the answer of a linear
        // oscillator to white noise is its undamped frequency.
        let up = x.windows(2).filter(|w| w[0] < 0.0 && w[1] >= 0.0).count();
        let hz = up as f64 / (n * DT_S);
        assert!((hz - 3.0).abs() < 0.06, "{hz}");
    }

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
        let mut samples = Stream::new("settle", 0).normals(4000);
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
