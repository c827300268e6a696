//! Which module may name which.

/// Which top-level module may name which: the data flow. Tests inside a module
/// count as the module.
pub type Edges = &'static [(&'static str, &'static [&'static str])];

/// The modules of the core.
const CORE: Edges = &[
    ("block", &[]),
    ("capacity", &["names", "statistics"]),
    ("excitation", &["names", "number", "record"]),
    ("fragility", &["statistics"]),
    (
        "ida",
        &[
            "block",
            "capacity",
            "excitation",
            "integrator",
            "names",
            "number",
            "record",
        ],
    ),
    (
        "integrator",
        &["block", "excitation", "names", "number", "record", "stop"],
    ),
    ("intensity", &["names", "record", "stop", "units"]),
    ("names", &[]),
    ("number", &[]),
    ("procedures", &["capacity", "fragility", "statistics", "stop"]),
    ("record", &["stop", "units"]),
    ("statistics", &["names", "number", "stop", "streams"]),
    ("stop", &[]),
    ("streams", &[]),
    ("units", &[]),
];

/// The modules of the texts that other programs read.
const EXCHANGE: Edges = &[
    ("format", &["fragility", "table"]),
    ("fragility", &[]),
    ("ida", &["table"]),
    ("table", &[]),
];

/// The modules of the embedded suites.
const SYNTHESIS: Edges = &[
    ("near_fault", &["draws", "noise", "pair", "special"]),
    ("ordinary", &["draws", "noise", "pair", "special"]),
    ("pair", &["noise"]),
    ("noise", &["draws"]),
    ("draws", &[]),
    ("special", &[]),
    ("tests", &["near_fault", "ordinary", "pair"]),
];

/// The modules that all crates of the harness share. Between those crates the
/// manifests hold the walls.
const COMMON: Edges = &[
    ("curves", &[]),
    ("files", &[]),
    ("findings", &["json", "paper"]),
    ("json", &["words"]),
    ("paper", &["words"]),
    ("suites", &["paper", "table"]),
    ("table", &[]),
    ("words", &[]),
];

/// Each source folder with its table.
pub const TREES: [(&str, Edges); 4] = [
    ("src", CORE),
    ("exchange/src", EXCHANGE),
    ("synthesis/src", SYNTHESIS),
    ("validation/common/src", COMMON),
];
