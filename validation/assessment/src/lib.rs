//! The page of an assessment: which object is damaged first, how often, and
//! how sure that is.

mod charts;
mod data;
mod room;
pub mod shaking;
mod words;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_draw::page::table::scrolled;
use rocking_draw::page::{head, inline};
use rocking_exchange::ExchangeFormat;
use rocking_procedures::assess::{Assessment, Damage, ObjectAssessment};
use rocking_procedures::fragility::hazard::Hazard;
use rocking_statistics::Interval;
use rocking_synthesis::SuiteKind;
use serde::{Deserialize, Serialize};

pub use data::json;
pub use words::{once_in, text};

use rocking_common::words::percent;
use words::{WordTable, measure, short};

/// The page; it is written last, so if it exists, all files do.
pub const PAGE: &str = "index.html";

/// How many records are named that damage an object first.
const NAMED: usize = 5;

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
        ("objects.csv".to_owned(), data::objects(found)),
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
    let all: Vec<_> = words::every(found).collect();
    let title = match all.as_slice() {
        [one] => format!("Rocking of {}", one.object.label),
        all => format!("Rocking of {} objects", all.len()),
    };
    let introduction = html! {
        (about.ground) " Each object is modelled as a free-standing rigid \
         block, which was not tested itself. " (words::held(found)) " "
        @if let Some(words) = words::recorded(found) { (words) "." }
        @for remark in &found.remarks { " Note: " (remark.to_string()) "." }
    };
    let sections = html! {
        section {
            h2 { "Which object first" }
            @if !found.objects.is_empty() {
                (table("Objects that rock", &words::objects(found)))
            }
            (sliding(found))
        }
        (remedies(found))
        section {
            h2 { "The room" }
            (room::line(&all))
            (room::plan(&all))
            p {
                "The dashed outline is the rotation that counts as damage. \
                 The clearance is how far the top leans beyond the base \
                 there; farther, the object falls as far as it is high."
            }
            (table("Clearance, and falls", &words::room(found)))
        }
        @if !found.together.is_empty() { (together(found)) }
        @for (k, one) in found.objects.iter().enumerate() {
            (object(found, one, k))
        }
        (limits(found))
        (provenance(about, files))
        (sign_off())
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

/// The objects that slide before they rock.
fn sliding(found: &Assessment) -> Markup {
    let unknown = found.objects.iter();
    let unknown = unknown.filter(|one| one.slides_first.is_none());
    let unknown: Vec<&str> =
        unknown.map(|one| one.facts.object.label.as_str()).collect();
    html! {
        @if !found.not_rocking.is_empty() {
            h3 { "Objects that slide first" }
            p {
                "Under more than " (percent(found.sliding_share, 0))
                " of the records, these objects need more friction than their \
                 floor gives at some time before damage. The model does not \
                 slide. It has no answer for them, so they have no rank and \
                 no return period. On a floor with the friction that rocking \
                 needs, they can be assessed; else fix them, or ask for a \
                 study of their sliding."
            }
            (table("Objects that slide first", &words::sliding(found)))
        }
        @if !unknown.is_empty() {
            p {
                "No coefficient of friction is given for "
                (words::list(&unknown))
                ". Whether they slide before they rock was not checked."
            }
        }
    }
}

/// What helps the objects that do not meet the target.
fn remedies(found: &Assessment) -> Markup {
    let all = words::remedies(found);
    html! {
        @if !all.1.is_empty() {
            section {
                h2 { "Measures that reach the target" }
                p {
                    "An object meets the target if its whole interval does, \
                     and with each measure it does. Sizes are close to the least ones, and rounded up \
                     to 1 cm or 1 % of the weight. A wider base counts across \
                     the shorter side. A lower centre of mass, such as \
                     ballast, counts as a block of twice its height. Ties hold \
                     the top. They are computed from the moments about the \
                     pivot, the yielding one for small angles. Check that the \
                     object bears them."
                }
                (table("Measures", &all))
            }
        }
    }
}

fn sign_off() -> Markup {
    html! {
        section.sign {
            h2 { "Sign-off" }
            p {
                "By signing I confirm that the inventory, the hazard curve and \
                 the records are those of the site, and that each remark \
                 above was considered."
            }
            ul.signatures {
                @for what in ["Issued", "Prepared by", "Reviewed by"] {
                    li { (what) " ____________________" }
                }
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
    let facts = &one.facts;
    let eta = facts.object.restitution.velocity_ratio();
    let own = format!("as above: coefficient of restitution {eta}");
    let others = one.alternatives.iter();
    let others = others.map(|o| (o.assumption.to_string(), &o.answer));
    let rows = std::iter::once((own, &one.answer)).chain(others);
    let all = words::answers(found, ("Assumption", " damage"), rows);
    let block = &facts.object.block;
    html! {
        section {
            h2 { (k + 1) ". " (words::label(facts)) }
            p {
                (short(facts.width_m)) " m wide, " (short(facts.height_m))
                " m high: alpha " (short(block.slenderness_rad())) " rad, p "
                (short(block.frequency_rad_s())) " rad/s. "
                @if let Some(floor) = &facts.object.floor {
                    "It stands on the floor " (floor.name) ", one linear mode \
                     of the building. There it begins to rock where the floor \
                     accelerates by " (short(facts.uplift_pga_g)) " g. "
                } @else {
                    "It begins to rock at a PGA of "
                    (short(facts.uplift_pga_g)) " g. "
                }
                "Damage is " (words::damage(facts)) ". Its key in the files \
                 for other programs is " code { (facts.object.id) } "."
            }
            h3 { "What changes the answer" }
            (table("Parts of the interval", &words::parts(found, one)))
            (table("Answers under other assumptions", &all))
            details {
                summary { "Curves and further facts" }
                figure.figure {
                    div class="scroll drawing wide" role="region"
                        aria-label={ "Curves of " (facts.object.label) }
                        tabindex="0"
                    {
                        (PreEscaped(inline(&chart.svg())))
                    }
                    figcaption {
                        "(a) Probability of damage: the records (points), \
                         and their lognormal fit with its 95 % band. An \
                         error of the model also moves the onset of rocking. \
                         (b) Rotation over alpha of 16, 50 and 84 % of the \
                         records at rising intensity. At 1 the object is at \
                         the angle from which it does not come back on flat, \
                         quiet ground."
                        @if !one.contributions.is_empty() {
                            " (c) The part of the annual frequency of damage \
                             that comes from motions of each intensity."
                        }
                    }
                }
                (remarks(found, one))
            }
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
                    "Jumping, twisting, soft or uneven ground, \
                     neighbours and walls. The model is one rigid block in \
                     a plane (Eq. 1 of Lachanas, Vamvatsikos and \
                     Dimitrakopoulos)."
                }
                li {
                    "The other horizontal and the vertical component of \
                     each record."
                }
                @if words::every(found).any(|one| one.object.floor.is_some()) {
                    li {
                        "The other modes of the building, its damage, and \
                         the weight of the object."
                    }
                }
                li {
                    "The uncertainty of the hazard curve. Drawn: "
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
                }
                @if objects.iter().any(|one| one.answer.risk.is_some()) {
                    li {
                        "Motions beyond the last point of the hazard curve. \
                         They are given the probability of damage at that \
                         point; for the upper end of a frequency each of \
                         them causes damage. A return period longer than that \
                         of the last point is not known."
                    }
                }
                @if words::every(found).any(|o| o.damage != Damage::Overturning) {
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
