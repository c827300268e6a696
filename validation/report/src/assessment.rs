//! The page of an assessment: which object is damaged first, how often, and
//! how sure that is.

use std::collections::BTreeMap;

use anyhow::Context as _;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking::intensity::IntensityMeasure;
use rocking::procedures::assess::{Answer, Assessed, Assessment};
use rocking::procedures::counts::Bounds;
use rocking_common::suites::StudySuite;
use rocking_common::table::{Table, number, optional};
use rocking_common::words::{percent, rounded};
use rocking_draw::colour;
use rocking_draw::colour::{Fill, Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Look, Mark, Series,
};
use rocking_draw::markup;

use crate::page::STYLE;
use crate::page::figures::inline;
use crate::page::table::scrolled;

/// The page, which tells that all files are there.
pub const PAGE: &str = "index.html";

/// Version of the layout of `assess.json`.
const SCHEMA: u32 = 1;

/// Height in px of the tallest object in the drawing of all.
const TALLEST_PX: f64 = 150.0;

/// How many records are named that damage an object first.
const NAMED: usize = 5;

/// What an assessment was made of.
#[derive(Clone, Debug)]
pub struct About<'a> {
    /// The records.
    pub suite: &'a StudySuite,
    /// What was done to them.
    pub processing: Option<String>,
    /// Name of the hazard curve's file.
    pub hazard: Option<String>,
}

/// The files of an assessment, by their names.
///
/// # Errors
/// None in practice: all numbers can be written.
pub fn files(
    found: &Assessment,
    about: &About<'_>,
) -> anyhow::Result<BTreeMap<String, Vec<u8>>> {
    Ok(BTreeMap::from([
        (PAGE.to_owned(), page(found, about).into_bytes()),
        ("assess.json".to_owned(), json(found)?.into_bytes()),
        ("fragilities.csv".to_owned(), fragilities(found).into_bytes()),
        ("capacities.csv".to_owned(), capacities(found).into_bytes()),
    ]))
}

/// All numbers, as JSON.
///
/// # Errors
/// None in practice.
pub fn json(found: &Assessment) -> anyhow::Result<String> {
    let mut value = serde_json::to_value(found).context("assess.json")?;
    if let Some(map) = value.as_object_mut() {
        map.insert("schema".to_owned(), SCHEMA.into());
    }
    Ok(serde_json::to_string_pretty(&value)? + "\n")
}

/// What the terminal shows.
pub fn text(found: &Assessment) -> String {
    let rows = found.objects.iter().map(|one| ranked(found, one).join("; "));
    let rows: Vec<String> = rows.collect();
    format!("{}\n{}\n", first(found), rows.join("\n"))
}

fn fragilities(found: &Assessment) -> String {
    let mut table =
        Table::new(&["object", "im", "unit", "intensity", "p", "low", "high"]);
    for one in &found.objects {
        let band = one.fragility.band.iter().flat_map(|b| &b.points);
        for point in band {
            table.row([
                one.id.clone(),
                found.im.to_string(),
                found.unit.to_owned(),
                number(point.intensity),
                number(point.probability),
                optional(point.low),
                optional(point.high),
            ]);
        }
    }
    table.finish()
}

fn capacities(found: &Assessment) -> String {
    let mut table =
        Table::new(&["object", "record", "intensity", "unit", "damages"]);
    for one in &found.objects {
        for row in &one.by_record {
            table.row([
                one.id.clone(),
                row.record.clone(),
                number(row.im),
                found.unit.to_owned(),
                u8::from(row.damages).to_string(),
            ]);
        }
    }
    table.finish()
}

/// A number in three significant digits.
fn short(x: f64) -> String {
    rounded(x, 3).to_string()
}

/// A value with its interval.
fn bounds(value: &Bounds) -> String {
    let Bounds { point, low, high, .. } = value;
    match (low, high) {
        (Some(low), Some(high)) => {
            format!("{} ({} to {})", short(*point), short(*low), short(*high))
        }
        _ => format!("{} (interval open)", short(*point)),
    }
}

/// Years between damages, with their interval.
fn years(answer: &Answer) -> Option<String> {
    let risk = answer.risk.as_ref()?;
    let years = |frequency: f64| rounded(frequency.recip(), 2).to_string();
    let point = years(risk.annual_frequency_truncation_lower);
    Some(match &risk.sampling {
        None => point,
        Some(drawn) => format!(
            "{point} ({} to {})",
            years(drawn.annual_frequency_high),
            years(drawn.annual_frequency_low)
        ),
    })
}

/// The probability in T years in percent, with its interval.
fn probability(answer: &Answer) -> Option<String> {
    let risk = answer.risk.as_ref()?;
    let share = |p: f64| rounded(100.0 * p, 2).to_string();
    let point = share(risk.probability_truncation_lower);
    Some(match &risk.sampling {
        None => point,
        Some(drawn) => format!(
            "{point} ({} to {})",
            share(drawn.probability_low),
            share(drawn.probability_high)
        ),
    })
}

fn measure(found: &Assessment) -> String {
    match &found.im {
        IntensityMeasure::Pga => "PGA".to_owned(),
        IntensityMeasure::Pgv => "PGV".to_owned(),
        other => {
            let words = other.words();
            words.split(" (").next().unwrap_or_default().to_owned()
        }
    }
}

/// The sentence that comes first.
fn first(found: &Assessment) -> String {
    let Some(one) = found.objects.first() else { return String::new() };
    let what = one.damage;
    let often = match years(&one.answer) {
        Some(years) => {
            format!("{what} is to be expected once in {years} years")
        }
        None => format!(
            "a {} of {} {} causes {what} with a probability of 5 %",
            measure(found),
            bounds(&one.answer.small_im),
            found.unit
        ),
    };
    let sure = match found.objects.len() {
        1 => String::new(),
        _ => format!(
            " It comes first in {} of the resampled suites.",
            percent(one.first_in_draws, 0)
        ),
    };
    let id = &one.id;
    match found.objects.len() {
        1 => format!("{id}: {often}; in brackets the 95 % interval."),
        _ => format!(
            "{id} needs attention first: {often}; in brackets the 95 % \
             interval.{sure}"
        ),
    }
}

/// The heads of the table of all objects.
fn heads(found: &Assessment) -> Vec<String> {
    let (im, unit) = (measure(found), found.unit);
    let mut heads = vec!["Object".to_owned(), "Damage".to_owned()];
    if found.objects.iter().any(|one| one.answer.risk.is_some()) {
        heads.push("Once in years".to_owned());
        heads.push(format!("Probability in {} years, %", found.years));
    }
    heads.push(format!("{im} of 5 % damage, {unit}"));
    heads.push(format!("{im} of 50 % damage, {unit}"));
    heads.push("Comes first in resampled suites".to_owned());
    heads.push("Records that slide it first".to_owned());
    heads
}

fn ranked(_: &Assessment, one: &Assessed) -> Vec<String> {
    let answer = &one.answer;
    let mut cells = vec![one.id.clone(), one.damage.to_string()];
    cells.extend(years(answer));
    cells.extend(probability(answer));
    cells.push(bounds(&answer.small_im));
    cells.push(bounds(&answer.median_im));
    cells.push(percent(one.first_in_draws, 0));
    cells.push(match one.slides_first {
        None => "friction not given".to_owned(),
        Some(share) => percent(share, 0),
    });
    cells
}

fn table(label: &str, heads: &[String], rows: &[Vec<String>]) -> Markup {
    let body = html! {
        table.cards {
            thead { tr { @for head in heads { th scope="col" { (head) } } } }
            tbody {
                @for row in rows {
                    tr {
                        @for (k, cell) in row.iter().enumerate() {
                            @if k == 0 {
                                th scope="row" { (cell) }
                            } @else {
                                td data-label=(heads[k]) { (cell) }
                            }
                        }
                    }
                }
            }
        }
    };
    scrolled(label, body)
}

fn page(found: &Assessment, about: &About<'_>) -> String {
    let title = match found.objects.as_slice() {
        [one] => format!("Rocking of {}", one.id),
        all => format!("Rocking of {} objects", all.len()),
    };
    let rows: Vec<Vec<String>> =
        found.objects.iter().map(|one| ranked(found, one)).collect();
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; style-src 'unsafe-inline'";
                meta name="viewport"
                    content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(colour::STYLE)) }
            }
            body {
                header {
                    h1 { (title) }
                    p { strong { (first(found)) } }
                    p.subtitle {
                        "Each object is taken for a rigid block that stands \
                         free on flat ground. It begins to rock where the \
                         ground accelerates by g tan(alpha) or more, and \
                         overturns where it rocks too far. "
                        (ground(about))
                    }
                }
                main {
                    section {
                        h2 { "Which object first" }
                        (sketch(&found.objects))
                        (table("All objects", &heads(found), &rows))
                        (sliding(found))
                    }
                    @if !found.together.is_empty() { (together(found)) }
                    @for (k, one) in found.objects.iter().enumerate() {
                        (object(found, one, k))
                    }
                    (limits(found))
                    (provenance(found, about))
                }
            }
        }
    }
    .into_string()
        + "\n"
}

fn ground(about: &About<'_>) -> String {
    match about.suite.source.is_embedded() {
        true => "The motions are synthetic: the program makes them by \
                 published relations for ordinary earthquakes. Records of \
                 your own (--suite) replace them."
            .to_owned(),
        false => format!("The motions are those of {}.", about.suite.source),
    }
}

/// The objects side by side, to scale.
fn sketch(objects: &[Assessed]) -> Markup {
    let tallest = objects.iter().map(|o| o.height_m).fold(0.0, f64::max);
    let scale = TALLEST_PX / tallest;
    let mut x = 10.0;
    let mut shown = Vec::new();
    for one in objects {
        let (w, h) = (scale * one.width_m, scale * one.height_m);
        let room = w.max(9.0 * one.id.chars().count() as f64).max(70.0);
        shown.push((x + 0.5 * (room - w), x + 0.5 * room, w, h, one));
        x += room + 24.0;
    }
    let (width, height) = (x, TALLEST_PX + 52.0);
    let ground = TALLEST_PX + 10.0;
    html! {
        div.scroll.drawing role="region" aria-label="The objects to scale"
            tabindex="0"
        {
            svg xmlns="http://www.w3.org/2000/svg" width=(width)
                height=(height) viewBox={ "0 0 " (width) " " (height) }
                role="img" aria-label="The objects, to scale"
            {
                line x1="0" x2=(width) y1=(ground) y2=(ground)
                    stroke="currentColor" stroke-width="1.5" {}
                @for (left, middle, w, h, one) in &shown {
                    rect x=(left) y=(ground - h) width=(w) height=(h)
                        fill="none" stroke="currentColor"
                        stroke-width="1.5" {}
                    text x=(middle) y=(ground + 17.0) font-size="13"
                        text-anchor="middle" fill="currentColor" { (one.id) }
                    text x=(middle) y=(ground + 34.0) font-size="11"
                        text-anchor="middle" fill="currentColor"
                    {
                        (short(one.width_m)) " × "
                        (short(one.height_m)) " m"
                    }
                }
            }
        }
    }
}

/// What friction makes of the answers.
fn sliding(found: &Assessment) -> Markup {
    let ids = |of: &dyn Fn(&Assessed) -> bool| {
        let all = found.objects.iter().filter(|one| of(one));
        let all: Vec<&str> = all.map(|one| one.id.as_str()).collect();
        all.join(", ")
    };
    let slide = ids(&|one| one.slides_first.is_some_and(|s| s > 0.05));
    let unknown = ids(&|one| one.slides_first.is_none());
    html! {
        @if !slide.is_empty() {
            p {
                strong { "Sliding: " }
                "more than 5 % of the records ask for more friction than \
                 the floor gives before they damage " (slide) ". These \
                 objects slide first, and their fragility does not apply."
            }
        }
        @if !unknown.is_empty() {
            p {
                "No coefficient of friction is given for " (unknown)
                ": whether these objects slide before they rock was not \
                 checked."
            }
        }
    }
}

fn together(found: &Assessment) -> Markup {
    let (im, unit) = (measure(found), found.unit);
    let has_risk = found.together.iter().any(|t| t.answer.risk.is_some());
    let mut heads = vec!["Objects damaged by one earthquake".to_owned()];
    if has_risk {
        heads.push("Once in years".to_owned());
        heads.push(format!("Probability in {} years, %", found.years));
    }
    heads.push(format!("{im} of 5 %, {unit}"));
    heads.push(format!("{im} of 50 %, {unit}"));
    let rows: Vec<Vec<String>> = found
        .together
        .iter()
        .map(|row| {
            let mut cells = vec![format!("{} or more", row.at_least)];
            cells.extend(years(&row.answer));
            cells.extend(probability(&row.answer));
            cells.push(bounds(&row.answer.small_im));
            cells.push(bounds(&row.answer.median_im));
            cells
        })
        .collect();
    html! {
        section {
            h2 { "Together" }
            p {
                "One earthquake moves all objects. The objects that each \
                 record damages are counted; they are not taken as \
                 independent."
            }
            (table("Objects damaged together", &heads, &rows))
        }
    }
}

fn object(found: &Assessment, one: &Assessed, k: usize) -> Markup {
    let chart = chart(found, one, k).figure(String::new());
    let heads: Vec<String> = ["Assumption"]
        .into_iter()
        .map(str::to_owned)
        .chain(one.answer.risk.iter().map(|_| "Once in years".to_owned()))
        .chain(["5 % damage".to_owned(), "50 % damage".to_owned()])
        .collect();
    let line = |words: String, answer: &Answer| {
        let mut cells = vec![words];
        cells.extend(years(answer));
        cells.push(bounds(&answer.small_im));
        cells.push(bounds(&answer.median_im));
        cells
    };
    let made = format!("as made: coefficient of restitution {}", one.eta);
    let mut rows = vec![line(made, &one.answer)];
    for other in &one.alternatives {
        rows.push(line(other.assumption.to_string(), &other.answer));
    }
    let best = one.ranking.measures.iter().filter_map(|m| {
        let beta = m.dispersion.as_ref()?.point;
        Some((m, beta))
    });
    let best = best.min_by(|a, b| a.1.total_cmp(&b.1));
    let pga = one.ranking.measures.first();
    let pga = pga.and_then(|m| Some(m.dispersion.as_ref()?.point));
    let by_record = one.by_record.iter().filter(|r| r.damages).take(NAMED);
    let by_record: Vec<String> =
        by_record.map(|r| format!("{} ({})", r.record, short(r.im))).collect();
    let stand = one.by_record.iter().filter(|r| !r.damages).count();
    html! {
        section {
            h2 { (one.id) }
            p {
                (short(one.width_m)) " m wide, "
                (short(one.height_m)) " m high: alpha "
                (short(one.alpha_rad)) " rad, p "
                (short(one.p_rad_s)) " rad/s. It begins to rock at \
                 a PGA of " (short(one.uplift_pga_g)) " g. Damage is "
                (one.damage.to_string()) "."
            }
            figure.figure {
                div class="scroll drawing wide" role="region"
                    aria-label={ "Curves of " (one.id) } tabindex="0"
                {
                    (PreEscaped(inline(&chart.svg())))
                }
                figcaption {
                    "Left: probability of damage, by record (points), \
                     lognormal fit and its 95 % band. Middle: rotation over \
                     alpha of 16, 50 and 84 % of the records at rising PGA; \
                     at 1 the object overturns."
                    @if !one.contributions.is_empty() {
                        " Right: the part of the annual frequency that \
                         comes from motions of each intensity."
                    }
                }
            }
            h3 { "What moves the answer" }
            (table("Answers under other assumptions", &heads, &rows))
            @if let Some(((best, beta), pga)) = best.zip(pga) {
                p {
                    "Of " (one.ranking.measures.len()) " intensity measures "
                    (best.im) " says most: it leaves a dispersion of "
                    (short(beta)) ", PGA one of "
                    (short(pga)) "."
                }
            }
            @if !by_record.is_empty() {
                p {
                    "Damaged first by " (by_record.join(", ")) ", in "
                    (measure(found)) " (" (found.unit) "). "
                    @if stand > 0 {
                        (stand) " of the " (found.records)
                        " records do not damage it at all."
                    }
                }
            }
            @if let Some(needed) = &one.fragility.needed {
                p {
                    "An interval of ±10 % about the median above the onset \
                     of rocking needs " (short(needed.for_median))
                    " records like these; there are " (found.records) "."
                }
            }
            @if one.resolution.unresolved > 0 {
                p {
                    (one.resolution.unresolved) " of "
                    (one.resolution.analyses) " analyses have a fate that \
                     double precision does not resolve; --certify does."
                }
            }
        }
    }
}

/// Fragility, response and, under a hazard curve, risk by intensity.
fn chart(found: &Assessment, one: &Assessed, k: usize) -> Chart {
    let axis = format!("{} ({})", measure(found), found.unit);
    let band = one.fragility.band.iter().flat_map(|b| &b.points);
    let band: Vec<_> = band.collect();
    let x: Vec<f64> = band.iter().map(|p| p.intensity).collect();
    let y: Vec<f64> = band.iter().map(|p| p.probability).collect();
    let ends: Vec<(f64, f64)> = band
        .iter()
        .map(|p| (p.low.unwrap_or(f64::NAN), p.high.unwrap_or(f64::NAN)))
        .collect();
    let last = one.answer.fitted.quantile(0.98);
    let n = one.by_record.len() as f64;
    let damaged: Vec<f64> =
        one.by_record.iter().filter(|r| r.damages).map(|r| r.im).collect();
    let place = (0..damaged.len()).map(|k| (k as f64 + 0.5) / n).collect();
    let dots = Look::marks(
        rocking_draw::panel::Marker::of_series(0),
        2.0,
        Ink::Muted,
    );
    let fragility = vec![
        Series::new("fit and 95 % band", Mark::Line, x, y).with(ends),
        Series::of(dots, damaged, place),
    ];
    let mut panels = vec![ChartPanel::new(
        "Probability of damage",
        ChartAxis::linear(axis.as_str(), (0.0, last)),
        ChartAxis::linear("", (0.0, 1.0)),
        fragility,
    )];
    let quantile = |name: &str, of: fn(&Ida) -> f64| {
        let y = one.ida.iter().map(|s| s.intensity).collect();
        Series::new(name, Mark::Line, one.ida.iter().map(of).collect(), y)
    };
    panels.push(ChartPanel::new(
        "Rotation over alpha",
        ChartAxis::linear("largest rotation / alpha", (0.0, 1.2)),
        ChartAxis::linear("PGA (g)", None::<(f64, f64)>),
        vec![
            quantile("16 %", |s| s.edp16),
            quantile("50 %", |s| s.edp50),
            quantile("84 %", |s| s.edp84),
        ],
    ));
    if !one.contributions.is_empty() {
        let edges = one.contributions.iter().map(|c| c.from_im);
        let end = one.contributions.last().map(|c| c.to_im);
        let edges: Vec<f64> = edges.chain(end).collect();
        let total: f64 =
            one.contributions.iter().map(|c| c.annual_frequency).sum();
        let share = |c: f64| 100.0 * c / total;
        let parts: Vec<f64> = one
            .contributions
            .iter()
            .map(|c| share(c.annual_frequency))
            .collect();
        let look = Look {
            bins: Some(Fill::tint(Ink::Series(1), 30)),
            pen: Some(Pen::new(Ink::Series(1), 0.8)),
            ..Look::default()
        };
        let most = parts.iter().copied().fold(0.0, f64::max);
        panels.push(ChartPanel::new(
            "Where the risk comes from",
            ChartAxis::logarithmic(
                axis.as_str(),
                edges.first().copied().zip(edges.last().copied()),
            ),
            ChartAxis::linear("% of the frequency", (0.0, 1.1 * most)),
            vec![Series::of(look, edges, parts)],
        ));
    }
    let columns = panels.len();
    let heading = Heading::new(
        format!("object-{k}"),
        format!("Curves of {}", markup::escape(&one.id)),
        "Fragility, response and risk of one object.",
    );
    Chart { heading, panels, columns }
}

type Ida = rocking::procedures::StripeResponses;

fn limits(found: &Assessment) -> Markup {
    html! {
        section {
            h2 { "What is not in these numbers" }
            ul {
                li {
                    "Sliding, jumping, twisting, a soft floor, uneven feet, \
                     neighbours and walls: the model is one rigid block in \
                     a plane (Eq. 1 of Lachanas, Vamvatsikos and \
                     Dimitrakopoulos)."
                }
                li {
                    "The other horizontal and the vertical component of \
                     each record."
                }
                li {
                    "The uncertainty of the hazard curve. The intervals \
                     are what the choice of the records leaves ("
                    (found.drawn.to_string()) ")."
                }
                li {
                    "A coefficient of restitution of your object that was \
                     measured: the table of each object shows what 0.85 and \
                     0.97 make of the answer."
                }
                @if found.objects.iter().any(|o| o.answer.risk.is_some()) {
                    li {
                        "Motions beyond the last point of the hazard curve, \
                         but for the damage that this point itself has."
                    }
                }
            }
        }
    }
}

fn provenance(found: &Assessment, about: &About<'_>) -> Markup {
    let suite = about.suite;
    let mut rows = vec![
        ("Program", format!("rocking {}", env!("CARGO_PKG_VERSION"))),
        ("Records", format!("{}, {}", suite.source, found.drawn)),
        ("SHA-256 of the records", suite.sha256()),
    ];
    rows.extend(about.processing.clone().map(|done| ("Processing", done)));
    if !suite.set_aside.is_empty() {
        rows.push(("Set aside", suite.set_aside.to_string()));
    }
    rows.extend(suite.remarks.words().map(|words| ("Remarks", words)));
    rows.extend(about.hazard.clone().map(|name| ("Hazard curve", name)));
    html! {
        section {
            h2 { "Provenance" }
            dl { @for (what, is) in &rows { dt { (what) } dd { (is) } } }
            p {
                "All numbers: " a href="assess.json" { "assess.json" } ", "
                a href="fragilities.csv" { "fragilities.csv" } ", "
                a href="capacities.csv" { "capacities.csv" } "."
            }
        }
    }
}
