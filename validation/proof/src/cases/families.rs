//! The case files.

/// Each family with the text of its file.
macro_rules! families {
    ($($family:literal),+ $(,)?) => {
        &[$((
            $family,
            include_str!(concat!("../../cases/", $family, ".toml")),
        )),+]
    };
}

/// The case files, by family, embedded.
pub const FAMILIES: &[(&str, &str)] = families![
    "benchmark",
    "block-geometry",
    "calibration",
    "certificate",
    "double-double",
    "earthquakes",
    "ends-and-touches",
    "estimators",
    "fates",
    "floors",
    "fragility-transforms",
    "free-rocking",
    "hard-cases",
    "inference",
    "intensity",
    "inversion",
    "invariants",
    "lilliefors",
    "nist-univariate",
    "overturning-spectrum",
    "pivot-forces",
    "pulse-trajectories",
    "rectangular-pulse",
    "risk",
    "sampled-records",
    "similarity-defect",
    "sine-pulse-similarity",
    "solution-verification",
    "work-counters",
];
