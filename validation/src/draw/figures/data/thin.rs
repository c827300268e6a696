//! Dropping the points of a curve that a drawing does not need.

use crate::draw::geometry::kept;

/// How far the curve left may be from the full one, in px.
const TOLERANCE_PX: f64 = 0.1;

/// Thins a curve drawn with this many px a unit of x and of y, from its
/// first point to the last one that is finite; of those after it the first
/// stays.
pub fn thin(x: &mut Vec<f64>, y: &mut Vec<f64>, px: (f64, f64)) {
    let points: Vec<_> = x
        .iter()
        .zip(y.iter())
        .take_while(|(x, y)| x.is_finite() && y.is_finite())
        .map(|(x, y)| (px.0 * x, px.1 * y))
        .collect();
    let mut keep = kept(&points, TOLERANCE_PX);
    keep.push(true);
    for values in [x, y] {
        let mut keep = keep.iter();
        values.retain(|_| keep.next() == Some(&true));
    }
}

/// Largest finite magnitude, or 1.
pub fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let finite = values.map(|x| x.abs()).filter(|x| x.is_finite());
    let most = finite.fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}
