//! The two suites by name.

use rocking::names::named;

named! {
    /// One of the two suites, by its kind of motion.
    ///
    /// ```
    /// use rocking_synthesis::SuiteKind;
    /// let names = SuiteKind::ALL.map(SuiteKind::name);
    /// assert_eq!(names, ["ordinary", "pulse-type"]);
    /// ```
    #[derive(PartialOrd, Ord, Hash)]
    pub enum SuiteKind: "suite" {
        /// Far-field records without pulses.
        Ordinary = "ordinary",
        /// Near-fault records with a pulse in the velocity.
        PulseType = "pulse-type",
    }
}
