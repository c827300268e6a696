use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use rocking::stop::{Stop, StopError};
use rocking_records::{Processing, ReadOptions};

use super::tile::{TileState, read};
use super::*;
use crate::failure::Failure;
use rocking_common::suites::inputs::{SuiteInput, sha256_hex};

/// A suite of three half sines in a folder.
fn suite(folder: &Path) -> (PathBuf, ReadOptions) {
    let place = folder.join("records");
    fs::create_dir_all(&place).unwrap();
    for (name, scale) in [("a", 0.4), ("b", 0.6), ("c", 0.9)] {
        let samples: Vec<f64> = (0..200)
            .map(|i| scale * libm::sin(f64::from(i) * 0.06 / scale))
            .collect();
        let text: String = samples.iter().map(|x| format!("{x}\n")).collect();
        fs::write(place.join(format!("{name}.txt")), text).unwrap();
    }
    let read = ReadOptions {
        dt_s: Some(0.02),
        unit: Some(rocking::units::AccelerationUnit::parse("g").unwrap()),
        gravity_m_s2: 9.81,
        ..ReadOptions::default()
    };
    (place, read)
}

fn plan(folder: &Path, tile_blocks: usize) -> SweepFolder {
    let blocks: Vec<SweepBlock> = [0.08, 0.1, 0.12, 0.15, 0.2, 0.22, 0.25]
        .into_iter()
        .enumerate()
        .map(|(k, alpha_rad)| SweepBlock {
            id: format!("block_{k}").parse().unwrap(),
            alpha_rad,
            p_rad_s: 3.0,
            eta: 0.92,
        })
        .collect();
    let ((place, read), none) = (suite(folder), Processing::default());
    let (input, suite) =
        SuiteInput::read::<Failure>(&place, read, &none, 0).unwrap();
    let plan = SweepPlan {
        schema: SCHEMA,
        software: BUILD.into(),
        levels: LevelSteps::StepIm(0.05),
        demands: vec![0.35, 1.0],
        rows: true,
        blocks,
        records: Vec::new(),
        events: Vec::new(),
        tile_blocks,
    };
    plan.write(&suite, input, &folder.join("plan")).unwrap()
}

/// The program of all plans and tiles here.
const BUILD: &str = "rocking 0.1.0 (commit 0123456789ab)";

fn run_all(planned: &SweepFolder, of: usize) {
    // The last task first: the order does not matter.
    for task in (0..of).rev() {
        run(planned, BUILD, (task, of), &|_| ()).unwrap();
        assert!(left(planned, (task, of)).is_empty());
    }
}

fn merged(planned: &SweepFolder, content: Content) -> String {
    let out = planned.folder.join("merged.csv");
    merge(planned, content, &out).unwrap();
    let text = fs::read(&out).unwrap();
    fs::remove_file(out).unwrap();
    sha256_hex(&text)
}

#[test]
fn any_tiles_and_any_tasks_give_the_same_bytes() {
    let mut sums = Vec::new();
    let all = usize::MAX;
    for (tile_blocks, tiles, of, block_samples) in [
        (9, 1, 1, all),
        (7, 1, 1, 1),
        (1, 7, 1, 201),
        (1, 7, 5, all),
        (3, 3, 2, all),
    ] {
        let place = tempfile::tempdir().unwrap();
        let planned = plan(place.path(), tile_blocks);
        let planned = SweepFolder { block_samples, ..planned };
        let first = planned.records(0).unwrap().len();
        assert_eq!(
            first,
            if block_samples == all { 3 } else { block_samples.div_ceil(200) }
        );
        assert_eq!(planned.plan.tiles(), tiles);
        run_all(&planned, of);
        let contents = Content::kept(&planned.plan);
        assert_eq!(contents.len(), 3);
        sums.push(contents.into_iter().map(|c| merged(&planned, c)).collect());
    }
    let first: &Vec<String> = &sums[0];
    assert!(sums.iter().all(|sum| sum == first), "{sums:?}");
}

/// The table of capacities counts the levels that the table of rows lists.
#[test]
fn unresolved_levels_are_counted_curve_by_curve() {
    let place = tempfile::tempdir().unwrap();
    let planned = plan(place.path(), 7);
    run_all(&planned, 1);
    let rows = |content| {
        let text = read(&planned, content, 0).unwrap();
        let mut rows = csv::Reader::from_reader(text.as_bytes());
        let rows: Result<Vec<BTreeMap<String, String>>, _> =
            rows.deserialize().collect();
        rows.unwrap()
    };
    let (curves, levels) = (rows(Content::Capacities), rows(Content::Rows));
    assert_eq!(curves.len(), 7 * 3);
    for curve in curves {
        let own = levels.iter().filter(|level| {
            let same = |key| level[key] == curve[key];
            same("id") && same("record") && level["refined"] == "false"
        });
        let open = own.filter(|level| level["resolved"] == "false").count();
        assert_eq!(curve["unresolved"], open.to_string(), "{curve:?}");
    }
}

#[test]
fn what_was_interrupted_goes_on_and_leaves_nothing_half_written() {
    let place = tempfile::tempdir().unwrap();
    let planned = plan(place.path(), 1);
    let stop = Stop::default();
    let done = |tile| {
        if tile == 2 {
            stop.request();
        }
    };
    let stopped = stop.run(2, || run(&planned, BUILD, (0, 1), &done));
    assert!(matches!(stopped, Err(StopError::Stopped)), "{stopped:?}");
    assert_eq!(left(&planned, (0, 1)), [3, 4, 5, 6]);
    let out = place.path().join("out.csv");
    let error = merge(&planned, Content::Fragilities, &out).unwrap_err();
    let words = error.message;
    assert!(words.starts_with("4 of 7 tiles are not done;"), "{words}");
    for tile in 0..7 {
        let missing = words.contains(&format!("0000{tile}.csv: missing"));
        assert_eq!(missing, tile > 2, "{words}");
    }
    assert!(!out.exists());
    run_all(&planned, 1);
    let whole = tempfile::tempdir().unwrap();
    let other = plan(whole.path(), 1);
    run_all(&other, 1);
    for content in Content::kept(&planned.plan) {
        assert_eq!(merged(&planned, content), merged(&other, content));
    }
    let names = fs::read_dir(planned.folder.join("tiles")).unwrap();
    assert_eq!(names.count(), 3 * 7);
}

#[test]
fn a_flipped_byte_a_foreign_tile_and_another_record_are_named() {
    let place = tempfile::tempdir().unwrap();
    let planned = plan(place.path(), 1);
    run_all(&planned, 1);
    let path = planned.tile_path(Content::Fragilities, 3);
    let right = fs::read(&path).unwrap();
    let mut flipped = right.clone();
    flipped[40] ^= 1;
    fs::write(&path, &flipped).unwrap();
    let state = || read(&planned, Content::Fragilities, 3).unwrap_err();
    assert_eq!(state(), TileState::Damaged);
    let out = place.path().join("out.csv");
    let error = merge(&planned, Content::Fragilities, &out).unwrap_err();
    let words = error.message;
    assert!(words.contains("fragilities-00003.csv"), "{words}");
    // The same tile, once more.
    run_all(&planned, 1);
    assert_eq!(fs::read(&path).unwrap(), right);
    // Of a plan with other demands.
    let text = String::from_utf8(right).unwrap();
    let foreign = text.replace(&planned.hash, &"0".repeat(64));
    fs::write(&path, foreign).unwrap();
    assert_eq!(state(), TileState::Foreign);
    let record = planned.folder.join("suite/b.at2");
    let mut bytes = fs::read(&record).unwrap();
    let last = bytes.len() - 3;
    bytes[last] = if bytes[last] == b'1' { b'2' } else { b'1' };
    fs::write(&record, bytes).unwrap();
    let error = run(&planned, BUILD, (0, 1), &|_| ()).unwrap_err();
    assert!(error.message.contains("b.at2"), "{error:?}");
}

/// Two builds of one version may give other numbers.
#[test]
fn tiles_of_two_builds_are_not_mixed() {
    let place = tempfile::tempdir().unwrap();
    let planned = plan(place.path(), 1);
    let other = BUILD.replace("0123456789ab", "ba9876543210");
    let error = run(&planned, &other, (0, 1), &|_| ()).unwrap_err().message;
    assert!(error.contains(BUILD) && error.contains(&other), "{error}");
    run_all(&planned, 1);
    // A tile of this plan that another build has made, sum and all.
    let path = planned.tile_path(Content::Capacities, 5);
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text.matches(BUILD).count(), 1);
    fs::write(&path, text.replace(BUILD, &other)).unwrap();
    assert_eq!(left(&planned, (0, 1)), [5]);
    let out = place.path().join("out.csv");
    let error = merge(&planned, Content::Capacities, &out).unwrap_err();
    let words = error.message;
    assert!(
        words.contains("00005.csv: of another plan or another"),
        "{words}"
    );
    assert!(!out.exists());
}

/// A plan lies in a shared folder: it is input like any other.
#[test]
fn a_plan_is_checked_when_it_is_read() {
    let place = tempfile::tempdir().unwrap();
    let planned = plan(place.path(), 1);
    let path = planned.folder.join("plan.json");
    let whole = fs::read_to_string(&path).unwrap();
    assert_eq!(whole, SweepFolder::read(&planned.folder).unwrap().plan.text());
    let value: serde_json::Value = serde_json::from_str(&whole).unwrap();
    let refused = |pointer: &str, to: serde_json::Value, words: &str| {
        let mut changed = value.clone();
        let at = changed.pointer_mut(pointer).unwrap_or_else(|| {
            panic!("{pointer}: not in the plan");
        });
        *at = to;
        fs::write(&path, changed.to_string()).unwrap();
        let error = SweepFolder::read(&planned.folder).unwrap_err().message;
        assert!(error.contains("plan.json"), "{error}");
        assert!(error.contains(words), "{pointer}: {error}");
    };
    use serde_json::json;
    for (pointer, to, words) in [
        ("/schema", json!(5), "schema 5: expected 6"),
        ("/demands", json!([]), "no demands"),
        ("/demands", json!([0.35, 0.0]), "demand 0: expected a number above"),
        ("/demands", json!([0.35, 0.35]), "comes again"),
        ("/levels/step_im", json!(0.0), "step 0: expected a positive"),
        ("/levels/step_im", json!(-0.1), "step -0.1"),
        ("/tile_blocks", json!(0), "7 blocks, 0 a tile: expected one"),
        ("/blocks", json!([]), "0 blocks, 1 a tile: expected one"),
        ("/blocks/0/alpha_rad", json!(2.0), "block_0: "),
        ("/blocks/0/eta", json!(1.5), "block_0: "),
        ("/blocks/0/id", json!("a b"), "found `a b`"),
        ("/blocks/1/id", json!("block_0"), "two blocks are named block_0"),
        ("/blocks/1/alpha_rad", json!(0.08), "block_1 is the same block as"),
        ("/records", json!([]), "0 records"),
        ("/records/0/0", json!("../../a"), "that a file can have"),
        ("/records/0/0", json!("b"), "of its own"),
        ("/records/0/1", json!("0"), "a SHA-256"),
    ] {
        refused(pointer, to, words);
    }
    let mut short = value.clone();
    short["events"] = json!(["one"]);
    fs::write(&path, short.to_string()).unwrap();
    let error = SweepFolder::read(&planned.folder).unwrap_err().message;
    assert!(error.contains("3 records of 1 earthquakes"), "{error}");
}
