//! Figures 2 and 3.

use serde::Serialize;

use super::{Heading, Intensity, Table, number};
use crate::drawing::geometry::kept;
use crate::drawing::scene::TOLERANCES_PX;

/// Response histories at equal dimensionless intensity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Histories {
    /// The words.
    pub heading: Heading,
    /// Panels row by row: a row a frequency parameter, a column a record.
    pub panels: Vec<HistoryPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One record at one frequency parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// left out lies farther than a twentieth of a pixel from the line.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        for panel in &mut self.panels {
            let ends = panel.curves.iter().filter_map(|c| c.time_s.last());
            let until_s = ends.copied().fold(panel.until_s, f64::max);
            if until_s > 0.0 && until_s.is_finite() {
                panel.curves.iter_mut().for_each(|c| c.thin(until_s));
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
                        number(*t),
                        number(*y),
                    ]);
                }
            }
        }
        table.finish()
    }
}

impl History {
    /// Keeps what a drawing of this length, some 300 px square for a ratio
    /// of one, needs.
    fn thin(&mut self, until_s: f64) {
        const PX: f64 = 300.0;
        let points = self.time_s.iter().zip(&self.ratio);
        let points = points.map(|(t, y)| (PX * t / until_s, PX * y));
        let points: Vec<_> = points.collect();
        if points.iter().any(|(x, y)| !x.is_finite() || !y.is_finite()) {
            return;
        }
        let keep = kept(&points, TOLERANCES_PX[0]);
        for values in [&mut self.time_s, &mut self.ratio] {
            let mut keep = keep.iter();
            values.retain(|_| keep.next() == Some(&true));
        }
    }
}
