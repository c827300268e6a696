//! Flags that say what the caller knows of record files, and what becomes of
//! remarks on them.

use rocking::units::AccelerationUnit;
use rocking_records::{ReadOptions, SetAside};

use super::processing::ProcessingArgs;
use crate::failure::{Failure, bail, ensure};
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
    recursive: bool,
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

    /// As [`ReadArgs::options`], for one file.
    ///
    /// # Errors
    /// [`Failure`] for a flag that is of folders.
    pub fn of_one(self, gravity_m_s2: f64) -> Result<ReadOptions, Failure> {
        ensure!(
            !self.recursive,
            "--recursive is not used with one record: expected a suite"
        );
        Ok(self.options(gravity_m_s2))
    }

    /// The first flag given, to be refused if no record is read.
    pub fn given(self) -> Option<&'static str> {
        if self.dt.is_some() {
            Some("--dt")
        } else if self.units.is_some() {
            Some("--units")
        } else if self.recursive {
            Some("--recursive")
        } else {
            self.strict.then_some("--strict")
        }
    }

    /// Refuses flags of reading and processing if no record is read without
    /// another flag.
    ///
    /// # Errors
    /// [`Failure`] with the flag and the other one.
    pub fn refuse_unused(
        self,
        processing: ProcessingArgs,
        without: &str,
    ) -> Result<(), Failure> {
        match self.given().or(processing.given()) {
            None => Ok(()),
            Some(flag) => bail!("{flag} is not used without {without}"),
        }
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
