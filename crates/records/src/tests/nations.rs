//! AFAD's text and GeoNet's volumes, written from their public descriptions
//! with invented numbers.

use super::*;

pub(super) const AFAD: &str = "STRONG GROUND MOTION RECORDS OF NOWHERE\r\n\
    PLACE                   : NOWHERE\r\n\
    EARTHQUAKE DATE         : 1900/01/01 00:00:00 (GMT)\r\n\
    STATION ID              : 0001\r\n\
    NUMBER OF DATA          : 4\r\n\
    SAMPLING INTERVAL (sec) : 0.01\r\n\
    RAW PGA VALUES (gal)    : (N-S) 98.066500 (E-W) 12.163827 (U-D) 9.840572\r\n\
    Copyright NOBODY\r\n\
    \x20      N-S          E-W          U-D\r\n\
    \x20   0.000909     -0.000191    -0.000092\r\n\
    \x20 -98.066500      1.000000     9.840572\r\n\
    \x20   2.000000     12.163827    -3.000000\r\n\
    \x20   0.000894     -0.000180    -0.000083\r\n";

#[test]
fn afad_text_is_read_and_checked_against_its_header() {
    let all = read_all("d/A_1.txt", AFAD.as_bytes(), &options(None)).unwrap();
    let names: Vec<_> = all.iter().map(|r| r.accelerogram.name()).collect();
    assert_eq!(names, ["A_1:N-S", "A_1:E-W", "A_1:U-D"]);
    let directions: Vec<_> = all.iter().map(|r| r.direction).collect();
    use Direction::{Horizontal, Vertical};
    assert_eq!(directions, [Horizontal, Horizontal, Vertical]);
    for record in &all {
        assert_eq!(record.format.name, "afad");
        assert_eq!(record.accelerogram.dt_s(), 0.01);
        assert_eq!(record.accelerogram.samples_g().len(), 4);
    }
    assert_eq!(all[0].accelerogram.pga_g(), 0.1);
    assert_eq!(all[1].accelerogram.samples_g()[2], 12.163827 / 980.665);
    let cases = [
        (AFAD.replace(": 4", ": 5"), "test:13: 4 samples: expected 5, as"),
        (AFAD.replace(": 4", ": -4"), "test:5: \"NUMBER OF DATA          :"),
        (AFAD.replace("0.01\r", "0\r"), "test:6: \"SAMPLING INTERVAL (sec)"),
        (AFAD.replace("0.01\r", "1e300\r"), "test: sampling interval 1e300 s"),
        (
            AFAD.replace("(N-S) 98.066500", "(N-S) 98.066400"),
            "test:13: largest absolute sample 98.0665 cm/s2: expected 98.0664",
        ),
        (
            AFAD.replace("(E-W) 12", "(N-S) 12"),
            "test:7: \"(N-S) 98.066500 (N-S) 12.163827 (U-D)...\": expected peaks",
        ),
        (
            AFAD.replace("E-W          U-D\r", "U-D          E-W\r"),
            "test:13: the file ends: expected a line `N-S E-W U-D`",
        ),
        (AFAD.replace("    -3.000000", "     -3.00000"), "test:12: \"2.00"),
        (AFAD.replace("     1.000000", "      1.000000"), "test:11: \"-98.0"),
        (
            AFAD.replace("     9.840572\r", "\r"),
            "test:11: \"-98.066500      1",
        ),
        (AFAD.replace(" 1.000000", "      NaN"), "test:11: \"NaN\": expected"),
        (AFAD.replace("-0.000083\r\n", "-0.00008"), "test:13: \"0.000894"),
        (AFAD.replace("RAW PGA", "RAW PGV"), "test:13: the file ends: expec"),
    ];
    refused_with(&cases);
}

/// A V1A or, with velocity and displacement, a V2A file.
pub(super) fn geonet(corrected: bool) -> String {
    let component = |name: &str| {
        let (first, interval, peak) = match corrected {
            false => (
                "Uncorrected",
                "Raw readings in units of 1.00 mm/s/s  at intervals of 0.005 s",
                "Peak -11026.2 mm/s/s at   0.03 s     RMS   145.6 mm/s/s",
            ),
            true => (
                "Corrected",
                "Instrument corrected data at 0.005 sec intervals",
                "peak -11026.2 mm/s/s at   0.03 sec     rms   145.6 mm/s/s",
            ),
        };
        let mut text = format!(
            "{first} accelerogram 19000101_000000_XXXX_20 GNS Science\n\
             Site XXXX      42 37 10S  173 03 13E\nNowhere\nInstrument X\n\
             Resolution: 18-bit\nAccelerogram 19000101_000000_XXXX_20\n\
             5 km from Nowhere\n1900 January 01         00:00:00 UT\n\
             Epicentre  42 41 33S 173 01 19E\n\
             Number of points  12    Duration 0.06 s\n{interval}\n\
             Data is unfiltered\nComponent {name}\n\
             Acceleration:  {peak}\nVelocity\nDisplacement\n"
        );
        let more = if corrected { 3 } else { 0 };
        for place in 1..=40 {
            let value = match place {
                34 => 12,
                35 | 36 => more,
                _ => 1,
            };
            let end = if place % 10 == 0 { "\n" } else { "" };
            text.push_str(&format!("{value:8}{end}"));
        }
        for place in 1..=60 {
            let value = if place == 26 { "0.0050" } else { "0.0" };
            let end = if place % 10 == 0 { "\n" } else { "" };
            text.push_str(&format!("{value:>8}{end}"));
        }
        text.push_str(
            "    -6.5    -5.7    -5.4 -9865.4  -11026    -4.7    -4.4    -5.1    -6.3    -6.6\n\
             \x20   -4.6    -4.3\n",
        );
        for _ in 0..more.min(2) {
            text.push_str("    1.25   -2.50    3.75\n");
        }
        text
    };
    ["N28W  Longitudinal", "E 0N", "Up"].map(component).concat()
}

#[test]
fn geonet_volumes_are_read_and_checked_against_their_header() {
    for corrected in [false, true] {
        let text = geonet(corrected);
        let all =
            read_all("d/A_20.V1A", text.as_bytes(), &options(None)).unwrap();
        let names: Vec<_> =
            all.iter().map(|r| r.accelerogram.name()).collect();
        assert_eq!(names, ["A_20:N28W", "A_20:E_0N", "A_20:Up"]);
        let directions: Vec<_> = all.iter().map(|r| r.direction).collect();
        use Direction::{Horizontal, Vertical};
        assert_eq!(directions, [Horizontal, Horizontal, Vertical]);
        for record in &all {
            assert_eq!(record.format.name, "geonet");
            assert_eq!(record.accelerogram.dt_s(), 0.005);
            assert_eq!(record.accelerogram.samples_g().len(), 12);
            assert_eq!(record.accelerogram.pga_g(), 1102.6 / 980.665);
        }
        let third = text.rfind("orrected acc").unwrap();
        let third = text[..third].rfind('\n').unwrap() + 1;
        let last = text.lines().count();
        let cases = [
            (text[..third].to_owned(), format!("test:{}: the", last / 3 * 2)),
            (format!("{text}x\n"), format!("test:{}: \"x\": exp", last + 1)),
            (text.replacen("points  12", "points  13", 1), "test:10: ".into()),
            (text.replacen("0.005 s", "0.050 s", 1), "test:11: ".into()),
            (text.replacen("0.0050", "0.0500", 1), "test:11: ".into()),
            (
                text.replacen("Duration 0.06", "Duration 0.16", 1),
                "test:10: samples for 0.06 s: expected 0.16 s".into(),
            ),
            (text.replacen("  -11026 ", "  -11020 ", 1), "test:".into()),
            (
                text.replacen("26.2 mm/s/s", "26.2 cm/s/s", 1),
                "test:14:".into(),
            ),
            (text.replacen(" -4.6 ", " -4.6", 1), "test:28:".into()),
            (text.replacen(" -9865.4", "-9865.4", 1), "test:27:".into()),
            (text.replacen("    -4.6    -4.3\n", "", 1), "test:28:".into()),
            (text.trim_end()[..text.len() - 2].to_owned(), "test:".into()),
        ];
        for (changed, expected) in cases {
            let found = refusal(&changed);
            assert!(found.starts_with(&expected), "{found} / {expected}");
            assert!(!found.contains("channels"), "{found}");
        }
    }
    let units = geonet(false).replace("of 1.00", "of 2.00");
    assert!(refusal(&units).contains("readings in 1.00 mm/s/s"));
}

/// Two horizontal channels of one place and a vertical one, as BRI writes
/// them; the numbers are invented.
fn bri() -> String {
    let channel = |label: &str, peak: f64| {
        let line = format!(
            "{label:<10}{peak:>10.3}{:>10}{:>10.3}  3.00e-2\n",
            3, 0.013
        );
        let sample = |i: i32| {
            let value = if i == 2 { peak } else { 0.077 - f64::from(i) };
            let end = if i % 8 == 7 { "\n" } else { "" };
            format!("{value:>10.3}{end}")
        };
        let samples: String = (0..10).map(sample).collect();
        format!("{line}{samples}\n")
    };
    format!(
        "1900/01/15 20:06:08   3 100    10 ABC: Nowhere\n{}{}{}",
        channel("063-GL", -71.403),
        channel("153-GL", 63.24),
        channel("UP-GL", 36.391)
    )
}

#[test]
fn bri_channels_are_read_and_checked_against_their_peaks() {
    let text = bri().replace('\n', "\r\n");
    let records = read_all("a.ac", text.as_bytes(), &options(None)).unwrap();
    let names: Vec<_> =
        records.iter().map(|r| r.accelerogram.name()).collect();
    assert_eq!(names, ["a:063-GL", "a:153-GL", "a:UP-GL"]);
    let directions: Vec<_> = records.iter().map(|r| r.direction).collect();
    use Direction::{Horizontal, Vertical};
    assert_eq!(directions, [Horizontal, Horizontal, Vertical]);
    for record in &records {
        assert_eq!(record.format.name, "bri");
        assert_eq!(record.unit, AccelerationUnit::CentimetrePerSecondSquared);
        assert_eq!(record.accelerogram.dt_s(), 0.01);
        assert_eq!(record.accelerogram.samples_g().len(), 10);
        let site = Some("1900/01/15 20:06:08 ABC GL");
        assert_eq!(record.site.as_deref(), site);
    }
    assert_eq!(records[0].accelerogram.pga_g(), 71.403 / 980.665);
    let text = bri();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let without = |k: usize| [&lines[..k], &lines[k + 1..]].concat().concat();
    refused_with(&[
        (
            text.replace("-71.403      ", "-70.403      "),
            "test:2: largest abs",
        ),
        (
            text.replace("    10 ABC", "    11 ABC"),
            "test:4: 10 samples: expected",
        ),
        (
            text.replace("  3 100", "  4 100"),
            "test:10: the file ends: expected",
        ),
        (text.replace("  3 100", "  2 100"), "test:8: \"UP-GL"),
        (without(3), "test:4:"),
        (without(4), "test:5: \"0.077    -0.923"),
        (lines[..9].concat(), "test:9: 8 samples: expected 10"),
    ]);
}
