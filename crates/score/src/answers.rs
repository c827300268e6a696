//! The answers of a code.

use std::path::Path;

use rocking_exchange::FileError;
use rocking_exchange::read::{no_csv, reader};
use rocking_exchange::table::Table;

use crate::reference::{Value, reference};

/// The answers of a code, with a place for each quantity of the data set.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers(Vec<Option<Value>>);

const COLUMNS: [&str; 3] = ["scene", "quantity", "value"];

impl Answers {
    /// No answers.
    pub fn none() -> Self {
        Self(vec![None; reference().items.len()])
    }

    /// Reads a CSV with the columns `scene,quantity,value`. A missing line or
    /// an empty value is no answer. `path` is its name in messages.
    ///
    /// # Errors
    /// [`FileError`] for other columns, a scene or quantity that is not in the
    /// data set or occurs twice, and a value of another kind.
    pub fn parse(text: &str, path: &Path) -> Result<Self, FileError> {
        let mut csv = reader(text.as_bytes(), csv::Trim::All, None);
        let no_csv = |e| no_csv(path, e);
        let header = csv.headers().map_err(no_csv)?;
        if !header.iter().eq(COLUMNS) {
            let found = header.iter().collect::<Vec<_>>().join(",");
            let expected = COLUMNS.join(",");
            let message =
                format!("found columns `{found}`: expected `{expected}`");
            return Err(FileError::new(path, 1, message));
        }
        let mut answers = Self::none();
        for row in csv.records() {
            let row = row.map_err(no_csv)?;
            let line = row.position().map(csv::Position::line);
            let added = answers.add([&row[0], &row[1], &row[2]]);
            added.map_err(|message| FileError::new(path, line, message))?;
        }
        Ok(answers)
    }

    /// Adds a value for a quantity of a scene; an empty value is no answer.
    ///
    /// # Errors
    /// The found and the expected text.
    pub fn add(
        &mut self,
        [scene, quantity, value]: [&str; 3],
    ) -> Result<(), String> {
        let set = reference();
        let Some(place) = set.place(scene, quantity) else {
            let known = set.scenes.iter().any(|s| s.name == scene);
            return Err(if known {
                format!(
                    "scene {scene} with quantity `{quantity}`: expected one \
                     of its `quantities` in scenes.json"
                )
            } else {
                format!("scene `{scene}`: expected a name of scenes.json")
            });
        };
        if value.is_empty() {
            return Ok(());
        }
        let parsed = Value::parse(quantity, value).map_err(|expected| {
            format!("{scene}, {quantity}: found `{value}`: {expected}")
        })?;
        if self.0[place].replace(parsed).is_some() {
            return Err(format!("{scene}, {quantity}: expected it once"));
        }
        Ok(())
    }

    /// Sets the answer at a place of [`Reference::items`].
    ///
    /// [`Reference::items`]: crate::Reference::items
    pub fn set(&mut self, place: usize, value: Option<Value>) {
        self.0[place] = value;
    }

    /// The answer at a place of [`Reference::items`].
    ///
    /// [`Reference::items`]: crate::Reference::items
    pub fn get(&self, place: usize) -> Option<&Value> {
        self.0[place].as_ref()
    }

    /// The answers as CSV, 17 digits.
    pub fn csv(&self) -> String {
        let mut table = Table::new(&COLUMNS);
        for (item, value) in reference().items.iter().zip(&self.0) {
            let scene = &reference().scene(item).name;
            let value = match value {
                None => String::new(),
                Some(Value::Fate(fate)) => fate.clone(),
                Some(Value::Count(n)) => n.to_string(),
                Some(Value::Number(x)) => format!("{x:e}"),
            };
            table.row([scene, &item.quantity, &value]);
        }
        table.finish()
    }
}
