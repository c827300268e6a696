//! Figures 4 and 5.

use super::Heading;
use super::thin::{largest, thin};
use crate::paper::Intensity;
use crate::table::point;
use crate::table::{Table, number};

/// Single-record IDA curves.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaCurves {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Panels row by row: a row a frequency parameter, a column a record.
    pub panels: Vec<IdaPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One record at one frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Record as named in the panel's title.
    pub record: String,
    /// A curve a slenderness.
    pub curves: Vec<IdaCurve>,
}

/// One block's IDA curve up to its first overturning.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaCurve {
    /// Slenderness.
    pub alpha_rad: f64,
    /// Intensities, rising.
    pub im: Vec<f64>,
    /// Peak |theta|/alpha at each intensity; +infinity where overturned.
    pub edp: Vec<f64>,
    /// Intensity of first overturning, if it was reached: the flat line
    /// starts there.
    pub overturning_im: Option<f64>,
}

/// Size of a panel for [`IdaCurves::thinned`].
const PX: f64 = 288.0;

impl IdaCurves {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line.
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

    /// `panel,p_rad_s,record,im_kind,alpha_rad,im,edp`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel",
            "p_rad_s",
            "record",
            "im_kind",
            "alpha_rad",
            "im",
            "edp",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                let mut row = |im: f64, edp: f64| {
                    table.row([
                        super::letter(i),
                        number(panel.p_rad_s),
                        panel.record.clone(),
                        self.intensity.name().into(),
                        number(curve.alpha_rad),
                        number(im),
                        point(edp),
                    ]);
                };
                for (im, edp) in curve.im.iter().zip(&curve.edp) {
                    row(*im, *edp);
                }
                if let Some(im) = curve.overturning_im
                    && curve.edp.last().is_none_or(|e| e.is_finite())
                {
                    row(im, f64::INFINITY);
                }
            }
        }
        table.finish()
    }
}
