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

/// Integral of a^2 over a record in g^2 s, and the times (s) from 5 to 75 % and
/// from 5 to 95 % of it (Husid 1969); no times if it is 0.
pub(super) fn husid(samples: &[f64], dt_s: f64) -> (f64, Option<[f64; 2]>) {
    let mut sum = 0.0;
    // The integral up to each sample, in g^2 times the interval.
    let mut cumulative = Vec::with_capacity(samples.len());
    cumulative.push(sum);
    for pair in samples.windows(2) {
        sum += square(pair[0], pair[1]);
        cumulative.push(sum);
    }
    // First time at which a share of the integral is reached.
    let time_s = |share: f64| {
        let target = share * sum;
        let next = cumulative.partition_point(|sum| *sum < target);
        let (i, missing) = (next - 1, target - cumulative[next - 1]);
        let (a, b) = (samples[i], samples[next]);
        // The part of the interval up to which its integral, a rising cubic,
        // is the missing rest.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let x = 0.5 * (low + high);
            let end = (b - a).mul_add(x, a);
            if x * square(a, end) < missing { low = x } else { high = x }
        }
        (i as f64 + 0.5 * (low + high)) * dt_s
    };
    let durations_s = (0.05 * sum > 0.0).then(|| {
        let from = time_s(0.05);
        [0.75, 0.95].map(|share| time_s(share) - from)
    });
    (dt_s * sum, durations_s)
}
