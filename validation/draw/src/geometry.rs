//! Points, rectangles, clipping and simplification, in pixels.

/// A point in px, y downwards.
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

impl Rect {
    /// Width.
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    /// Height.
    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Whether the point lies inside or on the edge, within `slack`.
    pub fn contains(&self, (x, y): Point, slack: f64) -> bool {
        x >= self.left - slack
            && x <= self.right + slack
            && y >= self.top - slack
            && y <= self.bottom + slack
    }

    /// The four corners, clockwise.
    pub fn corners(&self) -> [Point; 4] {
        [
            (self.left, self.top),
            (self.right, self.top),
            (self.right, self.bottom),
            (self.left, self.bottom),
        ]
    }
}

/// The parts of a polyline inside the rectangle; a point that is not finite
/// breaks the line.
pub fn clip(line: &[Point], to: Rect) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut open = false;
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let Some((start, end)) = clip_segment(a, b, to) else {
            open = false;
            continue;
        };
        match parts.last_mut() {
            Some(part) if open && part.last() == Some(&start) => {
                part.push(end);
            }
            _ => parts.push(vec![start, end]),
        }
        open = end == b;
    }
    parts
}

/// Liang and Barsky's clipping of one segment.
fn clip_segment(a: Point, b: Point, to: Rect) -> Option<(Point, Point)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for (slope, room) in [
        (-dx, a.0 - to.left),
        (dx, to.right - a.0),
        (-dy, a.1 - to.top),
        (dy, to.bottom - a.1),
    ] {
        if slope.is_nan() || room.is_nan() || slope.is_infinite() {
            return None;
        }
        if slope == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if slope < 0.0 {
            enter = enter.max(room / slope);
        } else {
            leave = leave.min(room / slope);
        }
    }
    if enter > leave {
        return None;
    }
    let at = |t: f64, end: Point| {
        if t == 0.0 {
            a
        } else if t == 1.0 {
            end
        } else {
            (dx.mul_add(t, a.0), dy.mul_add(t, a.1))
        }
    };
    Some((at(enter, b), at(leave, b)))
}

/// Drops points of a polyline that lie within `tolerance` of what remains.
pub fn simplify(line: &[Point], tolerance: f64) -> Vec<Point> {
    let keep = kept(line, tolerance);
    line.iter().zip(keep).filter(|(_, k)| *k).map(|(p, _)| *p).collect()
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
