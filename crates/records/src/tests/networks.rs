//! The networks' formats, written from their public descriptions with
//! invented numbers.

use super::*;

pub(crate) const KNET: &str = "Origin Time       1900/01/01 00:00:00\n\
    Lat.              38.103\n\
    Long.             142.860\n\
    Depth. (km)       24\n\
    Mag.              9.9\n\
    Station Code      XXX004\n\
    Station Lat.      38.7292\n\
    Station Long.     141.0217\n\
    Station Height(m) 40\n\
    Record Time       1900/01/01 00:00:15\n\
    Sampling Freq(Hz) 10Hz\n\
    Duration Time(s)  2\n\
    Dir.              E-W\n\
    Scale Factor      3920(gal)/4000\n\
    Max. Acc. (gal)   944.671\n\
    Last Correction   1900/01/01 00:00:15\n\
    Memo.\n\
    \x20     100      -10       20      -30       40      -50       60    -1000\n\
    \x20      11      -12       13      -14       15      -16       17      -18\n\
    \x20      80      -90       81       82\n";

#[test]
fn a_knet_header_gives_the_interval_and_the_scale_of_its_counts() {
    let gravity = 9.8;
    let options = ReadOptions { gravity_m_s2: gravity, ..options(None) };
    let record = read("a/X.EW", KNET.as_bytes(), &options).unwrap();
    let motion = &record.accelerogram;
    assert_eq!(record.format.name, "knet");
    assert_eq!(motion.name(), "X.EW");
    assert_eq!(motion.dt_s(), 0.1, "interval of 10 Hz, s");
    let pga_g = 980.0 / (100.0 * gravity);
    assert_eq!(motion.pga_g(), pga_g, "PGA of 1000 counts, g");
    assert_eq!(record.channel.as_deref(), Some("E-W"));
    let cases = [
        (KNET.replace("       82", ""), "test:20: 19 samples: expected 20"),
        (KNET.replace(" -1000", " -100"), "test:18:68: \"-100\": expected a"),
        (
            KNET.replace("      80", "      8O"),
            "test:20:8: \"8O\": expected a",
        ),
        (KNET.replace("10Hz", "0Hz"), "test:11: \"Sampling Freq"),
        (KNET.replace("/4000", "/0"), "test:14: \"Scale Factor"),
        (KNET.replace("(s)  2", "(s)  2.05"), "test:17: \"10 Hz for 2.05 s\""),
        (KNET[..KNET.len() - 170].to_owned(), "test:1"),
        // The mean of the counts is -36.05, by hand: 963.95 of them, 0.98 gal
        // each.
        (
            KNET.replace("944.671", "980.0"),
            "test:20: largest absolute sample 944.67",
        ),
    ];
    refused_with(&cases);
}

#[test]
fn knet_fields_may_begin_a_blank_earlier() {
    // As the network writes them: I8, then seven I9.
    let first = KNET.rfind("Memo.\n").unwrap() + "Memo.\n".len();
    let (header, counts) = KNET.split_at(first);
    let counts: String =
        counts.lines().map(|line| format!("{}\n", &line[1..])).collect();
    let text = format!("{header}{counts}");
    let even = read_text(KNET).unwrap().accelerogram;
    assert_eq!(read_text(&text).unwrap().accelerogram, even);
    let narrow = text.replace("       40 ", "       4 ");
    assert!(
        refusal(&narrow)
            .starts_with("test:18:43: \"4\": expected a number of 9"),
        "{}",
        refusal(&narrow)
    );
}

pub(super) const ESM: &str = "EVENT_NAME: NOWHERE\n\
    EVENT_DATE_YYYYMMDD: 19000101\n\
    STATION_CODE: XXX\n\
    SAMPLING_INTERVAL_S: 0.005000\n\
    NDATA: 4\n\
    DURATION_S: 0.015\n\
    STREAM: HNE\n\
    UNITS: cm/s^2\n\
    PGA_CM/S^2: -98.066500\n\
    TIME_PGA_S: 0.010000\n\
    DATA_TYPE: ACCELERATION\n\
    USER5: \n\
    0.012300\n\
    -1.500000\n\
    -98.066500\n\
    3.000000\n";

#[test]
fn esm_is_read_and_checked_against_its_peak() {
    let record = read_text(ESM).unwrap();
    assert_eq!(record.format.name, "esm");
    assert_eq!(record.accelerogram.dt_s(), 0.005);
    assert_eq!(record.accelerogram.pga_g(), 0.1);
    assert_eq!(record.channel.as_deref(), Some("HNE"));
    let cases = [
        (ESM.replace("3.000000\n", ""), "test:15: 3 samples: expected 4"),
        (ESM.replace("-98.066500\n3", "-98.06650\n3\n"), "test:17: 5 samples"),
        (
            ESM.replace("-98.066500\n3", "-8.066500\n3"),
            "test:16: largest absolute sample 8.0665 cm/s2: expected 98.0665",
        ),
        (ESM.replace("-1.5", "-1.5x"), "test:14: \"-1.5x00000\": expected"),
        (ESM.replace("ACCELERATION", "VELOCITY"), "test:11: \"DATA_TYPE"),
        (ESM.replace("cm/s^2", "cm"), "test:8: unit \"cm\": expected"),
        (ESM.replace(": 0.005000", ": -1"), "test:4: \"SAMPLING_INT"),
        (ESM.replace("NDATA: 4", "NDATA: -4"), "test:5: \"NDATA: -4\""),
    ];
    refused_with(&cases);
}

pub(crate) fn smc() -> String {
    let mut text = "2 CORRECTED ACCELEROGRAM\n".to_owned();
    text.push_str(&"*\n".repeat(10));
    for place in 1..=48 {
        let value = match place {
            16 => 2,
            17 => 10,
            _ => -32768,
        };
        text.push_str(&format!("{value:10}"));
        text.push_str(if place % 8 == 0 { "\n" } else { "" });
    }
    for place in 1..=50 {
        let value = match place {
            2 => "2.0000000E+02",
            30 => "4.0000000E+00",
            32 => "-9.8067000E+01",
            _ => "1.7000000E+38",
        };
        text.push_str(&format!("{value:>15}"));
        text.push_str(if place % 5 == 0 { "\n" } else { "" });
    }
    text.push_str("| invented\n| numbers\n");
    text.push_str(
        "-1.2345E-1 1.0000E+0-9.8067E+1 2.0000E+0-3.0000E+0 4.0000E+0-5.0000E+0 6.0000E+0\n",
    );
    text.push_str("-7.0000E+0 8.0000E+0\n");
    text
}

#[test]
fn smc_is_read() {
    let text = smc();
    let record = read_text(&text).unwrap();
    assert_eq!(record.format.name, "smc");
    assert_eq!(record.accelerogram.dt_s(), 0.005);
    assert_eq!(record.accelerogram.samples_g().len(), 10);
    assert_eq!(record.accelerogram.pga_g(), 98.067 / 980.665);
    let cases = [
        (
            text.replace("-7.0000E+0 8.0000E+0\n", ""),
            "test:30: 8 samples: exp",
        ),
        (
            text.replace("-9.8067E+1", "-9.8067E1"),
            "test:30:21: \"-9.8067E1\": e",
        ),
        (text.replace("| numbers\n", ""), "test:30: 2 samples: expected 10"),
        (
            text.replace("-9.8067000E+01", "-9.7067000E+01"),
            "test:31: largest absolute sample 98.067 cm/s2: expected 97.067",
        ),
        (
            text.replace("2 CORRECTED ACCELEROGRAM", "3 VELOCITY"),
            "test:1: \"3 V",
        ),
        (
            text.replace("2.0000000E+02", "1.7000000E+38"),
            "test:18:16: \"1.7e38",
        ),
        (text.lines().take(20).collect::<Vec<_>>().join("\n"), "test:20: the"),
        (text.lines().take(27).collect::<Vec<_>>().join("\n"), "test:27: the"),
        (text.replace("        10", "    -32768"), "test:14: \"integer 17 is"),
    ];
    refused_with(&cases);
}
