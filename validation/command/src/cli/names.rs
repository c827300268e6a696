//! Flags whose value is one of a few names.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use rocking::capacity::InversionRule;
use rocking::ida::Adjust;
use rocking::integrator::{Model, Order, Overturning};
use rocking_statistics::QuantileType;
use rocking_statistics::lognormal::FitMethod;

use rocking_common::paper::Intensity;

/// Names of values, with their help texts, if any.
pub fn named<T: Copy + Send + Sync + 'static>(
    values: impl AsRef<[T]>,
    name: fn(T) -> &'static str,
    help: impl IntoIterator<Item = &'static str>,
) -> impl TypedValueParser<Value = T> {
    let values = values.as_ref().to_vec();
    let names = values.clone().into_iter().zip(help).map(|(value, help)| {
        let name = PossibleValue::new(name(value));
        if help.is_empty() { name } else { name.help(help) }
    });
    PossibleValuesParser::new(names).try_map(move |found| {
        let is_it = |value: &T| name(*value).eq_ignore_ascii_case(&found);
        let value = values.iter().copied().find(is_it);
        value.ok_or("expected one of the names")
    })
}

/// Equations of motion.
pub fn model() -> impl TypedValueParser<Value = Model> {
    named(Model::ALL, Model::name, ["Eq. 1", "Eq. 2"])
}

/// When a block counts as overturned.
pub fn overturning() -> impl TypedValueParser<Value = Overturning> {
    let help = ["|theta| reaches alpha", "|theta| exceeds pi/2"];
    named(Overturning::ALL, Overturning::name, help)
}

/// Dimensionless intensity measures.
pub fn intensity() -> impl TypedValueParser<Value = Intensity> {
    let help = Intensity::ALL.map(|intensity| intensity.row().words);
    named(Intensity::ALL, Intensity::name, help)
}

/// Capacity of a record with several crossings.
pub fn crossing() -> impl TypedValueParser<Value = InversionRule> {
    let help = [
        "The median crossing",
        "The first crossing",
        "The last crossing",
        "The length of intensity below the level",
    ];
    named(InversionRule::ALL, InversionRule::name, help)
}

/// How intensity is reached.
pub fn adjustment() -> impl TypedValueParser<Value = Adjust> {
    let help = ["Scale the record", "Keep the record and adjust alpha"];
    named(Adjust::ALL, Adjust::name, help)
}

/// Orders of the Taylor polynomial.
pub fn order() -> impl TypedValueParser<Value = Order> {
    let help = [
        "A first look",
        "Exploring large numbers of analyses",
        "Statistics of many analyses",
        "More accurate than most steps need",
    ];
    named(Order::ALL, Order::name, help)
}

/// How a lognormal distribution is fitted.
pub fn fit_method() -> impl TypedValueParser<Value = FitMethod> {
    let help = [
        "Maximum likelihood (divisor n); values `>LIMIT` enter by their \
         limits",
        "Mean and standard deviation of the logarithms (divisor n - 1)",
        "The same of the values up to the 95 % quantile",
        "Median and half the logarithm of the ratio of the 84 and 16 % \
         quantiles",
        "Maximum likelihood, values above the 95 % quantile and infinite ones \
         right-censored at the largest value left, values `>LIMIT` at theirs",
    ];
    let all = FitMethod::all(QuantileType::default());
    named(all, FitMethod::name, help)
}
