//! Drawings of the objects: side by side with their lean, and in plan.

use maud::{Markup, html};
use rocking_procedures::assess::ObjectFacts;

use crate::words::short;

/// Height in px of the tallest object.
const TALLEST_PX: f64 = 150.0;

/// Width and height in px of the plan.
const PLAN_PX: (f64, f64) = (640.0, 420.0);

/// The objects side by side, to scale, upright and at the rotation that
/// counts as damage.
pub(crate) fn line(objects: &[&ObjectFacts]) -> Markup {
    let tallest = objects.iter().map(|o| o.height_m).fold(0.0, f64::max);
    let scale = TALLEST_PX / tallest;
    let ground = TALLEST_PX + 24.0;
    let mut x = 10.0;
    let mut shown = Vec::new();
    for one in objects {
        let (w, h) = (scale * one.width_m, scale * one.height_m);
        let lean = scale * one.lean_m;
        let label = 7.5 * one.object.label.chars().count() as f64;
        let room = (w + lean).max(label).max(70.0);
        let left = x + 0.5 * (room - w - lean);
        let angle = libm::asin(one.lean_m / one.height_m).to_degrees();
        shown.push((left, x + 0.5 * room, w, h, angle, one));
        x += room + 16.0;
    }
    let (width, height) = (x, ground + 42.0);
    html! {
        div.scroll.drawing.wide role="region" aria-label="The objects to scale"
            tabindex="0"
        {
            svg xmlns="http://www.w3.org/2000/svg" width=(width)
                height=(height) viewBox={ "0 0 " (width) " " (height) }
                role="img" aria-label="The objects, to scale"
            {
                line x1="0" x2=(width) y1=(ground) y2=(ground)
                    stroke="currentColor" stroke-width="1.5" {}
                @for (left, middle, w, h, angle, one) in &shown {
                    rect x=(left) y=(ground - h) width=(w) height=(h)
                        fill="none" stroke="currentColor"
                        stroke-width="1.5" {}
                    rect x=(left) y=(ground - h) width=(w) height=(h)
                        fill="none" stroke="currentColor" stroke-width="0.8"
                        stroke-dasharray="3 3" transform={
                            "rotate(" (angle) " " (left + w) " " (ground) ")"
                        } {}
                    text x=(middle) y=(ground + 17.0) font-size="12"
                        text-anchor="middle" fill="currentColor"
                    { (one.object.label) }
                    text x=(middle) y=(ground + 34.0) font-size="11"
                        text-anchor="middle" fill="currentColor"
                    {
                        (short(one.width_m)) " × "
                        (short(one.height_m)) " m"
                    }
                }
            }
        }
    }
}

/// The objects of which a position is known, in plan, each with the circle
/// that it reaches if it falls.
pub(crate) fn plan(objects: &[&ObjectFacts]) -> Markup {
    let placed = objects.iter();
    let placed = placed.filter_map(|one| Some((one.object.position_m?, one)));
    let mut placed: Vec<_> = placed
        .map(|(at, one)| (at, 0.5 * one.width_m + one.height_m, one))
        .collect();
    placed.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let span = |of: fn((f64, f64)) -> f64| {
        let ends = placed.iter().map(|(at, reach, _)| (of(*at), *reach));
        let low = ends.clone().map(|(x, r)| x - r);
        let high = ends.map(|(x, r)| x + r);
        (low.fold(f64::INFINITY, f64::min), high.fold(f64::MIN, f64::max))
    };
    let ((left, right), (low, top)) = (span(|at| at.0), span(|at| at.1));
    let scale = (PLAN_PX.0 / (right - left)).min(PLAN_PX.1 / (top - low));
    let (width, height) = (scale * (right - left), scale * (top - low));
    html! {
        @if !placed.is_empty() {
            div.scroll.drawing.wide role="region" aria-label="Plan of the room"
                tabindex="0"
            {
                svg xmlns="http://www.w3.org/2000/svg" width=(width)
                    height=(height) viewBox={ "0 0 " (width) " " (height) }
                    role="img" aria-label="Plan: reach of each object"
                {
                    @for (k, ((x, y), reach, one)) in placed.iter().enumerate() {
                        @let (x, y) = (scale * (x - left), scale * (top - y));
                        @let w = scale * one.width_m;
                        circle cx=(x) cy=(y) r=(scale * reach) fill="none"
                            stroke="currentColor" stroke-width="0.8"
                            stroke-dasharray="3 3" {}
                        rect x=(x - 0.5 * w) y=(y - 0.5 * w) width=(w)
                            height=(w) fill="none" stroke="currentColor"
                            stroke-width="1.5" {}
                        // Labels alternate, below and above the objects.
                        @let off = if k % 2 == 0 { 13.0 } else { -5.0 - w };
                        text x=(x) y=(y + 0.5 * w + off) font-size="12"
                            text-anchor="middle" fill="currentColor"
                        { (one.object.label) }
                    }
                }
            }
            p {
                "The plan. Each dashed circle is the reach of an object that \
                 falls."
            }
        }
    }
}
