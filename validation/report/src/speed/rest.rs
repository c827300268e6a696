//! The rule for rest that every tool applies, and the impacts by it.
//!
//! After an impact the block goes to rest if the series of hops provably ends
//! within the record's interval while the ground stays below the uplift
//! threshold. The core lists the impacts of that series, but other tools do
//! not integrate them, so lists are compared without them.

use rocking::block::Block;

/// Ground acceleration over gravity, linear between samples.
pub struct GroundRecord<'a> {
    /// Samples, multiples of gravity.
    pub samples_g: &'a [f64],
    /// Interval in s.
    pub dt_s: f64,
}

impl GroundRecord<'_> {
    /// End of the record in s.
    pub fn end_s(&self) -> f64 {
        (self.samples_g.len() - 1) as f64 * self.dt_s
    }

    /// Number of the interval that contains a time; none beyond the end.
    fn interval(&self, time_s: f64) -> Option<usize> {
        let k = (time_s / self.dt_s) as usize;
        (k + 1 < self.samples_g.len()).then_some(k)
    }

    /// Value and slope (1/s) at a time within an interval.
    fn at(&self, k: usize, time_s: f64) -> (f64, f64) {
        let (a, b) = (self.samples_g[k], self.samples_g[k + 1]);
        let slope = (b - a) / self.dt_s;
        (slope.mul_add(time_s - k as f64 * self.dt_s, a), slope)
    }

    /// First instant from `time_s` on at which |a/g| exceeds the threshold,
    /// and the sign of a.
    pub fn exceedance(
        &self,
        time_s: f64,
        threshold: f64,
    ) -> Option<(f64, f64)> {
        let first = self.interval(time_s)?;
        (first..self.samples_g.len() - 1).find_map(|k| {
            let start = k as f64 * self.dt_s;
            let from = if k == first { time_s } else { start };
            let (now, slope) = self.at(k, from);
            if now.abs() > threshold {
                return Some((from, now.signum()));
            }
            let last = self.samples_g[k + 1];
            if !(last.abs() > threshold) {
                return None;
            }
            let level = threshold * last.signum();
            Some((from + (level - now) / slope, last.signum()))
        })
    }
}

/// Time in s after an impact at which the hops end, if they provably do; `side`
/// is the sign of theta after the impact and `speed_rad_s` the speed.
pub fn chatter_s(
    block: &Block,
    eta: f64,
    ground: &GroundRecord<'_>,
    time_s: f64,
    side: f64,
    speed_rad_s: f64,
) -> Option<f64> {
    let positive = |x: f64| (x > 0.0).then_some(x);
    let (p, alpha) = (block.frequency_rad_s(), block.slenderness_rad());
    let threshold = libm::tan(alpha);
    let cosine = libm::cos(alpha);
    let restoring = |f: f64| (threshold + f) * cosine;
    let k = ground.interval(time_s)?;
    let (f, slope) = ground.at(k, time_s);
    let (f, w) = (side * f, speed_rad_s / p);
    let left = ((k + 1) as f64 * ground.dt_s - time_s) * p;
    positive(threshold - f.abs())?;
    let guess = 2.0 * w / (restoring(-f.abs()) * (1.0 - eta));
    positive(left - guess)?;
    let window = f64::min(2.0 * guess, left);
    let drift = (slope / p).abs() * window;
    let least = positive(restoring(-(f.abs() + drift)))?;
    let push = (1.0 + threshold) * 2.0 * w * w / least;
    let least = positive(least - push)?;
    let ratio =
        |f| (restoring(f + drift) + push) / (restoring(f - drift) - push);
    let worst = f64::max(ratio(f), ratio(-f));
    let decay = eta * worst.sqrt();
    positive(1.0 - decay)?;
    let bound = 2.0 * w * worst.sqrt() / (least * (1.0 - decay));
    positive(window - bound)?;
    let hops = 1.0 / restoring(f) + eta / restoring(-f);
    Some(2.0 * w * hops / (1.0 - eta * eta) / p)
}

/// Times of the impacts up to the record's end, without the series that end at
/// rest; `all` has the time and the speed before each.
pub fn without_chatter(
    block: &Block,
    eta: f64,
    ground: &GroundRecord<'_>,
    all: &[(f64, f64)],
) -> Vec<f64> {
    let threshold = libm::tan(block.slenderness_rad());
    let mut kept = Vec::new();
    let Some((mut uplift_s, sign)) = ground.exceedance(0.0, threshold) else {
        return kept;
    };
    let mut side = -sign;
    for (time_s, speed_before_rad_s) in all {
        // A hop of a series that is left out.
        if !(*time_s > uplift_s) {
            continue;
        }
        if *time_s > ground.end_s() {
            break;
        }
        kept.push(*time_s);
        side = -side;
        let speed = eta * speed_before_rad_s;
        if let Some(rest) = chatter_s(block, eta, ground, *time_s, side, speed)
        {
            match ground.exceedance(time_s + rest, threshold) {
                None => break,
                Some((time_s, sign)) => (uplift_s, side) = (time_s, -sign),
            }
        }
    }
    kept
}
