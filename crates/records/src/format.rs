//! Formats of record files, one a module.

pub(crate) mod afad;
pub(crate) mod at2;
pub(crate) mod bri;
pub(crate) mod column;
pub(crate) mod cosmos;
pub(crate) mod counted;
pub(crate) mod csv;
pub(crate) mod esm;
pub(crate) mod geonet;
pub(crate) mod knet;
pub(crate) mod resorce;
pub(crate) mod smc;
