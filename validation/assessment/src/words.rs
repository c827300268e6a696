//! The numbers of an assessment in words.

use crate::RECORDED_MOTIONS;
use rocking_common::words::{columns, percent, rounded};
use rocking_procedures::assess::{
    Answer, Assessment, Damage, IntervalPart, ObjectAssessment, ObjectFacts,
    ObjectState, Remedy, RemedyKind, SlidingObject, TargetVerdict,
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

/// Mean return period of damage in years, with its interval; a number beyond
/// the hazard curve is not known.
fn years(found: &Assessment, years: &Estimate) -> String {
    let longest = found.longest_years.unwrap_or(f64::INFINITY);
    let end = |x: f64| match x <= longest {
        true => thousands(x),
        false => format!("> {}", thousands(longest)),
    };
    let low = years.interval().map_or(f64::INFINITY, Interval::low);
    match years.value() <= longest {
        true => years.text("", end),
        false => {
            let rare = format!("rarer than 1 in {}", thousands(longest));
            let low = (low <= longest).then(|| end(low));
            rare + &low.map_or(String::new(), |x| format!(" (at least {x})"))
        }
    }
}

fn return_period(found: &Assessment, answer: &Answer) -> Option<String> {
    Some(years(found, &answer.return_period_years()?))
}

/// The probability of damage in T years in percent, with its interval; a
/// number beyond the hazard curve is not known.
pub(crate) fn in_years(found: &Assessment, answer: &Answer) -> Option<String> {
    let least = found.longest_years.unwrap_or(f64::INFINITY).recip();
    let least = 100.0 * -libm::expm1(-found.years * least);
    let percent = answer.probability()?.map(|p| 100.0 * p);
    Some(percent.text("", |x| match x >= least {
        true => rounded(x, 2).to_string(),
        false => format!("< {}", rounded(least, 2)),
    }))
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
pub(crate) fn damage(facts: &ObjectFacts) -> String {
    match facts.damage {
        Damage::Overturning => "overturning".to_owned(),
        Damage::Rotation(ratio) => format!("a rotation above {ratio} alpha"),
    }
}

/// Words in a list: `a, b and c`.
pub(crate) fn list(all: &[&str]) -> String {
    match all {
        [] => "none".to_owned(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The answer: which object first, how often, and whether the objects meet
/// the target.
pub(crate) fn first(found: &Assessment) -> String {
    let mut rows = Vec::new();
    let mut words = match found.objects.first() {
        None => "No object rocks: each slides first. ".to_owned(),
        Some(one) => leading(found, one),
    };
    if let Some(target) = found.target_years {
        let years = thousands(target);
        for (verdict, what) in [
            (TargetVerdict::Misses, "missed by"),
            (TargetVerdict::Undecided, "not decided for"),
            (TargetVerdict::Meets, "met by"),
        ] {
            let all = found.objects.iter();
            let those = all.filter(|one| one.target == Some(verdict));
            let those: Vec<&str> =
                those.map(|one| &*one.facts.object.label).collect();
            if !those.is_empty() {
                rows.push(format!("{what} {}", list(&those)));
            }
        }
        if !rows.is_empty() {
            let rows = rows.join("; ");
            words +=
                &format!("The target of once in {years} years is {rows}. ");
        }
    }
    let sliding = found.not_rocking.iter();
    let sliding: Vec<&str> =
        sliding.map(|one| one.facts.object.label.as_str()).collect();
    if !(sliding.is_empty() || found.objects.is_empty()) {
        words += &format!(
            "Without a rank, because of sliding before rocking: {}. ",
            list(&sliding)
        );
    }
    words.trim_end().to_owned()
}

/// The sentence on the object that comes first.
fn leading(found: &Assessment, one: &ObjectAssessment) -> String {
    let (label, what) = (&one.facts.object.label, damage(&one.facts));
    let longest = found.longest_years.unwrap_or(f64::INFINITY);
    let often = match one.answer.return_period_years() {
        Some(often) if often.value() <= longest => {
            let ends = often.interval().map(Interval::ends);
            format!("{what} is expected {}", once_in(often.value(), ends))
        }
        Some(_) => format!(
            "{what} is rarer than once in {} years",
            thousands(longest)
        ),
        None => format!(
            "a {} of {} {} causes {what} with a probability of 5 %",
            measure(found),
            three_digits(&one.answer.small_im),
            found.unit
        ),
    };
    if found.objects.len() + found.not_rocking.len() == 1 {
        return format!("{label}: {often}. ");
    }
    format!(
        "{label} needs attention first: {often}. It comes first in {} of the \
         draws. ",
        percent(one.first_in_draws, 0)
    )
}

/// What the intervals hold, and which part is the largest.
pub(crate) fn held(found: &Assessment) -> String {
    let parts = found.objects.iter().flat_map(|one| &one.parts);
    let mut sources: Vec<String> =
        parts.map(|part| part.source.to_string()).collect();
    sources.sort();
    sources.dedup();
    if sources.is_empty() {
        return "The numbers have no interval.".to_owned();
    }
    let sources: Vec<&str> = sources.iter().map(String::as_str).collect();
    let hazard = match found.longest_years {
        Some(_) => " The hazard curve counts as known.",
        None => "",
    };
    let mut words =
        format!("The 95 % intervals include: {}.{hazard}", list(&sources));
    if let Some(one) = found.objects.first()
        && let Some(part) = one.largest_part()
    {
        words += &format!(
            " For {}, the largest part is the {}: from {} to {} {} alone.",
            one.facts.object.label,
            part.source,
            end(found, part.low),
            end(found, part.high),
            unit(found)
        );
    }
    if !found.model_error.is_none() {
        words += &format!(" Error of the model: {}.", found.model_error);
    }
    if let Some(remark) = found.basis.remark {
        words += &format!(" Note: {remark}.");
    }
    words
}

/// An end of a part of an interval: years, or an intensity.
pub(crate) fn end(found: &Assessment, x: f64) -> String {
    match found.longest_years {
        Some(longest) if !(x <= longest) => {
            format!("> {}", thousands(longest))
        }
        Some(_) => thousands(x),
        None => short(x),
    }
}

/// The unit of an end of a part of an interval.
pub(crate) fn unit(found: &Assessment) -> String {
    match found.longest_years {
        Some(_) => "years".to_owned(),
        None => format!("{} for 5 %", found.unit),
    }
}

/// Effect of recorded motions, in words.
pub(crate) fn recorded(found: &Assessment) -> Option<String> {
    let own = found.recorded_motions?;
    Some(format!(
        "Embedded motions: under recorded motions the median {} of \
         overturning is {} times as large ({} blocks, ordinary suite). Each \
         answer on the ground includes this factor. {RECORDED_MOTIONS}",
        measure(found),
        rounded_text(&own.median_ratio, 2),
        own.blocks
    ))
}

/// A table of answers, each behind its words; `first` is the head of these.
pub(crate) fn answers<'a>(
    found: &Assessment,
    (first, damage): (&str, &str),
    rows: impl Iterator<Item = (String, &'a Answer)>,
) -> WordTable {
    let row = |(words, answer): (String, &'a Answer)| {
        let risk = return_period(found, answer).into_iter();
        let risk = risk.chain(in_years(found, answer));
        let ims = [&answer.small_im, &answer.median_im].map(three_digits);
        [words].into_iter().chain(risk).chain(ims).collect()
    };
    let mut heads = risk_heads(found, first);
    heads.extend(intensity_heads(found, damage));
    (heads, rows.map(row).collect())
}

/// The head of a first column, and those of the risk.
fn risk_heads(found: &Assessment, first: &str) -> Vec<String> {
    let mut heads = vec![first.to_owned()];
    if found.longest_years.is_some() {
        heads.push("Mean return period of damage, years".to_owned());
        let years = found.years;
        heads.push(format!("Probability of damage in {years} years, %"));
    }
    heads
}

fn intensity_heads(found: &Assessment, damage: &str) -> [String; 2] {
    let (im, unit) = (measure(found), found.unit);
    ["5 %", "50 %"].map(|p| format!("{im} of {p}{damage}, {unit}"))
}

/// The label of an object, with the further columns of its inventory.
pub(crate) fn label(facts: &ObjectFacts) -> String {
    let notes = facts.object.notes.iter();
    let notes: Vec<String> =
        notes.map(|(head, cell)| format!("{head} {cell}")).collect();
    let label = &facts.object.label;
    match notes.is_empty() {
        true => label.clone(),
        false => format!("{label} ({})", notes.join(", ")),
    }
}

/// The remarks on an object; without one, nothing.
pub(crate) fn remarks(facts: &ObjectFacts) -> String {
    let all = facts.remarks.iter().map(ToString::to_string);
    all.collect::<Vec<_>>().join("; ")
}

/// The table of all objects that rock.
pub(crate) fn objects(found: &Assessment) -> WordTable {
    let mut heads = risk_heads(found, "Object");
    heads.insert(1, "Damage".to_owned());
    let with_risk = found.longest_years.is_some();
    if found.target_years.is_some() {
        heads.push("Target".to_owned());
        heads.push("Measure that meets the target".to_owned());
    }
    if !with_risk {
        heads.extend(intensity_heads(found, " damage"));
    }
    heads.push("Share of draws in which it comes first".to_owned());
    heads.push("Records under which it slides first".to_owned());
    let with_remarks =
        (found.objects.iter()).any(|one| !one.facts.remarks.is_empty());
    heads.extend(with_remarks.then(|| "Remarks".to_owned()));
    let row = |(one, rank): (&ObjectAssessment, usize)| {
        let facts = &one.facts;
        let mut cells = vec![format!("{rank}. {}", label(facts))];
        cells.push(facts.damage.to_string());
        cells.extend(return_period(found, &one.answer));
        cells.extend(in_years(found, &one.answer));
        if let Some(target) = one.target {
            let meets = Some(TargetVerdict::Meets);
            let mut those = one.remedies.iter();
            let found = those.find(|remedy| remedy.target == meets);
            let found = found.map(|remedy| measure_of(remedy, facts));
            cells.extend([target.to_string(), found.unwrap_or_default()]);
        }
        if !with_risk {
            let ims = [&one.answer.small_im, &one.answer.median_im];
            cells.extend(ims.map(three_digits));
        }
        cells.push(percent(one.first_in_draws, 0));
        cells.push(match one.slides_first {
            None => "friction not given".to_owned(),
            Some(share) => percent(share, 0),
        });
        cells.extend(with_remarks.then(|| remarks(facts)));
        cells
    };
    (heads, found.objects.iter().zip(1..).map(row).collect())
}

/// The table of the objects that slide first.
pub(crate) fn sliding(found: &Assessment) -> WordTable {
    let heads = [
        "Object",
        "State",
        "Friction",
        "Friction that rocking needs",
        "Records under which it slides first",
        "Remarks",
    ];
    let row = |one: &SlidingObject| {
        let needed = match one.needed_friction {
            mu if mu <= 1.0 => ((100.0 * mu).ceil() / 100.0).to_string(),
            _ => "above 1".to_owned(),
        };
        let own = one.facts.object.friction.unwrap_or(f64::NAN);
        vec![
            label(&one.facts),
            ObjectState::NotRocking.to_string(),
            short(own),
            needed,
            percent(one.share, 0),
            remarks(&one.facts),
        ]
    };
    let rows = found.not_rocking.iter().map(row).collect();
    (heads.map(str::to_owned).to_vec(), rows)
}

/// A measure in words.
fn measure_of(remedy: &Remedy, facts: &ObjectFacts) -> String {
    let to = if remedy.return_period_years.is_some() { "" } else { "up to " };
    let percent = rounded(100.0 * remedy.size, 3);
    match remedy.measure {
        RemedyKind::WiderBase => format!(
            "base {to}{percent} cm wide instead of {} cm",
            rounded(100.0 * facts.width_m, 3)
        ),
        RemedyKind::LowerCentre => {
            format!("centre of mass {to}{percent} cm lower")
        }
        RemedyKind::Isolation => format!(
            "isolation with a period of {} s and 15 % damping",
            remedy.size
        ),
        RemedyKind::Tie => {
            format!("tie at the top that yields at {percent} % of its weight")
        }
        RemedyKind::NoUplift => {
            format!("tie at the top for {percent} % of its weight: no uplift")
        }
    }
}

/// The measures for the objects that do not meet the target.
pub(crate) fn remedies(found: &Assessment) -> WordTable {
    let heads =
        ["Object", "Measure", "Mean return period of damage, years", "Target"];
    let row = |one: &ObjectAssessment, remedy: &Remedy| {
        let held = remedy.measure == RemedyKind::NoUplift;
        let period = remedy.return_period_years.map(|own| years(found, &own));
        vec![
            one.facts.object.label.clone(),
            measure_of(remedy, &one.facts),
            match (period, held) {
                (Some(period), _) => period,
                (None, true) => {
                    let target = found.target_years.unwrap_or(f64::NAN);
                    format!("no uplift up to once in {}", thousands(target))
                }
                (None, false) => "not enough".to_owned(),
            },
            remedy.target.map_or(String::new(), |own| own.to_string()),
        ]
    };
    let each = found.objects.iter();
    let each = each.flat_map(|one| one.remedies.iter().map(move |r| (one, r)));
    let rows = each.map(|(one, remedy)| row(one, remedy)).collect();
    (heads.map(str::to_owned).to_vec(), rows)
}

/// How far each object leans, and on what it can fall.
pub(crate) fn room(found: &Assessment) -> WordTable {
    let heads = ["Object", "Clearance for its top, cm", "Can fall on"];
    let row = |facts: &ObjectFacts| {
        let falls: Vec<&str> =
            facts.falls_on.iter().map(String::as_str).collect();
        vec![
            facts.object.label.clone(),
            rounded(100.0 * facts.lean_m, 2).to_string(),
            match facts.object.position_m {
                Some(_) => list(&falls),
                None => "no position given".to_owned(),
            },
        ]
    };
    let rows = every(found).map(row).collect();
    (heads.map(str::to_owned).to_vec(), rows)
}

/// All objects: first those with a rank.
pub(crate) fn every(
    found: &Assessment,
) -> impl Iterator<Item = &ObjectFacts> + Clone {
    let sliding = found.not_rocking.iter().map(|one| &one.facts);
    found.objects.iter().map(|one| &one.facts).chain(sliding)
}

/// The parts of an object's interval.
pub(crate) fn parts(found: &Assessment, one: &ObjectAssessment) -> WordTable {
    let heads = [
        "If only this is uncertain".to_owned(),
        match found.longest_years {
            Some(_) => "Mean return period of damage, years".to_owned(),
            None => format!("{}, {}", measure(found), unit(found)),
        },
    ];
    let row = |part: &IntervalPart| {
        let [low, high] = [part.low, part.high].map(|x| end(found, x));
        vec![part.source.to_string(), format!("{low} to {high}")]
    };
    (heads.to_vec(), one.parts.iter().map(row).collect())
}

/// The text for the terminal: the answer, the tables, and the effect of
/// recorded motions.
pub fn text(found: &Assessment) -> String {
    let mut text = format!("{}\n\n{}\n", first(found), held(found));
    for remark in &found.remarks {
        text += &format!("Note: {remark}.\n");
    }
    for table in [objects(found), sliding(found), remedies(found)] {
        if !table.1.is_empty() {
            text += &format!("\n{}", numbered(&table));
        }
    }
    let last = recorded(found).map(|own| format!("\n{own}\n"));
    text + &last.unwrap_or_default()
}

/// A table: its heads, and its rows cell by cell.
pub(crate) type WordTable = (Vec<String>, Vec<Vec<String>>);

/// A table whose heads are too long for its columns: numbered, above it.
pub(crate) fn numbered((heads, rows): &WordTable) -> String {
    let heads = heads.iter().zip(1..);
    let heads = heads.map(|(head, k)| format!("[{k}] {head}\n"));
    heads.collect::<String>() + "\n" + &columns(rows, |_| false)
}
