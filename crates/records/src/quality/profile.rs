//! The profile of a motion whose samples stay in their file.

use std::borrow::Cow;

use super::{COMPARED_SAMPLES, FEW_SAMPLES, NOT_YET_DIFFERENT, NearPeak};
use super::{Remark, SAME_RECORDING, mean_of, remarks};
use rocking::accelerogram::Accelerogram;

/// A summary of a motion whose samples stay in their file. It is enough to
/// pair the motion, to judge it, and to find it again, and takes about 5 kB.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    pub(super) name: String,
    pub(super) dt_s: f64,
    pub(super) remarks: Vec<Remark>,
    /// Samples about the peak, over the peak.
    pub(super) about_peak: Vec<f32>,
    /// Number of these samples before the peak.
    pub(super) before: usize,
}

impl Profile {
    /// The profile of a record.
    ///
    /// ```
    /// use rocking::accelerogram::Accelerogram;
    /// use rocking_records::Profile;
    /// let record = Accelerogram::try_new("a", 0.01, vec![0.0, 0.2, -0.1])?;
    /// let profile = Profile::of(&record);
    /// assert_eq!(profile.name(), "a");
    /// # Ok::<(), rocking::accelerogram::AccelerogramError>(())
    /// ```
    pub fn of(record: &Accelerogram) -> Self {
        let samples = record.samples_g();
        // The first of the largest samples.
        let sizes = samples.iter().map(|a| a.abs()).enumerate().rev();
        let peak = sizes.max_by(|a, b| a.1.total_cmp(&b.1));
        let peak = peak.map_or(0, |(index, _)| index);
        let from = peak.saturating_sub(COMPARED_SAMPLES);
        let to = samples.len().min(peak + COMPARED_SAMPLES + 1);
        let pga_g = record.pga_g();
        let unit = if pga_g > 0.0 { pga_g } else { 1.0 };
        let about = samples[from..to].iter().map(|a| (a / unit) as f32);
        Self {
            name: record.name().to_owned(),
            dt_s: record.dt_s(),
            remarks: remarks(record),
            about_peak: about.collect(),
            before: peak - from,
        }
    }

    /// Name of the record.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The motion near the peak; `None` if there are too few samples.
    pub(super) fn near_peak(&self) -> Option<NearPeak> {
        let from = self.before.checked_sub(FEW_SAMPLES)?;
        let near = self.about_peak.get(from..self.before + FEW_SAMPLES)?;
        let squares = |samples: &[f32], mean: f64| {
            let parts = samples.iter().map(|a| f64::from(*a) - mean);
            parts.map(|part| part * part).sum::<f64>()
        };
        let mean = mean_of(near);
        let of_near = squares(near, mean);
        let unit =
            |k: usize| ((f64::from(near[k]) - mean) / of_near.sqrt()) as f32;
        // What one recording cannot explain of the other near the peak is at
        // most what it cannot explain of all samples.
        let all = squares(&self.about_peak, mean_of(&self.about_peak));
        let off = (1.0 - SAME_RECORDING * SAME_RECORDING) * all / of_near;
        let least = f64::max(1.0 - off, 0.0).sqrt().max(NOT_YET_DIFFERENT);
        Some(NearPeak { unit: std::array::from_fn(unit), least })
    }
}

/// The motion of a record in a suite: the accelerogram, or the [`Profile`] of
/// an accelerogram that stays in its file.
pub trait MemberMotion {
    /// Name of the record.
    fn name(&self) -> &str;
    /// Its profile.
    fn profile(&self) -> Cow<'_, Profile>;
}

impl MemberMotion for Accelerogram {
    fn name(&self) -> &str {
        self.name()
    }

    fn profile(&self) -> Cow<'_, Profile> {
        Cow::Owned(Profile::of(self))
    }
}

impl MemberMotion for Profile {
    fn name(&self) -> &str {
        &self.name
    }

    fn profile(&self) -> Cow<'_, Profile> {
        Cow::Borrowed(self)
    }
}
