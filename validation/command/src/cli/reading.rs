//! Flags that say what the caller knows of record files, and what becomes of
//! remarks on them.

use rocking::units::AccelerationUnit;
use rocking_records::{ReadOptions, SetAside};

use crate::failure::{Failure, ensure};
use crate::terminal::note;
use rocking_common::suites::remarks::Remarks;

/// Flags for what record files do not state.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ReadArgs {
    /// Sampling interval in s, for record files that do not state it.
    #[arg(long, value_name = "S")]
    dt: Option<f64>,
    /// Unit (g, m/s2 or cm/s2), for record files that do not state it.
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    units: Option<AccelerationUnit>,
    /// Also read the subfolders of a folder of records.
    #[arg(long)]
    pub recursive: bool,
    /// Fail if a record looks suspicious or a file is set aside; `rocking
    /// records` lists them.
    #[arg(long)]
    strict: bool,
}

fn unit(text: &str) -> Result<AccelerationUnit, String> {
    AccelerationUnit::parse(text)
        .ok_or_else(|| "expected g, m/s2 or cm/s2".to_owned())
}

impl ReadArgs {
    /// How records are read under gravity `gravity_m_s2`.
    pub fn options(self, gravity_m_s2: f64) -> ReadOptions {
        let (dt_s, unit, recursive) = (self.dt, self.units, self.recursive);
        ReadOptions { dt_s, unit, gravity_m_s2, recursive }
    }

    /// The flags, and whether they are given.
    pub fn flags(self) -> [(&'static str, bool); 4] {
        [
            ("--dt", self.dt.is_some()),
            ("--units", self.units.is_some()),
            ("--recursive", self.recursive),
            ("--strict", self.strict),
        ]
    }

    /// Notes for how many records the flags were used. With `--strict`,
    /// refuses remarks on records and files that were set aside.
    ///
    /// # Errors
    /// [`Failure`] with both in short.
    pub fn judge(
        self,
        set_aside: &SetAside,
        remarks: &Remarks,
    ) -> Result<(), Failure> {
        for words in remarks.given() {
            note(&words);
        }
        let remarks =
            remarks.words().map(|words| format!("remarks on {words}"));
        let aside = (!set_aside.is_empty()).then(|| {
            format!(
                "set aside: {set_aside}: expected only records, as in an \
                 index"
            )
        });
        let found: Vec<String> = aside.into_iter().chain(remarks).collect();
        let found = found.join("; ");
        ensure!(!self.strict || found.is_empty(), "--strict: {found}");
        Ok(())
    }
}
