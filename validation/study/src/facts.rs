//! Names and intensity measures of the records.

use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_common::paper::FREQUENCIES_RAD_S;
use rocking_common::suites::StudyMotion;
use rocking_records::intensity::{IntensityMeasure, Measures, Settings};

/// Periods of the response spectra, in s.
pub const SPECTRUM_PERIODS_S: [f64; 14] = [
    0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0,
];

/// Name and intensity measures of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Name.
    pub name: String,
    /// Peak ground acceleration, in g.
    pub pga_g: f64,
    /// PGV/PGA over gravity, in s.
    pub velocity_ratio_s: f64,
    /// PGA of the geometric mean of the pair over the PGA of this component.
    pub mean_over_study: Option<f64>,
    /// AvgSA over the periods of a block, divided by PGA, by frequency parameter of
    /// the paper's blocks.
    pub average_ratios: Vec<f64>,
    /// Intensity measures of the study component, with its spectrum at
    /// [`SPECTRUM_PERIODS_S`].
    pub measures: Measures,
}

/// Name and intensity measures of a motion's study component.
///
/// # Errors
/// For a motion of zeros.
pub fn facts(motion: &StudyMotion) -> anyhow::Result<Facts> {
    let study = &motion.study;
    let pga_g = study.pga_g();
    let periods_s = SPECTRUM_PERIODS_S.to_vec();
    let settings = Settings::try_new(STANDARD_GRAVITY_M_S2, 0.05, periods_s)?;
    let measures = Measures::of(study, &settings)?;
    let ims = FREQUENCIES_RAD_S
        .map(|p| IntensityMeasure::RockingSa(None).of_block(p));
    let settings = Settings::of(STANDARD_GRAVITY_M_S2, &ims)?;
    let averages = Measures::of(study, &settings)?;
    let ratio = |im: &IntensityMeasure| {
        let value = im.value(&averages, settings.periods_s());
        value.map_or(f64::NAN, |average_g| average_g / pga_g)
    };
    Ok(Facts {
        name: study.name().to_owned(),
        pga_g,
        average_ratios: ims.iter().map(ratio).collect(),
        velocity_ratio_s: study.pgv_g_s() / pga_g,
        mean_over_study: motion
            .other
            .as_ref()
            .map(|other| (other.pga_g() / pga_g).sqrt()),
        measures,
    })
}
