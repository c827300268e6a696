//! Ordinary motions: the site-based model of Rezaeian and Der Kiureghian.

use rocking::statistics::normal;

use super::draws::{Stream, cholesky, correlate};
use super::noise::{DT_S, Filter, corner_hz, filtered_noise, high_pass};
use super::special::{
    beta_quantile, bisect, gamma_quantile, two_sided_exponential_quantile,
};
use super::{Role, Scenario};

/// Regression coefficients of the six transformed parameters on 1,
/// magnitude, reverse faulting, distance, Vs30 (Rezaeian, Zhong, Hartzell
/// and Zareian 2015, as in the SCEC Broadband Platform): Arias intensity,
/// D5-95, time of 45 % intensity, filter frequency, its slope, damping. The
/// first row is on M/7, ln(R/25 km), ln(Vs30/750 m/s), the others on M,
/// R in km, Vs30 in m/s.
const REGRESSION: [[f64; 5]; 6] = [
    [-2.2962, 2.9440, -0.0707, -1.3564, -0.2654],
    [-6.1946, 0.9703, -0.7034, 0.0087, -0.0007],
    [-5.0105, 0.6625, -0.3450, 0.0139, -0.0002],
    [2.2525, -0.2586, -0.0808, -0.0084, 0.0],
    [-2.4886, 0.3440, 0.0441, 0.0026, -0.0001],
    [-0.2583, 0.1293, -0.4772, -0.0115, 0.0004],
];

/// Standard deviations within and between events, in the same order.
const DEVIATION: [[f64; 2]; 6] = [
    [0.5937, 0.2738],
    [0.5688, 0.4574],
    [0.4145, 0.5114],
    [0.7228, 0.6918],
    [0.9529, 0.1286],
    [0.7601, 0.6815],
];

/// Correlation of the total errors, strict lower triangle.
const CORRELATION: [&[f64]; 6] = [
    &[],
    &[-0.3555],
    &[0.0066, 0.6729],
    &[-0.1545, -0.1303, -0.2761],
    &[0.1341, -0.1576, -0.1977, -0.2034],
    &[-0.0078, -0.1958, -0.2188, 0.2814, -0.0137],
];

/// Correlation of a parameter between the two components of a pair
/// (Dabaghi and Der Kiureghian 2018, motions without pulse).
const BETWEEN_COMPONENTS: [f64; 6] =
    [0.9452, 0.8484, 0.9085, 0.8971, 0.6475, 0.7613];

/// The six parameters of one component, in physical units.
#[derive(Clone, Copy, Debug)]
struct Parameters {
    /// Arias intensity divided by gravity, pi/2 times the integral of the
    /// squared acceleration in g, in s.
    intensity_s: f64,
    /// Time from 5 to 95 % of the intensity, in s.
    d5_95_s: f64,
    /// Time of 45 % of the intensity, in s.
    mid_s: f64,
    /// Filter frequency then, in Hz.
    mid_hz: f64,
    /// Its rate of change, in Hz/s.
    slope_hz_s: f64,
    /// Filter damping ratio.
    damping: f64,
}

/// Mean of the six transformed parameters for a scenario.
fn mean(scenario: &Scenario) -> [f64; 6] {
    let reverse = if scenario.reverse { 1.0 } else { 0.0 };
    let mut out = [0.0; 6];
    for (i, b) in REGRESSION.iter().enumerate() {
        let (m, r, v) = if i == 0 {
            (
                scenario.mw / 7.0,
                libm::log(scenario.rrup_km / 25.0),
                libm::log(scenario.vs30_m_s / 750.0),
            )
        } else {
            (scenario.mw, scenario.rrup_km, scenario.vs30_m_s)
        };
        out[i] = b[0] + b[1] * m + b[2] * reverse + b[3] * r + b[4] * v;
    }
    out
}

/// From the space of normals to physical units, by the marginal
/// distributions of the same source.
fn physical(u: &[f64; 6]) -> Parameters {
    let p = u.map(normal::cdf);
    Parameters {
        intensity_s: libm::exp(-4.8255 + 1.4318 * u[0]),
        d5_95_s: 5.0 + 40.0 * beta_quantile(p[1], 1.1314, 2.4474),
        mid_s: 0.5 + 39.5 * beta_quantile(p[2], 1.5792, 3.6405),
        mid_hz: 1.4330 * gamma_quantile(p[3], 4.0982),
        slope_hz_s: two_sided_exponential_quantile(
            p[4],
            (17.095, 6.7729, 4.8512),
            (-2.0, 0.5),
        ),
        damping: 0.02 + 0.98 * beta_quantile(p[5], 1.4250, 5.7208),
    }
}

/// Gamma-shaped energy of the modulating function.
#[derive(Clone, Copy, Debug)]
struct Modulation {
    shape: f64,
    scale_s: f64,
}

impl Modulation {
    /// Shape and scale that give D5-95 and the time of 45 %; `None` where
    /// that needs a shape below 1.1 (an onset without rise) or above 100.
    fn fit(d5_95_s: f64, mid_s: f64) -> Option<Self> {
        let ratio = |shape: f64| {
            (gamma_quantile(0.95, shape) - gamma_quantile(0.05, shape))
                / gamma_quantile(0.45, shape)
        };
        let (low, high) = (1.1, 100.0);
        let target = d5_95_s / mid_s;
        if !(ratio(low) > target && ratio(high) < target) {
            return None;
        }
        let shape = bisect(low, high, |k| target - ratio(k));
        Some(Self { shape, scale_s: mid_s / gamma_quantile(0.45, shape) })
    }

    fn time_s(&self, share: f64) -> f64 {
        self.scale_s * gamma_quantile(share, self.shape)
    }

    /// Value at `t`: sqrt of the energy's density for intensity
    /// `intensity_s`.
    fn value(&self, t: f64, intensity_s: f64) -> f64 {
        if !(t > 0.0) {
            return 0.0;
        }
        let x = t / self.scale_s;
        let ln_density = (self.shape - 1.0) * libm::log(x)
            - x
            - libm::lgamma(self.shape)
            - libm::log(self.scale_s);
        let energy = intensity_s * std::f64::consts::FRAC_2_PI;
        (energy * libm::exp(ln_density)).sqrt()
    }
}

/// Both components of one motion, or `None` where the parameters drawn give
/// no modulating function or a motion of more than a minute.
pub(super) fn pair(
    scenario: &Scenario,
    suite: &str,
    stream: impl Fn(Role) -> u64,
) -> Option<[Vec<f64>; 2]> {
    let factor = cholesky(&CORRELATION)?;
    let mut draws = Stream::new(suite, stream(Role::Parameters));
    let first = correlate(&factor, &draws.normals(6));
    let other = correlate(&factor, &draws.normals(6));
    let mean = mean(scenario);
    let mut u = [mean; 2];
    for i in 0..6 {
        let [within, between] = DEVIATION[i];
        let sd = (within * within + between * between).sqrt();
        let rho = BETWEEN_COMPONENTS[i];
        u[0][i] += sd * first[i];
        u[1][i] += sd * (rho * first[i] + (1.0 - rho * rho).sqrt() * other[i]);
    }
    let parameters = u.map(|u| physical(&u));
    let modulations = [
        Modulation::fit(parameters[0].d5_95_s, parameters[0].mid_s)?,
        Modulation::fit(parameters[1].d5_95_s, parameters[1].mid_s)?,
    ];
    let ends = modulations.map(|m| m.time_s(0.99));
    let end = if ends[0] > ends[1] { ends[0] } else { ends[1] };
    let duration_s = super::duration_s(end)?;
    let n = (duration_s / DT_S).round() as usize + 1;
    let component = |i: usize, role: Role| {
        let (p, m) = (parameters[i], modulations[i]);
        let noise = Stream::new(suite, stream(role)).normals(n);
        let filter = Filter {
            mid_hz: p.mid_hz,
            slope_hz_s: p.slope_hz_s,
            damping: p.damping,
            mid_s: p.mid_s,
            between_s: (m.time_s(0.01), m.time_s(0.99)),
        };
        let mut samples = filtered_noise(&noise, &filter);
        for (k, a) in samples.iter_mut().enumerate() {
            *a *= m.value(k as f64 * DT_S, p.intensity_s);
        }
        high_pass(&mut samples, corner_hz(scenario.mw));
        samples
    };
    Some([component(0, Role::First), component(1, Role::Second)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_of_the_worked_example_are_met() {
        // Rezaeian and Der Kiureghian (2010) give the sample means of the
        // marginals: 5.87 Hz for the frequency (gamma: shape times scale),
        // 0.213 for the damping, 17.3 s for D5-95. Means by quadrature over
        // the normal scores.
        let mut sums = [0.0; 3];
        let n = 400;
        for i in 0..n {
            let u =
                crate::suites::synthesis::special::bisect(-8.0, 8.0, |z| {
                    normal::cdf(z) - (f64::from(i) + 0.5) / f64::from(n)
                });
            let p = physical(&[u; 6]);
            sums[0] += p.mid_hz / f64::from(n);
            sums[1] += p.damping / f64::from(n);
            sums[2] += p.d5_95_s / f64::from(n);
        }
        assert!((sums[0] - 5.87).abs() < 0.03, "{sums:?}");
        assert!((sums[1] - 0.213).abs() < 0.005, "{sums:?}");
        assert!((sums[2] - 17.3).abs() < 0.4, "{sums:?}");
    }

    #[test]
    fn modulation_meets_its_two_times() {
        let m = Modulation::fit(15.0, 10.0).expect("solvable");
        assert!((m.time_s(0.45) - 10.0).abs() < 1e-9);
        assert!((m.time_s(0.95) - m.time_s(0.05) - 15.0).abs() < 1e-8);
        // The squared value integrates to the intensity.
        let n = 20_000;
        let sum = (0..n).fold(0.0, |s, k| {
            let q = m.value(f64::from(k) * 0.005, 0.07);
            s + q * q * 0.005
        });
        assert!((0.5 * std::f64::consts::PI * sum - 0.07).abs() < 1e-6);
        assert!(Modulation::fit(40.0, 1.0).is_none());
    }
}
