//! COSMOS and CSMIP, written from their public descriptions with invented
//! numbers.

use super::*;

/// Blocks of a COSMOS file with two horizontal channels and a vertical one;
/// the first is followed by its velocity.
pub(super) fn cosmos() -> String {
    // The recorder's interval is 0.02 (s), that of the series 5 ms.
    let value = |place| match place {
        34 => 0.02,
        62 => 5.0,
        63 => 0.05,
        64 => -98066.5,
        _ => -999.0,
    };
    let reals: Vec<String> = (1..=70)
        .map(value)
        .map(|value: f64| format!("{value:15.6}"))
        .collect();
    let reals: Vec<String> = reals.chunks(5).map(|row| row.concat()).collect();
    let reals = reals.join("\n");
    let channel = |number: usize, name: &str| {
        format!(
            "Corrected acceleration   (Format v01.20 with 13 text lines)\n\
             Sta Chan   {number}: {name} (Rcrdr Chan  {number}) Location:Free\n\
             \x2010 Integer-header values follow on  1 lines, Format= (10I8)\n\
             \x20      0       1      50     120       1    -999    -999       7    -999    -999\n\
             \x2070 Real-header values follow on 14 lines, Format= (5F15.6)\n\
             {reals}\n\
             \x20  1 Comment line(s) follow, each starting with a \"|\":\n\
             | invented\n\
             \x20     10 acceleration pts, approx  0 secs, units=cm/sec2 (4),Format=(8F10.3)\n\
             \x20    0.000     1.000    -2.000     3.000    -4.000     5.000-98066.500     7.000\n\
             \x20    8.000    -9.000\n\
             End-of-data for Chan  {number} acceleration\n"
        )
    };
    let velocity = "      3 velocity     pts, approx  0 secs, units=cm/sec (5),Format=(8F10.3)\n\
        \x20    0.000     1.000    -2.000\n\
        End-of-data for Chan  1 velocity\n";
    let first = channel(1, "90 deg");
    let third = channel(3, "360 deg");
    format!("{first}{velocity}{}{third}", channel(2, "Up"))
}

#[test]
fn cosmos_channels_are_read_by_their_announced_format() {
    let text = cosmos();
    let all = read_all("d/CE1.V2", text.as_bytes(), &options(None)).unwrap();
    assert_eq!(all.len(), 3);
    for record in &all {
        let motion = &record.accelerogram;
        assert_eq!(record.format.name, "cosmos");
        assert_eq!(motion.dt_s(), 0.005);
        assert_eq!(motion.samples_g().len(), 10);
        assert_eq!(motion.pga_g(), 100.0);
    }
    let names: Vec<_> = all.iter().map(|r| r.accelerogram.name()).collect();
    assert_eq!(names, ["CE1:1_90_deg", "CE1:2_Up", "CE1:3_360_deg"]);
    assert_eq!(refusal(&text), "test: 3 acceleration channels: expected one");
    let row = text.lines().position(|l| l.contains("5.000-98066")).unwrap();
    let cases = [
        (
            text.replacen("     8.000    -9.000\n", "", 1),
            format!("test:{}:1: \"End-of-dat", row + 2),
        ),
        (
            text.replacen("     8.000    -9.000\n", "     8.000\n", 1),
            format!("test:{}: 9 samples: expected 10", row + 2),
        ),
        (
            text.replacen("    -9.000\n", "    -9.000\n     1.000\n", 1),
            format!("test:{}: \"1.000\": expected the end", row + 3),
        ),
        (
            text.replacen("     3.000", "    3.000", 1),
            format!("test:{}:35: \"3.000\": expected a number of 10", row + 1),
        ),
        (
            text.replacen("     3.000", "      3.00", 1),
            format!("test:{}:37: \"3.00\": expected 3 decimals", row + 1),
        ),
        (
            text.replacen("units=cm/sec2 (4)", "units=counts (50)", 1),
            format!("test:{row}: unit \"counts\": expected g"),
        ),
        (
            text.replacen("       5.000000", "       0.000000", 1),
            format!("test:{row}: \"real header value 62: 0\""),
        ),
        (
            text.replacen("       5.000000", "       0.005000", 1),
            format!("test:{row}: samples for 0.00005 s: expected 0.05 s"),
        ),
        (
            text.replacen("approx  0 secs", "approx  9 secs", 1),
            format!("test:{row}: samples for 0.05 s: expected 9 s"),
        ),
        (
            text.replacen("  -98066.500000", "  -97066.500000", 1),
            "test:78: largest absolute sample 98066.5".to_owned(),
        ),
        (
            text.replacen("       5.000000", "    -999.000000", 1),
            "test: no sampling interval in the file".to_owned(),
        ),
        (
            text.replacen("10 acceleration", "99999999999 acceleration", 1),
            "test:".to_owned(),
        ),
        (
            text.replacen("(8F10.3)", "(8Q10.3)", 1),
            format!("test:{row}: \"10 acceleration pts"),
        ),
    ];
    for (text, expected) in cases {
        let found = refusal(&text);
        assert!(found.starts_with(&expected), "{found} / {expected}");
        assert!(!found.contains("channels"), "{found}");
    }
    let velocity = "  3 velocity pts, approx 0 secs, units=cm/sec (5),Format=(8F10.3)\n     0.000     1.000    -2.000\n";
    assert!(refusal(velocity).contains("an acceleration history"));
}

pub(super) const CSMIP: &str = "Corrected accelerogram     Nowhere\n\
    Chan  1: 90 Deg\n\
    \x20  10 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.3)\n\
    \x20    .000     1.000    -2.000     3.000    -4.000     5.000  -980.665     7.000\n\
    \x20   8.000    -9.000\n\
    \x20   3 points of veloc data equally spaced at  .020 sec, in cm/sec.   (8f10.3)\n\
    \x20    .000     1.000    -2.000\n\
    /&  ----------  End of data for channel  1  ----------\n";

#[test]
fn csmip_v2_is_read() {
    let text = CSMIP
        .replace("\n     .000", "\n      .000")
        .replace("\n    8.000", "\n     8.000");
    let record = read_text(&text).unwrap();
    assert_eq!(record.format.name, "cosmos");
    assert_eq!(record.accelerogram.dt_s(), 0.02);
    assert_eq!(record.accelerogram.pga_g(), 1.0);
    assert_eq!(record.channel.as_deref(), Some("1 90 Deg"));
    // Two fields shorter by a blank: the lines are out of step.
    assert!(refusal(CSMIP).starts_with("test:4:"), "{}", refusal(CSMIP));
    let bad = text.replacen(".020 sec", "-.020 sec", 1);
    assert!(refusal(&bad).starts_with("test:3: sampling interval"));
}

/// Volume 2 of 1983: no format in the announcing line, two intervals and a
/// peak in the header.
const OLD: &str = "CORRECTED ACCELEROGRAM   1-S1       CHAN  1:  90 DEG     FROM\n\
    AT EQUALLY-SPACED INTERVALS OF    .020  SEC.\n\
    NO. OF POINTS =  12080  RECORD LENGTH = 59.998 SEC\n\
    PEAK ACCELERATION =  -267.957    CM/SEC/SEC  AT   10.940   SEC.\n\
    \x20  10 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)\n\
    \x20   -3.038     -.787     2.288 -1004.106     4.898     3.777      .630  -267.957\n\
    \x20   -2.112    -5.659\n\
    \x20   3 POINTS OF VELOC DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC)\n\
    \x20     .000     1.000    -2.000\n\
    /&  ----------  END OF DATA FOR CHANNEL  1  ----------\n";

/// A volume whose samples agree with its header.
pub(super) fn old() -> String {
    OLD.replace("-1004.106", "    4.106")
}

#[test]
fn volumes_of_1971_to_2000_show_their_field_width() {
    let text = old();
    let record = read_text(&text).unwrap();
    assert_eq!(record.accelerogram.dt_s(), 0.02);
    assert_eq!(record.accelerogram.samples_g().len(), 10);
    assert_eq!(record.accelerogram.pga_g(), 267.957 / 980.665);
    assert_eq!(record.channel.as_deref(), Some("1 90 DEG"));
    // Without a unit in the announcing line, the peak's unit counts.
    let bare = text.replacen(".020 SEC.  (UNITS: CM/SEC/SEC)", ".020 SEC.", 1);
    let bare = bare.replacen("CM/SEC/SEC", "CMS/SEC/SEC", 1);
    assert_eq!(read_text(&bare).unwrap(), record);
    let units = text.replacen("(UNITS: CM/SEC/SEC)", "IN UNITS CM/SEC/SEC", 1);
    assert_eq!(read_text(&units).unwrap(), record);
    let cases = [
        (OLD, "test:10: largest absolute sample 1004.106 cm/s2: expected 267"),
        (
            &*text.replacen("OF    .020", "OF    .010", 1),
            "test:2: \"AT EQUALLY-SPACED INTERVALS OF    .01...\": expected",
        ),
        (
            &*text.replacen("  -267.957\n", "   -267.957\n", 1),
            "test:5: \"10 POINTS OF ACCEL DATA EQUALLY SPACE...\": expected",
        ),
    ];
    refused_with(&cases);
}

const RAW: &str = "Uncorrected Accelerogram Data\n\
    Chan  1:  90 Deg\n\
    No. of Points =  10  Record Length =  .100 sec   at 100 Samples/sec\n\
    \x20   3  100    1\n\
    \x20   10 Accelerogram points at 100 pts/sec in units of g.  Format: (8f9.6)\n\
    \x20 .000027  .000021 -.250000  .000024  .000027  .000027  .000019-1.000023\n\
    \x20 .000026  .000028\n\
    /&  ----------  End of Data for Station Channel   1  ----------\n";

#[test]
fn csmip_raw_is_read() {
    let record = read_text(RAW).unwrap();
    assert_eq!(record.format.name, "cosmos");
    assert_eq!(record.unit, AccelerationUnit::Gravity);
    assert_eq!(record.accelerogram.dt_s(), 0.01);
    assert_eq!(record.accelerogram.samples_g().len(), 10);
    assert_eq!(record.accelerogram.pga_g(), 1.000023);
    assert_eq!(record.channel.as_deref(), Some("1 90 Deg"));
    let two = format!("{RAW}{}", RAW.replace("Chan  1", "Chan  2"));
    let all = read_all("x", two.as_bytes(), &options(None)).unwrap();
    assert_eq!(all.len(), 2);
    let lines: Vec<&str> = two.lines().collect();
    let without = |at: usize| {
        let rest = [&lines[..at], &lines[at + 1..]].concat();
        refusal(&format!("{}\n", rest.join("\n")))
    };
    let cases = [
        (RAW.replace(" 10 Acc", " 11 Acc"), "test:7: 10 samples: exp"),
        (RAW.replace("=  10", "=  11"), "test:3: \"No. of Points =  11  Re"),
        (RAW.replace("at 100 pts", "at 0 pts"), "test:5: \"Accelerogram po"),
        (RAW.replace("of g.", "of counts."), "test:5: unit \"counts\""),
        (RAW.replace("-.25", " -.2"), "test:6:"),
    ];
    refused_with(&cases);
    // The second channel's announcement, and a header without its samples.
    assert!(without(12).starts_with("test:15: \"/&  ----"), "{}", without(12));
    let cut = format!("{}\n", lines[..11].join("\n"));
    assert!(refusal(&cut).contains("samples after a header"));
}
