//! Figures 6, 7 and 9.

use super::Heading;
use crate::paper::Intensity;
use crate::table::optional;
use crate::table::{Table, number};

/// Notched boxplots of paired ratios, stripe by stripe.
#[derive(Debug, Clone, PartialEq)]
pub struct Boxplots {
    /// The words.
    pub heading: Heading,
    /// What is compared, in markup: `*r*_{α} = *θ̃*_{α} / *θ̃*_{0.10}`.
    pub ratio_label: String,
    /// What a stripe is a level of.
    pub stripes: StripeKind,
    /// Panels row by row.
    pub panels: Vec<BoxPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// What a stripe is a level of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StripeKind {
    /// A dimensionless intensity.
    Intensity(Intensity),
    /// The demand, peak |theta|/alpha.
    Demand,
}

/// One pair of blocks.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness of the compared block; the colour of the boxes goes by
    /// it.
    pub alpha_rad: f64,
    /// More words for the panel's title, or nothing.
    pub note: String,
    /// Stripes in rising level.
    pub stripes: Vec<Stripe>,
}

/// One level.
#[derive(Debug, Clone, PartialEq)]
pub struct Stripe {
    /// The level.
    pub level: f64,
    /// Number of well-defined ratios.
    pub usable: usize,
    /// Number of records.
    pub records: usize,
    /// The box; none where too few ratios are usable.
    pub summary: Option<NotchedBox>,
}

impl Stripe {
    /// Share of the records with a well-defined ratio, 0 to 1.
    #[must_use]
    pub fn usable_share(&self) -> f64 {
        if self.records == 0 {
            return 0.0;
        }
        self.usable as f64 / self.records as f64
    }
}

/// The numbers of one notched box.
#[derive(Debug, Clone, PartialEq)]
pub struct NotchedBox {
    /// Lower quartile.
    pub q1: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub q3: f64,
    /// Lower end of McGill's notch.
    pub notch_low: f64,
    /// Upper end of McGill's notch.
    pub notch_high: f64,
    /// Lower whisker: smallest datum within 1.5 IQR of the box.
    pub whisker_low: f64,
    /// Upper whisker: largest datum within 1.5 IQR of the box.
    pub whisker_high: f64,
    /// Data beyond the whiskers.
    pub outliers: Vec<f64>,
    /// Exact order-statistic 95 % interval of the median, where known.
    pub median_interval: Option<(f64, f64)>,
}

impl Boxplots {
    /// One row a stripe, then one row an outlier:
    /// `panel,p_rad_s,alpha_rad,note,stripe_kind,level,quantity,value`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel",
            "p_rad_s",
            "alpha_rad",
            "note",
            "stripe_kind",
            "level",
            "quantity",
            "value",
        ]);
        let kind = match self.stripes {
            StripeKind::Intensity(i) => i.name(),
            StripeKind::Demand => "edp",
        };
        for (i, panel) in self.panels.iter().enumerate() {
            for stripe in &panel.stripes {
                let mut row = |quantity: &str, value: String| {
                    table.row([
                        super::letter(i),
                        number(panel.p_rad_s),
                        number(panel.alpha_rad),
                        panel.note.clone(),
                        kind.into(),
                        number(stripe.level),
                        quantity.into(),
                        value,
                    ]);
                };
                row("usable", stripe.usable.to_string());
                row("records", stripe.records.to_string());
                let Some(b) = &stripe.summary else { continue };
                for (quantity, value) in [
                    ("whisker_low", b.whisker_low),
                    ("q1", b.q1),
                    ("notch_low", b.notch_low),
                    ("median", b.median),
                    ("notch_high", b.notch_high),
                    ("q3", b.q3),
                    ("whisker_high", b.whisker_high),
                ] {
                    row(quantity, number(value));
                }
                let interval = b.median_interval;
                row("median_low", optional(interval.map(|i| i.0)));
                row("median_high", optional(interval.map(|i| i.1)));
                for outlier in &b.outliers {
                    row("outlier", number(*outlier));
                }
            }
        }
        table.finish()
    }
}
