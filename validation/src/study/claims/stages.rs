//! Section 4: can the slenderness be normalized out?

use rocking::capacity::InversionRule;
use rocking::statistics::paired::Pairs;

use super::{
    Claim, Context, Measured, Results, SAME, StudyError, all_one, away,
    difference, median, middle, stripes, varied_ratios,
};
use crate::paper::{
    Arm, FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, Section, Shown,
    SuiteKind, position,
};
use crate::study::analyses::{Apart, SuiteResults};
use crate::study::figures::of_arm;
use crate::study::runs::capacities;
use crate::study::sensitivities::Choice;

/// Demands at which intensities are compared.
const DEMANDS: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

pub(super) fn all(results: &Results) -> Result<Vec<Claim>, StudyError> {
    let mut out = single_records(results);
    for arm in results.plan.drawn() {
        out.extend(stripes::all(results, arm)?);
        out.push(at_equal_demand(results, arm)?);
        out.extend(quantile_curves(results, arm)?);
        out.extend(resurrections(results, arm)?);
        out.push(inversion(results, arm)?);
    }
    out.push(housner(results)?);
    Ok(out)
}

/// Mean over frequencies and slendernesses of a record's measure, for the
/// records where there is one.
fn by_record(suite: &SuiteResults, of: impl Fn(&Apart) -> f64) -> Vec<f64> {
    (0..suite.records.len())
        .map(|record| {
            let values: Vec<f64> = suite
                .single
                .iter()
                .flat_map(|single| &single.apart[record])
                .map(&of)
                .filter(|x| x.is_finite())
                .collect();
            values.iter().fold(0.0, |s, x| s + x) / values.len() as f64
        })
        .filter(|x| x.is_finite())
        .collect()
}

fn single_records(results: &Results) -> Vec<Claim> {
    let (ordinary, pulse) = (&results.ordinary, &results.pulse);
    let context = |section, suites| Context {
        section,
        suites,
        blocks: "all 15",
        arm: Some(results.plan.common()),
    };
    let distance = |s| by_record(s, |a: &Apart| a.distance);
    let histories =
        difference("histories", &distance(ordinary), &distance(pulse));
    let peaks = median(&by_record(ordinary, |a| {
        (a.peak_ratio - 1.0).abs() - a.distance
    }));
    let apart = |s| by_record(s, |a: &Apart| a.mean_ln_im);
    let nearly = median(&apart(pulse));
    let curves = difference("curves", &apart(ordinary), &apart(pulse));
    vec![
        context(Section::new(4, Shown::Figures(2, 3)), &SuiteKind::BOTH).claim(
            "histories-pulse-better",
            "for the case of pulse-like ground motions normalization of the \
             slenderness seems to work better",
            "median normalized L2 distance to alpha = 0.10, ordinary minus \
             pulse-type",
            histories,
            "above 0",
            histories.above(0.0),
            String::new(),
        ),
        context(Section::new(4, Shown::Figure(2)), &[SuiteKind::Ordinary]).claim(
            "peaks-better-than-histories",
            "relatively low differences are observed for the peak \
             dimensionless rocking angle",
            "median over records of |peak ratio - 1| minus normalized L2 \
             distance",
            peaks,
            "below 0",
            peaks.below(0.0),
            String::new(),
        ),
        context(Section::new(4, Shown::Figure(5)), &[SuiteKind::PulseType]).claim(
            "one-curve-pulse",
            "the seismic response of the blocks of different alpha yields \
             close to a unique IDA curve",
            "median over records of mean |ln| of the ratio of intensities \
             at equal demand",
            nearly,
            "below 0.05",
            nearly.below(SAME),
            String::new(),
        ),
        context(Section::new(4, Shown::Figures(4, 5)), &SuiteKind::BOTH).claim(
            "curves-ordinary-worse",
            "in contrast, for the case of the ordinary ground motions, the \
             differences observed necessitate further investigation",
            "the same measure, ordinary minus pulse-type",
            curves,
            "above 0",
            curves.above(0.0),
            String::new(),
        ),
    ]
}

fn capacity_ratios(
    results: &Results,
    arm: Arm,
    frequency: usize,
    slenderness: usize,
    demand: f64,
) -> Result<Vec<f64>, StudyError> {
    let curves = results.ordinary.curves(arm).ok_or(StudyError::NoArm)?;
    let of = |slenderness| -> Result<Vec<f64>, StudyError> {
        curves[position(frequency, slenderness)]
            .iter()
            .map(|c| Ok(c.capacity(demand, InversionRule::Median)?.im()))
            .collect()
    };
    Ok(Pairs::try_new(&of(slenderness)?, &of(REFERENCE)?)?.ratios)
}

fn at_equal_demand(results: &Results, arm: Arm) -> Result<Claim, StudyError> {
    let mut cells = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            for demand in DEMANDS {
                if slenderness != REFERENCE {
                    cells.push(capacity_ratios(
                        results,
                        arm,
                        frequency,
                        slenderness,
                        demand,
                    )?);
                }
            }
        }
    }
    let cells = all_one(&cells, SAME);
    let context = Context {
        section: Section::new(4, Shown::Text),
        suites: &[SuiteKind::Ordinary],
        blocks: "all 15",
        arm: Some(arm),
    };
    Ok(context.claim(
        "ratios-at-demand",
        "the same observations are valid if the comparison is employed on \
         a vertical-statistics basis",
        "median paired ratio of intensities to alpha = 0.10 at demands 0.1 \
         to 1.0",
        cells.measured,
        "all within 5 % of 1",
        cells.verdict,
        cells.note(),
    ))
}

/// Median over records of the capacity at each demand.
fn medians(
    curves: &[rocking::capacity::ResponseCurve],
) -> Result<Vec<f64>, StudyError> {
    DEMANDS
        .iter()
        .map(|demand| {
            let sample: Vec<f64> = curves
                .iter()
                .map(|c| Ok(c.capacity(*demand, InversionRule::Median)?.im()))
                .collect::<Result<_, StudyError>>()?;
            Ok(middle(&sample))
        })
        .collect()
}

fn worst_off(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |worst, (a, b)| {
        let off = (a / b - 1.0).abs();
        if off <= worst { worst } else { off }
    })
}

fn quantile_curves(
    results: &Results,
    arm: Arm,
) -> Result<Vec<Claim>, StudyError> {
    let curves = results.ordinary.curves(arm).ok_or(StudyError::NoArm)?;
    let (mut slender, mut adjusted): (f64, f64) = (0.0, 0.0);
    let by_frequency = results.ordinary.adjusted.iter().find(|a| a.arm == arm);
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        let reference = medians(&curves[position(frequency, REFERENCE)])?;
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            let own = medians(&curves[position(frequency, slenderness)])?;
            let off = worst_off(&own, &reference);
            slender = if off > slender { off } else { slender };
        }
        if let Some(by_frequency) = by_frequency {
            let own = medians(&by_frequency.curves[frequency])?;
            let off = worst_off(&own, &reference);
            adjusted = if off > adjusted { off } else { adjusted };
        }
    }
    let context = |section, blocks| Context {
        section,
        suites: &[SuiteKind::Ordinary],
        blocks,
        arm: Some(arm),
    };
    let measure = "largest relative difference of the median intensity at \
                   demands 0.1 to 1.0";
    let [slender, adjusted] = [slender, adjusted].map(Measured::exact);
    Ok(vec![
        context(Section::new(4, Shown::Figure(8)), "all 15").claim(
            "quantiles-coincide",
            "slenderness can be normalized out for rocking blocks when the \
             seismic response is treated on a probabilistic basis",
            measure,
            slender,
            "below 10 %",
            slender.below(0.10),
            String::new(),
        ),
        context(Section::new(4, Shown::Figure(10)), "alpha = 0.10").claim(
            "adjustment-quantiles",
            "the differences between the two methods are negligible",
            measure,
            adjusted,
            "below 10 %",
            adjusted.below(0.10),
            String::new(),
        ),
    ])
}

fn resurrections(
    results: &Results,
    arm: Arm,
) -> Result<Vec<Claim>, StudyError> {
    let stripes = of_arm(&results.ordinary, arm).ok_or(StudyError::NoArm)?;
    let total =
        |counts: &[Vec<usize>]| -> usize { counts.iter().flatten().sum() };
    let again = total(&stripes.stand_again);
    let overturned = total(&stripes.overturned);
    let share = Measured::exact(again as f64 / overturned as f64);
    let of_slenderness = |slenderness: usize| {
        let sum = |counts: &[Vec<usize>]| -> usize {
            (0..FREQUENCIES_RAD_S.len())
                .flat_map(|f| &counts[position(f, slenderness)])
                .sum()
        };
        sum(&stripes.stand_again) as f64 / sum(&stripes.overturned) as f64
    };
    let stocky = SLENDERNESSES_RAD.len() - 1;
    let sturdy = Measured::exact(of_slenderness(stocky) - of_slenderness(0));
    let context = Context {
        section: Section::new(3, Shown::Text),
        suites: &[SuiteKind::Ordinary],
        blocks: "all 15",
        arm: Some(arm),
    };
    Ok(vec![
        context.claim(
            "resurrections",
            "This no-resurrection assumption is adequate for all practical \
             purposes",
            "share of the overturned on the stripes that stand at that very \
             intensity",
            share,
            "below 5 %",
            share.below(0.05),
            format!("{again} of {overturned}"),
        ),
        context.claim(
            "resurrections-sturdy",
            "resurrections only matter for the response of sturdy blocks \
             close to overturning",
            "the same share at alpha = 0.25 minus that at alpha = 0.05",
            sturdy,
            "above 0",
            sturdy.above(0.0),
            "sturdy taken as stocky; the margin was set with the measure, \
             after the other results were seen"
                .into(),
        ),
    ])
}

fn inversion(results: &Results, arm: Arm) -> Result<Claim, StudyError> {
    let curves = results.ordinary.curves(arm).ok_or(StudyError::NoArm)?;
    let mut worst: f64 = 0.0;
    for records in curves {
        let mean = |rule| -> Result<Vec<f64>, StudyError> {
            let mut sums = vec![0.0; DEMANDS.len()];
            for curve in records {
                let own = capacities(curve, &DEMANDS, rule)?;
                for (sum, x) in sums.iter_mut().zip(own) {
                    *sum += x;
                }
            }
            Ok(sums)
        };
        let off = worst_off(
            &mean(InversionRule::Median)?,
            &mean(InversionRule::Monotone)?,
        );
        worst = if off <= worst { worst } else { off };
    }
    let measured = Measured::exact(worst);
    let context = Context {
        section: Section::new(5, Shown::Text),
        suites: &[SuiteKind::Ordinary],
        blocks: "all 15",
        arm: Some(arm),
    };
    Ok(context.claim(
        "inversion-unbiased",
        "the median of the multiple IM values ..., this being a nearly \
         unbiased approach for rocking IDAs",
        "largest relative difference of the mean capacity to that of the \
         unbiased monotone inversion, demands 0.1 to 1.0",
        measured,
        "below 5 %",
        measured.below(SAME),
        String::new(),
    ))
}

fn housner(results: &Results) -> Result<Claim, StudyError> {
    let of = |slenderness| {
        results.varied.iter().find(|v| {
            v.choice == Choice::Housner
                && v.frequency == 1
                && v.slenderness == slenderness
        })
    };
    let ratio = |slenderness| -> Result<Vec<f64>, StudyError> {
        let Some(varied) = of(slenderness) else { return Ok(Vec::new()) };
        Ok(varied_ratios(results, varied, 1.0)?.ratios)
    };
    // Capacities with Housner's restitution, stocky over slender, by way of
    // the study's: what the slenderness's own ratio does is divided out.
    let pairs = Pairs::try_new(&ratio(4)?, &ratio(0)?);
    let measured =
        pairs.map_or(Measured::exact(f64::NAN), |pairs| median(&pairs.ratios));
    let off = away(measured);
    let context = Context {
        section: Section::new(4, Shown::Text),
        suites: &[SuiteKind::Ordinary],
        blocks: "p = 3, alpha = 0.05 and 0.25",
        arm: Some(results.plan.common()),
    };
    Ok(context.claim(
        "housner-breaks",
        "this conclusion only holds when eta is constant and independent of \
         the slenderness",
        "with Housner's restitution, |median paired ratio of overturning \
         intensities, alpha = 0.25 over 0.05, - 1|",
        off,
        "above 0.05",
        off.above(SAME),
        String::new(),
    ))
}
