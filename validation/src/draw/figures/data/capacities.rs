//! Figure 11.

use super::Heading;
use super::thin::{largest, thin};
use crate::paper::Intensity;
use crate::table::point;
use crate::table::{Table, number};

/// Size of a panel for [`Capacities::thinned`].
const PX: f64 = 440.0;

/// Capacity curves, intensity given demand, as inverted and shifted.
#[derive(Debug, Clone, PartialEq)]
pub struct Capacities {
    /// The words.
    pub heading: Heading,
    /// Slenderness of the block.
    pub alpha_rad: f64,
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// One panel an intensity measure: (a) PGA, (b) PGV.
    pub panels: Vec<CapacityPanel>,
}

/// One intensity measure.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// The shift IM_R.
    pub shift: f64,
    /// A curve a record.
    pub curves: Vec<CapacityCurve>,
}

/// One record's capacities; the shifted curve is drawn from `im - shift`.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityCurve {
    /// Record.
    pub record: String,
    /// Demand levels, rising, 0 to 1.
    pub edp: Vec<f64>,
    /// Intensity that reaches each level (unshifted).
    pub im: Vec<f64>,
}

impl Capacities {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line. Of
    /// a curve's levels without a capacity the first one stays.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let top = largest(panel.curves.iter().flat_map(|c| &c.im));
            for curve in &mut panel.curves {
                thin(&mut curve.edp, &mut curve.im, (PX, PX / top));
            }
        }
        self
    }

    /// `panel,im_kind,shift,record,edp,im`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table =
            Table::new(&["panel", "im_kind", "shift", "record", "edp", "im"]);
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                for (edp, im) in curve.edp.iter().zip(&curve.im) {
                    table.row([
                        super::letter(i),
                        panel.intensity.name().into(),
                        number(panel.shift),
                        curve.record.clone(),
                        number(*edp),
                        point(*im),
                    ]);
                }
            }
        }
        table.finish()
    }
}
