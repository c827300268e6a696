//! The page of an assessment: which object is damaged first, how often, and
//! how sure that is.

mod charts;
mod data;
pub mod shaking;
mod words;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_draw::page::table::scrolled;
use rocking_draw::page::{head, inline};
use rocking_exchange::ExchangeFormat;
use rocking_procedures::ModelError;
use rocking_procedures::assess::{Assessment, Damage, ObjectAssessment};
use rocking_procedures::fragility::hazard::Hazard;
use rocking_statistics::Interval;
use rocking_synthesis::SuiteKind;
use serde::{Deserialize, Serialize};

pub use data::json;
pub use words::{once_in, text};

use words::{WordTable, measure, short};

/// The page; it is written last, so if it exists, all files do.
pub const PAGE: &str = "index.html";

/// How many records are named that damage an object first.
const NAMED: usize = 5;

/// Share of the records from which on an object slides first.
const SLIDES: f64 = 0.05;

/// How to get recorded motions.
pub const RECORDED_MOTIONS: &str =
    "Recorded motions (FEMA P-695): python -m rocking.recorded motions";

/// Origin of an assessment.
#[derive(Clone, Debug, Default)]
pub struct About {
    /// Origin of the records, in a sentence.
    pub ground: String,
    /// Names and values that are needed to make the page again.
    pub provenance: Vec<Provenance>,
}

/// A fact that is needed to make a page again.
#[derive(Clone, Debug, Serialize)]
pub struct Provenance {
    what: String,
    is: String,
}

impl About {
    /// The names and values that are known.
    pub fn of<'a>(
        ground: String,
        known: impl IntoIterator<Item = (&'a str, Option<String>)>,
    ) -> Self {
        let known = known.into_iter();
        let known = known.filter_map(|(what, is)| {
            Some(Provenance { what: what.into(), is: is? })
        });
        Self { ground, provenance: known.collect() }
    }
}

/// The study's blocks under embedded and recorded motions.
const COMPARED: &str = rocking_fixtures::text("comparison/suites.csv");

/// A row of the comparison; other columns are not read.
#[derive(Deserialize)]
struct ComparedRow {
    suite: SuiteKind,
    group: String,
    quantity: String,
    edp: Option<f64>,
    embedded: Option<f64>,
    recorded: Option<f64>,
}

/// The median intensities of overturning under recorded ordinary motions over
/// those under the embedded ones, block by block: in the measure of the hazard
/// curve, or in PGA without one; none in a measure that was not compared.
///
/// # Errors
/// If the comparison cannot be read.
pub fn recorded_ratios(hazard: Option<&Hazard>) -> anyhow::Result<Vec<f64>> {
    let im = hazard.map_or(Some("pga".into()), |own| own.im.name());
    let mut ratios = Vec::new();
    for row in csv::Reader::from_reader(COMPARED.as_bytes()).deserialize() {
        let row: ComparedRow = row?;
        let is_own = row.suite == SuiteKind::Ordinary
            && row.group == "capacity"
            && row.edp == Some(1.0)
            && im.as_ref() == Some(&row.quantity);
        let both = row.recorded.zip(row.embedded).filter(|_| is_own);
        ratios.extend(both.map(|(recorded, embedded)| recorded / embedded));
    }
    Ok(ratios)
}

/// The files of an assessment, by their names.
///
/// # Errors
/// An object whose name other programs do not take.
pub fn files(
    found: &Assessment,
    about: &About,
) -> anyhow::Result<BTreeMap<String, Vec<u8>>> {
    let mut files = vec![
        ("assess.json".to_owned(), json(found, about)?),
        ("capacities.csv".to_owned(), data::capacities(found)),
        ("fragilities.csv".to_owned(), data::fragilities(found)),
        ("responses.csv".to_owned(), data::responses(found)),
    ];
    for format in ExchangeFormat::ALL.iter().filter(|f| f.in_assessment) {
        files.extend(data::exchanged(found, format)?);
    }
    let names: Vec<&str> = files.iter().map(|file| &*file.0).collect();
    let page = page(found, about, &names);
    files.push((PAGE.to_owned(), page));
    Ok(bytes(files))
}

fn bytes(
    files: impl IntoIterator<Item = (String, String)>,
) -> BTreeMap<String, Vec<u8>> {
    let files = files.into_iter();
    files.map(|(name, text)| (name, text.into_bytes())).collect()
}

/// The page, beside which `files` lie.
pub fn page(found: &Assessment, about: &About, files: &[&str]) -> String {
    let title = match found.objects.as_slice() {
        [one] => format!("Rocking of {}", one.id),
        all => format!("Rocking of {} objects", all.len()),
    };
    let introduction = html! {
        "Each object is modelled as a free-standing rigid block. It begins \
         to rock when the ground accelerates by g tan(alpha) or more; the \
         tangent of the angle alpha is width over height. It overturns if it \
         rotates too far. " (about.ground)
    };
    let sections = html! {
        section {
            h2 { "Which object first" }
            (charts::sketch(&found.objects))
            (table("All objects", &words::objects(found)))
            (sliding(found))
        }
        @if !found.together.is_empty() { (together(found)) }
        @for (k, one) in found.objects.iter().enumerate() {
            (object(found, one, k))
        }
        (limits(found))
        (provenance(about, files))
    };
    document(&title, &words::first(found), &introduction, &sections)
}

/// A page: its title, its first sentence, what is said below it, and its
/// sections.
fn document(
    title: &str,
    first: &str,
    introduction: &Markup,
    sections: &Markup,
) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(title))
            body {
                header {
                    h1 { (title) }
                    p { strong { (first) } }
                    p { (introduction) }
                }
                main id="main" { (sections) }
            }
        }
    };
    page.into_string() + "\n"
}

fn table(label: &str, (heads, rows): &WordTable) -> Markup {
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

/// Effect of friction on the answers.
fn sliding(found: &Assessment) -> Markup {
    let ids = |of: &dyn Fn(&ObjectAssessment) -> bool| {
        let all = found.objects.iter().filter(|one| of(one));
        let all: Vec<&str> = all.map(|one| one.id.as_str()).collect();
        all.join(", ")
    };
    let slide = ids(&|one| one.slides_first.is_some_and(|s| s > SLIDES));
    let unknown = ids(&|one| one.slides_first.is_none());
    html! {
        @if !slide.is_empty() {
            p {
                strong { "Sliding. " }
                "Under more than 5 % of the records these objects need more \
                 friction than their floor gives, before damage: " (slide)
                ". They would slide before they rock, so the rocking results \
                 do not apply to them."
            }
        }
        @if !unknown.is_empty() {
            p {
                "No coefficient of friction is given for " (unknown)
                ". Whether they slide before they rock was not checked."
            }
        }
    }
}

fn together(found: &Assessment) -> Markup {
    let heads = ("Objects damaged by one earthquake", "");
    let rows = found.together.iter();
    let rows =
        rows.map(|row| (format!("{} or more", row.at_least), &row.answer));
    let all = words::answers(found, heads, rows);
    html! {
        section {
            h2 { "Together" }
            p {
                "One earthquake moves all objects. For each record the \
                 damaged objects are counted together; the objects are not \
                 treated as independent."
                @if let Some(r) = &found.correlation {
                    " Over the records, the logarithms of the intensities \
                     that damage two objects have a correlation of "
                    (short(r.value())) " in the median of all pairs"
                    @if let Some((low, high)) = r.interval().map(Interval::ends) {
                        ", from " (short(low)) " to " (short(high))
                    }
                    "."
                }
            }
            (table("Objects damaged together", &all))
        }
    }
}

fn object(found: &Assessment, one: &ObjectAssessment, k: usize) -> Markup {
    let chart = charts::curves(found, one, k).figure(String::new());
    let own = format!("as above: coefficient of restitution {}", one.eta);
    let others = one.alternatives.iter();
    let others = others.map(|o| (o.assumption.to_string(), &o.answer));
    let rows = std::iter::once((own, &one.answer)).chain(others);
    let all = words::answers(found, ("Assumption", " damage"), rows);
    html! {
        section {
            h2 { (one.id) }
            p {
                (short(one.width_m)) " m wide, " (short(one.height_m))
                " m high: alpha " (short(one.alpha_rad)) " rad, p "
                (short(one.p_rad_s)) " rad/s. "
                @if let Some(floor) = &one.floor {
                    "It stands on the floor " (floor) ", one linear mode of \
                     the building. There it begins to rock where the floor \
                     accelerates by " (short(one.uplift_pga_g)) " g. "
                } @else {
                    "It begins to rock at a PGA of "
                    (short(one.uplift_pga_g)) " g. "
                }
                "Damage is " (words::damage(one)) "."
            }
            figure.figure {
                div class="scroll drawing wide" role="region"
                    aria-label={ "Curves of " (one.id) } tabindex="0"
                {
                    (PreEscaped(inline(&chart.svg())))
                }
                figcaption {
                    "(a) Probability of damage: the records (points), and \
                     their lognormal fit with its 95 % band. An error of \
                     the model also moves the onset of rocking. (b) \
                     Rotation over alpha of 16, 50 and 84 % of the records at rising \
                     intensity. At 1 the object is at the angle from which \
                     it does not come back on flat, quiet ground."
                    @if !one.contributions.is_empty() {
                        " (c) The part of the annual frequency of damage \
                         that comes from motions of each intensity."
                    }
                }
            }
            h3 { "What changes the answer" }
            (table("Answers under other assumptions", &all))
            (remarks(found, one))
        }
    }
}

/// Further facts about an object.
fn remarks(found: &Assessment, one: &ObjectAssessment) -> Markup {
    let (im, unit) = (measure(found), found.unit);
    let damaging = one.by_record.iter().filter(|r| r.damages).take(NAMED);
    let damaging: Vec<String> =
        damaging.map(|r| format!("{} ({})", r.record, short(r.im))).collect();
    let stand = one.by_record.iter().filter(|r| !r.damages).count();
    html! {
        ul {
            @if let Some((best, beta)) = one.best_im() {
                li {
                    "Intensity measure: of " (one.ranking.measures.len())
                    " measures, " (best)
                    " predicts the damage best, with a dispersion of "
                    (short(beta)) "."
                    @for pga in one.ranking.measures.iter().take(1) {
                        @let beta = pga.dispersion.estimate.value();
                        @if beta.is_finite() && pga.im != best {
                            " PGA leaves " (short(beta)) "."
                        }
                    }
                }
            }
            @if !damaging.is_empty() {
                li {
                    "Records that damage it first, with their " (im) " in "
                    (unit) ": " (damaging.join(", ")) "."
                }
            }
            @if stand > 0 {
                li {
                    (stand) " of the " (found.records)
                    " records do not damage it at any intensity that was \
                     run. They enter the fit as lower bounds."
                }
            }
            @if let Some(needed) = &one.fragility.needed {
                li {
                    "For a 90 % interval of ±10 % about the median"
                    @if one.fragility.fitted.shift() > 0.0 {
                        " intensity above the onset of rocking"
                    }
                    ", "
                    (short(needed.for_median))
                    " records like these are needed. There are "
                    (found.records) "."
                }
            }
            @if one.resolution.unresolved > 0 {
                li {
                    "In " (one.resolution.unresolved) " of "
                    (one.resolution.analyses) " analyses double precision \
                                               may not decide whether the \
                                               object overturns. With \
                                               --certify they are repeated \
                                               in sufficient precision."
                }
            }
        }
    }
}

fn limits(found: &Assessment) -> Markup {
    let objects = &found.objects;
    html! {
        section {
            h2 { "What these numbers leave out" }
            ul {
                li {
                    "Sliding, jumping, twisting, soft or uneven ground, \
                     neighbours and walls. The model is one rigid block in \
                     a plane (Eq. 1 of Lachanas, Vamvatsikos and \
                     Dimitrakopoulos)."
                }
                li {
                    "The other horizontal and the vertical component of \
                     each record."
                }
                @if let Some(words) = words::recorded(found) {
                    li { (words) }
                }
                @if objects.iter().any(|one| one.floor.is_some()) {
                    li {
                        "The other modes of the building, its damage, and \
                         the weight of the object."
                    }
                }
                li {
                    "The uncertainty of the hazard curve. The intervals come "
                    (words::held(found)) ". Drawn: "
                    (found.basis.drawn.to_string()) "."
                }
                li {
                    "A test of the object itself. "
                    @if found.model_error.is_none() {
                        "The numbers have no error of the model. "
                    } @else {
                        "The error of the model was measured on two rocks \
                         with natural bases, in one laboratory; that of \
                         another object may differ. "
                    }
                    @if found.model_error == ModelError::default() {
                        "The range of the bias also covers a coefficient of \
                         restitution from 0.85 to 0.97. "
                    } @else {
                        "The intervals treat the coefficient of restitution \
                         as known. "
                    }
                    "The tables show the answers for 0.85 and 0.97."
                }
                @if objects.iter().any(|one| one.answer.risk.is_some()) {
                    li {
                        "Motions beyond the last point of the hazard curve. \
                         They are given the probability of damage at that \
                         point; for the upper end of a frequency each of \
                         them causes damage."
                    }
                }
                @if objects.iter().any(|o| o.damage != Damage::Overturning) {
                    li {
                        "If a rotation is the limit: damage from impacts at \
                         smaller rotations."
                    }
                }
            }
        }
    }
}

fn provenance(about: &About, files: &[&str]) -> Markup {
    html! {
        section {
            h2 { "Provenance" }
            dl {
                @for Provenance { what, is } in &about.provenance {
                    dt { (what) } dd { (is) }
                }
            }
            @if !files.is_empty() {
                p {
                    "All numbers: "
                    @for (k, file) in files.iter().enumerate() {
                        @if k > 0 { ", " }
                        a href=(file) { (file) }
                    }
                    "."
                }
            }
        }
    }
}
