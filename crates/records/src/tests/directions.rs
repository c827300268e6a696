//! Directions by header and name together, as readers give them.

use super::*;
use Direction::{Horizontal, Unknown, Vertical};

/// Direction, whether in a borehole, and codes of remarks.
fn sensor(file: &str, text: &str) -> (Direction, bool, Vec<&'static str>) {
    let given = in_g(Some(0.01));
    let given = match file.ends_with(".txt") {
        true => given,
        false => options(None),
    };
    let record = read(file, text.as_bytes(), &given).expect(file);
    let codes = record.remarks.iter().map(Remark::code).collect();
    (record.direction, record.borehole, codes)
}

/// KiK-net numbers its six channels; none of the numbers is an azimuth.
#[test]
fn numbers_of_kiknet_are_codes_of_direction_and_depth() {
    let cases = [
        ("1", "A.NS1", Horizontal, true, "N-S borehole"),
        ("2", "A.EW1", Horizontal, true, "E-W borehole"),
        ("3", "A.UD1", Vertical, true, "U-D borehole"),
        ("4", "A.NS2", Horizontal, false, "N-S surface"),
        ("5", "A.EW2", Horizontal, false, "E-W surface"),
        ("6", "A.UD2", Vertical, false, "U-D surface"),
        // The header comes before the name.
        ("6", "A.EW2", Vertical, false, "U-D surface"),
        ("E-W", "A.EW", Horizontal, false, "E-W"),
        ("U-D", "A.UD", Vertical, false, "U-D"),
        // A number without a meaning: the name is heard.
        ("7", "A.UD2", Vertical, false, "7"),
        ("90", "A.EW", Horizontal, false, "90"),
        ("90", "A", Unknown, false, "90"),
    ];
    for (dir, file, direction, borehole, label) in cases {
        let text = networks::KNET.replace("E-W", dir);
        let codes: Vec<&str> = [
            (direction == Vertical).then_some("vertical"),
            borehole.then_some("borehole"),
        ]
        .into_iter()
        .flatten()
        .collect();
        assert_eq!(sensor(file, &text), (direction, borehole, codes), "{dir}");
        let record = read(file, text.as_bytes(), &options(None)).unwrap();
        assert_eq!(record.channel.as_deref(), Some(label));
    }
}

/// A COSMOS file of one channel: its name, and the integer of its orientation.
fn cosmos_channel(name: &str, orientation: i32) -> String {
    let value = |place| if place == 54 { orientation } else { -999 };
    let integers: String = (1..=60)
        .map(|place| {
            let end = if place % 10 == 0 { "\n" } else { "" };
            format!("{:8}{end}", value(place))
        })
        .collect();
    let text = cosmos::cosmos();
    let end = text.find("      3 velocity").unwrap();
    let old = " 10 Integer-header values follow on  1 lines, Format= (10I8)\n\
        \x20      0       1      50     120       1    -999    -999       7    -999    -999\n";
    let new = " 60 Integer-header values follow on  6 lines, Format= (10I8)\n";
    let text = text[..end].replace("   1: 90 deg", name);
    assert!(text.contains(old));
    text.replace(old, &format!("{new}{integers}"))
}

#[test]
fn the_number_of_a_cosmos_channel_is_no_azimuth() {
    let cases = [
        ("   1: 90 deg", -999, "A.V2", Horizontal),
        ("   ?: 90 Deg", -999, "A_UP.V2", Horizontal),
        ("   2:Up", -999, "A.V2", Vertical),
        // The integer header, where the words do not tell.
        ("   1:Other", 400, "A.V2", Vertical),
        ("   1:Other", 90, "A_UP.V2", Horizontal),
        ("   1:Other", 601, "A.V2", Horizontal),
        // The name, where neither tells: 0 and 900 are no orientations.
        ("   ?:Other", 0, "us_AK--n.1000.BNZ.--.acc.V2c", Vertical),
        ("   1:Other", 900, "us_AK--n.1000.BNE.--.acc.V2c", Horizontal),
        ("   3:Other", -999, "A.V2", Unknown),
    ];
    for (name, orientation, file, expected) in cases {
        let text = cosmos_channel(name, orientation);
        assert_eq!(sensor(file, &text).0, expected, "{name} {file}");
    }
    // The name of a file of several channels tells of none of them.
    let all = cosmos::cosmos().replace("90 deg", "Other");
    let all = read_all("A_UP.V2", all.as_bytes(), &options(None)).unwrap();
    let found: Vec<_> = all.iter().map(|record| record.direction).collect();
    assert_eq!(found, [Unknown, Vertical, Horizontal]);
}

#[test]
fn a_number_is_an_azimuth_where_the_format_says_so() {
    let line = at2("NPTS= 7, DT= .01 SEC");
    let silent = line.replace("Nowhere, 1/1/1900, Station, 90", "Nowhere");
    let column = "0.1\n-0.2\n0.3\n";
    let cases = [
        ("A_UP.AT2", &*line, Horizontal),
        ("A.AT2", &*line.replace(", 90\n", ", UP\n"), Vertical),
        ("A_HEC090.AT2", &*silent, Horizontal),
        ("A_HEC-UP.AT2", &*silent, Vertical),
        ("A.AT2", &*silent, Unknown),
        ("hall-90.txt", column, Unknown),
        ("record012.txt", column, Unknown),
        ("hall-NS.txt", column, Horizontal),
        ("hall_Z.txt", column, Vertical),
        ("hall.asc", networks::ESM, Horizontal),
        ("hall_U.asc", &*networks::ESM.replace("HNE", "90"), Vertical),
        ("hall.asc", &*networks::ESM.replace("HNE", "HNZ"), Vertical),
        ("hall.acc", &*resorce("UP"), Vertical),
        ("hall_V.acc", &*resorce("WE"), Horizontal),
        ("hall_V.acc", &*resorce("17"), Vertical),
    ];
    for (file, text, expected) in cases {
        assert_eq!(sensor(file, text).0, expected, "{file}");
    }
}

/// A RESORCE file with an orientation.
fn resorce(orientation: &str) -> String {
    let line = format!("Orientation : {orientation}\nTime Increment");
    let text = RESORCE.replace("  1.7", " 1.7");
    text.replace("Time Increment", &line)
}
