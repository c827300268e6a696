//! Words of headers, and names of files.

use super::Direction;
use Direction::{Horizontal, Unknown, Vertical};

#[test]
fn words_name_directions() {
    let words = [
        ("N-S", Horizontal),
        ("U-D", Vertical),
        ("HNZ", Vertical),
        ("BN1", Horizontal),
        ("N08W", Horizontal),
        ("Up", Vertical),
        ("H1", Horizontal),
        ("Vertical axis", Vertical),
        ("Other", Unknown),
        ("", Unknown),
        // Azimuths, where the format has such.
        ("90", Unknown),
        ("360 Deg", Unknown),
    ];
    for (word, expected) in words {
        assert_eq!(Direction::of_label(word, false), expected, "{word}");
    }
    for (word, expected) in [
        ("90", Horizontal),
        ("360 Deg", Horizontal),
        ("90deg", Horizontal),
        ("361", Unknown),
        ("Up", Vertical),
    ] {
        assert_eq!(Direction::of_label(word, true), expected, "{word}");
    }
}

#[test]
fn the_end_of_a_name_tells_a_direction() {
    let names = [
        ("A_UP", Vertical),
        ("A-DWN", Vertical),
        ("A.UD2", Vertical),
        ("A.NS1", Horizontal),
        ("A_RawAcc_U", Vertical),
        ("A_RawAcc_E", Horizontal),
        ("65006UD", Vertical),
        ("65006EW", Horizontal),
        ("IV.AQU..HNZ.D.1", Vertical),
        ("AK_BMR--n.1000.BNZ.--.acc", Vertical),
        ("AK_BMR--n.1000.BNE.--.acc", Horizontal),
        ("A_HNZ", Vertical),
        // A whole name is the station's.
        ("UP", Unknown),
        ("HALL", Unknown),
        ("NEW", Unknown),
        // Numbers are running ones.
        ("record_1", Unknown),
        ("record012", Unknown),
    ];
    for (name, expected) in names {
        assert_eq!(Direction::of_name(name, false), expected, "{name}");
    }
    for (name, expected) in [
        ("RSN1_HEC090", Horizontal),
        ("RSN1_HEC-90", Horizontal),
        ("RSN1_HEC-UP", Vertical),
        ("RSN1_HEC999", Unknown),
    ] {
        assert_eq!(Direction::of_name(name, true), expected, "{name}");
    }
}
