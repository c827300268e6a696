//! Files of one and of two columns.

use super::*;

#[test]
fn one_column_needs_an_interval() {
    let text = "# by hand\n0.00981\n-1.962E-2\r\n 3.0D-3 \n\n\n";
    assert_eq!(
        refusal(text),
        "test: no sampling interval in the file: expected --dt in s or a column `dt_s` in an index"
    );
    let given = ReadOptions {
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        gravity_m_s2: 9.81,
        ..options(Some(0.005))
    };
    let record = read("a/b.c.txt", text.as_bytes(), &given).unwrap();
    assert_eq!(record.format.name, "column");
    assert_eq!(record.accelerogram.name(), "b.c");
    assert!((record.accelerogram.pga_g() - 0.002).abs() < 1e-18);
    let stated = "test: no unit in the file: expected --units";
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
            assert_eq!(record.format.name, "csv");
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
        ("0.00,1\n0.00,1\n0.01,2\n", "test:2: time 0 s: expected 0.005 s"),
        ("0.0,1\n0.1,2\n0.2\n", "test:3: \"0.2\": expected two numbers"),
        ("0.0,1\n0.1,2\n0.2,x\n", "test:3: \"x\": expected a number"),
        ("0.0,1\n0.1,NaN\n", "test:2: \"NaN\": expected a finite"),
        ("0.0,1\n0.1,\n", "test:2: \"\": expected a number"),
        ("t (min),a (g)\n0,1\n10,2\n", "test:1: sampling interval"),
        ("t,a (furlong)\n0,1\n1,2\n", "test:1: unit \"furlong\""),
        ("0.0,1\n", "test:1: the file ends: expected a second time"),
    ];
    refused_with(&cases);
    let si = read_text("t (s),a [m/s^2]\n0,9.80665\n1,2\n").unwrap();
    assert_eq!(si.accelerogram.pga_g(), 1.0);
    let gal = read_text("t_s,a_cm_s2\n0,980.665\n1,2\n").unwrap();
    assert_eq!(gal.accelerogram.pga_g(), 1.0);
}

/// Times with few digits are read by what their digits resolve, with a
/// remark; an error names the place where the step changes.
#[test]
fn times_have_the_digits_of_their_program() {
    let rows = |time: &dyn Fn(u32) -> String, n: u32| -> String {
        (0..n).map(|i| format!("{} 0.5\n", time(i))).collect()
    };
    let read = |text: &str| read("test", text.as_bytes(), &in_g(None));
    // MATLAB's five digits beyond 100 s; zeros at the end are left out.
    let five = |i: u32| {
        let rounded = format!("{:.4e}", f64::from(i) * 0.005);
        rounded.parse::<f64>().unwrap().to_string()
    };
    let record = read(&rows(&five, 24_000)).unwrap();
    assert_eq!(record.accelerogram.dt_s(), 0.005);
    let [remark @ Remark::Times { .. }] = &record.remarks[..] else {
        panic!("{:?}", record.remarks)
    };
    let expected = "times lie up to 5.00e-3 s from constant steps of 0.005 s";
    assert!(remark.to_string().starts_with(expected), "{remark}");
    // 128 times a second with three decimals, and with Fortran's exponents.
    let three = |i: u32| format!("{:.3}", f64::from(i) / 128.0);
    let record = read(&rows(&three, 3000)).unwrap();
    assert_eq!(record.accelerogram.dt_s(), 1.0 / 128.0);
    let whole_ms = |i: u32| format!("{:.0}", f64::from(i) * 1000.0 / 128.0);
    let text = format!("time_ms acc\n{}", rows(&whole_ms, 3000));
    assert_eq!(read(&text).unwrap().accelerogram.dt_s(), 1.0 / 128.0);
    let fortran = |i: u32| format!("{:.6E}", f64::from(i) / 128.0);
    let record = read(&rows(&fortran, 3000)).unwrap();
    assert_eq!(record.accelerogram.dt_s(), 1.0 / 128.0);
    assert_eq!(record.remarks, []);
    // The product of an index and a step, both in single precision.
    let single = |i: u32| format!("{:.9}", i as f32 * 0.005_f32);
    let record = read(&rows(&single, 20_000)).unwrap();
    assert_eq!(record.accelerogram.dt_s(), 0.005);
    // A step that changes; the header and comments count as lines.
    let steps = "t a\n# note\n0 1\n0.005 1\n0.006 1\n0.007 1\n0.008 1\n";
    assert_eq!(
        read(steps).unwrap_err().to_string(),
        "test:5: time 0.006 s: expected 0.01 s, a constant step from the \
         times before, or times with more digits"
    );
    for unit in ["ms", "s"] {
        let per_second = if unit == "ms" { 1e3 } else { 1.0 };
        let time = |i: u32| {
            let step = if i < 700 { 0.0 } else { 0.004 };
            format!("{:.4}", per_second * (f64::from(i) * 0.005 + step))
        };
        let text = format!("t ({unit}) a\n{}", rows(&time, 1000));
        let error = read(&text).unwrap_err().to_string();
        let expected = "test:702: time 3.504 s: expected ";
        assert!(error.starts_with(expected), "{error}");
    }
}

/// Cells in quotes, and the column in which pandas numbers the rows.
#[test]
fn quotes_and_numbered_rows_are_read() {
    let expected = read_text("time,acc (g)\n0.00,0.1\n0.01,-0.2\n").unwrap();
    for text in [
        "\"time\",\"acc (g)\"\n\"0.00\",\"0.1\"\n\"0.01\",\"-0.2\"\n",
        "\"time\";\"acc (g)\"\n\"0.00\"; 0.1\n0.01;\"-0.2\"\n",
        "time,\"acc (g)\"\n0.00,0.1\n0.01,-0.2\n",
        ",time,acc (g)\n0,0.00,0.1\n1,0.01,-0.2\n",
        "index,time,acc (g)\n0,0.00,0.1\n1,0.01,-0.2\n",
        "Unnamed: 0,time,acc (g)\n0,0.00,0.1\n1,0.01,-0.2\n",
        "\"\",\"time\",\"acc (g)\"\n\"0\",0.00,0.1\n\"1\",0.01,-0.2\n",
    ] {
        assert_eq!(read_text(text).as_ref(), Ok(&expected), "{text}");
    }
    let comma = "\"time\",\"acc, north (g)\"\n0.00,0.1\n0.01,-0.2\n";
    assert_eq!(read_text(comma).as_ref(), Ok(&expected));
    refused_with(&[
        (",time,acc\n0,0,1\n2,1,2\n", "test:3: \"2\": expected 1, the row's"),
        (",time,acc\n0,0,1\n1,1\n", "test:3: \"1,1\": expected two"),
        (",time,acc\n0,0,1\n\n1,1,2\n", "test:3: \"\": expected two"),
        ("n,time,acc\n0,0,1\n1,1,2\n", "test:1: begins with"),
        ("t,\"a\n0,1\n1,2\n", "test: no unit"),
        ("\"t\",\"a\"\n0,1\n1,\"2\n", "test:3: \"\\\"2\": expected"),
        (
            "\"t\",\"a\"\n0,1\n\"1,2\"\n",
            "test:3: \"\\\"1,2\\\"\": expected two",
        ),
    ]);
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
    // A factor before an interval, written as the samples are or not.
    for factor in ["9.806650e+02", "9.810000e+00", "1"] {
        for last in ["7.953786e-04", "0"] {
            let text =
                format!("{factor}\n1.000000e-02\n-2.039432e-05\n{last}\n");
            let error = refused(&text).to_string();
            assert!(
                error.starts_with(&format!("test:1: {factor:?}")),
                "{error}"
            );
        }
    }
    // What is neither a whole number nor an interval is a sample, however
    // many digits it has.
    for first in ["0.2027100355086725", "0.10135501775433625"] {
        let text = format!("{first}\n-0.1013550177543\n0.0506775088771\n");
        let record = read("t", text.as_bytes(), &in_g(Some(0.01))).unwrap();
        assert_eq!(record.accelerogram.samples_g().len(), 3);
    }
    // A negative number is neither, however it is written.
    for text in ["-1.315\n0.7936\n0.1828\n", "-4\n0.1\n0.2\n0.3\n0.4\n"] {
        let record = read("t", text.as_bytes(), &in_g(Some(0.01))).unwrap();
        assert!(record.accelerogram.samples_g()[0] < 0.0);
    }
}

/// A last line without its end is read. Where the form of its number does
/// not prove it whole, a remark says so; where it shows a cut, it is refused.
#[test]
fn a_last_line_needs_no_end() {
    let read = |text: &str| read("t", text.as_bytes(), &in_g(Some(0.01)));
    let even = "0.00123\n-0.00456\n0.00789\n0.00012\n";
    // Numbers as MATLAB writes them: a bare 0 beside 15 decimals.
    let uneven = "                   0\n   0.000610352010000\n\
        \x20  0.001220704020000\n                   0\n  -0.032411769120000\n";
    let powers = "0.0012\n-1.25e-05\n0.0034\n2.5e-12\n0.004\n-0.05\n";
    let pairs = "0.00 0.1\n0.01 -0.25\n0.02 0.125\n0.03 0\n0.04 0.5\n";
    for (text, cut) in [
        (even, false),
        (uneven, true),
        (powers, true),
        (pairs, true),
        ("-1.315\n0.7936\n0.1828\n", true),
    ] {
        let whole = read(text).unwrap();
        assert_eq!(whole.remarks, []);
        let open = read(text.trim_end()).expect(text);
        assert_eq!(open.accelerogram, whole.accelerogram);
        let expected = cut.then_some(Remark::LastLine);
        assert_eq!(open.remarks, Vec::from_iter(expected), "{text}");
    }
    let cases = [
        (even, 1, "\"0.0001\": expected 5 decimals and no exponent"),
        (powers, 0, ""),
    ];
    for (text, bytes, expected) in cases {
        let cut = text.trim_end();
        let found = read(&cut[..cut.len() - bytes]);
        match found {
            Ok(_) => assert_eq!(expected, ""),
            Err(error) => assert!(error.to_string().contains(expected)),
        }
    }
    // A cut exponent would make another number of a small one.
    for last in ["-1.25e-0", "-1.25", "0.5", "-1.25e", "-1.", "-"] {
        let cut = powers.replace("-0.05\n", last);
        assert!(read(&cut).is_err(), "{last}");
        let ended = read(&format!("{cut}\n"));
        let number = last.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        assert_eq!(ended.is_ok(), number, "{last}");
    }
    let found = read(&powers.replace("-0.05\n", "-1.25")).unwrap_err();
    assert_eq!(
        found.to_string(),
        "t:6: \"-1.25\": expected an exponent of 4 characters, as in other numbers, or the end of the line"
    );
    // The same in the one format with a header that has one sample a line.
    let esm = networks::ESM.replace("-1.500000", "-1.5");
    let esm = esm.replace("3.000000\n", "3.0");
    assert_eq!(read_text(&esm).unwrap().remarks, [Remark::LastLine]);
}
