//! Figures 2 and 3.

use super::Heading;
use super::thin::{largest, thin};
use crate::paper::Intensity;
use crate::table::point;
use crate::table::{Table, number};

/// Size of a panel for [`Histories::thinned`].
const WIDTH_PX: f64 = 288.0;
const HALF_PX: f64 = 111.0;

/// Response histories at equal dimensionless intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Histories {
    /// The words.
    pub heading: Heading,
    /// Panels row by row: a row a frequency parameter, a column a record.
    pub panels: Vec<HistoryPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One record at one frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct HistoryPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Record as named in the panel's title.
    pub record: String,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Its level, the same for all slendernesses.
    pub im: f64,
    /// End of the time axis; NaN or not positive: the longest history's end.
    pub until_s: f64,
    /// A history a slenderness.
    pub curves: Vec<History>,
}

/// One block's history; times after overturning are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Slenderness.
    pub alpha_rad: f64,
    /// Times, rising.
    pub time_s: Vec<f64>,
    /// Rotation over slenderness, theta/alpha.
    pub ratio: Vec<f64>,
    /// Whether it ends in overturning (marked on the drawing).
    pub overturned: bool,
}

impl Histories {
    /// The same with only the points that a drawing keeps: none that is
    /// left out lies farther than a tenth of a pixel from the line.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let curves = || panel.curves.iter();
            let until_s = largest(curves().flat_map(|c| &c.time_s));
            let peak = largest(curves().flat_map(|c| &c.ratio));
            let px = (WIDTH_PX / until_s, HALF_PX / peak);
            for curve in &mut panel.curves {
                thin(&mut curve.time_s, &mut curve.ratio, px);
            }
        }
        self
    }

    /// `panel,p_rad_s,record,im_kind,im,alpha_rad,time_s,theta_over_alpha`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel",
            "p_rad_s",
            "record",
            "im_kind",
            "im",
            "alpha_rad",
            "time_s",
            "theta_over_alpha",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            for curve in &panel.curves {
                for (t, y) in curve.time_s.iter().zip(&curve.ratio) {
                    table.row([
                        super::letter(i),
                        number(panel.p_rad_s),
                        panel.record.clone(),
                        panel.intensity.name().into(),
                        number(panel.im),
                        number(curve.alpha_rad),
                        point(*t),
                        point(*y),
                    ]);
                }
            }
        }
        table.finish()
    }
}
