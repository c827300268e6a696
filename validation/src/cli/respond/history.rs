//! The history as a table.

use std::fmt::Write as _;

use rocking::integrator::{Response, Scene};

/// One row a point.
pub(super) fn history_csv(scene: &Scene<'_>, response: &Response) -> String {
    let alpha = scene.block.slenderness_rad();
    let mut text =
        String::from("time_s,rotation_rad,velocity_rad_s,rotation_ratio\n");
    for point in &response.history {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{}",
            point.time_s,
            point.rotation_rad,
            point.velocity_rad_s,
            point.rotation_rad / alpha
        );
    }
    text
}
