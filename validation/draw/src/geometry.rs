//! Points, rectangles, clipping and simplification.

/// A point, in px with y downwards unless said otherwise.
pub type Point = (f64, f64);

/// A rectangle in px.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub left: f64,
    /// Upper edge.
    pub top: f64,
    /// Right edge.
    pub right: f64,
    /// Lower edge.
    pub bottom: f64,
}

/// A vector in px of this length, `angle` rad from upwards, positive to the
/// right, from a point.
pub fn from((x, y): Point, length: f64, angle: f64) -> Point {
    (
        length.mul_add(libm::sin(angle), x),
        (-length).mul_add(libm::cos(angle), y),
    )
}

/// The parts of a polyline whose coordinates lie between 0 and 1; a point
/// that is not finite breaks the line.
pub fn clip(line: &[Point]) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut open = false;
    for pair in line.windows(2) {
        let inside = clip_segment(pair[0], pair[1]);
        match (inside, parts.last_mut()) {
            (Some((start, end)), Some(part))
                if open && part.last() == Some(&start) =>
            {
                part.push(end);
            }
            _ => parts.extend(inside.map(|(start, end)| vec![start, end])),
        }
        open = inside.is_some_and(|(_, end)| end == pair[1]);
    }
    parts
}

/// Liang and Barsky's clipping of one segment.
fn clip_segment(a: Point, b: Point) -> Option<(Point, Point)> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (from, to) in [
        (a.0, b.0),
        (1.0 - a.0, 1.0 - b.0),
        (a.1, b.1),
        (1.0 - a.1, 1.0 - b.1),
    ] {
        let edge = from / (from - to);
        match (from >= 0.0, to >= 0.0) {
            _ if !from.is_finite() || !to.is_finite() => return None,
            (true, true) => {}
            (false, false) => return None,
            (false, true) => enter = enter.max(edge),
            (true, false) => leave = leave.min(edge),
        }
    }
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let at = |t: f64| (dx.mul_add(t, a.0), dy.mul_add(t, a.1));
    let end = if leave < 1.0 { at(leave) } else { b };
    (enter <= leave).then(|| (at(enter), end))
}

/// Which points of a polyline stay (Douglas and Peucker, Cartographica 10,
/// 1973, 112-122).
pub fn kept(line: &[Point], tolerance: f64) -> Vec<bool> {
    if line.len() < 3 {
        return vec![true; line.len()];
    }
    let mut keep = vec![false; line.len()];
    keep[0] = true;
    keep[line.len() - 1] = true;
    let mut open = vec![(0, line.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let (mut far, mut distance) = (first, tolerance * tolerance);
        for i in first + 1..last {
            let d = squared_distance(line[i], line[first], line[last]);
            if d > distance {
                (far, distance) = (i, d);
            }
        }
        if far != first {
            keep[far] = true;
            open.push((first, far));
            open.push((far, last));
        }
    }
    keep
}

/// Squared distance of a point from a segment.
fn squared_distance(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (px, py) = (p.0 - a.0, p.1 - a.1);
    let length = dx.mul_add(dx, dy * dy);
    let along = if length > 0.0 {
        (px.mul_add(dx, py * dy) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (ex, ey) = ((-along).mul_add(dx, px), (-along).mul_add(dy, py));
    ex.mul_add(ex, ey * ey)
}
