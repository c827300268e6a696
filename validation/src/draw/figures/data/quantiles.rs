//! Figures 8 and 10.

use super::Heading;
use crate::paper::Intensity;
use crate::table::{Table, number};

/// 16/50/84 % curves of the demand given the intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantiles {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Panels row by row.
    pub panels: Vec<QuantilePanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One frequency parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantilePanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// More words for the panel's title, or nothing.
    pub note: String,
    /// What is compared: five slendernesses, or two procedures.
    pub groups: Vec<QuantileGroup>,
}

/// Three curves of one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantileGroup {
    /// Legend in markup: `*α* = 0.05 rad`, `scaled records`.
    pub label: String,
    /// Intensities, rising.
    pub im: Vec<f64>,
    /// 16 % quantile of peak |theta|/alpha; +infinity once overturned.
    pub q16: Vec<f64>,
    /// Median.
    pub q50: Vec<f64>,
    /// 84 % quantile.
    pub q84: Vec<f64>,
}

impl Quantiles {
    /// `panel,p_rad_s,note,im_kind,group,im,q16,q50,q84`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel", "p_rad_s", "note", "im_kind", "group", "im", "q16",
            "q50", "q84",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            for group in &panel.groups {
                for (k, im) in group.im.iter().enumerate() {
                    let at = |v: &[f64]| {
                        number(v.get(k).copied().unwrap_or(f64::NAN))
                    };
                    table.row([
                        super::letter(i),
                        number(panel.p_rad_s),
                        panel.note.clone(),
                        self.intensity.name().into(),
                        super::plain(&group.label),
                        number(*im),
                        at(&group.q16),
                        at(&group.q50),
                        at(&group.q84),
                    ]);
                }
            }
        }
        table.finish()
    }
}
