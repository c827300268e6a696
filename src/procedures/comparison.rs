//! Two samples over the same records.

use crate::statistics::paired::{
    Equivalence, HodgesLehmann, PairedError, Pairs, SignEquivalence, SignTest,
    equivalence, hodges_lehmann, sign_equivalence,
};
use crate::statistics::{Boxplot, ExtendedSample, QuantileType};

/// Paired ratios a/b of two samples, and tests of a centre at 1.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Comparison {
    /// The pairs by what they allow.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub pairs: Pairs,
    /// Pairs with a ratio.
    pub usable: usize,
    /// Share of pairs with a ratio.
    pub share: f64,
    /// Boxplot of the ratios (quantiles of type 5); none for no ratio.
    pub boxplot: Option<Boxplot>,
    /// Sign test of the ratios against 1.
    pub sign_test: SignTest,
    /// McNemar's test on the pairs with one infinite value.
    pub mcnemar: SignTest,
    /// Centre of the ratios.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::or_reason"))]
    pub hodges_lehmann: Result<HodgesLehmann, PairedError>,
    /// Two one-sided t tests of the mean of ln ratio.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::or_reason"))]
    pub mean_equivalence: Result<Equivalence, PairedError>,
    /// Two one-sided sign tests of the median ratio.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::or_reason"))]
    pub median_equivalence: Result<SignEquivalence, PairedError>,
}

/// Compares two samples of the same records.
///
/// `a` and `b` hold one value a record, in the same order, each not negative
/// or infinite. Ratios between 1/(1 + `margin`) and 1 + `margin` count as
/// equivalent to 1.
///
/// ```
/// use rocking::procedures::compare;
/// let found = compare(&[1.0, 2.0, 3.0], &[1.0, 1.9, 3.1], 0.05)?;
/// assert_eq!(found.pairs.ratios.len(), 3);
/// assert_eq!(found.sign_test.equal, 1);
/// # Ok::<(), rocking::statistics::paired::PairedError>(())
/// ```
///
/// # Errors
/// [`PairedError`] for unequal lengths, a value that is negative or NaN, or a
/// margin that is not positive.
pub fn compare(
    a: &[f64],
    b: &[f64],
    margin: f64,
) -> Result<Comparison, PairedError> {
    if !(margin > 0.0 && margin.is_finite()) {
        return Err(PairedError::Margin(margin));
    }
    let pairs = Pairs::try_new(a, b)?;
    let ratios = &pairs.ratios;
    let sample = ExtendedSample::try_new(ratios).ok();
    let boxplot = sample
        .and_then(|s| Boxplot::try_new(&s, QuantileType::default()).ok());
    Ok(Comparison {
        usable: ratios.len(),
        share: pairs.share(),
        boxplot,
        sign_test: SignTest::of(ratios, 1.0),
        mcnemar: pairs.mcnemar(),
        hodges_lehmann: hodges_lehmann(ratios),
        mean_equivalence: equivalence(ratios, margin),
        median_equivalence: sign_equivalence(ratios, margin),
        pairs,
    })
}
