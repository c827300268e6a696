//! Contents of buildings: FEMA P-58's overturning fragilities of bookcases
//! and filing cabinets, and the same items as blocks under the study's suites.

use std::sync::LazyLock;

use rocking::block::Block;
use rocking::units::STANDARD_GRAVITY_M_S2;
use serde::Deserialize;

const INCH_M: f64 = 0.0254;

/// An item of FEMA P-58 with its overturning fragility.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Furnishing {
    /// Name in FEMA P-58.
    pub id: String,
    /// Kind of furniture.
    pub item: String,
    depth_in: f64,
    height_in: f64,
    /// Median peak floor velocity at overturning, in m/s.
    pub median_m_s: f64,
    /// Dispersion, all uncertainties together.
    pub dispersion: f64,
}

impl Furnishing {
    /// Depth, the width of the base, in m.
    #[must_use]
    pub fn depth_m(&self) -> f64 {
        self.depth_in * INCH_M
    }

    /// Height in m.
    #[must_use]
    pub fn height_m(&self) -> f64 {
        self.height_in * INCH_M
    }

    /// Half the diagonal, in m.
    #[must_use]
    pub fn half_diagonal_m(&self) -> f64 {
        0.5 * libm::hypot(self.depth_m(), self.height_m())
    }

    /// The homogeneous block of this size.
    ///
    /// # Errors
    /// For a size that is not positive.
    pub fn block(&self) -> anyhow::Result<Block> {
        let (depth, height) = (self.depth_m(), self.height_m());
        Ok(Block::from_dimensions(depth, height, STANDARD_GRAVITY_M_S2)?)
    }
}

/// The nine items that FEMA P-58 gives with their sizes.
///
/// # Panics
/// If the table is not of the expected form: it is compiled in.
#[must_use]
pub fn items() -> &'static [Furnishing] {
    const TABLE: &str = rocking_fixtures::text("comparison/fema-p58.csv");
    static ITEMS: LazyLock<Vec<Furnishing>> = LazyLock::new(|| {
        let mut reader = csv::Reader::from_reader(TABLE.as_bytes());
        let rows = reader.deserialize::<Furnishing>();
        rows.map(|row| row.unwrap_or_else(|e| panic!("fema-p58: {e}")))
            .collect()
    });
    &ITEMS
}
