//! Clusters of records: records of one earthquake are not independent.
//!
//! A resampling draws clusters with all their records. If every record is a
//! separate cluster, it draws records.

use super::beta::student_quantile;
use super::sample::mean;
use rocking::names::{as_text, named};

named! {
    /// What a resampling draws.
    pub enum SamplingUnit: "unit" {
        /// Records: no earthquake is known, or none is shared.
        Record = "record",
        /// Earthquakes, each with all its records.
        Earthquake = "earthquake",
        /// Motions of a shaking table, each with all its tests.
        Motion = "motion",
    }
}

/// The records of a sample by the earthquake that each belongs to.
///
/// Clusters are numbered by their first record.
///
/// ```
/// use rocking_statistics::clusters::{Clusters, SamplingUnit};
/// let clusters = Clusters::from_labels(["Kobe", "Izmit", "Kobe"]);
/// assert_eq!((clusters.records(), clusters.count()), (3, 2));
/// assert_eq!((clusters.cluster_of(2), clusters.members(0)), (0, &[0, 2][..]));
/// assert_eq!(clusters.without(0), [0, 1, 0]);
/// assert_eq!(
///     clusters.to_string(),
///     "3 records of 2 earthquakes; unit: earthquake"
/// );
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clusters {
    unit: SamplingUnit,
    of: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Clusters {
    /// Earthquakes from one label per record: records with the same label form
    /// a cluster.
    pub fn from_labels(labels: impl IntoIterator<Item: AsRef<str>>) -> Self {
        Self::of_unit(SamplingUnit::Earthquake, labels)
    }

    /// Earthquakes from one label per record, or the `n` records themselves if
    /// there are no labels.
    pub fn of_events<S: AsRef<str>>(events: &[S], n: usize) -> Self {
        match events {
            [] => Self::singletons(n),
            events => Self::from_labels(events),
        }
    }

    /// Clusters with this unit, from one label per record.
    ///
    /// ```
    /// use rocking_statistics::clusters::{Clusters, SamplingUnit};
    /// let motions = Clusters::of_unit(SamplingUnit::Motion, ["a", "b", "c"]);
    /// assert_eq!(
    ///     motions.remark(200).unwrap().to_string(),
    ///     "intervals are rough: 3 motions, fewer than 8"
    /// );
    /// ```
    pub fn of_unit(
        unit: SamplingUnit,
        labels: impl IntoIterator<Item: AsRef<str>>,
    ) -> Self {
        let mut known = std::collections::BTreeMap::new();
        let (mut of, mut members) = (Vec::new(), Vec::<Vec<usize>>::new());
        for (record, label) in labels.into_iter().enumerate() {
            let label = label.as_ref().to_owned();
            let cluster = *known.entry(label).or_insert(members.len());
            members.resize_with(known.len(), Vec::new);
            members[cluster].push(record);
            of.push(cluster);
        }
        Self { unit, of, members }
    }

    /// Clusters of `n` records without a label: each record is a cluster.
    pub fn singletons(n: usize) -> Self {
        let members = (0..n).map(|record| vec![record]).collect();
        Self { unit: SamplingUnit::Record, of: (0..n).collect(), members }
    }

    /// What a resampling draws.
    pub fn unit(&self) -> SamplingUnit {
        self.unit
    }

    /// Number of records.
    pub fn records(&self) -> usize {
        self.of.len()
    }

    /// Number of clusters G.
    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// The cluster of a record.
    pub fn cluster_of(&self, record: usize) -> usize {
        self.of[record]
    }

    /// The records of a cluster, ascending.
    pub fn members(&self, cluster: usize) -> &[usize] {
        &self.members[cluster]
    }

    /// Whether each record is a separate cluster.
    pub fn is_singletons(&self) -> bool {
        self.count() == self.records()
    }

    /// Only these records, in this order.
    pub fn part(&self, records: &[usize]) -> Self {
        let labels = records.iter().map(|record| self.of[*record].to_string());
        match self.unit {
            SamplingUnit::Record => Self::singletons(records.len()),
            unit => Self::of_unit(unit, labels),
        }
    }

    /// The multiplicities without the records of one cluster.
    pub fn without(&self, cluster: usize) -> Vec<u32> {
        self.of.iter().map(|of| u32::from(*of != cluster)).collect()
    }

    /// The number G_e = (sum n_g)^2/sum n_g^2 of clusters of one size that
    /// weigh as much as those of sizes n_g (Kish, Survey Sampling, 1965).
    pub fn effective(&self) -> f64 {
        let n = self.records() as f64;
        let sizes = self.members.iter().map(|own| own.len() as f64);
        n * n / sizes.fold(0.0, |sum, size| f64::mul_add(size, size, sum))
    }

    /// Degrees of freedom nu of the standard error of a mean over clusters
    /// of sizes n_g (Bell and McCaffrey, Survey Methodology 28 (2002) 169,
    /// with independent records as the working model): with n records and
    /// c_g = 1/(1 - n_g/n), nu = n^2/(sum_g n_g^2 + sum_(g != h) c_g c_h
    /// (n_g n_h/n)^2). Of clusters of one size it is G - 1.
    pub fn degrees_of_freedom(&self) -> f64 {
        let n = self.records() as f64;
        let (mut own, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for members in &self.members {
            let size = members.len() as f64;
            let term = size * size / (1.0 - size / n);
            own += size * size;
            sum += term;
            squares = f64::mul_add(term, term, squares);
        }
        n * n / (own + (sum * sum - squares) / (n * n))
    }

    /// Share of the variance of values that lies between clusters, at least 0:
    /// (B - W)/(B + (n_0 - 1) W) with the mean squares B between and W within
    /// clusters, n_0 = (n - sum n_g^2/n)/(G - 1) (analysis of variance, one
    /// way). `None` for values that are not all finite, for a single cluster,
    /// and if no cluster has two records.
    ///
    /// ```
    /// use rocking_statistics::clusters::Clusters;
    /// let clusters = Clusters::from_labels(["a", "a", "b", "b"]);
    /// // B = 16, W = 1, n_0 = 2.
    /// let share = clusters.intraclass(&[0.0, 2.0f64.sqrt(), 4.0, 5.5]);
    /// assert!(share.is_some_and(|share| share > 0.8 && share < 1.0));
    /// ```
    pub fn intraclass(&self, values: &[f64]) -> Option<f64> {
        let centre = mean(values);
        let (mut between, mut within) = (0.0, 0.0);
        for members in &self.members {
            let own: Vec<f64> = members.iter().map(|&i| values[i]).collect();
            let own_mean = mean(&own);
            let gap = own_mean - centre;
            between += own.len() as f64 * gap * gap;
            for value in own {
                within += (value - own_mean) * (value - own_mean);
            }
        }
        let (n, count) = (self.records() as f64, self.count() as f64);
        let (between, within) =
            (between / (count - 1.0), within / (n - count));
        let size = n * (1.0 - 1.0 / self.effective()) / (count - 1.0);
        let share = (between - within) / (between + (size - 1.0) * within);
        share.is_finite().then_some(share.max(0.0))
    }

    /// Student's t at a two-sided level, with [`Self::degrees_of_freedom`];
    /// `None` for a single cluster.
    pub fn student(&self, level: f64) -> Option<f64> {
        student_quantile(self.degrees_of_freedom(), level)
    }
}

impl std::fmt::Display for Clusters {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let unit = self.unit;
        write!(f, "{} records", self.records())?;
        if unit != SamplingUnit::Record {
            write!(f, " of {} {unit}s", self.count())?;
        }
        write!(f, "; unit: {unit}")
    }
}

as_text!(write Clusters);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Range;
    use crate::bootstrap::Bootstrap;
    use crate::resampling::Resampling;

    #[test]
    fn a_single_cluster_has_no_interval() {
        let one = Clusters::from_labels(["a", "a", "a"]);
        assert_eq!(one.student(0.95), None);
        let (how, range) = (Resampling::Bootstrap, Range::Real);
        let found = one.estimate(1.0, &[0.5, 1.0, 1.5], how, range, 0.95);
        assert!(found.is_none());
        assert_eq!(Clusters::singletons(0).count(), 0);
    }

    /// Of {0, 2} and {4}: B = 6, W = 2, n_0 = (3 - 5/3)/1 = 4/3, and
    /// (6 - 2)/(6 + 2/3) = 0.6. Of {0, 2} and {5, 7}: B = 25, W = 2, n_0 = 2.
    #[test]
    fn the_share_between_clusters_is_that_of_its_mean_squares() {
        let share = |labels: &[&str], values: &[f64]| {
            Clusters::from_labels(labels).intraclass(values).unwrap()
        };
        let found = share(&["a", "a", "b"], &[0.0, 2.0, 4.0]);
        assert!((found - 0.6).abs() < 1e-14, "{found}");
        let found = share(&["a", "b", "a", "b"], &[0.0, 5.0, 2.0, 7.0]);
        assert!((found - 23.0 / 27.0).abs() < 1e-14, "{found}");
    }

    #[test]
    fn records_of_earthquakes_of_their_own_are_drawn_as_records() {
        let clusters = Clusters::from_labels(["a", "b", "c", "d"]);
        assert!(clusters.is_singletons());
        assert_eq!(clusters.unit(), SamplingUnit::Earthquake);
        let records = Clusters::singletons(4);
        let drawn = |of: &Clusters| {
            Bootstrap::of_clusters("test", 0, of, 1).multiplicities(5)
        };
        assert_eq!(drawn(&clusters), drawn(&records));
        assert_eq!(clusters.student(0.95), records.student(0.95));
    }
}
