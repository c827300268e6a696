//! The data set: scenes, certified values, and the answers of wrong models.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::LazyLock;

use rocking::excitation::{PulseKind, PulseName};
use rocking::integrator::{Model, Overturning};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// The scenes and the quantities of each, as JSON.
pub const SCENES: &str = rocking_fixtures::text("benchmark/scenes.json");
const CERTIFIED: &str = rocking_fixtures::text("benchmark/certified.csv");
const WRONG: &str = rocking_fixtures::text("benchmark/wrong-models.csv");
const MISTAKES: &str = rocking_fixtures::text("benchmark/mistakes.csv");

/// Inputs whose relative derivatives are known, as the columns name them.
pub const INPUTS: [&str; 5] = ["alpha", "p", "eta", "size", "clock"];

/// A block, its excitation, and the requested quantities; inputs in SI units.
#[derive(Clone, Debug, Deserialize)]
pub struct Problem {
    /// Its name, unique in the set.
    pub name: String,
    /// Level of difficulty, 1 to 5.
    pub level: u8,
    /// Its level in words.
    pub kind: String,
    /// Equation of motion.
    pub equation: Model,
    /// Criterion that ends the run.
    pub overturning: Overturning,
    /// Slenderness angle, rad.
    pub alpha_rad: f64,
    /// Frequency parameter, rad/s.
    pub p_rad_s: f64,
    /// Ratio of angular velocities at an impact.
    pub eta: f64,
    /// Gravity, m/s2.
    pub g_m_s2: f64,
    /// Rotation from which the block is released, rad.
    pub initial_theta_rad: f64,
    /// Motion of the ground.
    pub excitation: SceneExcitation,
    /// Times of the requested rotations, s.
    pub theta_times_s: Vec<f64>,
    /// Time until which impacts are counted, s.
    pub impacts_until_s: f64,
    /// Time by which all requested quantities have occurred, s.
    pub end_s: f64,
}

/// Ground motion of a scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum SceneExcitation {
    /// None.
    Free,
    /// Samples in m/s2 at an interval in s, linear between them.
    Samples {
        /// Interval, s.
        dt_s: f64,
        /// Samples, m/s2.
        samples_m_s2: Vec<f64>,
    },
    /// A pulse, its amplitude in m/s2.
    #[serde(untagged, deserialize_with = "pulse")]
    Pulse(PulseKind),
}

/// A pulse by its name and its parameters.
fn pulse<'de, D: Deserializer<'de>>(from: D) -> Result<PulseKind, D::Error> {
    #[derive(Deserialize)]
    struct Fields {
        kind: PulseName,
        #[serde(flatten)]
        parameters: BTreeMap<String, serde_json::Value>,
    }
    let fields = Fields::deserialize(from)?;
    fields.kind.kind(|parameter| {
        let found = fields.parameters.get(&parameter.name().replace('-', "_"));
        let number = found.and_then(serde_json::Value::as_f64);
        number.ok_or_else(|| D::Error::custom(format!("no {parameter}")))
    })
}

fn text<T, E: Display>(found: Result<T, E>) -> Result<T, String> {
    found.map_err(|error| error.to_string())
}

/// Answer of a code for a quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// The outcome, as the core names it.
    Fate(String),
    /// A number of impacts.
    Count(u64),
    /// A time, a rotation, a speed or a ratio.
    Number(f64),
}

/// Names of outcomes.
const FATES: [&str; 3] = ["no-uplift", "rocked", "overturned"];

impl Value {
    /// Reads the value of a quantity.
    ///
    /// # Errors
    /// The expected value, in words.
    pub fn parse(quantity: &str, text: &str) -> Result<Self, String> {
        let number = text.parse::<f64>().ok();
        match quantity {
            "fate" if FATES.contains(&text) => Ok(Self::Fate(text.into())),
            "fate" => Err(format!("expected one of {}", FATES.join(", "))),
            "impacts" => number
                .filter(|n| *n >= 0.0 && n.fract() == 0.0 && *n < 1e15)
                .map(|n| Self::Count(n as u64))
                .ok_or_else(|| "expected a count".into()),
            _ => number.filter(|x| x.is_finite()).map(Self::Number).ok_or(
                "expected a finite number, or nothing if it is missing".into(),
            ),
        }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            _ => None,
        }
    }
}

/// A quantity of a scene, with its certified value and its properties.
#[derive(Clone, Debug)]
pub struct Item {
    /// Index of the scene.
    pub scene: usize,
    /// The quantity.
    pub quantity: String,
    /// The certified value, all digits.
    pub digits: String,
    /// The certified value.
    pub value: Value,
    /// Uncertainty of the certified value.
    pub uncertainty: f64,
    /// Sum of the absolute relative derivatives by the inputs.
    pub condition: f64,
    /// Digits that double precision can reach; `None` for outcomes and counts.
    pub attainable: Option<f64>,
    /// Relative derivatives by [`INPUTS`].
    pub rates: [f64; 5],
    /// Answer of each wrong model; `None` if it has no such value.
    pub wrong: Vec<Option<Value>>,
}

/// The data set.
#[derive(Debug)]
pub struct Reference {
    /// Scenes by level.
    pub scenes: Vec<Problem>,
    /// Quantities, scene after scene.
    pub items: Vec<Item>,
    /// Names of the wrong models; `+` joins two mistakes.
    pub models: Vec<String>,
    /// For each single mistake and each input: its description, and advice.
    pub mistakes: BTreeMap<String, [String; 2]>,
}

#[derive(Deserialize)]
struct SceneFile {
    scenes: Vec<Problem>,
}

/// The data set, read once.
///
/// # Panics
/// Never: the files are part of the program, and a test reads them.
pub fn reference() -> &'static Reference {
    static SET: LazyLock<Reference> = LazyLock::new(|| {
        Reference::read().unwrap_or_else(|e| panic!("fixtures/benchmark: {e}"))
    });
    &SET
}

fn lines(csv: &str) -> csv::Reader<&[u8]> {
    csv::Reader::from_reader(csv.as_bytes())
}

impl Reference {
    fn read() -> Result<Self, String> {
        let SceneFile { scenes } = text(serde_json::from_str(SCENES))?;
        let mut wrong = lines(WRONG);
        let models = text(wrong.headers())?.iter().skip(2);
        let models = models.map(str::to_owned).collect();
        let mistakes = text(lines(MISTAKES).deserialize().collect())?;
        let mut set = Self { scenes, items: Vec::new(), models, mistakes };
        for (row, others) in lines(CERTIFIED).records().zip(wrong.records()) {
            let (row, others) = (text(row)?, text(others)?);
            let (name, quantity) = (&row[0], &row[1]);
            if others.iter().take(2).ne([name, quantity]) {
                return Err(format!(
                    "wrong-models.csv: no {name}, {quantity}"
                ));
            }
            if set.place(name, quantity).is_some() {
                return Err(format!("{name}, {quantity} twice"));
            }
            let scene = set.scenes.iter().position(|s| s.name == *name);
            let scene = scene.ok_or_else(|| name.to_owned())?;
            set.items.push(item(scene, &row, &others)?);
        }
        Ok(set)
    }

    /// Index of a quantity of a scene.
    pub fn place(&self, scene: &str, quantity: &str) -> Option<usize> {
        let is_it = |item: &Item| {
            item.quantity == quantity && self.scene(item).name == scene
        };
        self.items.iter().position(is_it)
    }

    /// The scene of an item.
    pub fn scene(&self, item: &Item) -> &Problem {
        &self.scenes[item.scene]
    }
}

fn item(
    scene: usize,
    row: &csv::StringRecord,
    others: &csv::StringRecord,
) -> Result<Item, String> {
    let number = |k: usize| text(row[k].parse::<f64>());
    let value = Value::parse(&row[1], &row[2])?;
    let wrong = others.iter().skip(2).map(|cell| match cell {
        "" => Ok(None),
        "=" => Ok(Some(value.clone())),
        cell => Value::parse(&row[1], cell).map(Some),
    });
    Ok(Item {
        scene,
        quantity: row[1].to_owned(),
        digits: row[2].to_owned(),
        wrong: wrong.collect::<Result<_, _>>()?,
        value,
        uncertainty: number(3)?,
        condition: number(4)?,
        attainable: (!row[5].is_empty()).then(|| number(5)).transpose()?,
        rates: [number(6)?, number(7)?, number(8)?, number(9)?, number(10)?],
    })
}
