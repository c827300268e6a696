//! Names of choices: read as they are written, and refused otherwise.

use std::fmt::{Debug, Display};
use std::str::FromStr;

use rocking::accelerogram::Accelerogram;
use rocking::capacity::InversionRule;
use rocking::excitation::{PulseKind, PulseName, PulseParameter};
use rocking::ida::Adjust;
use rocking::integrator::{Model, Order, Overturning};
use rocking::names::UnknownName;
use rocking_records::intensity::{
    Intensity, IntensityMeasure, Measures, Settings,
};
use rocking_statistics::QuantileType;
use rocking_statistics::lognormal::FitMethod;

/// The texts of values; each text reads as its value again.
fn texts<T>(values: impl IntoIterator<Item = T>) -> Vec<String>
where
    T: Display + FromStr<Err = UnknownName> + PartialEq + Debug,
{
    let read = |value: T| {
        let text = value.to_string();
        assert_eq!(text.parse(), Ok(value));
        text
    };
    values.into_iter().map(read).collect()
}

#[test]
fn every_choice_is_read_as_it_is_written() {
    assert_eq!(texts(Model::ALL), ["nonlinear", "linearized"]);
    assert_eq!(texts(Overturning::ALL), ["alpha", "half-pi"]);
    assert_eq!(texts(Order::ALL), ["4", "6", "8", "10"]);
    let by = ["record-scaling", "slenderness-adjustment"];
    assert_eq!(texts(Adjust::ALL), by);
    let rules = ["median", "first", "last", "monotone"];
    assert_eq!(texts(InversionRule::ALL), rules);
    assert_eq!(texts(Intensity::ALL)[..2], ["pga", "pgv"]);
    assert_eq!(texts(PulseName::ALL)[0], "one-sine");
    assert_eq!(texts(PulseParameter::ALL)[0], "amplitude-m-s2");
}

#[test]
fn a_fit_is_read_with_its_type_of_quantiles_and_without() {
    for number in 1..=9 {
        let quantile_type = QuantileType::try_new(number).unwrap();
        let all = texts(FitMethod::all(quantile_type));
        assert_eq!(all[..2], ["mle", "moment"]);
        assert_eq!(all[2], format!("trimmed (type {number})"));
    }
    let alone: FitMethod = "quantile".parse().unwrap();
    assert_eq!(alone, FitMethod::Quantile(QuantileType::default()));
    let seven = QuantileType::try_new(7).unwrap();
    let changed = alone.with_quantile_type(seven);
    assert_eq!(changed, FitMethod::Quantile(seven));
    for text in ["mle (type 5)", "quantile (type 10)", "quantiles", ""] {
        assert!(text.parse::<FitMethod>().is_err(), "{text}");
    }
}

#[test]
fn another_text_is_refused_with_what_was_expected() {
    let error = "halfpi".parse::<Overturning>().unwrap_err();
    assert_eq!(error.found, "halfpi");
    assert_eq!(error.expected, ["alpha", "half-pi"]);
    let words = "overturning criterion \"halfpi\": expected one of alpha, \
                 half-pi";
    assert_eq!(error.to_string(), words);
}

#[test]
fn measures_are_read_as_they_are_written_and_others_refused() {
    let names = [
        "pga",
        "pgv",
        "pgd",
        "arias",
        "cav",
        "pgv-d575",
        "sa:0.5",
        "avgsa:0.5,1,2",
        "column:I-a 1",
    ];
    for name in names {
        assert_eq!(texts(name.parse::<IntensityMeasure>()), [name]);
        // Capitals count as small letters, but in the name of a column.
        let capitals = name.replace("pg", "PG").replace("sa:", "Sa:");
        assert_eq!(texts(capitals.parse::<IntensityMeasure>()), [name]);
    }
    for text in
        ["sa", "sa:", "sa:0", "sa:-1", "sa:nan", "sa:inf", "avgsa:1,", "pgax"]
    {
        let error = text.parse::<IntensityMeasure>().unwrap_err();
        assert_eq!(error.found, text);
    }
    assert!("column:".parse::<IntensityMeasure>().is_err());
}

#[test]
fn a_measure_has_no_value_at_a_period_that_was_not_measured() {
    let samples = vec![0.1; 5];
    let record = Accelerogram::try_new("step", 0.5, samples).unwrap();
    let settings = Settings::try_new(9.81, 0.05, vec![1.0]).unwrap();
    let measures = Measures::of(&record, &settings).unwrap();
    let value = |name: &str| {
        let measure: IntensityMeasure = name.parse().unwrap();
        measure.value(&measures, settings.periods_s())
    };
    assert_eq!(value("sa:1"), Some(measures.spectral_acceleration_g[0]));
    for name in ["sa:2", "avgsa:1,2", "column:mw"] {
        assert_eq!(value(name), None, "{name}");
    }
}

#[test]
fn a_pulse_asks_for_its_own_parameters_and_stops_at_the_first_refused() {
    let ricker = PulseName::RickerSymmetric;
    let own = [
        PulseParameter::Amplitude,
        PulseParameter::Period,
        PulseParameter::Cycles,
    ];
    assert_eq!(ricker.parameters(), own);
    let mut asked = Vec::new();
    let kind = ricker.kind(|parameter| {
        asked.push(parameter);
        Ok::<_, ()>(asked.len() as f64)
    });
    let expected = PulseKind::RickerSymmetric {
        amplitude: 1.0,
        period_s: 2.0,
        cycles: 3.0,
    };
    assert_eq!((kind, &asked[..]), (Ok(expected), &own[..]));
    let refused = ricker.kind(|parameter| match parameter {
        PulseParameter::Amplitude => Ok(1.0),
        other => Err(other),
    });
    assert_eq!(refused, Err(PulseParameter::Period));
}

#[test]
fn choices_are_their_names_in_json() {
    let measure: IntensityMeasure = "sa:1".parse().unwrap();
    let method = FitMethod::Trimmed(QuantileType::default());
    let all = (Model::Linearized, method, measure);
    let json = serde_json::to_string(&all).unwrap();
    assert_eq!(json, r#"["linearized","trimmed (type 5)","sa:1"]"#);
    let read: (Model, FitMethod, IntensityMeasure) =
        serde_json::from_str(&json).unwrap();
    assert_eq!(read, all);
    let error = serde_json::from_str::<Model>("\"both\"").unwrap_err();
    assert!(error.to_string().contains("expected one of nonlinear"));
}
