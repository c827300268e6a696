//! The walk over two trees side by side. The path of a branch decides its
//! kind, and so how much it may differ.

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::change::{Change, Difference, Subject};
use super::input::{bounded, text};
use super::number::NumberChange;
use rocking_common::findings::{
    ClaimResult, Effect, Exists, Quantity, RowPlace, Seen, SuiteSet, TableRow,
    Topic, Unit,
};
use rocking_common::json::Extended;
use rocking_common::paper::{Arm, LEAST_USABLE};
use rocking_proof::verdict::snapshot::QuantityResult;
use rocking_statistics::Estimate;

/// Old and new.
type Sides<T> = [T; 2];

/// A walk over two trees.
pub(super) struct Walk<'a> {
    /// The trees.
    pub roots: Sides<&'a Value>,
    /// The differences found so far.
    pub out: &'a mut Difference,
}

impl Walk<'_> {
    /// Compares a branch, or those below it that either side has.
    pub fn compare(&mut self, path: &[&str], sides: Sides<Option<&Value>>) {
        let before = self.out.changes.len();
        let whole = self.visit(path, sides).is_some();
        let silent = sides[0] != sides[1] && self.out.changes.len() == before;
        match sides {
            [Some(Value::Object(a)), Some(Value::Object(b))]
                if silent || !whole =>
            {
                let added = b.keys().filter(|key| !a.contains_key(*key));
                for key in a.keys().chain(added) {
                    let path = [path, &[key]].concat();
                    self.compare(&path, [a.get(key), b.get(key)]);
                }
            }
            _ if silent => self.say(Subject::Text, words(path), sides),
            _ => {}
        }
    }

    /// Compares a branch as a whole; none if its branches are to be compared.
    /// They are compared as well if this finds no change in branches that
    /// differ.
    fn visit(
        &mut self,
        path: &[&str],
        sides: Sides<Option<&Value>>,
    ) -> Option<()> {
        match (path, sides) {
            (
                ["settings", _]
                | ["suites", _, "source" | "component_rule"]
                | ["claims", _, "yardsticks" | "no_effect"]
                | ["cases", _, "kind" | "method" | "oracle"]
                | ["cases", _, "quantities", _, "kind" | "bound" | "values"],
                _,
            ) => self.say(Subject::Setting, words(path), sides),
            (["cases", _, "verdict"], _) => {
                self.say(Subject::Case, words(&path[..2]), sides);
            }
            (["answers", question], [Some(a), Some(b)]) => {
                let stays = a["lead"] == b["lead"];
                let of =
                    if stays { Subject::Wording } else { Subject::Answer };
                let sentences = [a, b].map(|answer| answer.get("sentence"));
                self.say(of, (*question).to_owned(), sentences);
            }
            (["suites", suite, "list", _], _) => {
                let records = self.out.records.entry((*suite).to_owned());
                records.or_default().add(sides);
            }
            (["overturnings", _, record], [Some(a), Some(b)]) => {
                let [a, b] = both::<Extended>([a, b])?;
                let records = &mut self.out.effect.records;
                records.insert((*record).into(), b.0 / a.0 - 1.0);
            }
            (["tables", topic, "rows", _], [Some(a), Some(b)]) => {
                self.row(topic, [a, b])?;
            }
            (["claims", id, "results", _], [Some(a), Some(b)]) => {
                self.result(id, both([a, b])?);
            }
            (["cases", id, "quantities", name, "first"], _) => {
                let own = |root: &'_ Value| {
                    QuantityResult::deserialize(
                        &root["cases"][id]["quantities"][name],
                    )
                };
                let [a, b] = self.roots.map(own);
                self.values(&words(&path[..4]), &[a.ok()?, b.ok()?]);
            }
            (
                ["suites" | "claims" | "tables" | "cases", _]
                | ["claims", _, "results", _]
                | ["tables", _, "rows", _]
                | ["cases", _, "quantities" | "rejected", _],
                [Some(one), None] | [None, Some(one)],
            ) => {
                let other = self.roots[usize::from(sides[0].is_some())];
                let (what, why) = part(path, one, other);
                let said = sides.map(|side| side.map(|_| String::new()));
                if self.out.changes.iter().all(|c| c.what != what) {
                    let change = Change::of(Subject::Part, what, said);
                    self.out.changes.push(Change { why, ..change });
                }
            }
            _ => return None,
        }
        Some(())
    }

    /// Compares texts.
    fn say(
        &mut self,
        of: Subject,
        what: String,
        [a, b]: Sides<Option<&Value>>,
    ) {
        self.tally(of);
        if a != b {
            let said = [a, b].map(|side| Some(text(side)));
            self.out.changes.push(Change::of(of, what, said));
        }
    }

    fn tally(&mut self, of: Subject) {
        *self.out.compared.entry(of).or_default() += 1;
    }

    fn number(&mut self, what: String, moved: Option<NumberChange>) {
        self.tally(Subject::Number);
        self.out.changes.extend(moved.map(|moved| {
            let said = moved.values.clone().map(Some);
            Change {
                relevant: moved.is_beyond(),
                moved: Some(moved),
                ..Change::of(Subject::Number, what, said)
            }
        }));
    }

    /// Compares the numbers of a row of a table.
    fn row(&mut self, topic: &str, rows: Sides<&Value>) -> Option<()> {
        let quantities =
            self.roots.map(|root| &root["tables"][topic]["quantities"]);
        let [old, new] = both::<Vec<Quantity>>(quantities)?;
        let topic = topic_of(topic).filter(|_| old == new)?;
        let [a, b] = both::<TableRow>(rows)?;
        let RowPlace { suite, intensity, .. } = b.at;
        for (k, Quantity { name, words, unit }) in new.iter().enumerate() {
            let n = [(&a, self.roots[0]), (&b, self.roots[1])];
            let n = n.map(|(row, root)| {
                let own = behind(&new, row, name);
                own.or_else(|| records(root, suite?.name()))
            });
            let effect = topic.smallest_effect(*unit);
            let values = [a.values[k], b.values[k]];
            let moved = NumberChange::between(effect, *unit, values, n);
            if topic == Topic::Overturning {
                let group =
                    RowPlace { suite, intensity, ..RowPlace::default() };
                let medians = &mut self.out.effect.medians;
                let own = medians.entry(placed(&group)).or_default();
                own.push(moved.as_ref().map_or(0.0, |moved| moved.change));
            }
            self.number(format!("{words}, {}", placed(&b.at)), moved);
        }
        Some(())
    }

    /// Compares the verdicts on a claim, and its effect.
    fn result(&mut self, id: &str, [a, b]: Sides<ClaimResult>) {
        let claim = &self.roots[1]["claims"][id];
        let plain = Some(&claim["plain"]).filter(|plain| *plain != "");
        let named = text(plain.or(claim.get("measure")));
        let what = format!("\"{named}\" ({id}), {}", b.place());
        let n = self.roots.map(|root| records(root, b.suite.name()));
        let values = [a.estimate, b.estimate];
        let effect = Effect::of(b.unit);
        let moved = NumberChange::between(effect, b.unit, values, n);
        let seen = [a.seen, b.seen];
        let exists = [a.exists, b.exists];
        let turned = |seen: &[Seen; 2]| {
            seen.contains(&Seen::Yes) && seen.contains(&Seen::No)
        };
        let against = [Some(Exists::Yes), Some(Exists::Opposite)];
        for (of, words, opposite, moved) in [
            ("seen", seen.map(|seen| Some(seen.name())), turned(&seen), None),
            (
                "exists",
                exists.map(|exists| Some(exists?.name())),
                against.iter().all(|word| exists.contains(word)),
                moved.clone(),
            ),
        ] {
            if words[0].and(words[1]).is_some() {
                self.tally(Subject::Finding);
            }
            if words[0] != words[1] {
                let said = words.map(|word| word.map(str::to_owned));
                let what = format!("{what}, {of}");
                let change = Change::of(Subject::Finding, what, said);
                let change = Change { opposite, moved, ..change };
                self.out.changes.push(change);
            }
        }
        self.number(what, moved);
    }

    /// Compares the values of a quantity of a case.
    fn values(&mut self, what: &str, [a, b]: &Sides<QuantityResult>) {
        for (k, (old, new)) in a.first.iter().zip(&b.first).enumerate() {
            // Every bound was checked when it was read.
            let effect = bounded(b, old.0).unwrap_or_default();
            let values = [old.0, new.0].map(Estimate::exact);
            let moved =
                NumberChange::between(effect, Unit::One, values, [None; 2]);
            let what = format!("{what}, value {} of {}", k + 1, b.values);
            self.number(what, moved);
        }
    }
}

impl Change {
    fn of(
        of: Subject,
        what: String,
        [old, new]: Sides<Option<String>>,
    ) -> Self {
        let relevant = !matches!(of, Subject::Wording | Subject::Text);
        Self { kind: of, what, old, new, relevant, ..Self::default() }
    }
}

/// Two branches in their type; none if either has another type.
fn both<T: DeserializeOwned>(sides: Sides<&Value>) -> Option<Sides<T>> {
    let [a, b] = sides.map(T::deserialize);
    Some([a.ok()?, b.ok()?])
}

/// A path in words.
fn words(path: &[&str]) -> String {
    let owner = match path {
        ["settings", "eta"] => "coefficient of restitution".into(),
        ["settings", name, ..] => name.replace('_', " "),
        ["suites", kind, ..] => format!("{kind} suite"),
        ["claims", id, ..] => format!("claim {id}"),
        ["cases", id, ..] => format!("case {id}"),
        ["tables", topic, ..] => {
            topic_of(topic).map_or("", Topic::words).to_owned()
        }
        _ => path[..path.len().min(2)].join(", "),
    };
    let rest = path.iter().skip(2);
    let rest = rest.filter(|name| !["results", "quantities"].contains(name));
    rest.fold(owner, |all, name| format!("{all}, {}", name.replace('_', " ")))
}

fn topic_of(name: &str) -> Option<Topic> {
    Topic::deserialize(&Value::from(name)).ok()
}

/// A place of a table in words, with its intensity measure and suite.
fn placed(at: &RowPlace) -> String {
    let intensity = at.intensity.map(|im| im.row().words.to_owned());
    let suite = at.suite.map(|suite| suite.to_string());
    let rest = Some(at.to_string()).filter(|rest| !rest.is_empty());
    let parts = [intensity, suite, rest].into_iter().flatten();
    parts.collect::<Vec<_>>().join(", ")
}

/// Number of records of the suites with a name.
fn records(root: &Value, tested: &str) -> Option<usize> {
    let suites = root["suites"].as_object()?;
    let own = suites.iter().filter(|(kind, _)| {
        [SuiteSet::Both.name(), kind.as_str()].contains(&tested)
    });
    let n: u64 = own.filter_map(|(_, s)| s["records"].as_u64()).sum();
    usize::try_from(n).ok().filter(|n| *n > 0)
}

/// Number of ratios or histories behind a number of a row, if the row counts
/// them.
fn behind(all: &[Quantity], row: &TableRow, name: &str) -> Option<usize> {
    let count = |name: &str| {
        let at = all.iter().position(|quantity| quantity.name == name)?;
        Some(row.values[at].value() as usize)
    };
    match name {
        "median_alpha_above_0.25" => count("usable_alpha_above_0.25"),
        "median_alpha_to_0.25" => None,
        _ => count("usable"),
    }
}

/// The name of a part, and the reason why the other results lack it, if known.
/// All parts of a grid that was not run have one name.
pub(super) fn part(
    path: &[&str],
    part: &Value,
    other: &Value,
) -> (String, Option<String>) {
    let at = RowPlace::deserialize(&part["at"]).unwrap_or_default();
    let arm = Option::deserialize(&part["arm"]).unwrap_or_default();
    let arms = Vec::<Arm>::deserialize(&other["settings"]["arms"]);
    if let (Some(arm), Ok(arms)) = (at.arm.or(arm), arms)
        && !arms.contains(&arm)
    {
        let why = "this grid was not run".to_owned();
        return (format!("results of grid {}", arm.name()), Some(why));
    }
    let ["tables", topic, "rows", _] = path else {
        return (words(path), None);
    };
    let what = format!("{}, {}", words(&path[..2]), placed(&at));
    let is_adjusted = topic_of(topic) == Some(Topic::SlendernessAdjustment);
    let few = format!("fewer than {LEAST_USABLE} ratios");
    (what, is_adjusted.then_some(few))
}
