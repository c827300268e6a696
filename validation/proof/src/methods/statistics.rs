//! Statistics against values from outside: certified data sets, exact and
//! published critical values, other packages, and simulated truths.

mod calibration;
mod earthquakes;
mod equations;
mod fits;
mod inference;
mod inversion;
mod lilliefors;
mod nist;
mod proportion;
mod risk;
mod shaking;
mod truths;
mod two_samples;

use super::method::Method;

/// Methods that a page runs.
pub(super) const METHODS: &[Method] = &[
    ("sample-moments", nist::moments),
    ("lilliefors-largest", lilliefors::largest),
    ("lilliefors-published", lilliefors::published),
    ("normal-draws", lilliefors::draws),
    ("fits", fits::fits),
    ("counts-of-stripes", fits::counts),
    ("quantiles", fits::quantiles),
    ("tests-of-normality", fits::tests),
    ("two-samples", two_samples::two_samples),
    ("inversion", inversion::inversion),
    ("equations-5-to-7", equations::transforms),
    ("annual-frequency", risk::annual_frequency),
    ("total-fragility", risk::total),
    ("cornell", risk::cornell),
];

/// Methods that a page leaves out.
#[cfg(not(target_family = "wasm"))]
pub(super) const LEFT_OUT: &[Method] = &[
    ("lilliefors-null", lilliefors::null),
    ("lilliefors-mean", lilliefors::mean),
    ("lilliefors-table", lilliefors::table),
    ("lilliefors-asymptotics", lilliefors::asymptotics),
    ("interval-of-a-probability", risk::interval),
    ("rejected-share", calibration::rejection),
    ("coverage", calibration::coverage),
    ("coverage-of-inference", inference::coverage),
    ("rates-by-earthquake", earthquakes::rates),
    ("coverage-of-fits", earthquakes::coverage_of_fits),
    ("bias", calibration::bias),
    ("paired-procedures", fits::paired),
    ("proportions", proportion::intervals),
    ("proportions-of-clusters", proportion::of_clusters),
    ("earthquakes-of-other-packages", earthquakes::other_packages),
    ("tests-of-other-packages", shaking::other_packages),
    ("coverage-of-tests", shaking::coverage),
];
#[cfg(target_family = "wasm")]
pub(super) const LEFT_OUT: &[Method] = &[];
