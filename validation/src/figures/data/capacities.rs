//! Figure 11.

use serde::Serialize;

use super::table::point;
use super::{Heading, Intensity, Table, number};
use crate::drawing::geometry::kept;
use crate::drawing::scene::TOLERANCES_PX;

/// Capacity curves, intensity given demand, as inverted and shifted.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CapacityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// The shift IM_R.
    pub shift: f64,
    /// A curve a record.
    pub curves: Vec<CapacityCurve>,
}

/// One record's capacities; the shifted curve is drawn from `im - shift`.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// left out lies farther than a twentieth of a pixel from the line. Of
    /// a curve's levels without a capacity the first one stays.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let largest = panel.curves.iter().flat_map(|c| &c.im);
            let largest = largest.copied().filter(|im| im.is_finite());
            let top = largest.fold(0.0, f64::max);
            panel.curves.iter_mut().for_each(|c| c.thin(top));
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

impl CapacityCurve {
    /// Keeps what a drawing some 440 px square needs.
    fn thin(&mut self, top: f64) {
        const PX: f64 = 440.0;
        let points = self.edp.iter().zip(&self.im);
        let points: Vec<_> = points
            .take_while(|(_, im)| im.is_finite())
            .map(|(edp, im)| (PX * edp, PX * im / top))
            .collect();
        let mut keep = kept(&points, TOLERANCES_PX[0]);
        keep.push(true);
        for values in [&mut self.edp, &mut self.im] {
            let mut keep = keep.iter();
            values.retain(|_| keep.next() == Some(&true));
        }
    }
}
