use super::compare::same;
use rocking::accelerogram::{Accelerogram, AccelerogramError};
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Adjust, Analysis, Batch, Grid, Resurrections, curve, curves,
};
use rocking::integrator::{Extent, Model, Order, Overturning};
use rocking::number::dispatch::Isa;

/// Filtered noise under a parabolic envelope, from a linear congruence.
fn noise(seed: u64, dt_s: f64) -> Result<Accelerogram, AccelerogramError> {
    let count = (6.0 / dt_s) as usize;
    let mut state = seed;
    let (mut fast, mut slow) = (0.0, 0.0);
    let samples = (0..count)
        .map(|k| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let white =
                (state >> 11) as f64 * (0.5 / 4_503_599_627_370_496.0) - 0.5;
            fast += 0.3 * (white - 0.5 * fast);
            slow += 0.2 * (fast - slow);
            let share = k as f64 / count as f64;
            4.0 * slow * share * (1.0 - share)
        })
        .collect();
    Accelerogram::try_new(format!("noise {seed}"), dt_s, samples)
}

/// A panel that reaches every class of the pool and what runs alone.
fn panel() -> Result<Vec<Analysis>, Box<dyn std::error::Error>> {
    let restitution = Restitution::constant(0.92)?;
    let mut out = Vec::new();
    for (p, alpha) in
        [(1.0, 0.1), (3.0, 0.05), (3.0, 0.25), (4.0, 0.15), (6.0, 0.1)]
    {
        let paper = Analysis::paper(Block::try_new(alpha, p)?, restitution);
        let im = Grid::Im { step: 0.25 };
        out.push(Analysis { highest_im: 12.0, ..paper });
        let extent = Extent::Outcome;
        out.push(Analysis { certify: true, extent, ..paper });
        out.push(Analysis {
            overturning: Overturning::HalfPi,
            refine: Some(1e-3),
            grid: im,
            ..paper
        });
        out.push(Analysis {
            adjust: Adjust::SlendernessAdjustment,
            grid: im,
            resurrections: Some(Resurrections::Multiple(1.5)),
            ..paper
        });
        out.push(Analysis { model: Model::Linearized, grid: im, ..paper });
        for order in [Order::Four, Order::Six, Order::Eight, Order::Ten] {
            let order = Some(order);
            out.push(Analysis { order, grid: im, highest_im: 12.0, ..paper });
        }
    }
    Ok(out)
}

#[test]
fn lanes_have_the_bits_of_the_scalar_engine()
-> Result<(), Box<dyn std::error::Error>> {
    let records: Vec<NormalisedRecord> =
        [(1, 0.005), (2, 0.01), (3, 0.02), (4, 0.01), (5, 0.005)]
            .into_iter()
            .map(|(seed, dt_s)| Ok(NormalisedRecord::new(&noise(seed, dt_s)?)))
            .collect::<Result<_, AccelerogramError>>()?;
    let panel = panel()?;
    let mut expected = Vec::new();
    for analysis in &panel {
        let row: Result<Vec<_>, _> =
            records.iter().map(|record| curve(record, analysis)).collect();
        expected.push(row?);
    }
    let overturned = expected.iter().flatten();
    assert!(overturned.filter(|c| c.overturning.is_some()).count() > 50);
    for isa in Isa::available() {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()?;
            let batch = Batch { isa, ..Batch::default() };
            let found = pool.install(|| curves(&records, &panel, &batch))?;
            let way = format!("lanes of {} on {threads} threads", isa.name());
            for (a, (found, alone)) in found.iter().zip(&expected).enumerate()
            {
                for (found, alone) in found.iter().zip(alone) {
                    let name = &found.record;
                    let what = format!("{way}, analysis {a}, {name}");
                    same(&what, &found.points, &alone.points);
                    assert_eq!(found, alone, "{what}");
                }
            }
        }
    }
    Ok(())
}
