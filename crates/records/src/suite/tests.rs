//! Indexes, folders, pairs: what is read, and what must be refused.

use super::pairing::pair_key;
use super::*;

/// Keeps all of a record.
const KEEP: fn(SuiteMember) -> Result<SuiteMember, SuiteError> = Ok;

const MOTION: &str = "0\n0.2\n-0.1\n";

/// What `sha256sum` prints of it, in capitals.
const SUM_OF_MOTION: &str =
    "B85E44807B2A9E5E8C17B4FB410A2BAF86A443F7D79EA6305EEADF1682D31120";

fn suite(index: &str) -> Result<Suite, SuiteError> {
    let unit = Some(AccelerationUnit::Gravity);
    let read = ReadOptions { unit, ..ReadOptions::default() };
    Suite::from_index("i.csv", index.as_bytes(), &read, |_| {
        Ok(MOTION.as_bytes().to_vec())
    })
}

fn refusal(index: &str) -> String {
    suite(index).expect_err("a refusal").to_string()
}

#[test]
fn a_row_is_checked_against_its_record() {
    // By hand: v(i) in g s is 0, 0.001, 0.0015; PGV is that times gravity.
    let row = |cells: &str| {
        format!(
            "file,units,dt_s,npts,pga_g,pgv_m_s,format,sha256\na,g,{cells}\n"
        )
    };
    let all = ["0.01,3,0.2,0.014709975,column,", SUM_OF_MOTION].concat();
    assert!(suite(&row(&all)).is_ok());
    assert!(suite(&row("0.01,,,,,")).is_ok());
    let cases = [
        ("0.01,4,,,,", "i.csv:2: a has npts 3: expected 4, as in"),
        ("0.01,x,,,,", "i.csv:2: \"x\": expected a number of samples"),
        ("0.01,,0.2001,,,", "i.csv:2: a has pga_g 0.200000: expected 0.2001"),
        ("0.01,,,0.0148,,", "i.csv:2: a has pgv_m_s 0.014710: expected 0.01"),
        ("0.01,,nan,,,", "i.csv:2: \"nan\": expected a positive pga_g"),
        ("-0.01,,,,,", "i.csv:2: \"-0.01\": expected a positive dt_s"),
        (",,,,,", "a: no sampling interval in the file"),
        ("0.01,,,,at2,", "i.csv:2: a has format column: expected at2"),
        ("0.01,,,,,000c", "i.csv:2: a has sha256 b85e4480"),
        ("0.01,,,,", "i.csv:2: \"7 cells\": expected 8 cells, as the head"),
    ];
    for (cells, expected) in cases {
        let found = refusal(&row(cells));
        assert!(found.starts_with(expected), "{found}");
    }
    let unit = row("0.01,,,,,").replace("a,g", "a,ft/s2");
    assert_eq!(
        refusal(&unit),
        "i.csv:2: \"ft/s2\": expected g, m/s2 or cm/s2"
    );
}

/// An index that was made on Windows is read on every system.
#[test]
fn folders_in_an_index_end_with_any_slash() {
    let index = "file,dt_s,units\nnear\\a.csv,0.01,g\n";
    let unit = Some(AccelerationUnit::Gravity);
    let read = ReadOptions { unit, ..ReadOptions::default() };
    let found =
        Suite::from_index("C:\\x\\i.csv", index.as_bytes(), &read, |file| {
            assert_eq!(file, "near/a.csv");
            Ok(MOTION.as_bytes().to_vec())
        });
    let survey = found.unwrap();
    assert_eq!(survey.name, "i");
    assert_eq!(survey.members[0].file, "near/a.csv");
}

#[test]
fn an_index_that_is_none_is_refused() {
    let cases = [
        ("name,dt_s\na,0.01\n", "i.csv:1: \"name,dt_s\": expected a folder"),
        ("file,x,x\n", "i.csv:1: \"x\": expected each column once"),
        ("file,dt_s\n", "i.csv: no readable record in it"),
        ("file,dt_s\n,0.01\n", "i.csv:2: \"\": expected the name of a file"),
        (
            "file,dt_s,event\na,0.01,X\nb,0.01,\n",
            "i.csv:3: \"\": expected the earthquake of each record",
        ),
        ("file,dt_s\n\"a,0.01\n", "i.csv:2: \"\\\"a,0.01\": expected cells"),
        ("file,dt_s\na\"b,0.01\n", "i.csv:2: \"a\\\"b,0.01\": expected cells"),
        (
            "file,dt_s\na,0.01\nb/a,0.01\n",
            "i.csv: two records are named \"a\"",
        ),
    ];
    for (index, expected) in cases {
        let found = refusal(index);
        assert!(found.starts_with(expected), "{found}");
    }
}

#[test]
fn study_components_come_from_the_index() {
    let index = "file,dt_s,pair,study_component,event,mw\r\n\
        a-1.txt,0.01,p,0,\"Nowhere, \"\"old\"\"\",7.1\r\n\
        a-2.txt,0.01,p,1,X,7.1\r\n\
        b.txt,0.01,,1,Y,6\r\n\r\n";
    let found = suite(index).unwrap();
    assert_eq!(found.name(), "i");
    assert_eq!(found.study_rule(), StudyRule::Index);
    let study: Vec<_> = found.study_components().map(|m| &m.file).collect();
    assert_eq!(study, ["a-2.txt", "b.txt"]);
    let other: Vec<_> = found.other_components().map(|m| &m.file).collect();
    assert_eq!(other, ["a-1.txt"]);
    let [(first, second)] = found.both()[..] else { panic!() };
    assert_eq!((&*first.file, &*second.file), ("a-2.txt", "a-1.txt"));
    assert_eq!(second.event.as_deref(), Some("Nowhere, \"old\""));
    assert_eq!(second.attributes_by_name()["mw"], "7.1");
    assert_eq!(second.attributes.len(), 1);
    for (flags, study) in [("0,0", 0), ("1,1", 2)] {
        let (one, two) = flags.split_once(',').unwrap();
        let index = format!(
            "file,dt_s,pair,study_component\na,0.01,p,{one}\nb,0.01,p,{two}\n"
        );
        let expected =
            format!("pair \"p\" has 2 components, {study} for the study");
        assert!(refusal(&index).contains(&expected));
    }
    let index = "file,dt_s,pair,study_component\n\
        a,0.01,p,1\nb,0.01,p,0\nc,0.01,p,0\n";
    let expected = "pair \"p\" has 3 components, 1 for the study";
    assert!(refusal(index).contains(expected));
    let index = "file,dt_s,study_component\na,0.01,yes\n";
    assert_eq!(refusal(index), "i.csv:2: \"yes\": expected 1 or 0");
}

#[test]
fn without_a_mark_the_first_name_of_a_pair_is_the_study_component() {
    let index = "file,dt_s,pair\nz-090,0.01,q\nz-000,0.01,q\nlone,0.01,\n";
    let found = suite(index).unwrap();
    assert_eq!(found.study_rule(), StudyRule::FirstName);
    let study: Vec<_> = found.study_components().map(|m| &*m.file).collect();
    assert_eq!(study, ["z-000", "lone"]);
    // Without a column `pair`, by name; three of one name are no pair.
    let index =
        "file,dt_s\na_E,0.01\na_N,0.01\nb-1,0.01\nb-2,0.01\nb-3,0.01\n";
    let found = suite(index).unwrap();
    assert_eq!(found.both().len(), 1);
    assert_eq!(found.members()[0].pair.as_deref(), Some("a"));
    assert_eq!(found.study_components().count(), 4);
}

#[test]
fn pairs_share_a_name_but_for_the_orientation() {
    let cases = [
        ("R_HEC000", Some("R_HEC")),
        ("R_NIS090", Some("R_NIS")),
        ("R_E", Some("R")),
        ("R-N", Some("R")),
        ("R_ABBAR--L", Some("R_ABBAR")),
        ("R_16858_H1", Some("R_16858")),
        ("R_65006EW", Some("R_65006")),
        ("R_TAB-LN", Some("R_TAB")),
        ("R_0", Some("R")),
        ("R_H-CPE147", Some("R_H-CPE")),
        ("IV.AQU..HNE.D.1900.ACC", Some("IV.AQU..HN.D.1900.ACC")),
        ("IV.AQU..HNN.D.1900.ACC", Some("IV.AQU..HN.D.1900.ACC")),
        ("MYG0041103111446.EW", Some("MYG0041103111446")),
        ("MYGH041103111446.NS2", Some("MYGH041103111446.2")),
        ("CE1:3_360_deg", Some("CE1")),
        ("R_UP", None),
        ("R_999", None),
        ("STATION", None),
        ("NEW", None),
        ("E", None),
        ("\u{e9}\u{e9}", None),
    ];
    for (stem, key) in cases {
        assert_eq!(pair_key(stem).as_deref(), key, "{stem}");
    }
}

#[test]
fn an_index_may_have_semicolons_capitals_and_names() {
    let index = "FILE;Name;DT_S;Event\nx/a-1.txt;one;0.01;X, Y\n\
        y/a-1.txt;two;0.01;Z\n";
    let found = suite(index).unwrap();
    let names: Vec<_> =
        found.members().iter().map(|m| m.accelerogram.name()).collect();
    assert_eq!(names, ["one", "two"]);
    assert_eq!(found.members()[0].event.as_deref(), Some("X, Y"));
    // In UTF-16 too, as spreadsheets save it.
    let wide: Vec<u8> =
        index.encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(!is_index(&wide));
    let wide = [&[0xff, 0xfe], &wide[..]].concat();
    assert!(is_index(&wide));
    let unit = Some(AccelerationUnit::Gravity);
    let read = ReadOptions { unit, ..ReadOptions::default() };
    let options = read;
    let bytes = |_: &str| Ok(MOTION.as_bytes().to_vec());
    let same = Suite::from_index("i.csv", &wide, &options, bytes).unwrap();
    assert_eq!(same, found);
}

/// SMC files name event, station and component: names of files say nothing.
#[test]
fn smc_components_are_known_by_their_header() {
    let text = |station: &str, component: &str| {
        let mut lines: Vec<String> =
            crate::tests::smc().lines().map(str::to_owned).collect();
        lines[3] = "     1989  10  18    0004 Nowhere".to_owned();
        lines[5] =
            format!("station = {station:20} component= {component:>6}  ");
        lines.join("\n") + "\n"
    };
    let files = [
        ("0111a", "Town Hall", "270"),
        ("0111b", "Town Hall", "up"),
        ("0111c", "Town Hall", "360"),
        ("0112_UP", "Bridge", "45"),
    ];
    let names: Vec<String> =
        files.iter().map(|f| format!("{}.smc", f.0)).collect();
    let options = ReadOptions::default();
    let bytes = |name: &str| {
        let stem = name.trim_end_matches(".smc");
        let file = files.iter().find(|f| f.0 == stem).unwrap();
        Ok(text(file.1, file.2).into_bytes())
    };
    let survey =
        Survey::of_files("d", &names, &Reading::all(&options), bytes, KEEP);
    let suite = survey.unwrap().into_suite().unwrap();
    let kept: Vec<_> = suite.members().iter().map(|m| &*m.file).collect();
    assert_eq!(kept, ["0111a.smc", "0111c.smc", "0112_UP.smc"]);
    assert_eq!(suite.both().len(), 1);
    let [count] = suite.set_aside().counts()[..] else { panic!() };
    assert_eq!((count.reason, count.files), (AsideReason::Vertical, 1));
    assert_eq!(count.first, "0111b.smc");
}

/// The six files of a KiK-net station, and one of which nothing is known.
fn kiknet() -> Vec<(String, String)> {
    let text = crate::tests::KNET;
    let file = |(name, dir): (&str, &str)| {
        (format!("AAAH01.{name}"), text.replace("E-W", dir))
    };
    let channels = [
        ("EW1", "2"),
        ("EW2", "5"),
        ("NS1", "1"),
        ("NS2", "4"),
        ("UD1", "3"),
        ("UD2", "6"),
        ("xy", "9"),
    ];
    channels.into_iter().map(file).collect()
}

#[test]
fn of_a_kiknet_station_the_two_surface_components_make_a_suite() {
    let files = kiknet();
    let names: Vec<String> = files.iter().map(|f| f.0.clone()).collect();
    let bytes = |name: &str| {
        let file = files.iter().find(|f| f.0 == name).unwrap();
        Ok(file.1.clone().into_bytes())
    };
    let options = ReadOptions::default();
    let survey =
        Survey::of_files("d", &names, &Reading::all(&options), bytes, KEEP)
            .unwrap();
    let aside: Vec<_> = survey
        .set_aside
        .all()
        .iter()
        .map(|aside| format!("{} {}", aside.file, aside.reason.code()))
        .collect();
    assert_eq!(
        aside,
        [
            "AAAH01.EW1 borehole",
            "AAAH01.NS1 borehole",
            "AAAH01.UD1 vertical",
            "AAAH01.UD2 vertical"
        ]
    );
    let suite = survey.into_suite().unwrap();
    let kept: Vec<_> = suite.members().iter().map(|m| &*m.file).collect();
    assert_eq!(kept, ["AAAH01.EW2", "AAAH01.NS2", "AAAH01.xy"]);
    let [(study, other)] = suite.both()[..] else { panic!() };
    assert_eq!((&*study.file, &*other.file), ("AAAH01.EW2", "AAAH01.NS2"));
    // Of the third, neither the header nor the name tells the direction.
    let remarks = |m: &SuiteMember| m.remarks.clone();
    assert_eq!(remarks(study), []);
    assert_eq!(remarks(&suite.members()[2]), [Remark::Direction]);
    // An index says what is wanted, and a remark what it is.
    let index = "file\nAAAH01.NS1\nAAAH01.UD2\nAAAH01.NS2\nAAAH01.xy\n";
    let index = index.as_bytes();
    let suite = Suite::from_index("i.csv", index, &options, bytes).unwrap();
    let found: Vec<_> = suite.members().iter().map(remarks).collect();
    let expected =
        [vec![Remark::Borehole], vec![Remark::Vertical], vec![], vec![]];
    assert_eq!(found, expected);
    assert_eq!(suite.both().len(), 0);
}

#[test]
fn a_suite_has_the_name_of_its_folder_or_file() {
    let options = ReadOptions::default();
    let names = ["A.EW".to_owned()];
    let bytes = |_: &str| Ok(crate::tests::KNET.into());
    for (path, name) in [
        ("M6.5_0917", "M6.5_0917"),
        ("x/M6.5_0917/", "M6.5_0917"),
        ("x/peer.v2.zip", "peer.v2"),
    ] {
        let survey = Survey::of_files(
            path,
            &names,
            &Reading::all(&options),
            bytes,
            KEEP,
        );
        assert_eq!(survey.unwrap().into_suite().unwrap().name(), name);
    }
    for (path, name) in
        [("x/M6.5.csv", "M6.5"), ("M6.5_x/_SearchResults.csv", "M6.5_x")]
    {
        let index = b"file\nA.EW\n";
        let suite = Suite::from_index(path, index, &options, bytes).unwrap();
        assert_eq!(suite.name(), name);
    }
}

/// AT2 names the component at the end of its second line.
#[test]
fn at2_components_are_known_by_their_header() {
    let text = |component: &str| {
        format!(
            "PEER NGA STRONG MOTION DATABASE RECORD\n\
             Nowhere, 1/1/1900, Station, {component}\n\
             ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 2, DT= .01 SEC\n\
             \x20  .1000000E-02   .2000000E-02\n"
        )
    };
    let names = ["d.AT2".to_owned(), "e.AT2".to_owned()];
    let options = ReadOptions::default();
    let bytes = |name: &str| {
        Ok(text(if name == "d.AT2" { "UP" } else { "90" }).into_bytes())
    };
    let survey =
        Survey::of_files("f", &names, &Reading::all(&options), bytes, KEEP);
    let suite = survey.unwrap().into_suite().unwrap();
    assert_eq!(suite.members().len(), 1);
    assert_eq!(suite.members()[0].file, "e.AT2");
}

#[test]
fn any_text_is_an_index_or_refused() {
    let index =
        "file,dt_s,pair,study_component,e\na,0.01,p,1,\"x, y\"\nb,1,p,0,\n";
    for at in 0..index.len() {
        for with in ["", ",", "\"", "\n", "0", "-", "\u{e9}"] {
            let mut changed = index.to_owned();
            changed.replace_range(at..=at, with);
            if let Ok(found) = suite(&changed) {
                assert!(found.members().len() <= 2);
            }
        }
    }
}

#[test]
fn peers_search_results_are_an_index() {
    let results = "PEER Ground Motion Database\n\
        Search Criteria,\n\n\
        -- Summary of Metadata of Selected Records --\n\
        Result ID, Spectral Ordinate, Record Sequence Number, Tp-Pulse(s), Earthquake Name, Magnitude, Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename\n\
        1, SRSS, 9001, -, \"Nowhere, 1900\", 7.1, RSN9001_NO_A000.AT2, RSN9001_NO_A090.AT2, RSN9001_NO_UP.AT2\n\
        2, SRSS, 9002, 1.5, \"Nowhere\", 6.1, RSN9002_NO_B1.AT2, -----, -----\n\
        , , , , , , , , \n\
        -- Scaled Spectra used in Search & Scaling --\n\
        Period (sec), Target\n0.01, 0.5\n";
    assert!(is_index(results.as_bytes()));
    assert!(!is_index(b"t,a\n0,1\n"));
    let motion = "PEER NGA STRONG MOTION DATABASE RECORD\nX\n\
        ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 2, DT= .01 SEC\n\
        \x20  .1000000E-02   .2000000E-02\n";
    let options = ReadOptions::default();
    let read = |text: &str| {
        Suite::from_index("s.csv", text.as_bytes(), &options, |_| {
            Ok(motion.as_bytes().to_vec())
        })
    };
    let suite = read(results).unwrap();
    let files: Vec<_> = suite.members().iter().map(|m| &*m.file).collect();
    assert_eq!(
        files,
        ["RSN9001_NO_A000.AT2", "RSN9001_NO_A090.AT2", "RSN9002_NO_B1.AT2"]
    );
    assert_eq!(suite.both().len(), 1);
    assert_eq!(suite.members()[1].pair.as_deref(), Some("RSN9001"));
    let member = &suite.members()[1];
    assert_eq!(
        member.attributes_by_name()["Earthquake Name"],
        "Nowhere, 1900"
    );
    assert_eq!(member.attributes_by_name()["Magnitude"], "7.1");
    let short = results.replace(", -----, -----", ", -----");
    assert_eq!(
        read(&short).unwrap_err().to_string(),
        "s.csv:7: \"8 cells\": expected 9 cells, as the head"
    );
}

/// An interval and a unit hold for the files that state none, however many
/// others there are; what no file takes and one contradicts is refused.
#[test]
fn what_is_given_is_for_files_that_state_none() {
    let at2 = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere\n\
        ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 3, DT= .005 SEC\n\
        0.1\n0.2\n-0.1\n";
    let all =
        [("a.AT2", at2), ("b.txt", MOTION), ("c.txt", "# a [g]\n0.1\n0\n")];
    let suite = |files: &[(&str, &str)], dt_s, unit| {
        let names: Vec<String> =
            files.iter().map(|(name, _)| (*name).to_owned()).collect();
        let bytes = |name: &str| {
            let found = files.iter().find(|(known, _)| *known == name);
            Ok(found.unwrap().1.as_bytes().to_vec())
        };
        let options = ReadOptions { dt_s, unit, ..ReadOptions::default() };
        Survey::of_files("f", &names, &Reading::all(&options), bytes, KEEP)
            .and_then(Survey::into_suite)
            .map_err(|error| error.to_string())
    };
    let si = Some(AccelerationUnit::MetrePerSecondSquared);
    let mixed = suite(&all, Some(0.02), si).unwrap();
    let found: Vec<_> = mixed
        .members()
        .iter()
        .map(|m| (m.accelerogram.dt_s(), m.unit, m.given.dt, m.given.unit))
        .collect();
    let g = AccelerationUnit::Gravity;
    assert_eq!(
        found,
        [
            (0.005, g, false, false),
            (0.02, AccelerationUnit::MetrePerSecondSquared, true, true),
            (0.02, g, true, false),
        ]
    );
    assert_eq!(
        suite(&all[..1], Some(0.02), None).unwrap_err(),
        "f/a.AT2: given sampling interval 0.02 s: expected 0.005 s, \
         as in the file"
    );
    let unit = "f/a.AT2: given unit m/s2: expected g, as in the file";
    assert!(suite(&all[..1], None, si).unwrap_err().starts_with(unit));
    assert!(suite(&all[..1], Some(0.005), Some(g)).is_ok());
    // A row of an index describes only its file.
    let index = "file,dt_s,units\na.AT2,0.02,g\n";
    let options = ReadOptions { unit: si, ..ReadOptions::default() };
    let found = Suite::from_index("i.csv", index.as_bytes(), &options, |_| {
        Ok(at2.as_bytes().to_vec())
    });
    let row = "a.AT2: given sampling interval 0.02 s: expected 0.005 s";
    assert!(found.unwrap_err().to_string().starts_with(row));
}
