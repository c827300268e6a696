//! Values of the core that the command line calls by name.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rocking::capacity::InversionRule;
use rocking::ida::Adjust;
use rocking::integrator::{Model, Order, Overturning};

use crate::paper::{Arm, Intensity};

/// A name, the value, and what the help says of it, if anything.
pub type Named<T> = (&'static str, T, &'static str);

/// Equations of motion.
pub const MODELS: &[Named<Model>] = &[
    ("nonlinear", Model::Nonlinear, "Eq. 1"),
    ("linearized", Model::Linearized, "Eq. 2"),
];

/// When a block counts as overturned.
pub const OVERTURNING: &[Named<Overturning>] = &[
    ("alpha", Overturning::Alpha, "|theta| reaches alpha"),
    ("half-pi", Overturning::HalfPi, "|theta| exceeds pi/2"),
];

/// Intensity measures.
pub const INTENSITIES: &[Named<Intensity>] = &[
    ("pga", Intensity::Pga, "PGA/(g tan alpha)"),
    ("pgv", Intensity::Pgv, "p PGV/(g tan alpha)"),
];

/// Which single capacity is made of several crossings.
pub const CROSSINGS: &[Named<InversionRule>] = &[
    ("median", InversionRule::Median, "The median crossing"),
    ("first", InversionRule::First, "The first crossing"),
    ("last", InversionRule::Last, "The last crossing"),
    (
        "monotone",
        InversionRule::Monotone,
        "The length of intensity below the level",
    ),
];

/// How intensity is reached.
pub const ADJUSTMENTS: &[Named<Adjust>] = &[
    ("record-scaling", Adjust::RecordScaling, "Scale the record"),
    (
        "slenderness-adjustment",
        Adjust::SlendernessAdjustment,
        "Keep the record and adjust alpha",
    ),
];

/// Orders of the Taylor polynomial.
pub const ORDERS: &[Named<Order>] = &[
    ("4", Order::Four, "A first look"),
    ("6", Order::Six, "Exploring large numbers of analyses"),
    ("8", Order::Eight, "Statistics of many analyses"),
    ("10", Order::Ten, "More accurate than most steps need"),
];

/// Arms of the study.
pub const ARMS: &[Named<Arm>] =
    &[("A", Arm::A, ""), ("B", Arm::B, ""), ("C", Arm::C, "")];

/// Reads one of these names.
pub fn named<T: Copy + Send + Sync + 'static>(
    values: &'static [Named<T>],
) -> impl TypedValueParser<Value = T> {
    let names = values.iter().map(|(name, _, help)| {
        let name = PossibleValue::new(*name);
        if help.is_empty() { name } else { name.help(*help) }
    });
    PossibleValuesParser::new(names).try_map(|name| {
        let found = values.iter().find(|value| value.0 == name);
        found.map(|value| value.1).ok_or("expected one of the names")
    })
}

/// The name of a value, empty where it has none.
pub fn name_of<T: PartialEq>(
    values: &'static [Named<T>],
    value: &T,
) -> &'static str {
    let found = values.iter().find(|named| named.1 == *value);
    found.map_or("", |named| named.0)
}
