use super::orbit::carlson_rf;
use super::{Coast, coast};
use crate::block::{Block, Restitution};
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::motion::{BlockMotion, RunTrace};
use crate::integrator::{Observe, Side};
use crate::number::double::DoubleDouble;
use crate::number::{Number, Real};

const ALPHA: f64 = 0.25;

/// Time of overturning by pi/2, if it does, from u and w on; p is 1.
fn overturns(model: Model, eta: f64, u: f64, w: f64) -> Option<(f64, Side)> {
    let block = Block::try_new(ALPHA, 1.0).unwrap();
    let restitution = Restitution::constant(eta).unwrap();
    let overturning = Overturning::HalfPi;
    let dynamics = Dynamics::new(&block, restitution, model, overturning);
    let ask = Coast {
        dynamics: &dynamics,
        start_s: 0.0,
        observe: &Observe::default(),
        until_s: None,
    };
    let motion = BlockMotion { side: Side::Positive, u, w };
    coast(&ask, motion, &mut RunTrace::default()).overturned
}

/// On the saddle's own stable line the block neither passes nor comes back:
/// it does not overturn. The next doubles decide.
#[test]
fn the_stable_line_of_the_saddle_itself_does_not_overturn() {
    let half = 0.5 * ALPHA;
    let fate = |w: f64| overturns(Model::Linearized, 0.9, half, w);
    assert_eq!(fate(half), None);
    assert_eq!(fate(half.next_down()), None);
    let (time, side) = fate(half.next_up()).unwrap();
    assert_eq!(side, Side::Positive);
    // y = alpha - u falls as exp(-t) down to about sqrt(eps) and grows again.
    assert!((30.0..50.0).contains(&time), "{time}");
}

/// Beyond the saddle and moving inwards, but not past it: Eq. 2 has
/// u - alpha = y cosh(t - t0), tanh t0 = -w/(u - alpha).
#[test]
fn a_block_that_turns_beyond_the_saddle_overturns_when_it_should() {
    let right_angle = 0.5 * std::f64::consts::PI;
    for (u, w) in [(0.4, -0.1), (0.9, -0.6), (0.3, -0.049), (0.5, 0.2)] {
        let y = u - ALPHA;
        let least = (y * y - w * w).sqrt();
        let due =
            libm::acosh((right_angle - ALPHA) / least) - libm::atanh(w / y);
        let (time, side) = overturns(Model::Linearized, 0.9, u, w).unwrap();
        assert!((time - due).abs() < 1e-13, "{time} {due}");
        assert_eq!(side, Side::Positive);
    }
}

/// In either equation the ways in and out from a state and its mirror image
/// in time add up to twice the way from the turning point.
#[test]
fn a_turn_beyond_the_saddle_takes_as_long_in_as_out() {
    for model in [Model::Nonlinear, Model::Linearized] {
        for (u, w) in [(0.4, 0.1), (0.9, 0.6), (0.3, 0.049)] {
            let time = |u, w| overturns(model, 0.9, u, w).unwrap().0;
            // Depth below the saddle is that of the mirrored turning point.
            let s = libm::sin(0.5 * (u - ALPHA));
            let turn = match model {
                Model::Nonlinear => {
                    ALPHA + 2.0 * libm::asin((s * s - 0.25 * w * w).sqrt())
                }
                Model::Linearized => {
                    let y = u - ALPHA;
                    ALPHA + (y * y - w * w).sqrt()
                }
            };
            let sum = time(u, -w) + time(u, w);
            let twice = 2.0 * time(turn, 0.0);
            assert!((sum - twice).abs() < 1e-12, "{u} {sum} {twice}");
        }
    }
}

/// mpmath 1.3, elliprf to 45 digits.
#[test]
fn carlson_rf_has_its_values_to_all_digits() {
    let number = |hi: f64, lo: f64| {
        DoubleDouble::from_f64(hi) + DoubleDouble::from_f64(lo)
    };
    for ([x, y, z], hi, lo) in RF {
        let [a, b, c] = [x, y, z].map(DoubleDouble::from_f64);
        let wide = carlson_rf(a, b, c);
        let gap = (wide / number(hi, lo) - DoubleDouble::one()).to_f64();
        assert!(gap.abs() < 3e-31, "{x} {y} {z}: {gap:e}");
        let gap = carlson_rf(x, y, z) / hi - 1.0;
        assert!(gap.abs() < 1e-15, "{x} {y} {z}: {gap:e}");
    }
    assert_eq!(carlson_rf(0.0, 0.0, 1.0), f64::INFINITY);
}

/// Arguments, and the value as the sum of two doubles.
const RF: [([f64; 3], f64, f64); 6] = [
    ([0.0, 1.0, 2.0], 1.3110287771460598, 9.58215479734899e-17),
    ([2.0, 3.0, 4.0], 0.5840828416771517, -3.6150116917829376e-17),
    ([0.5, 1.0, 0.0], 1.8540746773013719, 4.2208106329620787e-17),
    ([0.0625, 1.0, 3.5], 1.0048294193009957, -1.043044047893426e-18),
    ([1.0, 1.0078125, 0.984375], 1.0013189929948003, 1.345207267035408e-17),
    ([1e-06, 0.25, 40.0], 0.6208289537194017, 6.390602404013986e-18),
];
