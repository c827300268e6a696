//! Size and alignment of texts on a drawing.

use serde::{Deserialize, Serialize};

/// Text size that elements have unless they say otherwise, in px.
pub const TEXT_PX: f64 = 11.0;

/// Horizontal alignment of a line of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Horizontal {
    /// Starts at the point.
    Left,
    /// Centred on the point.
    Centre,
    /// Ends at the point.
    Right,
}
