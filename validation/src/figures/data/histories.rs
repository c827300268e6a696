//! Figures 2 and 3.

use serde::Serialize;

use super::{Heading, Intensity, Table, number};

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
