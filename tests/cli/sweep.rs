//! `rocking sweep` as a program that is killed, and that finds no room.

use std::env;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{Clusters, Range};

use super::support::{
    answer, at2, close, folder, json, motion, refused_for, rocking,
};

/// A folder with a plan of `blocks` blocks in as many tiles.
fn planned(name: &str, blocks: usize) -> crate::support::Place {
    let mut table = String::from("alpha,p\n");
    for k in 0..blocks {
        writeln!(table, "{},3", 0.05 + 0.4 * k as f64 / blocks as f64)
            .unwrap();
    }
    let records = [7.0, 9.0, 11.0, 13.0].map(|rhythm| {
        let samples = motion(rhythm);
        (format!("records/{rhythm}.at2"), at2("0.02", samples.len(), &samples))
    });
    let mut files: Vec<(&str, &str)> = vec![("blocks.csv", &table)];
    files.extend(records.iter().map(|(n, t)| (n.as_str(), t.as_str())));
    let place = folder(name, &files);
    answer(
        &place,
        "sweep plan --blocks blocks.csv --suite records --out plan \
         --step-im 0.002 --tile-blocks 1",
    );
    place
}

/// Names in the folder of tiles, hidden ones too.
fn tiles(place: &Path) -> Vec<String> {
    let entries = fs::read_dir(place.join("plan/tiles")).unwrap();
    let name = |e: std::io::Result<fs::DirEntry>| {
        e.unwrap().file_name().into_string().unwrap()
    };
    entries.map(name).collect()
}

fn run(place: &Path) {
    let output = rocking(place, "sweep run plan").output().unwrap();
    assert!(output.status.success(), "{output:?}");
}

fn merged(place: &Path) -> [Vec<u8>; 2] {
    ["fragilities", "capacities"].map(|what| {
        answer(place, &format!("sweep merge plan --what {what} --out o.csv"));
        let bytes = fs::read(place.join("o.csv")).unwrap();
        fs::remove_file(place.join("o.csv")).unwrap();
        bytes
    })
}

#[test]
fn what_was_killed_goes_on_to_the_same_bytes() {
    let whole = planned("sweep-whole", 24);
    run(&whole);
    let expected = merged(&whole);
    let place = planned("sweep-killed", 24);
    // Killed (SIGKILL) in the middle of a tile, again and again.
    let mut kills = 0;
    while kills < 3 {
        let mut child = rocking(&place, "sweep run plan --threads 1")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let before = tiles(&place).len();
        while tiles(&place).len() < before + 3
            && child.try_wait().unwrap().is_none()
        {
            sleep(Duration::from_micros(200));
        }
        child.kill().unwrap();
        let ended = child.wait().unwrap();
        assert_eq!(ended.code(), None, "it ended before it was killed");
        kills += 1;
    }
    assert!(tiles(&place).len() < 48, "nothing was left to do");
    // What a run leaves that is killed while it writes, of long ago.
    let part = place.join("plan/tiles/.rocking-killed.part");
    fs::write(&part, "id,alpha_rad,p_rad_s").unwrap();
    let then = SystemTime::UNIX_EPOCH + Duration::from_secs(3600);
    File::options()
        .write(true)
        .open(&part)
        .unwrap()
        .set_modified(then)
        .unwrap();
    run(&place);
    assert_eq!(merged(&place), expected);
    let mut names = tiles(&place);
    // One killed at the moment of writing leaves its part for ten seconds.
    names.retain(|name| name != ".rocking-killed.part" || part.exists());
    let unfinished = names.iter().filter(|name| name.starts_with('.')).count();
    assert!(!part.exists() && unfinished <= kills, "{names:?}");
    assert_eq!(names.len() - unfinished, 48);
}

/// Runs a command where no file may grow beyond `kib` KiB.
#[cfg(unix)]
fn limited(place: &Path, arguments: &str, kib: usize) -> (bool, String) {
    let script = format!(
        "ulimit -f {kib} && trap '' XFSZ && exec '{}' {arguments}",
        env!("CARGO_BIN_EXE_rocking")
    );
    let output = Command::new("bash")
        .args(["-c", &script])
        .current_dir(place)
        .output()
        .unwrap();
    (output.status.success(), String::from_utf8(output.stderr).unwrap())
}

#[cfg(unix)]
#[test]
fn without_room_it_says_so_and_leaves_nothing_half_written() {
    let place = planned("sweep-room", 60);
    let all = "sweep plan --blocks blocks.csv --suite records --out plan \
               --step-im 0.02 --tile-blocks 60";
    fs::remove_dir_all(place.join("plan")).unwrap();
    answer(&place, all);
    // The tile of capacities is larger than 8 KiB.
    let (done, error) = limited(&place, "sweep run plan", 8);
    assert!(!done);
    let last = error.lines().last().unwrap();
    assert!(last.starts_with("rocking: cannot write plan/tiles/"), "{error}");
    assert!(last.contains("large"), "{error}");
    assert!(tiles(&place).iter().all(|name| name.ends_with(".csv")));
    let old = "an older table\n";
    fs::write(place.join("o.csv"), old).unwrap();
    let merge = "sweep merge plan --what capacities --out o.csv";
    refused_for(&place, merge, &["1 of 1 tiles are not done"]);
    run(&place);
    // Neither does a merge.
    let (done, error) = limited(&place, merge, 8);
    assert!(!done);
    assert!(error.starts_with("rocking: cannot write o.csv: "), "{error}");
    assert_eq!(fs::read_to_string(place.join("o.csv")).unwrap(), old);
    let names = fs::read_dir(&place).unwrap();
    let hidden = names
        .filter(|e| {
            let name = e.as_ref().unwrap().file_name();
            name.to_string_lossy().starts_with('.')
        })
        .count();
    assert_eq!(hidden, 0);
    answer(&place, merge);
    assert!(fs::read(place.join("o.csv")).unwrap().len() > 8 * 1024);
    // A file system that is full, where the system has such a device.
    if Path::new("/dev/full").exists() {
        let merge = "sweep merge plan --out /dev/full";
        let output = rocking(&place, merge).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(error.contains("cannot write /dev/full: No space"), "{error}");
        assert_eq!(output.status.code(), Some(2));
    }
}

#[test]
fn a_merge_replaces_no_file_of_its_plan_and_a_plan_has_an_end() {
    let place = planned("sweep-own", 1);
    run(&place);
    let suite = fs::read_dir(place.join("plan/suite")).unwrap();
    let record = suite.map(|e| e.unwrap().path()).next().unwrap();
    let record =
        format!("plan/suite/{}", record.file_name().unwrap().display());
    for own in ["plan/plan.json", "plan/suite.csv", &record] {
        let old = fs::read(place.join(own)).unwrap();
        let merge = format!("sweep merge plan --out {own}");
        refused_for(&place, &merge, &["is read: expected another file"]);
        assert_eq!(fs::read(place.join(own)).unwrap(), old);
    }
    let endless = "sweep plan --blocks blocks.csv --suite records --out more \
                   --step-pga-g 1e-14";
    answer(&place, endless);
    refused_for(&place, "sweep run more", &["levels up to the highest IM"]);
}

#[test]
fn a_table_of_blocks_that_makes_no_sweep_is_refused() {
    let place = planned("sweep-blocks", 1);
    for (table, names) in [
        ("id,alpha,p\na,0.1,3\na,0.2,3\n", "twice.csv:3: a is already on"),
        ("id,alpha,p\na,0.1,3\nb,0.1,3\n", "b is the same block as a"),
        ("alpha,p,sample\n0.1,3,x.txt\n", "twice.csv:2: a sample"),
        ("alpha,p,etta\n0.1,3,1\n", "twice.csv:1: column etta: expected"),
        ("alpha,p,eta\n0.1,3,1.5\n", "twice.csv:2"),
        ("alpha,p\n0.1,NaN\n", "twice.csv:2"),
        ("alpha,p\n", "no block"),
    ] {
        fs::write(place.join("twice.csv"), table).unwrap();
        let plan = "sweep plan --suite records --blocks twice.csv --out new";
        refused_for(&place, plan, &[names]);
    }
    let none = "sweep plan --suite records --blocks blocks.csv --out new \
                --tile-blocks 0";
    refused_for(&place, none, &["1 blocks, 0 a tile"]);
}

#[test]
fn the_law_of_a_block_needs_no_analysis_and_refuses_what_it_does_not_know() {
    let place = folder("law", &[]);
    let found = json(&place, "fragility law --alpha 0.15 --p 3 --json");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let ratio = number(&found["median_ratio"]) * libm::tan(0.15);
    let fitted = &found["fitted"];
    assert!((number(&fitted["median"]) / ratio - 1.0).abs() < 1e-12);
    // The fragility holds both dispersions, the total also the model's.
    let both = libm::hypot(
        number(&found["record_dispersion"]),
        number(&found["law_error"]),
    );
    assert!((number(&fitted["dispersion"]) - both).abs() < 1e-12);
    let total = number(&found["total"]["dispersion"]);
    assert!((total - libm::hypot(both, 0.2)).abs() < 1e-12);
    for (flags, words) in [
        ("--alpha 0.7 --p 3", ["alpha in rad 0.7", "0.05 to 0.6"]),
        ("--alpha 0.2 --p 12", ["p in rad/s 12", "0.7 to 8"]),
        ("--alpha 0.2 --p 3 --eta 0.8", ["eta 0.8", "0.85 to 0.986"]),
        ("--alpha 0.2 --p 3 --at 0.1", ["|theta|/alpha 0.1", "0.2 to 1"]),
        ("--alpha 0.2 --p 3 --at NaN", ["|theta|/alpha NaN", "0.2 to 1"]),
    ] {
        refused_for(&place, &format!("fragility law {flags}"), &words);
    }
}

/// The page's commands, in its order: a plan, a job as SLURM starts it, and
/// the fragilities of all blocks as one file for another program.
#[cfg(unix)]
#[test]
fn the_page_on_clusters_runs() {
    let place = planned("sweep-page", 1);
    let table = "id,alpha,p,eta\nshelf,0.15,4,0.9\nstatue,0.2,5,\n";
    fs::write(place.join("blocks.csv"), table).unwrap();
    fs::rename(place.join("plan"), place.join("my plan")).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_rocking")).parent().unwrap();
    let path = env::var("PATH").unwrap();
    let path = format!("{}:{path}", program.display());
    let page = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = fs::read_to_string(page.join("../../docs/cluster.md")).unwrap();
    let blocks: Vec<&str> = page.split("\n```sh\n").skip(1).collect();
    for block in &blocks {
        let block = block.split("\n```\n").next().unwrap();
        let done = Command::new("bash")
            .args(["-euc", block, "job.sh", "my plan"])
            .current_dir(&place)
            .env("PATH", &path)
            .output()
            .unwrap();
        assert!(done.status.success(), "{block}: {done:?}");
    }
    assert_eq!(blocks.len(), 3);
    let tiles = fs::read_dir(place.join("my plan/tiles")).unwrap();
    assert_eq!(tiles.count(), 2);
    let nrml = fs::read_to_string(place.join("blocks.xml")).unwrap();
    assert!(nrml.contains("4 capacities, PGA/(g tan alpha)"), "{nrml}");
    let found = json(
        &place,
        "fragility export --blocks samples/blocks.csv --shift 1 --format csv \
         --out out.csv",
    );
    let merged = fs::read_to_string(place.join("fragilities.csv")).unwrap();
    for (k, id) in ["shelf", "statue"].into_iter().enumerate() {
        assert!(nrml.contains(&format!("id=\"{id}\"")), "{nrml}");
        let own =
            |line: &&str| line.starts_with(id) && line.contains(",pga,1,");
        let row: Vec<&str> =
            merged.lines().find(own).unwrap().split(',').collect();
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        // The median in g: that of PGA/(g tan alpha), times tan alpha.
        let median = number(9) * libm::tan(number(1));
        assert_eq!(found["blocks"][k]["id"], id);
        close(&found["blocks"][k]["median"], median, 1e-8);
        close(&found["blocks"][k]["beta"], number(10), 1e-8);
    }
}

/// In the 95 % interval of a median in PGV each draw has the least onset of
/// its own records for a shift. The fit of a draw is made here: the mean of
/// the logarithms.
#[test]
fn each_draw_of_a_sweep_has_the_shift_of_its_own_records() {
    let place = planned("sweep-shift", 1);
    run(&place);
    let [fragilities, capacities] =
        merged(&place).map(|bytes| String::from_utf8(bytes).unwrap());
    let cells = |line: &str| -> Vec<String> {
        line.split(',').map(str::to_owned).collect()
    };
    let number = |text: &String| text.parse::<f64>().unwrap();
    let curves: Vec<Vec<String>> =
        capacities.lines().skip(1).map(cells).collect();
    let onsets: Vec<f64> = curves.iter().map(|c| number(&c[5])).collect();
    let sample: Vec<f64> =
        curves.iter().map(|c| number(&c[6]) * number(&c[5])).collect();
    assert!(sample.iter().all(|x| x.is_finite()), "{sample:?}");
    let least = |places: &[usize]| {
        places.iter().map(|i| onsets[*i]).fold(f64::INFINITY, f64::min)
    };
    let median = |places: &[usize]| {
        let shift = least(places);
        let logs = places.iter().map(|i| libm::log(sample[*i] - shift));
        shift + libm::exp(logs.sum::<f64>() / places.len() as f64)
    };
    let row = fragilities.lines().find(|line| line.contains(",pgv,1,"));
    let row = cells(row.unwrap());
    let all: Vec<usize> = (0..sample.len()).collect();
    assert!((number(&row[9]) / median(&all) - 1.0).abs() < 1e-9, "{row:?}");
    let stream = format!("sweep/{}", row[1..4].join("/"));
    let draws = Bootstrap::new(&stream, 0, sample.len(), 400);
    let medians = draws.map(|places| {
        // One record again and again makes no fit.
        let one = places.iter().all(|i| *i == places[0]);
        if one { f64::NAN } else { median(places) }
    });
    let (how, range) = (Resampling::Bootstrap, Range::NotNegative);
    let records = Clusters::singletons(sample.len());
    let found = records.estimate(median(&all), &medians, how, range, 0.95);
    let (low, high) = found.unwrap().estimate.ends();
    for (own, expected) in [(&row[11], low), (&row[12], high)] {
        assert!((number(own) / expected - 1.0).abs() < 1e-9, "{row:?}");
    }
    // The least onset of all in every draw gives another interval.
    let drawn = draws.map(|places| least(places) > least(&all));
    assert!(drawn.iter().any(|higher| *higher));
}
