//! What all rows of a table of an incremental dynamic analysis share.

/// Place of the first column of a [`Setting`] in a table of `rocking ida`.
pub const SETTING: usize = 11;

/// What all rows of a table share, as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    /// Coefficient of restitution.
    pub eta: String,
    /// Equation of motion.
    pub model: String,
    /// Overturning criterion.
    pub overturn: String,
    /// How intensity is reached.
    pub by: String,
    /// Gravity in m/s2.
    pub gravity_m_s2: String,
    /// What was done to the records.
    pub processing: String,
    /// Program and version.
    pub software: String,
}

impl Setting {
    /// The cells, in the order of their columns.
    #[must_use]
    pub fn cells(&self) -> [&str; 7] {
        [
            &self.eta,
            &self.model,
            &self.overturn,
            &self.by,
            &self.gravity_m_s2,
            &self.processing,
            &self.software,
        ]
    }

    /// The setting of a row's last cells.
    #[must_use]
    pub fn of(cell: impl Fn(usize) -> String) -> Self {
        Self {
            eta: cell(SETTING),
            model: cell(SETTING + 1),
            overturn: cell(SETTING + 2),
            by: cell(SETTING + 3),
            gravity_m_s2: cell(SETTING + 4),
            processing: cell(SETTING + 5),
            software: cell(SETTING + 6),
        }
    }
}
