//! Wrong models: what a case must be able to tell from the right one.

use crate::proof::naive::{
    Events, Hold, Loss, Naive, Pushback, Rest, Rules, STEP_P, Threshold,
};
use crate::proof::scene::{
    Engine, EngineError, Equation, Forcing, Scene, Trace,
};

/// A named mistake.
#[derive(Debug)]
pub struct WrongModel {
    /// Name in `reject` lists.
    pub name: &'static str,
    /// The mistake, in words.
    pub what: &'static str,
    how: How,
}

#[derive(Debug)]
enum How {
    /// A wrong input, given to the engine under test.
    Scene(fn(&mut Scene)),
    /// A wrong algorithm, on the naive integrator.
    Naive(Rules),
    /// Carried out by the method itself.
    Method,
}

const RIGHT: Rules = Rules {
    events: Events::Located,
    rest: Rest::Chatter,
    loss: Loss::Every,
    pushback: Pushback::Hop,
    hold: Hold::Linear,
    threshold: Threshold::Own,
    after_end: true,
    step_p: STEP_P,
};

/// The naive integrator without a mistake.
pub static RIGHT_NAIVE: WrongModel = WrongModel {
    name: "naive-with-right-rules",
    what: "no mistake",
    how: How::Naive(RIGHT),
};

/// All wrong models.
pub static WRONG_MODELS: &[WrongModel] = &[
    scene("ground-sign", "ground acceleration of the other sign", |s| {
        scale(&mut s.forcing, -1.0);
    }),
    scene("eta-squared", "energy ratio used as velocity ratio", |s| {
        s.restitution *= s.restitution;
    }),
    scene("other-equation", "Eq. 2 for Eq. 1, or Eq. 1 for Eq. 2", |s| {
        s.equation = match s.equation {
            Equation::Nonlinear => Equation::Linearized,
            Equation::Linearized => Equation::Nonlinear,
        };
    }),
    scene("p-one-percent-high", "p 1 % too high", |s| {
        s.frequency_rad_s *= 1.01;
    }),
    scene("p-one-percent-low", "p 1 % too low", |s| {
        s.frequency_rad_s *= 0.99;
    }),
    scene("alpha-one-percent-low", "alpha 1 % too low", |s| {
        s.slenderness_rad *= 0.99;
    }),
    scene("alpha-one-percent-high", "alpha 1 % too high", |s| {
        s.slenderness_rad *= 1.01;
    }),
    scene("other-gravity", "9.80665 for 9.81 m/s2", |s| {
        s.gravity_m_s2 *= 9.80665 / 9.81;
    }),
    scene("tangent-for-angle", "amplitude over g tan(alpha) in Eq. 2", |s| {
        let alpha = s.slenderness_rad;
        scale(&mut s.forcing, libm::tan(alpha) / alpha);
    }),
    scene("one-sample-late", "sample i taken at (i + 1) dt", |s| {
        if let Forcing::Samples { acceleration_m_s2, .. } = &mut s.forcing {
            acceleration_m_s2.insert(0, 0.0);
        }
    }),
    scene("record-normalised", "a record of whatever size made 1 g", |s| {
        if let Forcing::Samples { acceleration_m_s2, .. } = &mut s.forcing {
            let a = acceleration_m_s2;
            let peak = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            a.iter_mut().for_each(|x| *x = *x / peak * s.gravity_m_s2);
        }
    }),
    scene("cm-read-as-m", "cm/s2 taken for m/s2", |s| {
        scale(&mut s.forcing, 100.0);
    }),
    scene("last-sample-lost", "record one sample short", |s| {
        if let Forcing::Samples { acceleration_m_s2, .. } = &mut s.forcing {
            acceleration_m_s2.pop();
        }
    }),
    naive(
        "missed-impact",
        "the first impact passes without loss",
        Rules { loss: Loss::FirstMissed, ..RIGHT },
    ),
    naive(
        "sign-only-events",
        "impacts at the end of a step, by sign alone",
        Rules { events: Events::StepEnds, ..RIGHT },
    ),
    naive(
        "rotation-kept-at-impact",
        "impact at the end of a step with the rotation found there",
        Rules { events: Events::StepEndsRotationKept, ..RIGHT },
    ),
    naive(
        "crude-rest",
        "rest below a tenth of p alpha, whatever the ground does",
        Rules { rest: Rest::Slower(0.1), ..RIGHT },
    ),
    naive(
        "suppressed-hop",
        "no change of pivot while the ground pushes back",
        Rules { pushback: Pushback::Suppressed, ..RIGHT },
    ),
    naive(
        "zero-order-hold",
        "acceleration constant between samples",
        Rules { hold: Hold::Zero, ..RIGHT },
    ),
    naive(
        "other-threshold",
        "g alpha in Eq. 1, g tan(alpha) in Eq. 2",
        Rules { threshold: Threshold::Other, ..RIGHT },
    ),
    naive(
        "stops-with-the-record",
        "no motion after the last sample",
        Rules { after_end: false, ..RIGHT },
    ),
    method(
        "plain-bisection",
        "one bisection over the whole range of amplitudes",
    ),
    method(
        "energy-of-the-other-equation",
        "energy of Eq. 2 along Eq. 1, or of Eq. 1 along Eq. 2",
    ),
    method(
        "semi-infinite-sine",
        "the condition of a sine that never ends for one that does",
    ),
    method(
        "energy-whichever-way",
        "overturning wherever the energy passes the saddle's",
    ),
    method("angle-alone", "overturning wherever |theta| exceeds alpha"),
    method("eta-once-in-energy", "energy times eta at an impact, not eta^2"),
    method("order-too-low", "the series stops two terms early"),
    method("other-criterion", "pi/2 for alpha, or alpha for pi/2"),
    method("estimate-hundredth", "an error estimate 100 times too small"),
    method("without-branches", "no decision counts but the fate"),
    method("margin-infinity", "an overturned run is sure whatever its error"),
    method("tenth-of-the-error", "every error a tenth of what it is"),
    method("hundredth-of-the-error", "every error a hundredth of what it is"),
    method(
        "f64-constants",
        "coefficients and pi of a wider engine rounded to double precision",
    ),
    method("f64-inputs", "a/g of a wider engine rounded to double precision"),
    method("sum-of-squares", "variance in one pass, sum x^2 - (sum x)^2/n"),
    method("other-divisor", "n for n - 1, n - 1 for n, or the whole sample"),
    method("upper-side-only", "D+ alone, or the smaller side"),
    method("plain-kolmogorov", "critical values of a known distribution"),
    method("interpolated-in-n", "critical values linear in n between sizes"),
    method("two-terms", "an expansion that stops at 1/n"),
    method("next-stream", "the stream of another index"),
    method("other-quantile-type", "type 7 for 5, or 5 for 7"),
    method("half-the-shift", "half of IM_R taken off"),
    method("no-logarithm", "the values for their logarithms"),
    method("other-margin", "6 % for 5 %"),
    method("open-crossings", "a level touched does not count as reached"),
    method("overturning-as-an-angle", "interpolation to pi/2 at overturning"),
    method("first-for-median", "the first crossing for the median one"),
    method("equation-7-as-printed", "Eq. 7 as it stands, which cancels"),
    method("delta-method", "Eq. 7's limit for every c"),
    method("clamped", "Eq. 7 made up beyond its end"),
    method("notch-for-interval", "McGill's notch as 95 % interval"),
    method("other-interval", "another interval, too narrow"),
    method("period-one-percent-long", "oscillators 1 % too slow"),
    method("no-damping", "oscillators without damping"),
    method("velocity-for-acceleration", "measures of the velocity"),
    method("arias-without-its-factor", "the integral of a^2 over g"),
    method("geometric-mean-for-rotd50", "sqrt of the product"),
    method("rotd50-for-geometric-mean", "the median over directions"),
    method("one-component", "the second component left out"),
    method("velocity-in-m-s", "PGV in m/s where cm/s are meant"),
    method("late-pulses-kept", "no criterion of time"),
    method("one-side-doubled", "the limit for many values, doubled"),
    method("known-shift", "the table though the shift was estimated"),
];

const fn scene(
    name: &'static str,
    what: &'static str,
    change: fn(&mut Scene),
) -> WrongModel {
    WrongModel { name, what, how: How::Scene(change) }
}

const fn naive(
    name: &'static str,
    what: &'static str,
    rules: Rules,
) -> WrongModel {
    WrongModel { name, what, how: How::Naive(rules) }
}

const fn method(name: &'static str, what: &'static str) -> WrongModel {
    WrongModel { name, what, how: How::Method }
}

/// The wrong model of this name.
#[must_use]
pub fn wrong_model(name: &str) -> Option<&'static WrongModel> {
    WRONG_MODELS.iter().find(|model| model.name == name)
}

impl WrongModel {
    /// Whether it runs on the naive integrator.
    #[must_use]
    pub fn is_naive(&self) -> bool {
        matches!(self.how, How::Naive(_))
    }

    /// Whether the method itself carries it out.
    #[must_use]
    pub fn by_method(&self) -> bool {
        matches!(self.how, How::Method)
    }

    /// Makes the mistake in a scene, where it is one of the input.
    pub fn alter(&self, scene: &mut Scene) {
        if let How::Scene(change) = self.how {
            change(scene);
        }
    }

    /// The engine that makes the mistake.
    #[must_use]
    pub fn engine<'a>(
        &'a self,
        right: &'a dyn Engine,
    ) -> Box<dyn Engine + 'a> {
        match &self.how {
            How::Scene(change) => Box::new(Changed { right, change: *change }),
            How::Naive(rules) => Box::new(Naive(*rules)),
            How::Method => Box::new(Changed { right, change: |_| {} }),
        }
    }
}

struct Changed<'a> {
    right: &'a dyn Engine,
    change: fn(&mut Scene),
}

impl Engine for Changed<'_> {
    fn respond(&self, scene: &Scene) -> Result<Trace, EngineError> {
        let mut scene = scene.clone();
        (self.change)(&mut scene);
        self.right.respond(&scene)
    }
}

/// Multiplies the ground motion.
pub(super) fn scale(forcing: &mut Forcing, factor: f64) {
    match forcing {
        Forcing::Free { rotation_rad } => *rotation_rad *= factor.signum(),
        Forcing::Sine { amplitude_m_s2, .. }
        | Forcing::Cosine { amplitude_m_s2, .. }
        | Forcing::Rectangle { amplitude_m_s2, .. }
        | Forcing::Triangle { amplitude_m_s2, .. }
        | Forcing::Ricker { amplitude_m_s2, .. } => *amplitude_m_s2 *= factor,
        Forcing::Mavroeidis { velocity_m_s, .. } => *velocity_m_s *= factor,
        Forcing::Samples { acceleration_m_s2, .. } => {
            for a in acceleration_m_s2 {
                *a *= factor;
            }
        }
    }
}
