use super::{Barrier, BarrierHop, least_potential};
use crate::block::{Block, Restitution};
use crate::excitation::RecordIndex;
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::forcing::Remainder;

fn dynamics(model: Model, alpha: f64) -> Dynamics<f64> {
    let block = Block::try_new(alpha, 1.0).expect("block");
    let restitution = Restitution::constant(0.9).expect("restitution");
    Dynamics::new(&block, restitution, model, Overturning::Alpha)
}

fn hop(dynamics: &Dynamics<f64>, peak: f64) -> BarrierHop<f64> {
    let height = 2.0 * least_potential(dynamics, peak);
    let speed = height.sqrt();
    let barrier = Barrier { peak, height, speed, ..Barrier::none() };
    BarrierHop::below(&barrier, dynamics)
}

/// Without ground motion a hop of Eq. 2 to u_p lasts for
/// 2 arcosh(1 / (1 - u_p/alpha)); one of Eq. 1 differs by its curvature.
#[test]
fn hops_last_as_long_as_free_ones() {
    for model in [Model::Nonlinear, Model::Linearized] {
        for alpha in [0.05, 0.25] {
            let dynamics = dynamics(model, alpha);
            for ratio in [0.01, 0.1, 0.3, 0.6, 0.9, 0.99] {
                let free = 2.0 * libm::acosh(1.0 / (1.0 - ratio));
                let bound = hop(&dynamics, ratio * alpha).time;
                assert!(bound > free, "{model:?} {alpha} {ratio}");
                assert!(bound < 1.05 * free, "{model:?} {alpha} {ratio}");
            }
        }
    }
}

/// Motion of the ground: velocity and place at a time.
type Ground<'g> = &'g dyn Fn(f64) -> (f64, f64);

/// Largest growth of the energy within a hop that leaves the base with y = s
/// at a time, by small steps of y and u; how far the ground swayed and how
/// fast it was; nothing if the hop passes the peak.
fn growth(
    d: &Dynamics<f64>,
    (s, start, peak): (f64, f64, f64),
    ground: Ground<'_>,
) -> Option<(f64, f64, f64)> {
    const STEP: f64 = 1e-4;
    let rates = |t: f64, y: f64, u: f64| {
        let (v, _) = ground(t);
        let x = d.alpha - u;
        let (sine, cosine) = match d.model {
            Model::Nonlinear => (libm::sin(x), libm::cos(x)),
            Model::Linearized => (x, 1.0),
        };
        let w = y - v * cosine;
        let curve = match d.model {
            Model::Nonlinear => 1.0 - v * w,
            Model::Linearized => 1.0,
        };
        (-sine * curve, w)
    };
    let (mut t, mut y, mut u) = (start, s, 0.0);
    let energy = |y: f64, u: f64| 0.5 * y * y + d.potential(u);
    let first = energy(y, u);
    let (mut most, mut fast) = (0.0_f64, 0.0_f64);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    loop {
        let (v, place) = ground(t);
        fast = fast.max(v.abs());
        (low, high) = (low.min(place), high.max(place));
        let (a, b) = rates(t, y, u);
        let half = 0.5 * STEP;
        let (a, b) = rates(t + half, y + half * a, u + half * b);
        (y, u, t) = (y + STEP * a, u + STEP * b, t + STEP);
        if !(u > 0.0) {
            return Some((most, high - low, fast));
        }
        most = most.max(energy(y, u) - first);
        if !(u < peak) {
            return None;
        }
    }
}

/// The bound of a hop's gain holds under grounds of all periods and phases,
/// and some hop comes close, so the bound cannot be tightened.
#[test]
fn no_hop_gains_more_than_its_bound() {
    let mut nearest = 0.0_f64;
    for model in [Model::Nonlinear, Model::Linearized] {
        for alpha in [0.05, 0.25] {
            let d = dynamics(model, alpha);
            for ratio in [0.1, 0.4, 0.8] {
                let peak = ratio * alpha;
                let hop = hop(&d, peak);
                for k in (0..240_u32).step_by(5) {
                    let rate = 0.4 * libm::pow(1.5, f64::from(k % 8));
                    let phase = 0.8 * f64::from(k / 8 % 8);
                    let part = [0.3, 0.7, 0.95][k as usize / 64 % 3];
                    let size = 0.02 * alpha / rate;
                    let ground = |t: f64| {
                        let turn = rate * t + phase;
                        let fast = size * rate * libm::cos(turn);
                        (fast, size * libm::sin(turn))
                    };
                    let start = (part * hop.speed, 0.0, peak);
                    let Some((gain, sway, fast)) = growth(&d, start, &ground)
                    else {
                        continue;
                    };
                    let Some(bound) = bound(&hop, fast, sway) else {
                        continue;
                    };
                    assert!(gain <= bound, "{model:?} {alpha} {ratio} {k}");
                    nearest = nearest.max(gain / bound);
                }
            }
        }
    }
    assert!(nearest > 0.6, "{nearest}");
}

/// The gain that is allowed for where all of it may be.
fn bound(hop: &BarrierHop<f64>, v: f64, sway: f64) -> Option<f64> {
    let free = BarrierHop { eta: 0.0, ..*hop };
    Some(0.5 * (hop.height - free.safe(v, sway)?))
}

/// The bound is the sum that the head of the module derives, term by term,
/// under Eq. 2: lean = alpha, M^2 = u_p (2 alpha - u_p).
#[test]
fn the_bound_of_a_gain_has_all_its_terms() {
    let (alpha, peak, v, sway) = (0.25, 0.2, 0.05, 0.02);
    let hop = hop(&dynamics(Model::Linearized, alpha), peak);
    let (lean, time) = (alpha, hop.time);
    let most = (peak * (2.0 * alpha - peak)).sqrt();
    let bent = 0.625 * alpha * sway * sway;
    let way = (2.0 * peak + 2.0 * sway + 0.5 * alpha * sway * v * time)
        / (1.0 - 0.5 * alpha * sway);
    let gain = lean * sway
        + way * (0.5 * sway + alpha * v * (most + v) + bent)
        + 0.25 * sway * sway
        + bent * v * time;
    let found = bound(&hop, v, sway).expect("steady") / super::SURELY;
    assert!((found / gain - 1.0).abs() < 1e-12, "{found} {gain}");
}

/// From the calm on nothing is allowed that an impact could not take.
#[test]
fn calm_needs_impacts_that_take_more_than_hops_give() {
    let d = dynamics(Model::Nonlinear, 0.2);
    let hop = hop(&d, 0.1);
    // (1 - eta^2) M^2 / 2 is the least that impacts take from M^2 / 2.
    let taken = 0.5 * (1.0 - 0.9 * 0.9) * hop.height;
    for k in 1..400 {
        let (v, sway) = (1e-4 * f64::from(k), 5e-5 * f64::from(k));
        let gain = bound(&hop, v, sway).expect("steady");
        if hop.safe(v, sway).is_some() {
            assert!(gain < taken, "{v}");
        }
        if gain < 0.8 * taken && v < 0.05 * hop.speed {
            assert!(hop.safe(v, sway).is_some(), "{v}");
        }
    }
    assert_eq!(hop.safe(0.0, 0.0), Some(hop.height));
    assert_eq!(hop.safe(f64::NAN, 0.0), None);
    assert_eq!(hop.safe(0.0, f64::NAN), None);
}

/// Until the calm, whatever the ground still travels counts, and its speed:
/// E may grow by (lean + alpha M (M + V)) X, from (w + V)^2 / 2, to S^2 / 2
/// there, or to M^2 / 2 at the end.
#[test]
fn what_the_ground_travels_until_the_calm_is_allowed_for() {
    let d = dynamics(Model::Nonlinear, 0.2);
    let (sine, cosine) = (libm::sin(0.2), libm::cos(0.2));
    // Waves that fall to a tenth in the middle.
    let wave = |k: i32| {
        let size = if k < 3000 { 0.05 } else { 0.005 };
        size * libm::sin(0.05 * f64::from(k))
    };
    let samples: Vec<f64> = (0..6000).map(wave).collect();
    let index = RecordIndex::new(&samples);
    let remainder = Remainder::new(&index, 0.01, 1.0);
    let mut barrier = Barrier::none();
    barrier.raise(0.12, &d, &remainder);
    // Later than the change: the bound rests on what is left.
    assert!(barrier.calm > 2900 && barrier.calm < 3100, "{}", barrier.calm);
    assert!(barrier.safe < barrier.height);
    let calm = remainder.left(barrier.calm);
    let (mut by_calm, mut by_end, mut none) = (0, 0, 0);
    for piece in (0..6000).step_by(50) {
        let left = remainder.left(piece);
        let (m, v) = (barrier.speed, left.speed);
        let rate = 2.0 * (sine * cosine + 0.2 * m * (m + v));
        let to_end = m * m - rate * left.travel;
        let further = (left.travel - calm.travel).max(0.0);
        let to_calm = barrier.safe - rate * further;
        let due = to_end.max(to_calm).max(0.0).sqrt() - v;
        // The factor that covers rounding takes some thousandths of M.
        let found = barrier.fastest(&d, left);
        assert!(found <= due && found > due - 0.01 * m, "{piece}");
        assert_eq!(barrier.is_above_rest(&d, left), found > 0.0);
        match () {
            () if found < 0.0 => none += 1,
            () if to_calm < to_end => by_end += 1,
            () => by_calm += 1,
        }
    }
    assert!(none > 10 && by_calm > 10 && by_end > 10);
}
