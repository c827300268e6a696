//! Integrals of |a| and a^2 over straight lines, and the times at which shares
//! of the integral of a^2 are reached.

/// Integral of |a| over one interval of length 1 from `a` to `b`.
pub(super) fn absolute(a: f64, b: f64) -> f64 {
    let (p, q) = (a.abs(), b.abs());
    if a * b >= 0.0 {
        0.5 * (p + q)
    } else {
        // Two triangles about the crossing.
        0.5 * p.mul_add(p, q * q) / (p + q)
    }
}

/// Integral of a^2 over one interval of length 1 from `a` to `b`.
fn square(a: f64, b: f64) -> f64 {
    a.mul_add(a, b.mul_add(b, a * b)) / 3.0
}

/// Integral of a^2 up to each sample (Husid 1969).
pub(super) struct Husid<'a> {
    samples: &'a [f64],
    dt_s: f64,
    /// In g^2 times the interval.
    cumulative: Vec<f64>,
}

impl<'a> Husid<'a> {
    pub(super) fn of(samples: &'a [f64], dt_s: f64) -> Self {
        let mut sum = 0.0;
        let mut cumulative = Vec::with_capacity(samples.len());
        cumulative.push(0.0);
        for pair in samples.windows(2) {
            sum += square(pair[0], pair[1]);
            cumulative.push(sum);
        }
        Self { samples, dt_s, cumulative }
    }

    /// Integral of a^2 over the record, in g^2 s.
    pub(super) fn total(&self) -> f64 {
        self.dt_s * self.last()
    }

    fn last(&self) -> f64 {
        self.cumulative.last().copied().unwrap_or(0.0)
    }

    /// Times from 5 to 75 % and from 5 to 95 %; `None` if the total is 0.
    pub(super) fn durations_s(&self) -> Option<[f64; 2]> {
        let from = self.time_s(0.05)?;
        Some([self.time_s(0.75)? - from, self.time_s(0.95)? - from])
    }

    /// First time at which `share` of the total is reached, in s.
    fn time_s(&self, share: f64) -> Option<f64> {
        let target = share * self.last();
        if !(target > 0.0) {
            return None;
        }
        let next = self.cumulative.partition_point(|sum| *sum < target);
        let (i, reached) = (next - 1, self.cumulative[next - 1]);
        let (a, b) = (self.samples[i], self.samples[next]);
        let missing = target - reached;
        // The part of the interval up to which its integral, a rising cubic,
        // is the missing rest.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let x = 0.5 * (low + high);
            let end = (b - a).mul_add(x, a);
            if x * square(a, end) < missing { low = x } else { high = x }
        }
        Some((i as f64 + 0.5 * (low + high)) * self.dt_s)
    }
}
