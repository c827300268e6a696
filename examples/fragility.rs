//! A folder of records to a shifted fragility, and whether it is lognormal.
//! `cargo run --release --example fragility -- FOLDER`

use rocking::capacity::{CapacityError, InversionRule};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, BracketEnd, REFINEMENT, curves};
use rocking::{Block, Restitution};
use rocking_records::{ReadOptions, Suite};
use rocking_statistics::ExtendedSample;
use rocking_statistics::lilliefors::{
    LillieforsTable, LillieforsTest, Null, Scale,
};
use rocking_statistics::lognormal::{FitMethod, fit};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("expected a folder")?;
    let suite = Suite::read(folder.as_ref(), &ReadOptions::default())?;
    let records: Vec<_> = suite
        .study_components()
        .map(|member| NormalisedRecord::new(&member.accelerogram))
        .collect();
    let block = Block::try_new(0.2, 3.0)?;
    let paper = Analysis::paper(block, Restitution::constant(0.92)?);
    let analysis = Analysis { refine: Some(REFINEMENT), ..paper };
    let ida = curves(&records, &[analysis], &Batch::default())?;
    // The intensity PGA/(g tan alpha) at which each record overturns it.
    let overturning = ida[0].iter().map(|curve| {
        let response = curve.response(BracketEnd::Refined)?;
        Ok(response.crossings(1.0)?.capacity(InversionRule::Median).im())
    });
    let capacities = overturning.collect::<Result<Vec<_>, CapacityError>>()?;
    let sample = ExtendedSample::try_new(&capacities)?;
    let fragility = fit(&sample, 1.0, FitMethod::MaximumLikelihood)?;
    let scale = Scale::Logarithmic { shift: 1.0 };
    let null = Null::Table(LillieforsTable::embedded());
    let test = LillieforsTest::new(&sample, scale, 0.05, null);
    println!("{:?}: {:?}", fragility.distribution, test.verdict);
    Ok(())
}
