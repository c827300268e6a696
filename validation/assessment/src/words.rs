//! The numbers of an assessment in words.

use crate::RECORDED_MOTIONS;
use rocking_common::words::{columns, percent, rounded};
use rocking_procedures::assess::{
    Answer, Assessment, Damage, ObjectAssessment,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::{Estimate, Interval};

/// A number in three significant digits.
pub(crate) fn short(x: f64) -> String {
    rounded(x, 3).to_string()
}

/// A value and its interval, rounded to this number of significant digits.
fn rounded_text(estimate: &Estimate, digits: usize) -> String {
    estimate.text("", |x| match x.is_finite() {
        true => rounded(x, digits).to_string(),
        false => "open".to_owned(),
    })
}

/// A value and its interval, rounded to three significant digits.
pub(crate) fn three_digits(estimate: &Estimate) -> String {
    rounded_text(estimate, 3)
}

/// A return period in years with the ends of its 95 % interval, in two
/// significant digits: `once in 740 years on average (95 % interval 330 to
/// 1,700)`.
pub fn once_in(years: f64, ends: Option<(f64, f64)>) -> String {
    let ends = ends.map_or(String::new(), |(low, high)| {
        format!(" (95 % interval {} to {})", thousands(low), thousands(high))
    });
    format!("once in {} years on average{ends}", thousands(years))
}

/// A number of two significant digits, with commas between its thousands.
fn thousands(x: f64) -> String {
    match rounded(x, 2) {
        x if x.is_infinite() => "open".to_owned(),
        x if x >= 1e3 => {
            format!("{},{:03}", thousands((x / 1e3).floor()), x % 1e3)
        }
        x => x.to_string(),
    }
}

/// Mean return period of damage in years, with its interval.
pub(crate) fn return_period(answer: &Answer) -> Option<String> {
    Some(answer.return_period_years()?.text("", thousands))
}

/// The probability of damage in T years in percent, with its interval.
pub(crate) fn in_years(answer: &Answer) -> Option<String> {
    Some(rounded_text(&answer.probability()?.map(|p| 100.0 * p), 2))
}

/// The intensity measure.
pub(crate) fn measure(found: &Assessment) -> String {
    symbol(&found.im)
}

/// An intensity measure without its unit.
pub(crate) fn symbol(im: &IntensityMeasure) -> String {
    match im {
        IntensityMeasure::Axis(intensity) => intensity.row().symbol.to_owned(),
        other => other.words().split(" (").next().unwrap_or("").to_owned(),
    }
}

/// The damage, as a noun.
pub(crate) fn damage(one: &ObjectAssessment) -> String {
    match one.damage {
        Damage::Overturning => "overturning".to_owned(),
        Damage::Rotation(ratio) => format!("a rotation above {ratio} alpha"),
    }
}

/// The sentence that comes first.
pub(crate) fn first(found: &Assessment) -> String {
    let Some(one) = found.objects.first() else { return String::new() };
    let (id, what) = (&one.id, damage(one));
    let often = match one.answer.return_period_years() {
        Some(often) => {
            let ends = often.interval().map(Interval::ends);
            format!("{what} is expected {}", once_in(often.value(), ends))
        }
        None => format!(
            "a {} of {} {} causes {what} with a probability of 5 %",
            measure(found),
            three_digits(&one.answer.small_im),
            found.unit
        ),
    };
    let mut interval = format!("The 95 % interval comes {}.", held(found));
    if let Some(remark) = found.basis.remark {
        interval += &format!(" Note: {remark}.");
    }
    if found.objects.len() == 1 {
        return format!("{id}: {often}. {interval}");
    }
    format!(
        "{id} needs attention first: {often}. {interval} {id} comes first in \
         {} of the draws.",
        percent(one.first_in_draws, 0)
    )
}

/// Origin of the intervals.
pub(crate) fn held(found: &Assessment) -> String {
    let model = match found.model_error {
        none if none.is_none() => String::new(),
        error => format!(" and the error of the model: {error}"),
    };
    format!("from the choice of the records{model}")
}

/// Effect of recorded motions, in words.
pub(crate) fn recorded(found: &Assessment) -> Option<String> {
    let own = found.recorded_motions?;
    let mut words = format!(
        "Embedded motions: under recorded motions the median {} of \
         overturning is {} times as large ({} blocks, ordinary suite)",
        measure(found),
        rounded_text(&own.median_ratio, 2),
        own.blocks
    );
    if let Some(ratio) = &own.return_period_ratio {
        words += "; with this hazard curve, return periods are ";
        words += &rounded_text(ratio, 2);
        words += " times as long";
    }
    Some(words + ". " + RECORDED_MOTIONS)
}

/// The heads of the table of all objects.
fn heads(found: &Assessment) -> Vec<String> {
    let mut heads = answer_heads(found, "Object", " damage");
    heads.insert(1, "Damage".to_owned());
    if found.objects.len() > 1 {
        heads.push("Comes first in draws".to_owned());
    }
    heads.push("Records under which it slides first".to_owned());
    heads
}

/// A table of answers, each behind its words; `first` is the head of these.
pub(crate) fn answers<'a>(
    found: &Assessment,
    (first, damage): (&str, &str),
    rows: impl Iterator<Item = (String, &'a Answer)>,
) -> WordTable {
    let row = |(words, answer)| [vec![words], answer_cells(answer)].concat();
    (answer_heads(found, first, damage), rows.map(row).collect())
}

/// The head of a first column, and those of [`answer_cells`].
fn answer_heads(found: &Assessment, first: &str, damage: &str) -> Vec<String> {
    let (im, unit) = (measure(found), found.unit);
    let mut heads = vec![first.to_owned()];
    if found.objects.iter().any(|one| one.answer.risk.is_some()) {
        heads.push("Mean return period of damage, years".to_owned());
        let years = found.years;
        heads.push(format!("Probability of damage in {years} years, %"));
    }
    let ims = ["5 %", "50 %"];
    heads.extend(ims.map(|p| format!("{im} of {p}{damage}, {unit}")));
    heads
}

/// Numbers of a fragility, cell by cell.
fn answer_cells(answer: &Answer) -> Vec<String> {
    let risk = return_period(answer).into_iter().chain(in_years(answer));
    let ims =
        [three_digits(&answer.small_im), three_digits(&answer.median_im)];
    risk.chain(ims).collect()
}

/// The table of all objects.
pub(crate) fn objects(found: &Assessment) -> WordTable {
    let row = |one: &ObjectAssessment| {
        let mut cells = vec![one.id.clone(), one.damage.to_string()];
        cells.extend(answer_cells(&one.answer));
        if found.objects.len() > 1 {
            cells.push(percent(one.first_in_draws, 0));
        }
        cells.push(match one.slides_first {
            None => "friction not given".to_owned(),
            Some(share) => percent(share, 0),
        });
        cells
    };
    (heads(found), found.objects.iter().map(row).collect())
}

/// The text for the terminal: the first sentence, the table, and the effect of
/// recorded motions.
pub fn text(found: &Assessment) -> String {
    let table = numbered(&objects(found));
    let last = recorded(found).map(|own| format!("\n{own}\n"));
    first(found) + "\n\n" + &table + &last.unwrap_or_default()
}

/// A table: its heads, and its rows cell by cell.
pub(crate) type WordTable = (Vec<String>, Vec<Vec<String>>);

/// A table whose heads are too long for its columns: numbered, above it.
pub(crate) fn numbered((heads, rows): &WordTable) -> String {
    let heads = heads.iter().zip(1..);
    let heads = heads.map(|(head, k)| format!("[{k}] {head}\n"));
    heads.collect::<String>() + "\n" + &columns(rows, |_| false)
}
