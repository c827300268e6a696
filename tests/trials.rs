//! Random scenes by address: what double precision and wider arithmetic make
//! of them. `TRIALS=stratum:first:count` chooses them.

use rocking_validation::trials::{
    Judgement, Reading, Stratum, Summary, findings,
};

/// Scenes that are looked at where the environment chooses none.
const DEFAULT: &str = "ordinary:0:8";

/// So many findings, at most, are all printed.
const FEW: usize = 40;

fn chosen(text: &str) -> Option<(Stratum, std::ops::Range<u64>)> {
    let mut parts = text.split(':');
    let stratum = Stratum::named(parts.next()?)?;
    let first: u64 = parts.next()?.parse().ok()?;
    let count: u64 = parts.next()?.parse().ok()?;
    let end = first.checked_add(count)?;
    parts.next().is_none().then_some((stratum, first..end))
}

/// Prints every bad finding, and all of them where there are few.
#[test]
fn no_clear_run_is_wrong() {
    let text = std::env::var("TRIALS").unwrap_or_else(|_| DEFAULT.to_owned());
    let (stratum, indices) = chosen(&text).unwrap_or_else(|| {
        panic!("TRIALS={text}: expected stratum:first:count")
    });
    let found = findings(stratum, indices).unwrap();
    let mut bad = 0;
    for finding in &found {
        let judgement = Judgement::of(finding, Reading::Whole);
        if judgement.is_bad() || found.len() <= FEW {
            println!("{judgement:?}: {finding}");
        }
        bad += usize::from(judgement.is_bad());
    }
    println!("{}", Summary::of(&found, Reading::Whole));
    assert_eq!(bad, 0, "of {} scenes, {text}", found.len());
}

#[test]
fn a_scene_follows_from_its_address() {
    use rocking_validation::trials::trial;
    for stratum in Stratum::ALL {
        for index in 0..8 {
            let (a, b) = (trial(stratum, index), trial(stratum, index));
            assert_eq!(a.unwrap(), b.unwrap());
        }
    }
}
