//! Commands that a signal ends, or a crash: what is left, and what the exit
//! status says.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::support::{answer, at2, folder, motion, rocking, run, tree};

const STEP: Duration = Duration::from_millis(20);

/// Signals and their numbers.
const INT: (&str, u32) = ("INT", 2);
const TERM: (&str, u32) = ("TERM", 15);
const HUP: (&str, u32) = ("HUP", 1);

/// A folder with three motions, and a block.
fn scene(name: &str) -> crate::support::Place {
    let records = [7.0, 9.0, 11.0].map(|rhythm| {
        let samples = motion(rhythm);
        (format!("s/r{rhythm}.at2"), at2("0.02", samples.len(), &samples))
    });
    let mut files: Vec<(&str, &str)> =
        vec![("blocks.csv", "alpha,p\n0.1,3\n")];
    files.extend(records.iter().map(|(n, t)| (n.as_str(), t.as_str())));
    folder(name, &files)
}

/// Sends a signal to a program.
fn send(child: &Child, signal: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-s", signal, &id]).status();
    assert!(sent.unwrap().success());
}

/// Whether Linux lists a signal under a key of a program's status; none
/// elsewhere.
fn has(child: &Child, key: &str, signal: u32) -> Option<bool> {
    let path = format!("/proc/{}/status", child.id());
    let status = fs::read_to_string(path).ok()?;
    let mask = status.lines().find_map(|line| line.strip_prefix(key))?;
    let mask = u64::from_str_radix(mask.trim(), 16).ok()?;
    Some(mask >> (signal - 1) & 1 == 1)
}

/// Starts a command, and waits until it has opened what it writes and handles
/// signals.
fn begun(place: &Path, arguments: &str) -> Child {
    let files = tree(place).len();
    let mut child = rocking(place, arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while tree(place).len() == files
        || has(&child, "SigCgt:", TERM.1) == Some(false)
    {
        assert!(child.try_wait().unwrap().is_none(), "{arguments}: ended");
        sleep(STEP);
    }
    // It is at its work, not about to begin it.
    sleep(10 * STEP);
    child
}

/// Work that takes minutes, by the command.
const LONG: [&str; 5] = [
    "ida --alpha 0.1 --p 1 --suite s --step-g 2e-6 --certify --out o.csv",
    "assess --alpha 0.1 --p 3 --suite s --bootstrap 1000000 --out page",
    "study --out report",
    "study --ordinary s --pulse s --out report",
    "fragility fit --ida ida.csv --at 1 --bootstrap 1000000 --plot o.svg",
];

#[test]
fn a_signal_ends_every_long_command_cleanly() {
    let place = scene("stopped");
    answer(&place, "ida --alpha 0.1 --p 3 --suite s --out ida.csv");
    let before = tree(&place);
    for (k, arguments) in LONG.into_iter().enumerate() {
        for signal in [[INT, TERM, HUP][k % 3], TERM] {
            let child = begun(&place, arguments);
            // Behind a shell's `&`, or `nohup`, one may be ignored.
            let is_ignored = has(&child, "SigIgn:", signal.1) == Some(true);
            let (signal, _) = if is_ignored { TERM } else { signal };
            send(&child, signal);
            let ended = child.wait_with_output().unwrap();
            let error = String::from_utf8(ended.stderr).unwrap();
            let at = format!("{arguments}, {signal}: {error}");
            assert_eq!(ended.status.code(), Some(1), "{at}");
            assert!(error.ends_with("rocking: stopped by a signal\n"), "{at}");
            assert!(ended.stdout.is_empty(), "{at}");
            assert!(tree(&place) == before, "{at}");
        }
    }
}

/// `nohup` and a shell's `&` start a program with signals ignored.
#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_was_ignored_stays_so() {
    let place = scene("nohup");
    let script = format!(
        "trap '' HUP && exec '{}' {}",
        env!("CARGO_BIN_EXE_rocking"),
        LONG[0]
    );
    let files = tree(&place).len();
    let mut child = Command::new("bash")
        .args(["-c", &script])
        .current_dir(&place)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while tree(&place).len() == files {
        assert!(child.try_wait().unwrap().is_none(), "ended");
        sleep(STEP);
    }
    sleep(10 * STEP);
    send(&child, "HUP");
    sleep(20 * STEP);
    assert!(child.try_wait().unwrap().is_none());
    send(&child, "TERM");
    assert_eq!(child.wait().unwrap().code(), Some(1));
}

#[test]
fn after_a_kill_the_same_command_works_at_once() {
    let place = scene("killed");
    let short =
        "assess --alpha 0.1 --p 3 --suite s --bootstrap 100 --out page";
    let mut child = begun(&place, LONG[1]);
    child.kill().unwrap();
    child.wait().unwrap();
    let names = || fs::read_dir(place.join("page")).unwrap().count();
    assert_eq!(names(), 1, "the kill left something");
    assert_eq!(run(&place, short).0, 0);
    // Nothing but what another run of it writes.
    let found = tree(&place.join("page"));
    assert_eq!(run(&place, &short.replace("page", "other")).0, 0);
    let names = |tree: &[(std::path::PathBuf, Vec<u8>)]| -> Vec<String> {
        let name = |p: &Path| p.file_name().unwrap().display().to_string();
        tree.iter().map(|(path, _)| name(path)).collect()
    };
    assert_eq!(names(&found), names(&tree(&place.join("other"))));
    // That is a whole one, which the same command does not replace.
    let (status, _, error) = run(&place, short);
    assert_eq!(status, 2);
    assert!(error.contains("directory not empty"), "{error}");
}

/// The program decides 0, 1 and 2; a crash has another status.
#[cfg(target_os = "linux")]
#[test]
fn a_crash_has_the_status_of_no_decision() {
    let place = scene("crash");
    let script = format!(
        "ulimit -c 0; ulimit -s 64; '{}' ida --alpha 0.1 --p 3 --suite s \
         --out o.csv",
        env!("CARGO_BIN_EXE_rocking")
    );
    let output = Command::new("bash")
        .args(["-c", &script])
        .current_dir(&place)
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("overflow"), "{error}");
    use std::os::unix::process::ExitStatusExt as _;
    let status = output.status;
    assert!(status.signal().is_some() || status.code() > Some(128), "{error}");
}
