//! Charts of the result of one command, each a function of that result.

use rocking::accelerogram::Accelerogram;
use rocking::integrator::{Response, Scene, uplift_threshold};
use rocking_procedures::Ranking;
use rocking_records::intensity::{IntensityMeasure, Measures};
use rocking_score::{Code, Score};

use super::{
    Chart, ChartAxis, ChartPanel, Heading, History, HistoryPanel, Look, Mark,
    Series, histories,
};
use crate::colour::{Ink, Pen};
use crate::markup;

/// Rotation over slenderness against time, of a response with its history,
/// as SVG.
pub fn response_svg(
    scene: &Scene<'_>,
    response: &Response,
    excitation: &str,
    pga_g: f64,
) -> String {
    let alpha_rad = scene.block.slenderness_rad();
    let points = response.history.iter();
    let points = points.map(|p| (p.time_s, p.rotation_rad / alpha_rad));
    let (time_s, ratio) = points.unzip();
    let overturned = response.outcome.is_overturned();
    let history = History { alpha_rad, time_s, ratio, overturned };
    let panel = HistoryPanel {
        p_rad_s: scene.block.frequency_rad_s(),
        record: excitation.to_owned(),
        im: pga_g / uplift_threshold(&scene.block, scene.model),
        curves: vec![history],
    };
    let heading = Heading::new(
        "history",
        "Response history",
        "Rotation divided by slenderness, against time.",
    );
    histories(heading, &[panel], 1, String::new()).svg()
}

/// Acceleration, velocity, displacement and response spectrum (at
/// `periods_s`, 5 % damping) of a record, as SVG; `done` is what was done to
/// it.
pub fn record_svg(
    motion: &Accelerogram,
    (measures, periods_s): (&Measures, &[f64]),
    gravity_m_s2: f64,
    done: Option<&str>,
) -> String {
    let dt_s = motion.dt_s();
    let samples = motion.samples_g();
    let time_s: Vec<f64> =
        (0..samples.len()).map(|i| i as f64 * dt_s).collect();
    let shown_s = strong(motion);
    let label = markup::escape(&motion.name().replace('_', " "));
    let series = |x, y| Series::new(label.clone(), Mark::Line, x, y);
    let (velocity, displacement) = motion.integrals(gravity_m_s2);
    let spectrum = measures.spectral_acceleration_g.clone();
    let most = spectrum.iter().fold(0.0, |most: f64, s| most.max(*s));
    let ends = periods_s.first().copied().zip(periods_s.last().copied());
    let (pgv, pgd) = (measures.pgv_m_s, measures.pgd_m);
    let mut panels: Vec<ChartPanel> = [
        ("Acceleration", "*a* / *g*", samples.into(), measures.pga_g, "*g*"),
        ("Velocity", "*v* (m/s)", velocity, pgv, "m/s"),
        ("Displacement", "*d* (m)", displacement, pgd, "m"),
    ]
    .into_iter()
    .map(|(name, symbol, y, peak, unit)| {
        ChartPanel::new(
            format!("{name}, peak {peak:.3} {unit}"),
            ChartAxis::linear("*t* (s)", shown_s),
            ChartAxis::linear(symbol, None::<(f64, f64)>),
            vec![series(time_s.clone(), y)],
        )
    })
    .collect();
    panels.push(ChartPanel::new(
        "Response spectrum, 5 % damping",
        ChartAxis::logarithmic("*T* (s)", ends),
        ChartAxis::linear("*S*_{a} / *g*", (0.0, 1.05 * most)),
        vec![series(periods_s.to_vec(), spectrum)],
    ));
    let name = motion.name();
    let processed = |words| format!("processed: {words}");
    let done = done.map_or("as given".to_owned(), processed);
    let title = format!("Record {name}");
    let words = format!(
        "Acceleration, velocity and displacement of {name} against time \
         ({done}; from 0.1 to 99.5 % of its Arias intensity), and its \
         response spectrum."
    );
    let chart = Chart::of(["record", &title, &words], panels);
    let chart = Chart { columns: 2, ..chart }.thinned((440.0, 280.0));
    chart.figure(String::new()).svg()
}

/// Ends of the time axis: from 0.1 to 99.5 % of the Arias intensity, and a
/// tenth more either way, within the record.
fn strong(motion: &Accelerogram) -> (f64, f64) {
    let energy = motion.samples_g().iter().scan(0.0, |sum, a| {
        *sum += a * a;
        Some(*sum)
    });
    let energy: Vec<f64> = energy.collect();
    let sum = energy.last().copied().unwrap_or(0.0);
    let at = |share: f64| {
        let place = energy.iter().position(|e| *e >= share * sum);
        place.unwrap_or(0) as f64 * motion.dt_s()
    };
    let (first, last) = (at(0.001), at(0.995));
    let margin = 0.1 * (last - first) + motion.dt_s();
    ((first - margin).max(0.0), (last + margin).min(motion.duration_s()))
}

/// The dispersions of a ranking of `measures` at an EDP level, side by side
/// with their intervals, as SVG.
pub fn ranking_svg(
    ranking: &Ranking,
    measures: &[IntensityMeasure],
    edp: f64,
) -> String {
    let rows = &ranking.measures;
    let beta = rows.iter().map(|row| row.dispersion.estimate);
    let names = measures.iter().map(|m| markup::escape(&short(m)));
    let x = ChartAxis::named(names.collect());
    let label = format!("dispersion at EDP {edp}");
    let series = Series::new(
        "95 % interval from a bootstrap of records",
        Mark::Points,
        (1..=rows.len()).map(|k| k as f64).collect(),
        beta.clone().map(|beta| beta.value()).collect(),
    );
    let series = series.with(beta.map(|beta| beta.ends()).collect());
    let ends = series.interval.iter().map(|ends| ends.1);
    let most = ends.fold(0.0, f64::max);
    let top = if most > 0.0 { 1.1 * most } else { 1.0 };
    let y = ChartAxis::linear(label, (0.0, top));
    let words = format!(
        "Dispersion of the intensity at EDP {edp} in {} intensity measures, \
         with 95 % intervals.",
        rows.len()
    );
    let heading = ["rank", "Efficiency of intensity measures", &words];
    let panel = ChartPanel::new("", x, y, vec![series]);
    Chart::of(heading, vec![panel]).figure(String::new()).svg()
}

/// Digits of answers against their condition, and their medians by level
/// beside those of known codes, as SVG.
pub fn score_svg(score: &Score, conditions: &[f64], codes: &[Code]) -> String {
    let all = score.quantities.iter().zip(conditions);
    let points: Vec<_> =
        all.filter_map(|(q, k)| Some((k.max(1.0), q.digits?))).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
    let most = x.iter().fold(1e3, |most: f64, x| most.max(*x));
    let line = [1.0, 1e12].map(|k: f64| (k, 15.0 - libm::log10(k)));
    let (line_x, line_y) = line.into_iter().unzip();
    let left = ChartPanel::new(
        "Every number",
        ChartAxis::logarithmic("condition number", (1.0, 2.0 * most)),
        digits_axis(),
        vec![
            Series::new("these answers", Mark::Points, x, y),
            Series::new(
                "limit of double precision",
                Mark::Dashed,
                line_x,
                line_y,
            ),
        ],
    );
    let own = ("these answers", score);
    let right = by_level("Median of each level", codes, own, "best");
    let words = "Digits of each answer against its condition number, and \
                 the median of each level compared with known codes.";
    let heading = ["score", "Digits against difficulty", words];
    Chart::of(heading, vec![left, right]).figure(String::new()).svg()
}

fn digits_axis() -> ChartAxis {
    ChartAxis::linear("digits", (0.0, 15.5))
}

/// Medians of each level, of answers and of known codes in a setting.
fn by_level(
    title: &str,
    codes: &[Code],
    (name, own): (&str, &Score),
    setting: &str,
) -> ChartPanel {
    let codes: Vec<&Code> =
        codes.iter().filter(|code| code.setting == setting).collect();
    let mut notes = Vec::new();
    let mut series: Vec<Series> = Vec::new();
    for code in codes.chunk_by(|a, b| a.code == b.code) {
        let look = Look::line(Pen::new(Ink::Muted, 0.9));
        let of = code.iter().map(|c| (f64::from(c.level), c.median_digits));
        let (x, y): (Vec<f64>, Vec<f64>) = of.unzip();
        let end = x.last().copied().zip(y.last().copied());
        let name = markup::escape(&code[0].code);
        series.push(Series::of(look, x, y).keyed([code[0].code.clone()]));
        notes.extend(end.map(|at| Series::note(Mark::Edge, name, at)));
    }
    notes.sort_by(|a, b| a.y[0].total_cmp(&b.y[0]));
    series.extend(notes);
    let own = own.levels.iter().filter_map(|level| {
        Some((f64::from(level.level), level.median_digits?))
    });
    let (x, y) = own.unzip();
    series.push(Series::new(name, Mark::LineAndPoints, x, y));
    let levels = [1, 2, 3, 4, 5].map(|level| format!("level {level}"));
    let x = ChartAxis::named(levels.into());
    ChartPanel::new(title, x, digits_axis(), series)
}

/// A few letters, for the tick of an axis.
fn short(measure: &IntensityMeasure) -> String {
    use IntensityMeasure as M;
    match measure {
        M::Axis(intensity) => intensity.row().symbol.to_owned(),
        M::Scalar(scalar) => scalar.row().short.to_owned(),
        M::Sa(period_s) => format!("SA({period_s})"),
        M::AverageSa(periods_s) => {
            let (first, last) = (periods_s.first(), periods_s.last());
            let of = |t: Option<&f64>| t.copied().unwrap_or(f64::NAN);
            format!("SA({}–{})", of(first), of(last))
        }
        M::RockingSa(_) => "AvgSA".to_owned(),
        M::Column(name) => name.clone(),
        other => other.to_string(),
    }
}
