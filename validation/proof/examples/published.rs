//! Prints `fixtures/comparison/published.csv`: the statistics of the published
//! laws under the recorded suites, whose index files are given.
//!
//! ```sh
//! cargo run -p rocking-proof --example published -- ordinary.csv pulse.csv
//! ```
//!
//! Only the study components count.

use std::path::Path;

use anyhow::{Result, bail};
use rocking::accelerogram::Accelerogram;
use rocking_proof::methods::published::{
    PublishedLaw, PublishedValue, statistics,
};
use rocking_records::{ReadOptions, Suite};

fn main() -> Result<()> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    let [ordinary, pulse] = paths.as_slice() else {
        bail!("expected ORDINARY and PULSE");
    };
    let suites = [read(ordinary)?, read(pulse)?];
    println!("suite,law,quantity,p_rad_s,motions,value");
    for (name, motions) in ["ordinary", "pulse"].into_iter().zip(suites) {
        for law in PublishedLaw::ALL {
            for value in statistics(law, &motions, None)? {
                let PublishedValue { quantity, p_rad_s, motions, value } =
                    value;
                println!(
                    "{name},{law},{quantity},{p_rad_s},{motions},{value:.4}"
                );
            }
        }
    }
    Ok(())
}

fn read(path: &str) -> Result<Vec<Accelerogram>> {
    let suite = Suite::read(Path::new(path), &ReadOptions::default())?;
    let study = suite.study_components();
    Ok(study.map(|member| member.accelerogram.clone()).collect())
}
