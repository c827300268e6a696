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
mod power;
mod proportion;
mod risk;
mod truths;
mod two_samples;

pub(super) use calibration::{bias, coverage, rejection};
pub(super) use earthquakes::{other_packages, rates};
pub(super) use equations::transforms;
pub(super) use fits::{fits, paired, quantiles, tests};
pub(super) use inference::coverage as inference;
pub(super) use inversion::inversion;
pub(super) use lilliefors::{
    asymptotics, draws, largest, mean, null, published, table,
};
pub(super) use nist::moments;
pub(super) use power::power;
pub(super) use proportion::intervals as proportions;
pub(super) use risk::{annual_frequency, cornell, interval};
pub(super) use two_samples::two_samples;
