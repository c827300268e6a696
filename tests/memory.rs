//! What reading takes in memory: no more than 20 MiB for a tenth of 1 MiB of
//! anything, and no more than 64 MiB for 1 MiB that is packed; and what any
//! command takes for 1 MiB of anything that it reads: 256 MiB, the program
//! itself and its threads included.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{Cursor, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};

use peak_alloc::PeakAlloc;
use rocking::stop::Stop;
use rocking_common::suites::inputs::SuiteInput;
use rocking_records::{Processing, ReadOptions};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

#[path = "fuzz/targets.rs"]
mod targets;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

const MIB: usize = 1 << 20;

/// Size of the many inputs that a reader in this process reads: each costs a
/// tenth of the time that 1 MiB takes.
const READ: usize = MIB / 10;

/// Limit of the memory for one of them: a list of names takes 16 MiB.
const MOST: usize = 20 * MIB;

const EMPTY: &[u8] = &{
    let mut line = [b','; 1003];
    line[0] = b'x';
    line[1002] = b'\n';
    line
};

/// What goes on for as long as a file does.
const FILLS: [&[u8]; 15] = [
        b"0,0\n",
        b"1,",
        b"-1",
        b"1.",
        b"\xe9",
        b"\"\"",
        b"   .1000000E-02  -.2000000E-02   .3000000E-02   .4000000E-02  -.5000000E-02\n",
        b"10 acceleration pts, units=cm/sec2, Format=(8F10.3)\n",
        b"10 points of accel data equally spaced at .02 sec, in cm/sec2. (8f10.3)\n     1.000     1.000     1.000     1.000     1.000     1.000     1.000     1.000\n     1.000     1.000\n",
        b"a,0.01\n",
        EMPTY,
        b"\n",
        b"0\n",
        b"1 ",
        b"1,2\n",
    ];

fn filled(seed: &[u8], fill: &[u8], size: usize) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    while bytes.len() < size {
        bytes.extend(fill);
    }
    bytes.truncate(size);
    bytes
}

/// Beginnings that lead a reader on, and what then goes on.
fn hostile() -> Vec<(String, Vec<u8>)> {
    let corpus =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/fuzz/corpus");
    let mut seeds = vec![(String::new(), Vec::new())];
    for target in targets::names() {
        for entry in fs::read_dir(corpus.join(target)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.display().to_string();
            if name.contains("valid-") || name.contains("announces") {
                seeds.push((name, fs::read(path).unwrap()));
            }
        }
    }
    let columns: String = (0..1000).map(|i| format!("c{i},")).collect();
    seeds.push(("columns".to_owned(), format!("file,{columns}\n").into()));
    let long = "n".repeat(64);
    seeds.push(("names".to_owned(), format!("{long},file\n").into()));
    let mut inputs = Vec::new();
    for (name, seed) in &seeds {
        // After a valid header, what a sample or a line costs.
        let fills = if seed.is_empty() { &FILLS[..] } else { &FILLS[9..] };
        for fill in fills {
            let bytes = filled(seed, fill, READ);
            let with = String::from_utf8_lossy(&fill[..fill.len().min(20)]);
            inputs.push((format!("{name} and {with:?}"), bytes));
        }
    }
    inputs
}

/// Whether a target is meant for such a file: `any` for all of them.
fn meant(target: &str, name: &str) -> bool {
    let own = name.contains(&format!("corpus/{target}/"));
    own || !name.contains("corpus/")
}

/// Valid files of every kind, of `size` bytes or a little less, whose samples
/// take as few bytes as the format allows.
fn dense(size: usize) -> Vec<(&'static str, Vec<u8>)> {
    let rows = |head: String, row: &str| {
        let room = (size - head.len()) / row.len();
        head + &row.repeat(room)
    };
    let counted = |head: &dyn Fn(usize) -> String, row: &str, each: usize| {
        let room = (size - head(size).len()) / row.len();
        head(room * each) + &row.repeat(room)
    };
    let at2 = |n: usize| {
        format!(
            "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {n}, DT= .01 SEC\n"
        )
    };
    let esm = |n: usize| {
        format!(
            "SAMPLING_INTERVAL_S: 0.01\nNDATA: {n}\nUNITS: cm/s^2\n\
             DATA_TYPE: ACCELERATION\n"
        )
    };
    let knet = |n: usize| {
        format!(
            "Sampling Freq(Hz) 1Hz\nDuration Time(s) {n}\n\
             Scale Factor 2000(gal)/8388608\nMemo.\n"
        )
    };
    let csmip = |n: usize| {
        format!(
            "{n} points of accel data equally spaced at .01 sec, in cm/sec2. (64f2.0)\n"
        )
    };
    let mut times = String::new();
    for i in 0.. {
        let row = format!("{},0\n", i % 10);
        if times.len() + row.len() > size {
            break;
        }
        times.push_str(&row);
    }
    let spaced = counted(&at2, " 1 1 1 1\n", 4);
    let one_line = at2((size - 100) / 2) + &" 1".repeat((size - 100) / 2);
    let latin_1 = [b"#\xe9\n".to_vec(), b"0\n".repeat(size / 2 - 2)].concat();
    vec![
        ("column", rows(String::new(), "0\n").into()),
        ("Latin-1", latin_1),
        ("times", times.into()),
        ("at2", spaced.into()),
        ("at2 in one line", one_line.into()),
        ("at2, one a line", counted(&at2, "1\n", 1).into()),
        ("esm", counted(&esm, "0\n", 1).into()),
        ("knet", counted(&knet, " 1 1 1 1\n", 4).into()),
        ("csmip", counted(&csmip, &(" 1".repeat(64) + "\n"), 64).into()),
    ]
}

/// An archive with `files`, which are small once packed, and a hidden file
/// that fills it up.
fn packed(files: &[(&str, &[u8])]) -> Vec<u8> {
    let method = SimpleFileOptions::default().compression_level(Some(1));
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, method).unwrap();
        zip.write_all(bytes).unwrap();
    }
    let archive = zip.finish().unwrap();
    let room = MIB.saturating_sub(archive.get_ref().len() + 100);
    let mut zip = ZipWriter::new_append(archive).unwrap();
    let method = method.compression_method(CompressionMethod::Stored);
    zip.start_file(".fill", method.compression_level(None)).unwrap();
    zip.write_all(&vec![0; room]).unwrap();
    zip.finish().unwrap().into_inner()
}

/// Memory in bytes that reading an archive takes, and what came of it.
fn reading(archive: &[u8]) -> (usize, Result<(), String>) {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let result = targets::run("zip", archive);
    (ALLOCATOR.peak_usage() - before, result)
}

fn a_packed_megabyte_takes_no_more_either() {
    let mut index = String::from(
        "Record Sequence Number,Horizontal-1 Acc. Filename,\
         Horizontal-2 Acc. Filename",
    );
    index.extend((0..1000).map(|i| format!(",c{i}")));
    index.push('\n');
    while index.len() < MIB / 2 - 3000 {
        index.push_str("1,a.txt,b.txt");
        index.push_str(&",".repeat(1000));
        index.push('\n');
    }
    let mut archives = Vec::new();
    for fill in FILLS.iter().step_by(4) {
        let bytes = filled(b"", fill, 6 * MIB - 4096);
        let with = String::from_utf8_lossy(&fill[..fill.len().min(20)]);
        archives.push((format!("{with:?}"), packed(&[("a.txt", &bytes)])));
    }
    let half = dense((6 * MIB - MIB / 2) / 2 - 4096);
    for (name, bytes) in dense(6 * MIB - 4096) {
        archives.push((name.to_owned(), packed(&[("a.txt", &bytes)])));
    }
    for (name, bytes) in half.into_iter().step_by(3) {
        let results = ("_SearchResults.csv", index.as_bytes());
        let files = [results, ("a.txt", &*bytes), ("b.txt", &*bytes)];
        archives.push((format!("{name} by an index"), packed(&files)));
    }
    let names: Vec<String> = (0..2000).map(|i| i.to_string()).collect();
    let empty: Vec<(&str, &[u8])> =
        names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    archives.push(("empty files".to_owned(), packed(&empty)));
    // A thousand times their size.
    let bomb = vec![b'0'; 16 * MIB];
    let files: Vec<(&str, &[u8])> =
        names[..4].iter().map(|name| (name.as_str(), &bomb[..])).collect();
    archives.push(("bombs".to_owned(), packed(&files)));
    for (name, archive) in &archives {
        assert!(archive.len() <= MIB + MIB / 8, "{name}: {}", archive.len());
        let (used, result) = reading(archive);
        println!("{name}: {} MiB, {result:?}", used as f64 / MIB as f64);
        assert!(used <= 64 * MIB, "{name}");
    }
}

/// The samples of a suite that is worked off in blocks stay in their files.
fn profiles_hold_no_samples() {
    const RECORDS: usize = 80;
    const SAMPLES: usize = 100_000;
    let place = tempfile::tempdir().unwrap();
    let text = dense(2 * SAMPLES).swap_remove(0).1;
    fs::write(place.path().join("a.txt"), text).unwrap();
    let rows = (0..RECORDS).map(|k| format!("a.txt,r{k},g,0.01\n"));
    let index = format!("file,name,units,dt_s\n{}", rows.collect::<String>());
    let path = place.path().join("i.csv");
    fs::write(&path, index).unwrap();
    let (read, none) = (ReadOptions::default(), Processing::default());
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let work = || {
        let mut seen = 0;
        let found = SuiteInput::read(&path, read, &none, SAMPLES);
        let (input, suite) = found.map_err(|error: anyhow::Error| error)?;
        let members: Vec<_> = suite.members().iter().collect();
        input.each(&members, |record, _| {
            assert_eq!(record.samples_g().len(), SAMPLES);
            seen += 1;
            anyhow::Ok(())
        })?;
        anyhow::Ok(seen)
    };
    // More threads read more files at a time.
    assert_eq!(Stop::default().run(2, work).unwrap().unwrap(), RECORDS);
    let used = ALLOCATOR.peak_usage() - before;
    let held = RECORDS * SAMPLES * size_of::<f64>();
    println!("a suite in blocks: {} MiB", used as f64 / MIB as f64);
    assert!(4 * used < held, "{used} bytes, all samples {held}");
}

/// One test: two at a time would count each other's memory.
#[test]
fn a_megabyte_takes_no_more_than_sixty_four() {
    no_command_takes_more_than_its_share(no_reader_takes_more);
}

fn no_reader_takes_more() {
    a_packed_megabyte_takes_no_more_either();
    profiles_hold_no_samples();
    let mut most: BTreeMap<&str, (usize, String)> = BTreeMap::new();
    for (name, bytes) in hostile() {
        for target in targets::names() {
            if !meant(target, &name) {
                continue;
            }
            let before = ALLOCATOR.current_usage();
            ALLOCATOR.reset_peak_usage();
            let _ = targets::run(target, &bytes);
            let used = ALLOCATOR.peak_usage() - before;
            let most = most.entry(target).or_default();
            if used > most.0 {
                *most = (used, name.clone());
            }
        }
    }
    for (target, (used, name)) in &most {
        println!("{target}: {} MiB for {name}", used / MIB);
    }
    assert_eq!(most.len(), targets::names().count());
    assert!(most.values().all(|(used, _)| *used <= MOST));
}

/// Files of 1 MiB by name, each for the commands that read a file behind
/// these options; without an option for all.
fn bombs() -> Vec<(&'static str, &'static [&'static str], Vec<u8>)> {
    const BLOCKS: &[&str] = &["--objects", "--blocks"];
    const HAZARD: &[&str] = &["--hazard"];
    const COUNTS: &[&str] = &["--counts"];
    let goes_on =
        |seed: &str, fill: &str| filled(seed.as_bytes(), fill.as_bytes(), MIB);
    let columns: String = (0..1000).map(|i| format!(",c{i}")).collect();
    let commas = ",".repeat(1000);
    let rows: String = (0..1000).map(|i| format!("r{i}{commas}\n")).collect();
    let columns = format!("record{columns}\n{rows}");
    let level = |k: usize| {
        let edp = if k == 1 { 0.0 } else { 0.5 };
        format!("A,0.2,3,{k},1,{k},{k},{edp},rocked,0.5{IDA_END}")
    };
    let named =
        |k: usize| format!("r{k},0.2,3,1,1,1,1,0,no-uplift,1{IDA_END}");
    let point = |k: usize| format!("{k},{}\n", 1.0 / k as f64);
    let block = |k: usize| format!("0.2,{}\n", 2.0 + k as f64 / 50_000.0);
    vec![
        ("line", &[], goes_on("", "1,")),
        ("rows", &[], goes_on("", "1\n")),
        ("quotes", &[], goes_on("", "\"")),
        ("comments", &[], goes_on("", "# x\n")),
        ("empty", &[], goes_on("", "\n")),
        ("deep.json", &[], goes_on("", "[")),
        ("keys.json", &["diff"], goes_on("", "{\"a\":")),
        ("blocks", BLOCKS, goes_on("alpha,p\n", ",\n")),
        ("floors", &["--floors"], goes_on("name,period_s\n", ",\n")),
        ("counts", COUNTS, goes_on("intensity,exceeded,n\n", "1,1,2\n")),
        ("many", COUNTS, goes_on("intensity,exceeded,n\n", "1,1,1000000\n")),
        ("out", COUNTS, goes_on("intensity,record,exceeded\n", "1,a,1\n")),
        ("hazard", HAZARD, goes_on("pga_g,annual_frequency\n", "1,1\n")),
        ("oq", HAZARD, goes_on("#imt='PGA'\nlon,lat,poe-1\n", "1,1,1\n")),
        ("answers", &["score"], goes_on("scene,quantity,value\n", ",,\n")),
        ("columns", &["--attributes", "--suite"], columns.into()),
        ("levels", &["--ida"], whole(IDA_HEAD, &level)),
        ("names", &["--ida"], whole(IDA_HEAD, &named)),
        ("rises", HAZARD, whole("pga_g,annual_frequency\n", &point)),
        ("sizes", &["--blocks"], whole("alpha,p\n", &block)),
    ]
}

/// A table of 1 MiB at most that is read to its end.
fn whole(head: &str, row: &dyn Fn(usize) -> String) -> Vec<u8> {
    let mut text = head.to_owned();
    for k in 1.. {
        let row = row(k);
        if text.len() + row.len() > MIB {
            break;
        }
        text.push_str(&row);
    }
    text.into()
}

const IDA_HEAD: &str = "record,alpha_rad,p_rad_s,pga_g,pgv_m_s,intensity_pga,intensity_pgv,edp,outcome,margin,remarks,event,eta,model,order,overturn,by,gravity_m_s2,processing,software\n";
/// How each row of such a table ends, behind the margin.
const IDA_END: &str =
    ",,,0.92,nonlinear,,alpha,record-scaling,9.80665,none,x\n";

/// Commands that need more than their usage says, and what each reads in place
/// of FILE.
const COMMANDS: [&str; 22] = [
    "assess --objects FILE --out out",
    "assess --objects objects.csv --floors FILE --out out",
    "assess --objects objects.csv --suite FILE --out out",
    "capacities --ida FILE --levels 1",
    "diff FILE FILE",
    "fragility counts --counts FILE --bootstrap 2",
    "fragility export --law --format csv --blocks FILE --out -",
    "fragility fit --sample FILE",
    "ida --alpha 0.2 --p 2 --suite FILE --units g --dt 0.01 --step-im 9 --out -",
    "lilliefors --sample FILE --shift min",
    "rank --at 1 --ida FILE --suite one",
    "rank --at 1 --ida small.csv --suite one --attributes FILE",
    "records FILE --units g --dt 0.01",
    "respond --record FILE --units g --dt 0.01 --alpha 0.2 --p 2",
    "risk --median 0.4 --dispersion 0.5 --years 50 --hazard FILE",
    "score FILE",
    "stripes --levels 1 --ida FILE",
    "study --ordinary FILE --pulse FILE --out out",
    "suite export --suite FILE --units g --dt 0.01 --out out",
    "sweep plan --suite FILE --units g --dt 0.01 --blocks objects.csv --out out",
    "sweep plan --suite one --blocks FILE --out out",
    "validate FILE --units g --dt 0.01 --alpha 0.2 --p 2",
];

/// Commands that read a whole suite, here of equal records.
const OF_SUITES: [&str; 4] = ["ida", "records", "suite", "sweep"];

/// Address space of a command in KiB.
const MOST_KIB: usize = 256 << 10;

/// A command with FILE for each file that its usage asks for; none where it
/// asks for no file.
fn reading_line(name: &str, help: &str) -> Option<String> {
    let usage = help.lines().find_map(|l| l.strip_prefix("Usage: rocking "));
    let words = usage.unwrap().split_whitespace();
    let words = words.filter(|word| !word.starts_with('['));
    let words = words.map(|word| match word {
        "<FILE>" | "<PATH>" => "FILE",
        other => other,
    });
    let line = words.collect::<Vec<_>>().join(" ");
    let reads = line.contains("FILE");
    let may_read = help.contains("<FILE>") || help.contains("<PATH>");
    // `speed` takes minutes.
    assert!(reads || !may_read || name == "speed", "{name}: no bomb");
    reads.then_some(line)
}

/// Runs commands on hostile files, each a process with its own memory, while
/// `meanwhile` measures the memory of this process.
fn no_command_takes_more_than_its_share(meanwhile: impl FnOnce()) {
    let program = env!("CARGO_BIN_EXE_rocking");
    let help = |arguments: &[&str]| {
        let out = Command::new(program).args(arguments).arg("--help").output();
        String::from_utf8(out.unwrap().stdout).unwrap()
    };
    let mut commands = COMMANDS.map(str::to_owned).to_vec();
    let all = help(&[]);
    let named = all.lines().filter_map(|line| line.strip_prefix("  "));
    let named = named.filter(|line| line.starts_with(char::is_alphabetic));
    for name in named.filter_map(|line| line.split_whitespace().next()) {
        if !COMMANDS.iter().any(|line| line.starts_with(name)) {
            commands.extend(reading_line(name, &help(&[name])));
        }
    }
    let place = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        fs::write(place.path().join(name), bytes).unwrap();
    };
    let bombs = bombs();
    for (name, _, bytes) in &bombs {
        assert!(bytes.len() <= MIB, "{name}");
        write(name, bytes);
    }
    write("objects.csv", b"alpha,p\n0.2,2\n");
    let rows = [
        "A,0.2,3,0.2,0.1,1,0.5,0,no-uplift,inf",
        "A,0.2,3,0.3,0.2,1.5,0.75,0.4,rocked,0.6",
        "A,0.2,3,0.4,0.3,2,1,inf,overturned,0.1",
    ];
    let rows = rows.map(|row| format!("{row}{IDA_END}")).concat();
    write("small.csv", [IDA_HEAD, &rows].concat().as_bytes());
    let record = "ACCELERATION TIME SERIES IN UNITS OF G\n\
                  NPTS= 200, DT= .01 SEC\n"
        .to_owned()
        + &" .01 -.02 .03 -.04 .05\n".repeat(40);
    for folder in ["folder", "one"] {
        fs::create_dir(place.path().join(folder)).unwrap();
    }
    write("one/A.AT2", record.as_bytes());
    let method = SimpleFileOptions::default().compression_level(Some(1));
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for k in 0..400 {
        let name = format!("r{k}.AT2");
        zip.start_file(&*name, method).unwrap();
        zip.write_all(record.as_bytes()).unwrap();
        write(&format!("folder/{name}"), record.as_bytes());
    }
    write("equal.zip", &zip.finish().unwrap().into_inner());
    let mut runs = Vec::new();
    let mut behind_options = BTreeSet::new();
    for (k, command) in commands.iter().enumerate() {
        for (j, (file, behind, _)) in bombs.iter().enumerate() {
            let reads =
                |name: &&str| command.contains(&format!("{name} FILE"));
            // What any command may read, every third one in turn; what the
            // reader of an option reads, all of it for its first command.
            let is_own = behind.iter().any(reads);
            let is_first = is_own && behind_options.insert(*file);
            let is_next = (is_own || behind.is_empty()) && (j + k) % 3 == 0;
            if is_first || is_next {
                runs.push(command.replace("FILE", file));
            }
        }
        let is_of_suites = OF_SUITES.iter().any(|c| command.starts_with(c));
        if is_of_suites && command.contains("FILE --") {
            runs.push(command.replace("FILE", "equal.zip"));
            runs.push(command.replace("FILE", "folder"));
        }
    }
    let limited = format!("ulimit -v {MOST_KIB}; exec \"$0\" \"$@\"");
    let run = |arguments: &String| {
        let out = Command::new("sh")
            .args(["-c", &limited, program])
            .args(arguments.split_whitespace())
            .current_dir(place.path())
            .envs([("RAYON_NUM_THREADS", "2"), ("MALLOC_ARENA_MAX", "1")])
            .stdout(Stdio::null())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stderr);
        // What memory, or the command's own usage, refuses reads no file.
        let words = ["allocation", "panic", "try '--help'"];
        let is_read = !words.iter().any(|word| said.contains(word));
        let status = out.status.code();
        assert!(
            is_read && status.is_some_and(|code| code <= 2),
            "{arguments}: {status:?}\n{said}"
        );
    };
    drop(bombs);
    std::thread::scope(|scope| {
        scope.spawn(|| runs.iter().for_each(run));
        meanwhile();
    });
}
