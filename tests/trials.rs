//! Random scenes by address: what double precision and wider arithmetic make
//! of them. `TRIALS=stratum:first:count` chooses them.
//!
//! And what double precision resolves of a suite: `SUITES=embedded`, or the two
//! indices of recorded suites with a comma between, prints the table of
//! `src/certainty.md`.

use std::path::Path;

use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::integrator::Order;
use rocking_common::paper::BLOCKS;
use rocking_common::paper::SuiteKind;
use rocking_common::suites::StudySuite;
use rocking_proof::cases::WrongModel;
use rocking_proof::trials::{
    CertificateReading, Judgement, Stratum, findings, trial,
};
use rocking_records::{Processing, ReadOptions};

#[path = "trials/orders.rs"]
mod orders;
#[path = "trials/suites.rs"]
mod suites;
#[path = "trials/words.rs"]
mod words;

use orders::Held;
use suites::{Count, Survey};

/// Scenes that are looked at where the environment chooses none.
const DEFAULT: &str = "ordinary:0:8";

/// So many findings, at most, are all printed.
const FEW: usize = 40;

/// Characters of a scene that are still printed.
const LONG: usize = 2000;

/// Share of its estimate from which on an error is printed.
const NEAR: f64 = 0.1;

fn chosen(text: &str) -> Option<(Stratum, std::ops::Range<u64>)> {
    let mut parts = text.split(':');
    let stratum = {
        let name = parts.next()?;
        Stratum::ALL.into_iter().find(|stratum| stratum.name() == name)?
    };
    let first: u64 = parts.next()?.parse().ok()?;
    let count: u64 = parts.next()?.parse().ok()?;
    let end = first.checked_add(count)?;
    parts.next().is_none().then_some((stratum, first..end))
}

/// Prints every bad finding, those near their estimate, and all of them where
/// there are few.
#[test]
fn no_clear_run_is_wrong() {
    let text = std::env::var("TRIALS").unwrap_or_else(|_| DEFAULT.to_owned());
    let (stratum, indices) = chosen(&text).unwrap_or_else(|| {
        panic!("TRIALS={text}: expected stratum:first:count")
    });
    let found = findings(stratum, &indices.collect::<Vec<_>>()).unwrap();
    let mut bad = 0;
    for finding in &found {
        let judgement = Judgement::of(finding, CertificateReading::WHOLE);
        let near = matches!(judgement, Judgement::Within(r) if r >= NEAR);
        if judgement.is_bad() || near || found.len() <= FEW {
            println!("{judgement:?}: {}", words::finding(finding));
            let address = finding.name.split([':', ' ']).nth(1);
            let index = address.and_then(|index| index.parse().ok());
            let scene = index.map(|index| trial(stratum, index));
            let scene = format!("{scene:?}");
            if scene.len() < LONG {
                println!("  {scene}");
            }
        }
        bad += usize::from(judgement.is_bad());
    }
    println!("{}", words::summary(&found));
    assert_eq!(bad, 0, "of {} scenes, {text}", found.len());
}

/// Scenes that were wrong and clear once: a long Ricker pulse, whose block
/// passes its saddle at 4e-8 rad/s.
#[test]
fn what_was_wrong_and_clear_once_is_not_again() {
    let found = findings(Stratum::Grazing, &[1241]).unwrap();
    let wrong = Judgement::of(
        &found[0],
        CertificateReading(Some(WrongModel::MarginInfinity)),
    );
    assert_eq!(wrong, Judgement::WrongAndClear);
    let judgement = Judgement::of(&found[0], CertificateReading::WHOLE);
    assert_eq!(judgement, Judgement::Unresolved(true));
}

/// A block that is released near its saddle and loses nothing at impact: the
/// top of its second hop is the first one's but for rounding, which the slope
/// of the potential there magnifies.
#[test]
fn a_second_top_near_the_saddle_has_its_error() {
    let found = findings(Stratum::Extreme, &[11_776, 13_679, 15_535]).unwrap();
    for finding in &found {
        let judgement = Judgement::of(finding, CertificateReading::WHOLE);
        let words = words::finding(finding);
        assert!(!judgement.is_bad(), "{judgement:?}: {words}");
    }
    // Every one was outside its estimate by a factor of 200 or more.
    assert_eq!(found.len(), 3);
}

#[test]
fn a_scene_follows_from_its_address() {
    for stratum in Stratum::ALL {
        for index in 0..2 {
            let (a, b) = (trial(stratum, index), trial(stratum, index));
            assert_eq!(a.unwrap(), b.unwrap());
        }
    }
}

/// The suites of the environment with the blocks of the study; without any,
/// a few records and one block.
fn surveyed() -> (Vec<(&'static str, Vec<NormalisedRecord>)>, Vec<Block>) {
    let asked = std::env::var("SUITES").ok();
    let none = Processing::default();
    let read = |kind, path: &str| {
        let options = ReadOptions::default();
        StudySuite::read(kind, Path::new(path), options, &none).unwrap()
    };
    let suites = match asked.as_deref().map(|text| text.split_once(',')) {
        Some(Some((ordinary, pulse))) => [
            read(SuiteKind::Ordinary, ordinary),
            read(SuiteKind::PulseType, pulse),
        ],
        _ => StudySuite::embedded().unwrap(),
    };
    let (few, blocks) = match asked {
        Some(_) => (usize::MAX, BLOCKS.to_vec()),
        None => (2, vec![Block::try_new(0.1, 4.0).unwrap()]),
    };
    let records = |suite: &StudySuite| {
        let motions = suite.motions.iter().take(few);
        motions.map(|m| NormalisedRecord::new(&m.study)).collect()
    };
    (suites.iter().map(|s| (s.kind.name(), records(s))).collect(), blocks)
}

/// All that is otherwise in wider arithmetic is flagged, and of what is
/// flagged a third at most is clear.
#[test]
fn no_analysis_of_a_suite_is_another_without_a_flag() {
    let (suites, blocks) = surveyed();
    println!("suite,{}", Survey::header());
    for (kind, records) in suites {
        let eta = Restitution::constant(0.92).unwrap();
        let found = Survey::of(&blocks, &records, eta).unwrap();
        println!("{kind},{}", found.row());
        assert!(found.of_count(Count::Near) > 0);
        let flagged = found.of_count(Count::Flagged);
        let missed = found.of_count(Count::Missed);
        let clear = flagged + missed - found.of_count(Count::Unclear);
        assert!(3 * clear <= flagged, "{clear} of {flagged}");
        assert_eq!(found.of_count(Count::WrongAndNotFlagged), 0);
        assert_eq!(found.of_count(Count::MissedAndWrong), 0);
    }
}

/// A row of a fixed order without a flag agrees with the row of a free order.
#[test]
fn what_a_fixed_order_leaves_is_flagged() {
    let (suites, _) = surveyed();
    for (kind, records) in suites {
        for (order, held) in Held::of(&BLOCKS, &records) {
            println!("{kind}, order {order}: {held:?}");
            assert_eq!(held.off_without_flag, 0);
            assert!(held.flagged < held.analyses);
            assert!(held.off > 0 || order > Order::Four);
        }
    }
}
