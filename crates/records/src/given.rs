//! What the caller gives that a file does not state.

/// What the caller gave because the file states none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// Sampling interval.
    pub dt: bool,
    /// Unit of the samples.
    pub unit: bool,
}
