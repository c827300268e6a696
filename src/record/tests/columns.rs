//! Files of one and of two columns.

use super::*;

#[test]
fn one_column_needs_an_interval() {
    let text = "# by hand\n0.00981\n-1.962E-2\r\n 3.0D-3 \n\n\n";
    assert_eq!(
        refusal(text),
        "test: no sampling interval in the file: expected it to be given in s, as --dt or in a column `dt_s` of an index"
    );
    let given = ReadOptions {
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        gravity_m_s2: 9.81,
        ..options(Some(0.005))
    };
    let record = read("a/b.c.txt", text.as_bytes(), &given).unwrap();
    assert_eq!(record.format, Format::Column);
    assert_eq!(record.accelerogram.name(), "b.c");
    assert!((record.accelerogram.pga_g() - 0.002).abs() < 1e-18);
    let stated = "test: no unit in the file: expected it to be given, as";
    let error = read("test", text.as_bytes(), &options(Some(0.005)));
    assert!(error.unwrap_err().to_string().starts_with(stated));
    let refused = |text: &str| {
        read("test", text.as_bytes(), &in_g(Some(0.01)))
            .unwrap_err()
            .to_string()
    };
    assert_eq!(refused("0.1\n\n0.2\n"), "test:2: \"\": expected a number");
    assert_eq!(
        refused("0.1\n0.2 0.3\n"),
        "test:2: \"0.2 0.3\": expected a number"
    );
    assert_eq!(
        refused("0.1\nnan\n"),
        "test:2: \"nan\": expected a finite number"
    );
    assert_eq!(
        refused("-inf\n0\n"),
        "test:1: \"-inf\": expected a finite number"
    );
    assert_eq!(refused("0.1\n"), "test: 1 samples: expected at least 2");
    assert_eq!(refused("0.1\n0.2E\n"), "test:2: \"0.2E\": expected a number");
    assert_eq!(refused("0.1\n0x1\n"), "test:2: \"0x1\": expected a number");
}

#[test]
fn two_columns_state_their_interval() {
    for separator in [",", ";", "\t", "  ", " , "] {
        for head in ["", "time (s)#acc (g)\n", "# note\n", "t#a\n"] {
            let rows = "0.000#0.1\n0.005#-0.2\n0.010#3e-1\n0.015#0\n";
            let text = format!("{head}{rows}").replace('#', separator);
            let text =
                text.replacen(&format!("{separator} note"), "# note", 1);
            let given = match head.contains("(g)") {
                true => options(None),
                false => in_g(None),
            };
            let record = read("test", text.as_bytes(), &given).expect(&text);
            assert_eq!(record.format, Format::Csv);
            assert_eq!(record.accelerogram.dt_s(), 0.005);
            assert_eq!(record.accelerogram.samples_g(), [0.1, -0.2, 0.3, 0.0]);
        }
    }
    // Times rounded to four decimals, a step of 1/410 s.
    let rows = |times: &mut dyn Iterator<Item = f64>| -> String {
        times.map(|t| format!("{t:.4},0.5\n")).collect()
    };
    let text = rows(&mut (0..411).map(|i| f64::from(i) / 410.0));
    let dt = read("test", text.as_bytes(), &in_g(None)).unwrap();
    let dt = dt.accelerogram.dt_s();
    assert!((dt - 1.0 / 410.0).abs() < 1e-9, "{dt}");
    // A dropped line, at every place.
    for dropped in 1..40 {
        let times = (0..41).filter(|i| *i != dropped);
        let text = rows(&mut times.map(|i| f64::from(i) * 0.02));
        assert!(refusal(&text).contains("a constant step"), "{dropped}");
    }
    let cases = [
        ("0,1\n0,2\n", "test:2: the times end at 0 s: expected more"),
        ("0.1,1\n0.0,2\n", "test:2: the times end at 0 s: expected more"),
        ("0.00,1\n0.00,1\n0.01,2\n", "test:2: times of 2 decimals with"),
        ("0.0,1\n0.1,2\n0.2\n", "test:3: \"0.2\": expected two numbers"),
        ("0.0,1\n0.1,2\n0.2,x\n", "test:3: \"x\": expected a number"),
        ("0.0,1\n0.1,NaN\n", "test:2: \"NaN\": expected a finite"),
        ("0.0,1\n0.1,\n", "test:2: \"\": expected a number"),
        ("t (min),a (g)\n0,1\n10,2\n", "test:1: sampling interval"),
        ("t,a (furlong)\n0,1\n1,2\n", "test:1: unit \"furlong\""),
        ("0.0,1\n", "test:1: the file ends: expected a second time"),
    ];
    for (text, expected) in cases {
        let found = refusal(text);
        assert!(found.starts_with(expected), "{found}");
    }
    let si = read_text("t (s),a [m/s^2]\n0,9.80665\n1,2\n").unwrap();
    assert_eq!(si.accelerogram.pga_g(), 1.0);
    let gal = read_text("t_s,a_cm_s2\n0,980.665\n1,2\n").unwrap();
    assert_eq!(gal.accelerogram.pga_g(), 1.0);
}

/// Units that a header or a comment states; columns that are no times.
#[test]
fn headers_of_columns_are_heeded() {
    use AccelerationUnit as U;
    let (si, gal) = (U::MetrePerSecondSquared, U::CentimetrePerSecondSquared);
    let rows = "0.00 0.1\n0.01 -0.2\n0.02 0.3\n";
    let stated = [
        ("# time [s]  acc [m/s2]\n", si, 0.01),
        ("# units: (cm/s^2)\n", gal, 0.01),
        ("Time (s)  Acc (m/s\u{b2})\n", si, 0.01),
        ("Time(sec) Acceleration(g)\n", U::Gravity, 0.01),
        ("t_s acc_gal\n", gal, 0.01),
        ("time_ms acc_g\n", U::Gravity, 1e-5),
        ("time (ms) ground acceleration (cm/sec/sec)\n", gal, 1e-5),
    ];
    for (head, unit, dt_s) in stated {
        let record = read_text(&format!("{head}{rows}")).expect(head);
        assert_eq!(record.unit, unit, "{head}");
        assert_eq!(record.accelerogram.dt_s(), dt_s, "{head}");
    }
    let quoted = "\"Time (s)\",\"Acc (g)\"\n0,1\n1,2\n";
    assert_eq!(read_text(quoted).unwrap().unit, U::Gravity);
    let refused = [
        ("Period (s)  Sa (g)\n", "expected a first column of times"),
        ("index acc(g)\n", "expected a first column of times"),
        ("n acc(g)\n", "expected a first column of times"),
        ("frequency (Hz) acc(g)\n", "expected a first column of times"),
        ("t(s) Sa(g)\n", "expected an acceleration history"),
        ("time velocity\n", "expected an acceleration history"),
        ("# time [s]  acc [ft/s2]\n", "unit \"ft/s2\""),
        ("", "no unit in the file"),
    ];
    for (head, expected) in refused {
        let found = refusal(&format!("{head}{rows}"));
        assert!(found.contains(expected), "{head}: {found}");
    }
    // The interval is the decimal number that was meant, not a product.
    for dt in ["0.005", "0.01", "0.02", "0.0025"] {
        let dt_s: f64 = dt.parse().unwrap();
        let row = |i: u32| format!("{:.4},0.5\n", f64::from(i) * dt_s);
        let text: String = (0..500).map(row).collect();
        let record = read("t", text.as_bytes(), &in_g(Some(dt_s))).unwrap();
        assert_eq!(record.accelerogram.dt_s(), dt_s);
    }
}

/// A count or an interval on the first line of a column is no sample.
#[test]
fn a_first_line_unlike_all_others_is_refused() {
    let rows = "0.00123\n-0.00456\n0.00789\n0.00012\n";
    let refused = |text: &str| {
        read("test", text.as_bytes(), &in_g(Some(0.01))).unwrap_err()
    };
    for head in ["4", "400", "0.01"] {
        let error = refused(&format!("{head}\n{rows}")).to_string();
        assert!(error.starts_with(&format!("test:1: {head:?}")), "{error}");
    }
    for head in ["0", "0.00000", "# 4"] {
        let text = format!("{head}\n{rows}");
        assert!(read("t", text.as_bytes(), &in_g(Some(0.01))).is_ok());
    }
    // Whole although no line end follows; cut, and shown by its digits.
    let whole = rows.trim_end();
    assert!(read("t", whole.as_bytes(), &in_g(Some(0.01))).is_ok());
    let cut = refused(&whole[..whole.len() - 1]).to_string();
    assert!(cut.contains("expected 5 decimals"), "{cut}");
}
