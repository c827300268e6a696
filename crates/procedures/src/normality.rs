//! Is a sample normal, or lognormal above a shift?

use super::{ProcedureError, Shift};
use rocking_statistics::estimate::keys;
use rocking_statistics::lilliefors::{
    Inapplicable, LillieforsError, LillieforsTable, LillieforsTest, Null,
    NullDistribution, NullSource, Scale, ShiftedNull, Statistic, Verdict,
};
use rocking_statistics::normality::{
    Battery, NormalityTest, anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking_statistics::{CensoredSample, Estimate, ExtendedSample, Sample};

/// Values to simulate if the smallest value is the shift and no number of
/// samples is given: in 100 to 100,000 samples.
const VALUES: u64 = 100_000_000;

/// Options of the tests of normality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalityOptions {
    /// The logarithms above this shift are tested; none tests the values
    /// themselves. A free shift is rejected.
    pub log_above: Option<Shift>,
    /// Level of the tests, in (0, 1).
    pub level: f64,
    /// Samples to simulate; none takes the table.
    pub replicates: Option<u64>,
    /// Seed of the simulation.
    pub seed: u64,
}

impl Default for NormalityOptions {
    /// The values themselves at level 0.05, by the table.
    fn default() -> Self {
        Self { log_above: None, level: 0.05, replicates: None, seed: 0 }
    }
}

/// Lilliefors' test of a sample, and other tests beside it.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Normality {
    /// Size of the sample, censored values included.
    pub n: usize,
    /// Distinct values among those tested.
    pub distinct: Option<usize>,
    /// Size of the largest tie.
    pub largest_tie: Option<usize>,
    /// Lilliefors' statistic.
    pub statistic: Option<Statistic>,
    /// Its p-value, with the interval of its Monte Carlo error (95 %).
    #[serde(serialize_with = "keys::if_value")]
    pub p_value: Option<Estimate>,
    /// Origin of the p-value.
    pub method: Option<NullSource>,
    /// Simulated samples behind the p-value; none for the table.
    pub replicates: Option<usize>,
    /// Critical value of the statistic at the level.
    pub critical_value: Option<f64>,
    /// The level.
    pub level: f64,
    /// The verdict; none if the test does not apply.
    pub verdict: Option<Verdict>,
    /// Why the test does not apply.
    pub reason: Option<String>,
    /// Anderson and Darling's A2.
    pub anderson_darling: Option<OtherTest>,
    /// Cramer and von Mises' W2.
    pub cramer_von_mises: Option<OtherTest>,
    /// Shapiro and Wilk's W.
    pub shapiro_wilk: Option<OtherTest>,
}

/// A test beside Lilliefors'.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct OtherTest {
    /// The statistic.
    pub statistic: f64,
    /// Its p-value: simulated, with its 95 % interval, if a number of
    /// replicates was given; else from a published approximation, and with
    /// an interval from 0 where that ends.
    #[serde(flatten, serialize_with = "keys::p_value")]
    pub p_value: Estimate,
    /// The verdict of a simulated p-value.
    pub verdict: Option<Verdict>,
}

/// Tests whether a sample is normal, or lognormal above a shift.
///
/// The p-value of Lilliefors' test comes from the project's Monte Carlo table,
/// or from a simulation if replicates are given; the p-values of the other
/// tests are then simulated, too.
///
/// ```
/// use rocking_procedures::{NormalityOptions, test_normality};
/// use rocking_statistics::{CensoredSample, lilliefors::Verdict};
/// let values: Vec<f64> = (1..=40).map(f64::from).collect();
/// let sample = CensoredSample::try_new(&values, &[])?;
/// let found = test_normality(&sample, &NormalityOptions::default())?;
/// assert_eq!(found.verdict, Some(Verdict::NotRejected));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ProcedureError`] for a level outside (0, 1), a free shift, or invalid
/// replicates of a simulation; a test that does not apply is a result.
pub fn test_normality(
    sample: &CensoredSample,
    options: &NormalityOptions,
) -> Result<Normality, ProcedureError> {
    let level = options.level;
    if !(level > 0.0 && level < 1.0) {
        return Err(ProcedureError::Level(level));
    }
    let (scale, tested) = match options.log_above {
        None => (Scale::Linear, sample.extended()),
        Some(Shift::Free) => return Err(ProcedureError::FreeShiftTested),
        Some(shift) => {
            let (shift, above) = shift.split(sample)?;
            let above = ExtendedSample::try_new(above.values())?;
            (Scale::Logarithmic { shift }, above)
        }
    };
    let simulated = simulated(sample, &tested, options)?;
    let null = simulated.as_ref();
    let source = null.map_or(Null::Table(LillieforsTable::embedded()), |s| {
        Null::Simulated(&s.1)
    });
    let found = LillieforsTest::new(&tested, scale, level, source);
    if let Err(Inapplicable::Test(error @ LillieforsError::Level { .. })) =
        found.verdict
    {
        return Err(error.into());
    }
    let [anderson_darling, cramer_von_mises, shapiro_wilk] =
        others(found.tested.as_ref(), options)?;
    let method = |own| null.map_or(own, |s| s.0);
    let (verdict, reason) = match found.verdict {
        Ok(verdict) => (Some(verdict), None),
        Err(reason) => (None, Some(reason.to_string())),
    };
    Ok(Normality {
        n: found.n,
        distinct: found.tested.as_ref().map(Sample::distinct),
        largest_tie: found.tested.as_ref().map(Sample::largest_tie),
        statistic: found.statistic,
        p_value: found.p_value,
        method: found.source.map(method),
        replicates: found.p_value.and(null.map(|s| s.1.sorted().len())),
        critical_value: found.critical_value,
        level,
        verdict,
        reason,
        anderson_darling,
        cramer_von_mises,
        shapiro_wilk,
    })
}

/// The null distribution to simulate; none if the table answers.
fn simulated(
    sample: &CensoredSample,
    tested: &ExtendedSample,
    options: &NormalityOptions,
) -> Result<Option<(NullSource, NullDistribution)>, LillieforsError> {
    let (n, seed) = (tested.len(), options.seed);
    if n < 4 || tested.censored() > 0 {
        return Ok(None);
    }
    if options.log_above == Some(Shift::Smallest) {
        let own = (VALUES / n as u64).clamp(100, 100_000);
        let replicates = options.replicates.unwrap_or(own);
        let values = sample.values();
        let null = ShiftedNull::smallest_value(values, replicates, seed)?.null;
        return Ok(Some((NullSource::SmallestValue, null)));
    }
    let Some(replicates) = options.replicates else { return Ok(None) };
    let null = NullDistribution::simulate(n, replicates, seed)?;
    Ok(Some((NullSource::Simulation, null)))
}

/// Anderson-Darling, Cramer-von Mises and Shapiro-Wilk: simulated with
/// replicates, unless the shift is the sample's own or the sample is larger
/// than Shapiro and Wilk's test takes.
fn others(
    tested: Option<&Sample>,
    options: &NormalityOptions,
) -> Result<[Option<OtherTest>; 3], ProcedureError> {
    let Some(tested) = tested else { return Ok([None; 3]) };
    let known = options.log_above != Some(Shift::Smallest)
        && (4..=Battery::MOST_VALUES).contains(&tested.len());
    let replicates = options.replicates.filter(|_| known);
    let tests = match replicates {
        Some(replicates) => {
            let (n, seed) = (tested.len(), options.seed);
            let found = Battery::simulate(n, replicates, seed)?.assess(tested);
            found.map_or([None; 3], |tests| tests.map(Some))
        }
        None => [anderson_darling, cramer_von_mises, shapiro_wilk]
            .map(|test| test(tested).ok()),
    };
    Ok(tests.map(|test| {
        let NormalityTest { statistic, p_value, .. } = test?;
        let verdict =
            replicates.map(|_| Verdict::at_level(&p_value, options.level));
        Some(OtherTest { statistic, p_value, verdict })
    }))
}
