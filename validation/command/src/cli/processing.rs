//! Flags for how records are read, and changed before they are used.

use rocking_records::Processing;

use super::reading::ReadArgs;
use crate::failure::{AtPlace as _, Failure, bail};

/// How records are read and processed; no processing by default.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct RecordArgs {
    #[command(flatten)]
    pub reading: ReadArgs,
    /// Remove the mean of every record.
    #[arg(long)]
    demean: bool,
    /// Corner of a high-pass filter in Hz: Butterworth of order 4, forwards
    /// and backwards, with 6/corner s of zeros added at both ends.
    #[arg(long, value_name = "CORNER_HZ")]
    pub high_pass: Option<f64>,
}

impl RecordArgs {
    /// The processing of these flags.
    ///
    /// # Errors
    /// [`Failure`] for an invalid corner.
    pub fn processing(self) -> Result<Processing, Failure> {
        Processing::try_new(self.demean, self.high_pass).at("--high-pass")
    }

    /// The first flag given, to be refused if no record is read.
    pub fn given(self) -> Option<&'static str> {
        let flags = [
            ("--demean", self.demean),
            ("--high-pass", self.high_pass.is_some()),
        ];
        let mut flags = self.reading.flags().into_iter().chain(flags);
        flags.find_map(|(flag, is_given)| is_given.then_some(flag))
    }

    /// Refuses these flags if no record is read without another flag.
    ///
    /// # Errors
    /// [`Failure`] with the flag and the other one.
    pub fn refuse_unused(self, without: &str) -> Result<(), Failure> {
        match self.given() {
            None => Ok(()),
            Some(flag) => bail!("{flag} is not used without {without}"),
        }
    }
}

/// The processing in words; `None` if there was none.
pub fn words(processing: &Processing) -> Option<String> {
    (!processing.is_none()).then(|| processing.to_string())
}
