//! One record, drawn: acceleration, velocity, displacement, spectrum.

use rocking::intensity::{IntensityError, Measures, Settings};
use rocking::record::Accelerogram;

use super::Listed;
use crate::cli::Failure;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Mark, Scale, Series,
};
use rocking_draw::markup;

/// Periods of the spectrum: 40 a decade from 0.05 to 10 s.
const PERIODS: i32 = 92;

/// Draws the one record of a list.
///
/// # Errors
/// [`Failure`] for any other number of records.
pub(super) fn svg(
    records: &[Listed],
    processing: Option<&str>,
    gravity_m_s2: f64,
) -> Result<String, Failure> {
    let [listed] = records else {
        return Err(Failure::input(format!(
            "--plot: {} records: expected one",
            records.len()
        )));
    };
    let chart = chart(&listed.motion, processing, gravity_m_s2)?;
    Ok(chart.thinned().figure(String::new()).svg())
}

fn chart(
    motion: &Accelerogram,
    processing: Option<&str>,
    gravity_m_s2: f64,
) -> Result<Chart, IntensityError> {
    let periods_s: Vec<f64> = (0..=PERIODS)
        .map(|k| 0.05 * libm::exp10(f64::from(k) / 40.0))
        .collect();
    let settings = Settings::try_new(gravity_m_s2, 0.05, periods_s.clone())?;
    let measures = Measures::of(motion, &settings)?;
    let dt_s = motion.dt_s();
    let samples = motion.samples_g();
    let time_s: Vec<f64> =
        (0..samples.len()).map(|i| i as f64 * dt_s).collect();
    let shown_s = strong(motion);
    let label = markup::escape(&motion.name().replace('_', " "));
    let series = |x, y| Series::new(label.clone(), Mark::Line, x, y);
    let (velocity, displacement) = integrals(motion, gravity_m_s2);
    let history =
        |name: &str, symbol: &str, y: Vec<f64>, peak: String| ChartPanel {
            title: format!("{name}, peak {peak}"),
            x: ChartAxis::new("*t* (s)", Scale::Linear, Some(shown_s)),
            y: ChartAxis::new(symbol, Scale::Linear, None),
            series: vec![series(time_s.clone(), y)],
        };
    let spectrum = measures.spectral_acceleration_g;
    let most = spectrum.iter().fold(0.0, |most: f64, s| most.max(*s));
    let (first, last) = (periods_s[0], periods_s[periods_s.len() - 1]);
    let panels = vec![
        history(
            "Acceleration",
            "*a* / *g*",
            samples.to_vec(),
            format!("{:.3} *g*", measures.pga_g),
        ),
        history(
            "Velocity",
            "*v* (m/s)",
            velocity,
            format!("{:.3} m/s", measures.pgv_m_s),
        ),
        history(
            "Displacement",
            "*d* (m)",
            displacement,
            format!("{:.3} m", measures.pgd_m),
        ),
        ChartPanel {
            title: "Response spectrum, 5 % damping".to_owned(),
            x: ChartAxis::new(
                "*T* (s)",
                Scale::Logarithmic,
                Some((first, last)),
            ),
            y: ChartAxis::new(
                "*S*_{a} / *g*",
                Scale::Linear,
                Some((0.0, 1.05 * most)),
            ),
            series: vec![series(periods_s, spectrum)],
        },
    ];
    let name = motion.name();
    let done = processing.map_or_else(
        || "as given".to_owned(),
        |words| format!("processed: {words}"),
    );
    let heading = Heading::new(
        "record",
        format!("Record {name}"),
        format!(
            "Acceleration, velocity and displacement of {name} against time \
             ({done}; from 0.1 to 99.5 % of its Arias intensity), and its \
             response spectrum."
        ),
        None,
    );
    Ok(Chart { heading, panels, columns: 2 })
}

/// Ends of the time axis: from 0.1 to 99.5 % of the Arias intensity, and a
/// tenth more either way, within the record.
fn strong(motion: &Accelerogram) -> (f64, f64) {
    let mut sum = 0.0;
    let energy: Vec<f64> = motion
        .samples_g()
        .iter()
        .map(|a| {
            sum += a * a;
            sum
        })
        .collect();
    let at = |share: f64| {
        let place = energy.iter().position(|e| *e >= share * sum);
        place.unwrap_or(0) as f64 * motion.dt_s()
    };
    let (first, last) = (at(0.001), at(0.995));
    let margin = 0.1 * (last - first) + motion.dt_s();
    ((first - margin).max(0.0), (last + margin).min(motion.duration_s()))
}

/// Velocity (m/s) and displacement (m) at the samples, from rest, exact for
/// an acceleration that is linear between them.
fn integrals(motion: &Accelerogram, gravity: f64) -> (Vec<f64>, Vec<f64>) {
    let dt_s = motion.dt_s();
    let (mut v, mut d) = (0.0, 0.0);
    let (mut velocity, mut displacement) = (vec![v], vec![d]);
    for pair in motion.samples_g().windows(2) {
        let (a, b) = (gravity * pair[0], gravity * pair[1]);
        d += dt_s * (v + dt_s * (2.0 * a + b) / 6.0);
        v += 0.5 * dt_s * (a + b);
        velocity.push(v);
        displacement.push(d);
    }
    (velocity, displacement)
}
