use super::*;
use rocking_statistics::{Interval, Range};

fn estimate(value: f64, ends: Option<(f64, f64)>) -> Estimate {
    ends.map_or(Estimate::exact(value), |(low, high)| {
        let interval = Interval::try_new(low, high).unwrap();
        Estimate::try_new(value, interval, Range::Real).unwrap()
    })
}

fn text(
    scale: ValueScale,
    limit: Option<f64>,
    value: f64,
    ends: Option<(f64, f64)>,
) -> String {
    EstimateText::of(&estimate(value, ends), scale, limit).whole()
}

#[test]
fn values_carry_their_unit_and_as_many_digits_as_their_interval_gives() {
    use ValueScale::{Change, Percent, Plain, Points};
    let nan = f64::NAN;
    for (scale, value, ends, expected) in [
        (Change, 1.0131, Some((0.95, 1.041)), "+1 % (-5 to +4)"),
        (Change, 1.0131, Some((1.01, 1.02)), "+1.3 % (+1.0 to +2.0)"),
        (
            Change,
            0.99128,
            Some((0.99127, 0.99129)),
            "-0.87 % (-0.87 to -0.87)",
        ),
        (Percent, 0.967, Some((0.894, 1.0)), "97 % (89 to 100)"),
        (Percent, 0.272, None, "27.2 %"),
        (Points, -0.25, Some((-0.913, 0.406)), "-25 points (-91 to 41)"),
        (Plain, 1.28, Some((1.22, 1.36)), "1.28 (1.22 to 1.36)"),
        (Plain, 0.0516, Some((0.017, 0.159)), "0.05 (0.02 to 0.16)"),
        (Plain, 0.0143, None, "0.0143"),
        (Plain, 0.5, Some((-1e-9, 1.0)), "0.5 (0.0 to 1.0)"),
        (Change, nan, None, "no data"),
        (
            Change,
            1.2,
            Some((f64::NEG_INFINITY, f64::INFINITY)),
            "+20.0 % (-infinite to infinite)",
        ),
    ] {
        assert_eq!(text(scale, None, value, ends), expected);
    }
}

#[test]
fn an_end_is_printed_on_its_side_of_no_effect() {
    let ends = Some((0.000_283, 0.108));
    let text = |limit| text(ValueScale::Plain, limit, 0.0541, ends);
    assert_eq!(text(None), "0.05 (0.00 to 0.11)");
    assert_eq!(text(Some(0.0)), "0.0541 (0.0003 to 0.1080)");
}

#[test]
fn a_count_is_printed_on_its_side_of_the_limit() {
    let share = |holds| Yardstick {
        words: "notches that hold 1".into(),
        unit: Unit::Share,
        holds,
    };
    let most = share(Region::Above(0.5));
    assert_eq!(rule_text(&most), "above 50 %");
    assert_eq!(count_text(&most, &SampleCount::of(4, 47)), "8.5 % (4 of 47)");
    let near = SampleCount::of(5001, 10_000);
    assert_eq!(count_text(&most, &near), "50.01 % (5001 of 10000)");
    assert_eq!(count_text(&most, &SampleCount::of(0, 0)), "no data");
    let all = share(Region::Within(1.0, 1.0));
    assert_eq!(rule_text(&all), "100 %");
    let near = SampleCount::of(1999, 2000);
    assert_eq!(count_text(&all, &near), "99.95 % (1999 of 2000)");
    let almost = share(Region::Within(0.9, 1.0));
    assert_eq!(rule_text(&almost), "at least 90 %");
    let ratio = Yardstick {
        words: "the ratio".into(),
        unit: Unit::One,
        holds: Region::Within(0.95, 1.05),
    };
    assert_eq!(rule_text(&ratio), "0.95 to 1.05");
    let number = SampleCount::number(1.0501);
    assert_eq!(count_text(&ratio, &number), "1.0501");
}
