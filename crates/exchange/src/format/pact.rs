//! A table of medians and dispersions for FEMA P-58's PACT.

use rocking_records::intensity::Intensity;
use rocking_statistics::Lognormal;

use super::{ExchangeError, ExchangeFormat, Result, Texts};
use crate::fragility::BlockFragility;
use crate::table::{Table, number};

/// The format.
pub(super) static FORMAT: ExchangeFormat = ExchangeFormat {
    name: "pact",
    help: "Median and dispersion, not shifted: g, m/s",
    cells: "PACT | PGA, PGV | refused",
    texts,
    ..ExchangeFormat::BASE
};

/// Median and dispersion as FEMA P-58's PACT expects them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pact {
    /// Measure of the ground motion: PGA or PGV.
    pub demand: &'static str,
    /// Unit of the median: g or m/s.
    pub unit: &'static str,
    /// Median.
    pub median: f64,
    /// Standard deviation of the logarithm.
    pub dispersion: f64,
}

impl Pact {
    /// The parameters of a fragility in g or m/s; `None` if it has a shift,
    /// which PACT lacks.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// use rocking_records::intensity::Intensity;
    /// use rocking_exchange::Pact;
    /// let fitted = Lognormal::try_new(0.0, 0.0, 0.5)?;
    /// let pact = Pact::of(Intensity::Pgv, &fitted).expect("no shift");
    /// assert_eq!((pact.demand, pact.unit), ("PGV", "m/s"));
    /// assert_eq!((pact.median, pact.dispersion), (1.0, 0.5));
    /// let shifted = Lognormal::try_new(0.1, 0.0, 0.5)?;
    /// assert_eq!(Pact::of(Intensity::Pgv, &shifted), None);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    pub fn of(intensity: Intensity, fragility: &Lognormal) -> Option<Self> {
        (fragility.shift() == 0.0).then(|| Self {
            demand: intensity.row().symbol,
            unit: intensity.row().unit,
            median: fragility.median(),
            dispersion: fragility.dispersion(),
        })
    }
}

fn texts(fragilities: &[BlockFragility]) -> Result<Texts> {
    let mut table = Table::headed(
        "id,damage_state,demand,unit,directional,median,dispersion",
    );
    for one in fragilities {
        let id = &one.id;
        let intensity = one.im.dimensionless();
        let intensity =
            intensity.ok_or_else(|| one.unknown("PACT", "pga or pgv"))?;
        for (state, total) in one.totals(1.0)? {
            let closed = total.closed();
            let pact = closed
                .and_then(|law| Pact::of(intensity, &law))
                .ok_or_else(|| ExchangeError::Shifted(id.clone()))?;
            table.row([
                id.to_string(),
                state.name.to_string(),
                pact.demand.into(),
                pact.unit.into(),
                "yes".into(),
                number(pact.median),
                number(pact.dispersion),
            ]);
        }
    }
    Ok(Texts { main: table.finish(), beside: None })
}
