//! Little memory, few threads, a standard output that is closed, and wrong
//! functions of the platform.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::support::{answer, at2, folder, motion};

/// Exit status and standard error of a shell's line, in which `rocking` is
/// the program under test.
fn shell(place: &Path, line: &str) -> (i32, String) {
    let program = env!("CARGO_BIN_EXE_rocking");
    let script = format!("rocking() {{ '{program}' \"$@\"; }}\n{line}");
    let output = Command::new("bash")
        .args(["-c", &script])
        .current_dir(place)
        .output()
        .unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), error)
}

/// A folder with a suite of three records, a block's IDA and a sample.
fn prepared(name: &str) -> crate::support::Place {
    let place = folder(name, &[]);
    fs::create_dir(place.join("suite")).unwrap();
    for rhythm in [7.0, 9.0, 11.0] {
        let samples = motion(rhythm);
        let text = at2("0.02", samples.len(), &samples);
        let file = format!("suite/r{rhythm}_1.at2");
        fs::write(place.join(file), text).unwrap();
    }
    answer(&place, "ida --alpha 0.1 --p 3 --suite suite --out ida.csv");
    answer(&place, "capacities --ida ida.csv --levels 1 --at 1 --out c.txt");
    place
}

/// Threads that cannot be had are no panic. The environment asks for more of
/// them than the memory holds wherever a command does not say how many.
#[cfg(target_os = "linux")]
#[test]
fn no_command_takes_threads_that_it_does_not_ask_for() {
    let place = prepared("threads");
    for command in [
        "verify --family block-geometry",
        "suite export --out export",
        "records suite",
        "records suite --intensity",
        "capacities --ida ida.csv --suite suite --im cav",
        "rank --ida ida.csv --suite suite --at 1 --bootstrap 50",
        "fragility fit --sample c.txt --shift 1 --bootstrap 50",
        "lilliefors --sample c.txt --log",
        "ida --alpha 0.1 --p 3 --suite suite --friction 0.3 --out o.csv",
    ] {
        let line = format!(
            "ulimit -v 4000000; RAYON_NUM_THREADS=4000 rocking {command}"
        );
        let (status, error) = shell(&place, &line);
        assert_eq!(status, 0, "{command}: {error}");
    }
}

/// Where a thread cannot be started, that is said.
#[cfg(target_os = "linux")]
#[test]
fn threads_that_cannot_be_started_are_a_refusal() {
    let place = prepared("no-threads");
    // A thread takes some MiB of addresses; the stacks of none fit in.
    let line = "ulimit -v 4000000; export RUST_MIN_STACK=8000000000; \
                rocking verify --family free-rocking";
    let (status, error) = shell(&place, line);
    assert_eq!(status, 2, "{error}");
    assert!(error.contains("threads cannot be started: "), "{error}");
}

/// A message says what cannot be allocated; SIGABRT gives the status. The
/// program fits into 200 MB of addresses; four million values do not.
#[cfg(target_os = "linux")]
#[test]
fn memory_that_runs_out_is_said() {
    let place = folder("memory", &[]);
    let line = |values: u32| {
        format!(
            "ulimit -v 200000; \
             rocking sample --sample <(seq 1 {values}) --at 0.5 >/dev/null"
        )
    };
    assert_eq!(shell(&place, &line(100)), (0, String::new()));
    let (status, error) = shell(&place, &line(4_000_000));
    assert_eq!(status, 128 + 6, "{error}");
    assert!(error.contains("memory allocation of "), "{error}");
}

#[cfg(unix)]
#[test]
fn a_result_for_a_closed_standard_output_is_refused() {
    let place = prepared("closed");
    for command in [
        "capacities --ida ida.csv --levels 1",
        "capacities --ida ida.csv --levels 1 --json",
        "capacities --ida ida.csv --levels 1 --at 1 --out -",
        "fragility fit --sample c.txt --shift 1",
        "records suite",
        "ida --alpha 0.1 --p 3 --suite suite --out -",
    ] {
        let (status, error) = shell(&place, &format!("rocking {command} >&-"));
        assert_eq!(status, 2, "{command}");
        let words = "standard output: it is closed, or /dev/null opened for";
        let written = "cannot write -: it is closed, or /dev/null opened for";
        assert!(error.contains(words) || error.contains(written), "{error}");
        for silent in [">/dev/null", "1<>/dev/null 2<>/dev/null"] {
            let line = format!("rocking {command} {silent}");
            assert_eq!(shell(&place, &line).0, 0, "{line}");
        }
    }
    // What stands in a file is not lost.
    let line = "rocking ida --alpha 0.1 --p 3 --suite suite --out o.csv >&-";
    assert_eq!(shell(&place, line), (0, String::new()));
    assert!(place.join("o.csv").exists());
}

/// The last digits of the platform's elementary functions differ between
/// platforms. No result depends on them: if the twelfth digit of each function is
/// wrong, every byte stays.
#[cfg(target_os = "linux")]
#[test]
fn no_result_depends_on_the_functions_of_the_platform() {
    let place = prepared("platform");
    let define = |names: &str, given: &str, passed: &str| -> String {
        let line = |name| {
            format!(
                "double {name}({given}) {{ return {name}l({passed}) * \
                 (1 + 1e-12); }}\n"
            )
        };
        names.split(' ').map(line).collect()
    };
    let wrong = [
        "#include <math.h>\n".to_owned(),
        define(
            "exp exp2 expm1 log log1p log2 log10 sin cos tan asin acos atan \
             sinh cosh tanh asinh acosh atanh cbrt erf erfc lgamma tgamma",
            "double x",
            "x",
        ),
        define("hypot atan2", "double x, double y", "x, y"),
        // Whole powers of ten, from which plotters makes ticks, are exact.
        "double pow(double x, double y) { return powl(x, y) * \
         (1 + 1e-12 * (y != rint(y))); }\n"
            .to_owned(),
        define("fma", "double x, double y, double z", "x, y, z"),
    ];
    let objects = "id,width_m,height_m\nstele,0.35,1.4\nvase,0.2,0.8\n";
    let hazard = "pga_g,annual_frequency\n0.05,0.04\n0.5,6e-4\n3,1e-6\n";
    for (name, text) in [
        ("wrong.c", &*wrong.concat()),
        (
            "ask.c",
            "double exp(double);\nint main(int n) { return exp(0 * n) == 1; }",
        ),
        ("objects.csv", objects),
        ("hazard.csv", hazard),
    ] {
        fs::write(place.join(name), text).unwrap();
    }
    let build = "set -e; cc -w -fno-builtin -shared -fPIC -o wrong.so wrong.c -lm; \
                 cc -w -fno-builtin -o ask ask.c -lm; \
                 if ./ask; then exit 1; fi; LD_PRELOAD=$PWD/wrong.so ./ask";
    assert_eq!(shell(&place, build), (0, String::new()));
    for command in [
        "respond --alpha 0.1 --p 3 --record suite/r9_1.at2 --im 3 --certify",
        "ida --alpha 0.1 --p 3 --suite suite --out -",
        "records suite --intensity",
        "rank --ida ida.csv --suite suite --at 1 --bootstrap 50",
        "fragility fit --sample c.txt --shift 1 --bootstrap 50",
        "lilliefors --sample c.txt --log --replicates 500",
        "lilliefors --critical-values --n 44 --replicates 500",
        "stripes --ida ida.csv --levels 1.5,2,3",
        "assess --suite suite --objects objects.csv --hazard hazard.csv \
         --bootstrap 50 --out page; cat page/*",
        "verify --family estimators --json",
    ] {
        let program = env!("CARGO_BIN_EXE_rocking");
        let line = format!(
            "set -e; all() {{ rm -rf page; rocking {command}; }}; all > right; \
             rocking() {{ LD_PRELOAD=$PWD/wrong.so '{program}' \"$@\"; }}; \
             all > wrong; cmp right wrong"
        );
        let (status, error) = shell(&place, &line);
        assert_eq!(status, 0, "{command}: {error}");
    }
}
