//! Flags that change records before they are used.

use rocking_records::Processing;

use crate::failure::{AtPlace as _, Failure};

/// Processing of records; none by default.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ProcessingArgs {
    /// Remove the mean of every record.
    #[arg(long)]
    demean: bool,
    /// Corner of a high-pass filter in Hz: Butterworth of order 4, forwards
    /// and backwards, with 6/corner s of zeros added at both ends.
    #[arg(long, value_name = "CORNER_HZ")]
    pub high_pass: Option<f64>,
}

impl ProcessingArgs {
    /// The processing of these flags.
    ///
    /// # Errors
    /// [`Failure`] for an invalid corner.
    pub fn processing(self) -> Result<Processing, Failure> {
        Processing::try_new(self.demean, self.high_pass).at("--high-pass")
    }

    /// The first flag given, to be refused if no record is read.
    pub fn given(self) -> Option<&'static str> {
        if self.demean {
            Some("--demean")
        } else {
            self.high_pass.map(|_| "--high-pass")
        }
    }
}

/// The processing in words; `None` if there was none.
pub fn words(processing: &Processing) -> Option<String> {
    (!processing.is_none()).then(|| processing.to_string())
}
