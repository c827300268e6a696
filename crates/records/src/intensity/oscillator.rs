//! The linear oscillator under straight lines: exact steps, and its peak
//! between them.
//!
//! With tau = w t, w = 2 pi/T and u = w^2 x (in g) the equation is
//! u'' + 2 zeta u' + u = -a, and the largest |u| is the pseudo-spectral
//! acceleration. A step is at most a twentieth of a period, so that eighteen
//! terms of the solution's Taylor series give it to rounding, without the
//! cancellation that closed-form coefficients (Nigam and Jennings 1969)
//! suffer for short steps.

use std::f64::consts::PI;

use rocking::stop;

/// Terms of the series: the next is below 0.32^18/18! = 2e-25.
const TERMS: usize = 18;

/// Number of steps between two checks of `stop::point`.
const LOOK: usize = 1 << 16;

/// Position and velocity, in g.
pub(crate) type OscillatorState = [f64; 2];

/// An oscillator and its step.
pub(crate) struct Oscillator {
    damping: f64,
    /// Number of steps in one interval of the record.
    steps: usize,
    /// One step, in w t.
    step: f64,
    /// Rows: position and velocity after a step; columns: position and
    /// velocity before, acceleration before, and its change.
    transition: [[f64; 4]; 2],
}

impl Oscillator {
    pub fn new(period_s: f64, damping: f64, dt_s: f64) -> Self {
        let interval = 2.0 * PI * dt_s / period_s;
        let steps = (10.0 * interval / PI).ceil().max(1.0);
        let step = interval / steps;
        let mut transition = [[0.0; 4]; 2];
        for column in 0..4 {
            let mut unit = [0.0; 4];
            unit[column] = 1.0;
            // The last column is a change over the step, not a slope.
            unit[3] /= step;
            let terms = terms(damping, unit);
            transition[0][column] = position(&terms, step);
            transition[1][column] = velocity(&terms, step);
        }
        Self { damping, steps: steps as usize, step, transition }
    }

    /// States at the end of every step, from the state at the first sample.
    pub fn states(
        &self,
        from: OscillatorState,
        samples: &[f64],
    ) -> Vec<OscillatorState> {
        let count = self.steps * (samples.len() - 1) + 1;
        let mut states = Vec::with_capacity(count);
        let mut state = from;
        states.push(state);
        let mut b = self.at(samples, 0);
        for i in 1..count {
            if i % LOOK == 0 {
                stop::point();
            }
            let a = std::mem::replace(&mut b, self.at(samples, i));
            let input = [state[0], state[1], a, b - a];
            state = self.transition.map(|row| {
                row.iter().zip(input).fold(0.0, |s, (c, x)| c.mul_add(x, s))
            });
            states.push(state);
        }
        states
    }

    /// Absolute acceleration of the mass, -(2 zeta u' + u), at each sample, in
    /// g, and the last state.
    pub fn absolute(
        &self,
        from: OscillatorState,
        samples: &[f64],
    ) -> (Vec<f64>, OscillatorState) {
        let states = self.states(from, samples);
        let all = states.iter().step_by(self.steps);
        let all = all.map(|state| self.felt(*state)).collect();
        (all, states.last().copied().unwrap_or(from))
    }

    fn felt(&self, [u, v]: OscillatorState) -> f64 {
        -(2.0 * self.damping).mul_add(v, u)
    }

    /// Amplitude of the absolute acceleration in the free motion from a
    /// state, which falls by exp(-zeta tau).
    pub fn free_amplitude(&self, state: OscillatorState) -> f64 {
        let zeta = self.damping;
        // With s = u'': s' = -(2 zeta s + u').
        let s = self.felt(state);
        let w = zeta.mul_add(s, state[1]) / (1.0 - zeta * zeta).sqrt();
        libm::hypot(s, w)
    }

    /// Acceleration at the start of a step.
    fn at(&self, samples: &[f64], step: usize) -> f64 {
        let (i, part) = (step / self.steps, step % self.steps);
        if part == 0 {
            return samples[i];
        }
        let share = part as f64 / self.steps as f64;
        (samples[i + 1] - samples[i]).mul_add(share, samples[i])
    }

    /// Pseudo-spectral acceleration, in g.
    pub fn peak(&self, samples: &[f64]) -> f64 {
        self.peak_of(&self.states([0.0; 2], samples), samples)
    }

    /// Largest |u| at the ends of steps, at turning points between them, and
    /// at the first one after the record.
    pub fn peak_of(&self, states: &[OscillatorState], samples: &[f64]) -> f64 {
        stop::point();
        let mut peak: f64 = 0.0;
        for (i, pair) in states.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            peak = peak.max(to[0].abs());
            if from[1] * to[1] < 0.0 {
                let (a, b) = (self.at(samples, i), self.at(samples, i + 1));
                // With v = 0 inside the step h and |u''| <= M there, |u| is
                // at most U + M h^2/8 if it is U at the ends; M is below
                // 4 (A + U) with the ground's A, since h < 0.32.
                let most = from[0].abs().max(to[0].abs());
                let push = a.abs().max(b.abs()) + most;
                if 0.5 * self.step * self.step * push + most <= peak {
                    continue;
                }
                let slope = (b - a) / self.step;
                let start = [from[0], from[1], a, slope];
                peak = peak.max(self.turning_point(start).abs());
            }
        }
        let last = states.last().copied().unwrap_or_default();
        peak.max(self.after(last).abs())
    }

    /// Position at the zero of the velocity inside a step.
    fn turning_point(&self, start: [f64; 4]) -> f64 {
        let terms = terms(self.damping, start);
        let (mut low, mut high) = (0.0, self.step);
        let mut tau = 0.5 * self.step;
        for _ in 0..50 {
            let v = velocity(&terms, tau);
            if v * start[1] > 0.0 {
                low = tau
            } else {
                high = tau
            }
            let newton = tau - v / acceleration(&terms, tau);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - tau).abs() <= 1e-15 * self.step {
                break;
            }
            tau = next;
        }
        position(&terms, tau)
    }

    /// First turning point of the free motion from a state; later ones are
    /// lower.
    fn after(&self, state: OscillatorState) -> f64 {
        let zeta = self.damping;
        let beta = (1.0 - zeta * zeta).sqrt();
        let [u, v] = state;
        let w = (v + zeta * u) / beta;
        // u = exp(-zeta tau) (u cos + w sin), and u' has the factors v and
        // -(beta u + zeta w).
        let angle = libm::atan2(v, beta * u + zeta * w);
        let angle = if angle > 0.0 { angle } else { angle + PI };
        let (sin, cos) = libm::sincos(angle);
        libm::exp(-zeta * angle / beta) * (u * cos + w * sin)
    }
}

/// Taylor terms of the position from position, velocity, acceleration of
/// the ground and its slope.
fn terms(damping: f64, [u, v, a, slope]: [f64; 4]) -> [f64; TERMS] {
    let mut terms = [0.0; TERMS];
    terms[0] = u;
    terms[1] = v;
    for k in 0..TERMS - 2 {
        let push = match k {
            0 => a,
            1 => slope,
            _ => 0.0,
        };
        let n = k as f64;
        let rate = 2.0 * damping * (n + 1.0) * terms[k + 1];
        terms[k + 2] = -(push + rate + terms[k]) / ((n + 1.0) * (n + 2.0));
    }
    terms
}

fn position(terms: &[f64; TERMS], tau: f64) -> f64 {
    terms.iter().rev().fold(0.0, |s, c| s.mul_add(tau, *c))
}

fn velocity(terms: &[f64; TERMS], tau: f64) -> f64 {
    (1..TERMS).rev().fold(0.0, |s, k| s.mul_add(tau, k as f64 * terms[k]))
}

fn acceleration(terms: &[f64; TERMS], tau: f64) -> f64 {
    (2..TERMS)
        .rev()
        .fold(0.0, |s, k| s.mul_add(tau, (k * (k - 1)) as f64 * terms[k]))
}
