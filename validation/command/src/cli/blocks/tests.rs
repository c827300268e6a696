//! Inventories as people keep them, and all that is wrong with one.

use super::*;

fn bytes(table: &[u8]) -> Result<Vec<BlockRow>, String> {
    let found = parse(table, Path::new("store.csv"), 9.81);
    found.map_err(|failure| failure.message)
}

fn rows(table: &str) -> Vec<BlockRow> {
    bytes(table.as_bytes()).unwrap_or_else(|e| panic!("{table}\n{e}"))
}

/// The faults of a table, a line each, without the name of the file.
#[track_caller]
fn faults(table: &str) -> Vec<String> {
    let message = bytes(table.as_bytes()).expect_err(table);
    for word in ["CSV", "serialize", "invalid", "literal", "field", "record"] {
        assert!(!message.contains(word), "{word} in {message}");
    }
    let own = |line: &str| line.replacen("store.csv:", "", 1);
    message.lines().map(own).collect()
}

fn labels_and_ids(rows: &[BlockRow]) -> Vec<(&str, String)> {
    rows.iter().map(|row| (row.label.as_str(), row.id.to_string())).collect()
}

/// alpha and p of a block are these.
#[track_caller]
fn is(row: &BlockRow, (alpha, p): (f64, f64)) {
    let found = (row.block.slenderness_rad(), row.block.frequency_rad_s());
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-15 * b;
    assert!(near(found.0, alpha) && near(found.1, p), "{found:?}");
}

/// atan2 and sqrt of Python for blocks in m: 0.14 by 0.62, 0.16 by 0.48, 0.6
/// by 1.9 and 0.2 by 0.8.
const VASE: (f64, f64) = (0.222_081_901_905_480_2, 4.811_547_659_508_304);
const HYDRIA: (f64, f64) = (0.321_750_554_396_642_2, 5.392_872_365_990_231);
const VITRINE: (f64, f64) = (0.305_878_871_404_852_15, 2.717_581_056_501_777);
const SMALL: (f64, f64) = (0.244_978_663_126_864_14, 4.224_282_023_261_254);

#[test]
fn an_inventory_is_read_with_its_further_columns() {
    let all = rows(
        "id,width_m,height_m,depth_m,material,room\n\
         vase,0.14,0.62,0.14,clay,12\nlamp,0.14,0.62,,,13\n",
    );
    is(&all[0], VASE);
    assert_eq!(all[0].place, "store.csv:2");
    assert!(!all[0].depth_governs && !all[0].decimal_commas);
    let note = |head: &str, cell: &str| (head.to_owned(), cell.to_owned());
    assert_eq!(all[0].notes, [note("material", "clay"), note("room", "12")]);
    assert_eq!(all[1].notes, [note("room", "13")]);
    assert_eq!(all[0].position_m, None);
}

#[test]
fn a_label_is_any_text_and_gives_a_key() {
    let all = rows(
        "id,width_m,height_m\nVase on shelf,0.14,0.62\n1972.118.98,0.45,1.85\n\
         Case-1,0.6,2\nΚούρος,0.45,1.85\n",
    );
    let expected = [
        ("Vase on shelf", "Vase_on_shelf"),
        ("1972.118.98", "1972_118_98"),
        ("Case-1", "Case_1"),
        ("Κούρος", "Kouros"),
    ];
    assert_eq!(labels_and_ids(&all), expected.map(|(l, i)| (l, i.to_owned())));
}

#[test]
fn keys_differ_and_a_key_stays_as_it_is() {
    let long = "x".repeat(80);
    let table = format!(
        "NAME,p,Alpha\nCase 1,3,0.1\nCase_1,3,0.2\ncase.1,3,0.2\n\
         Case: 1,3,0.2\nCase-1,3,0.2\n\"...\",3,0.3\n{long}a,3,0.3\n\
         {long}b,3,0.3\n,3,0.25\n"
    );
    let all = rows(&table);
    let ids: Vec<String> = all.iter().map(|row| row.id.to_string()).collect();
    let (whole, cut) = ("x".repeat(75), "x".repeat(60) + "_2");
    let expected = [
        "Case_1_2",
        "Case_1",
        "case_1",
        "Case:_1",
        "Case_1_3",
        "object_7",
        &whole,
        &cut,
        "block_a0_25_p3",
    ];
    assert_eq!(ids, expected);
    assert_eq!(all[8].label, "block_a0_25_p3");
    // An id beside the label makes the key.
    let all = rows("id,label,alpha,p\nA 7,Kore,0.1,3\n,Kouros,0.2,3\n");
    let expected = [("Kore", "A_7"), ("Kouros", "Kouros")];
    assert_eq!(labels_and_ids(&all), expected.map(|(l, i)| (l, i.to_owned())));
}

#[test]
fn equal_names_are_refused() {
    let found = faults(
        "label,alpha,p\nMarble,0.1,3\nKore,0.1,3\nKrater,0.1,3\n\
         Krater,0.2,3\nKrater_2,0.2,3\n,0.1,3\n,0.1,3\n",
    );
    let expected = [
        "5: Krater is already on line 4: expected a unique label",
        "8: block_a0_1_p3 is already on line 7: expected a unique label",
    ];
    assert_eq!(found, expected);
    let found = faults("id,label,alpha,p\n7,Kore,0.1,3\n7,Stele,0.1,3\n");
    assert_eq!(found, ["3: 7 is already on line 2: expected a unique id"]);
    let found = faults("id,label,alpha,p\n7,Kore,0.1,3\n8,Kore,0.1,3\n");
    let expected = "3: Kore is already on line 2: expected a unique label";
    assert_eq!(found, [expected]);
}

#[test]
fn lengths_have_their_unit() {
    let metres = "width_m,height_m\n60,190\n";
    assert!(rows(metres)[0].block.frequency_rad_s() < 0.3);
    for table in [
        "width_cm,height_cm\n60,190\n",
        "\"Width\n(cm)\",Height [mm]\n60,1900\n",
        "width_mm,height_m,width_m\n600,1.9,\n",
        "width_m,height_m,depth_cm\n0.8,1.9,60\n",
        "width_m,height_m,depth_mm\n0.6,1.9,900\n",
    ] {
        let all = rows(table);
        is(&all[0], VITRINE);
        assert_eq!(all[0].depth_governs, table.contains("depth_cm"));
    }
    let size = "expected width and height, or alpha below pi/2 and p";
    for table in [
        "width_m,height_m\n0.6,\n",
        "alpha,p,width_m,height_m\n0.2,3,0.6,1.9\n",
        "alpha,p,depth_m\n0.2,3,0.1\n",
        "width_m,width_cm,height_m\n0.6,60,1.9\n",
        "width_m,height_m,depth_m,depth_cm\n0.6,1.9,0.2,20\n",
        "room\n12\n",
        "alpha,p\n1.6,3\n",
        "width_m,height_m\n1,1e-320\n",
    ] {
        assert_eq!(faults(table), [format!("2: size: {size}")], "{table}");
    }
}

/// A fault of the header line is not repeated for each row.
#[test]
fn a_column_without_a_unit_is_one_fault() {
    let row = "Kore,0.6,1.9,1.3O\n";
    let head = "1: column height: expected height_m, height_cm or height_mm";
    let found = faults(&format!("name,width_m,height,eta\n{row}"));
    assert_eq!(found.len(), 2);
    assert_eq!(found[0], head);
    assert!(found[1].starts_with("2: eta is"), "{}", found[1]);
    let found = faults("name,width_m,height_m,etas\nKore,0.6,,\n");
    assert_eq!(found.len(), 2);
    assert!(found[1].starts_with("2: size: expected"), "{}", found[1]);
}

#[test]
fn a_position_has_two_coordinates() {
    let all = rows("alpha,p,x_m,Y_M\n0.1,3,-1.5,2\n0.2,3,,\n");
    assert_eq!(all[0].position_m, Some((-1.5, 2.0)));
    assert_eq!(all[1].position_m, None);
    let found = faults("alpha,p,x_m,y_m\n0.1,3,1,\n0.2,3,1,far\n");
    let expected = [
        "2: x_m or y_m is empty: expected both or neither",
        "3: y_m is \"far\": expected a number with a decimal point, such as \
         0.16",
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_column_that_is_nearly_known_is_refused() {
    let sides = |name: &str| format!("{name}_m, {name}_cm or {name}_mm");
    for (name, expected) in [
        ("fricton", "friction, or another name".to_owned()),
        ("Friciton", "friction, or another name".to_owned()),
        ("flor", "floor, or another name".to_owned()),
        ("limit_ration", "limit_ratio, or another name".to_owned()),
        ("lable", "label, or another name".to_owned()),
        ("ets", "eta, or another name".to_owned()),
        ("x_cm", "x_m, or another name".to_owned()),
        ("p", "p, or another name".to_owned()),
        ("height", sides("height")),
        ("Width", sides("width")),
        ("depth_inches", sides("depth")),
    ] {
        let found = faults(&format!("alpha,p,{name}\n0.1,3,1\n"));
        assert_eq!(found, [format!("1: column {name}: expected {expected}")]);
    }
    for name in [
        "weight_kg",
        "room",
        "material",
        "floor_area",
        "value",
        "no",
        "n",
        "date",
        "inventory number",
        "period",
        "x",
        "",
    ] {
        let all = rows(&format!("alpha,p,{name}\n0.1,3, 1\n"));
        assert_eq!(all[0].notes, [(name.to_owned(), "1".to_owned())]);
    }
    let found = faults("name,label,alpha,p\nKore,Kore,0.1,3\n");
    assert_eq!(found, ["1: column label: expected label, or another name"]);
    // A head of any length costs each row little.
    let all = rows(&format!("alpha,p,{}\n0.1,3,1\n", "é".repeat(1000)));
    assert_eq!(all[0].notes[0].0.chars().count(), 64);
}

#[test]
fn decimal_commas_are_read_and_remembered() {
    let all = rows(
        "id,width_m,height_m,eta,friction,limit_ratio\n\
         Krater,0.30,0.52,,0.5,\nKrater_2,0.28,0.49,,0.5,\n\
         Hydria_on_shelf,\"0,16\",\" 0,48 \",,0.5,\nVitrine_3,60,190,,0.4,0.3\n",
    );
    let commas: Vec<bool> = all.iter().map(|row| row.decimal_commas).collect();
    assert_eq!(commas, [false, false, true, false]);
    is(&all[2], HYDRIA);
    let all = rows(
        "\u{feff}id;width_mm;height_m;sample\r\n\
         \"Hydria; small\";160,0;0,480;\"a.txt;b.txt\"\r\n;200;0.8;\r\n;;;\r\n",
    );
    is(&all[0], HYDRIA);
    is(&all[1], SMALL);
    assert_eq!(all.len(), 2);
    assert_eq!(all[0].id.to_string(), "Hydria_small");
    assert!(all[0].decimal_commas && !all[1].decimal_commas);
    assert_eq!(all[0].samples, ["a.txt", "b.txt"].map(PathBuf::from));
    // A comma of thousands is known where commas separate cells.
    let found = faults("width_mm,height_m\n\"1,300\",\"2,250\"\n");
    let expected = [
        "2: width_mm is \"1,300\": expected 1300 or 1.300",
        "2: height_m is \"2,250\": expected 2250 or 2.250",
    ];
    assert_eq!(found, expected);
    is(&rows("width_m,height_m\n\"0,200\",\"0,8\"\n")[0], SMALL);
    assert_eq!(rows("width_m;height_m\n1,300;2\n").len(), 1);
    for text in ["1.234,5", "1,234,5", "0,1O"] {
        let found = faults(&format!("width_mm,height_m\n\"{text}\",2\n"));
        let expected = "expected a number with a decimal point, such as 0.16";
        assert_eq!(found, [format!("2: width_mm is \"{text}\": {expected}")]);
    }
}

#[test]
fn all_faults_are_in_one_message() {
    let found = faults(
        "name,width_m,height_m,eta,friction,limit_ratio,fricton\n\
         Head,0.22,0.38,,0.5,,\n\nKrater,0.30,0.52,,0.5,,\n\
         Krater,1.3O,0.52,1.2,0,1,\nKore,NaN,-1,,inf,0,\nShort,0.2\n\
         Long,0.2,0.8,,,,,\n\"=two\nlines\",0.2,0.8,,,,\nLast,0.2,,,,,1",
    );
    let name = "expected no control character, and no =, +, - or @ at the \
                start, which makes a spreadsheet compute the cell";
    let expected = [
        "1: column fricton: expected friction, or another name",
        "5: width_m is \"1.3O\": expected a number with a decimal point, such \
         as 0.16",
        "5: eta is \"1.2\": expected a number in (0, 1]",
        "5: friction is \"0\": expected a positive number",
        "5: limit_ratio is \"1\": expected a number between 0 and 1",
        "5: Krater is already on line 4: expected a unique label",
        "6: width_m is \"NaN\": expected a positive number",
        "6: height_m is \"-1\": expected a positive number",
        "6: friction is \"inf\": expected a positive number",
        "6: limit_ratio is \"0\": expected a number between 0 and 1",
        "7: 2 cells: expected 7",
        "8: 8 cells: expected 7",
        &format!("9: label is \"=two lines\": {name}"),
        "11: size: expected width and height, or alpha below pi/2 and p",
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_number_out_of_range_is_refused_by_its_column() {
    for (column, range, cells) in [
        ("alpha", "a positive number", ["0", "-1", "nan", "inf"]),
        ("p", "a positive number", ["0", "-1", "NaN", "1e999"]),
        ("eta", "a number in (0, 1]", ["0", "1.01", "NaN", "-inf"]),
        ("friction", "a positive number", ["0", "-0.1", "NaN", "inf"]),
        ("limit_ratio", "a number between 0 and 1", ["0", "1", "NaN", "2"]),
        ("x_m", "a number", ["inf", "NaN", "-inf", "1e999"]),
    ] {
        for cell in cells {
            let rest = ["alpha,p,y_m", "0.1,3,1"].map(str::to_owned);
            let [head, row] = match column {
                "alpha" => ["p,y_m,x_m", "3,1,1"].map(str::to_owned),
                "p" => ["alpha,y_m,x_m", "0.1,1,1"].map(str::to_owned),
                "x_m" => rest,
                _ => rest.map(|half| {
                    half.replace(",y_m", "").replace(",3,1", ",3")
                }),
            };
            let found = faults(&format!("{column},{head}\n{cell},{row}\n"));
            let expected =
                format!("2: {column} is \"{cell}\": expected {range}");
            assert_eq!(found, [expected]);
        }
    }
    let all = rows("alpha,p,eta,friction,limit_ratio\n.1,3e0,1,+2,0.999\n");
    assert_eq!(all[0].cells.eta, Some(1.0));
    assert_eq!(all[0].cells.friction, Some(2.0));
    assert_eq!(all[0].cells.limit_ratio, Some(0.999));
}

#[test]
fn a_message_lists_twenty_faults_and_counts_the_others() {
    let table = "alpha,p\n".to_owned() + &"x,3\n".repeat(50);
    let found = faults(&table);
    // A block of no size has no label, and so no label comes again.
    assert_eq!(found.len(), 21);
    assert!(found[19].starts_with("21: alpha is \"x\""), "{}", found[19]);
    assert_eq!(found[20], "and 30 more");
    let long = format!("alpha,p\n{},3\n", "9".repeat(1000));
    assert!(faults(&long)[0].len() < 160);
}

#[test]
fn what_is_no_table_is_refused() {
    for (table, words) in [
        (&b"label\talpha\tp\nKore\t0.1\t3\n"[..], "store.csv: tabs: expected"),
        (
            b"label,alpha,p\nKor\xe9,0.1,3\n",
            "store.csv: expected CSV in UTF-8",
        ),
        (b"\xff\xfea\0,\0", "store.csv: expected CSV in UTF-8"),
        (b"", "store.csv: no block"),
        (b"\n;;\n", "store.csv: no block"),
        (b"alpha,p\n,\n\n", "store.csv: no block"),
        (
            b"label;alpha;p\nKore;0.1;\"3\nStele;0.2;3\n",
            "store.csv: a cell that begins with a quote on line 2 has",
        ),
    ] {
        let message = bytes(table).unwrap_err();
        assert!(message.starts_with(words), "{message}");
    }
}

#[test]
fn a_fault_has_the_line_that_an_editor_shows() {
    for (table, line) in [
        ("alpha,p\n0.1,x", 2),
        ("alpha,p\r\n0.1,3\r\n0.2,x\r\n", 3),
        ("alpha,p\r\n\r\n0.1,3\r\n\r\n\r\n0.2,x", 6),
        ("\u{feff}alpha,p,n\n0.1,3,\"a\nb\n\"\n\n0.2,x,\"a\n\"\n", 6),
    ] {
        let found = faults(table);
        let expected = format!("{line}: p is \"x\"");
        assert!(found[0].starts_with(&expected), "{found:?}");
    }
}

#[test]
fn a_floor_and_samples_are_texts() {
    let path = Path::new("store/objects.csv");
    let table = "alpha,p,floor,sample\n0.1,3,2nd floor,a.txt; sub/b.txt\n";
    let all = parse(table.as_bytes(), path, 9.81).unwrap();
    assert_eq!(all[0].cells.floor.as_deref(), Some("2nd floor"));
    let expected = ["store/a.txt", "store/sub/b.txt"].map(PathBuf::from);
    assert_eq!(all[0].samples, expected);
}
