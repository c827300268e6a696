//! Heads of a name, a count and an interval.

use super::*;

/// What eqsig writes.
const EQSIG: &str = "m1\n6 0.0100\n0.000000\n0.030053\n-0.067326\n\
    -0.211205\n0.119031\n0.000000\n";

/// What EMOD3D writes, in g.
pub(crate) const EMOD3D: &str = "DSZ        000 \n\
    8  1.00000e-02 0 0  0.00000e+00  0.00000e+00  0.00000e+00  0.00000e+00\n\
    \x20 5.89162e-02   2.13440e-01   2.38426e-02   7.97357e-02   4.38363e-02   1.98202e-02\n\
    \x20-1.01626e-01  -1.11335e-01\n";

/// What RspMatch writes.
const RSPMATCH: &str = "Time history matched to spectrum: a.acc\n\
    7 0.0200 656\n\
    \x20 0.10000E-01  0.20000E-01 -0.30000E-01  0.40000E-01 -0.50000E-01\n\
    \x20 0.60000E-01  0.70000E-01\n";

/// El Centro as lecture notes have it.
const WORDS: &str = "Data for a lecture\n\
    10 points at equal spacing of 0.02 sec\n\
    Points are listed in the format of 8F10.5\nThe units are (g)\n\
    *** Begin data ***\n\
    \x20  0.00630   0.00364   0.00099   0.00428   0.00758   0.01087   0.00682   0.00277\n\
    \x20 -0.00128   0.00368\n*** End Data ***\n\n";

#[test]
fn each_program_s_head_is_read() {
    let cases = [
        (EQSIG, 6, 0.01, 0.211_205, in_g(None)),
        (EMOD3D, 8, 0.01, 0.238_426 / 10.0, in_g(None)),
        (RSPMATCH, 7, 0.02, 0.07, in_g(None)),
        (WORDS, 10, 0.02, 0.01087, options(None)),
        ("4\n0.005\n1.2e-3\n-4.5e-3\n7e-3\n0\n", 4, 0.005, 7e-3, in_g(None)),
        ("3 0.005\n1.2e-3\n-4.5e-3\n0\n", 3, 0.005, 4.5e-3, in_g(None)),
    ];
    for (text, count, dt_s, pga_g, options) in cases {
        let record = read("a/DSZ.090", text.as_bytes(), &options).expect(text);
        assert_eq!(record.format.name, "counted", "{text}");
        let motion = &record.accelerogram;
        assert_eq!(motion.samples_g().len(), count, "{text}");
        assert_eq!(motion.dt_s(), dt_s);
        let pga_g = if text == EMOD3D { 0.21344 } else { pga_g };
        assert_eq!(motion.pga_g(), pga_g);
        assert_eq!(motion.name(), "DSZ.090");
        assert!(record.given.unit || text == WORDS);
    }
    let direction = |head: &str| {
        let text = EMOD3D.replace("DSZ        000", head);
        read("a", text.as_bytes(), &in_g(None)).unwrap().direction
    };
    assert_eq!(direction("DSZ        000"), Direction::Horizontal);
    assert_eq!(direction("DSZ        ver"), Direction::Vertical);
    assert_eq!(direction("DSZ        X"), Direction::Unknown);
}

#[test]
fn a_head_that_is_contradicted_is_refused() {
    let short = |text: &str| text.replace("0.119031\n", "");
    let without = |text: &str, line: usize| -> String {
        let lines = text.split_inclusive('\n').enumerate();
        lines.filter(|(i, _)| *i != line).map(|(_, line)| line).collect()
    };
    refused_with(&[
        (short(EQSIG), "test:7: 5 samples: expected 6, as in"),
        (
            EQSIG.replace("6 0.0100", "5 0.0100"),
            "test:8: 6 samples: expected 5",
        ),
        (EQSIG.replace("-0.067326", "-0.06x326"), "test:5: \"-0.06x326\""),
        (EQSIG.replace("-0.067326", "-0.067 0.3"), "test:5: \"-0.067 0.3\""),
        (without(EMOD3D, 2), "test:3: 2 samples: expected 8"),
        (without(RSPMATCH, 3), "test:3: 5 samples: expected 7"),
        (without(WORDS, 5), "test:6: 2 samples: expected 10"),
        (
            WORDS.replace("Data for", "Velocity for"),
            "test:1: \"Velocity for a lecture\": expected an acceleration",
        ),
        (EQSIG.to_owned(), "test: no unit in the file"),
        // Without its count a head is of no known format.
        (without(RSPMATCH, 1), "test:1: begins with"),
    ]);
    // Two columns under one line of names stay times and samples.
    let times = "t a\n2 0.1\n3 0.2\n4 0.1\n";
    let record = read("a", times.as_bytes(), &in_g(None)).unwrap();
    assert_eq!(record.format.name, "csv");
}
