//! Sampling interval of a fitted probability.

use super::Lognormal;
use crate::{Estimate, Interval, normal};

impl Lognormal {
    /// F(x) with its interval by the delta method, for a fit by maximum
    /// likelihood or moments to `n` complete values with a known shift.
    ///
    /// Intensity x in the unit of the sample; `level` between 0 and 1, 0.95
    /// for an interval of 95 %. The score z = (ln(x - r) - mu)/beta has the
    /// variance (1 + z^2/2)/n for many values: mu has beta^2/n, beta has
    /// beta^2/(2 n), and both are independent. The ends are Phi of z minus and
    /// plus the normal quantile times the standard deviation. Up to the shift
    /// both are 0.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// let fitted = Lognormal::try_new(1.0, 0.0, 0.5)?;
    /// let found = fitted.estimate_of_cdf(86, 2.0, 0.95);
    /// let (low, high) = found.interval().unwrap().ends();
    /// // At the median z = 0: Phi(-+1.96/sqrt(86)).
    /// assert!((low - 0.416_3).abs() < 1e-4 && (high - 0.583_7).abs() < 1e-4);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    ///
    /// Lehmann and Casella, Theory of Point Estimation, 1998, section 1.8.
    pub fn estimate_of_cdf(&self, n: usize, x: f64, level: f64) -> Estimate {
        let z = self.score(x);
        if !z.is_finite() {
            let none = Interval::rising(z, z);
            return Estimate::inside(z, none).map(normal::cdf);
        }
        let wide = normal::quantile(0.5 * (1.0 + level));
        let half = wide * ((1.0 + 0.5 * z * z) / n as f64).sqrt();
        let interval = Interval::rising(z - half, z + half);
        Estimate::inside(z, interval).map(normal::cdf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By Python: N = statistics.NormalDist(); z = (log(1.5) - 0.2)/0.5;
    /// N.cdf(z -+ N.inv_cdf(0.975)*sqrt((1 + z*z/2)/86)).
    #[test]
    fn the_delta_method_is_its_formula() {
        let fitted = Lognormal::try_new(1.0, 0.2, 0.5).unwrap();
        let ends = |x| {
            let found = fitted.estimate_of_cdf(86, x, 0.95);
            found.interval().unwrap().ends()
        };
        let (low, high) = ends(2.5);
        assert!((low - 0.575_674_673_392_426_2).abs() < 1e-12, "{low}");
        assert!((high - 0.735_986_294_185_030_7).abs() < 1e-12, "{high}");
        assert_eq!((ends(1.0), ends(0.5)), ((0.0, 0.0), (0.0, 0.0)));
    }
}
