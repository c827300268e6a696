//! Flags that change records before they are used.

use rocking_records::Processing;

use crate::failure::{AtPlace as _, Failure};

/// What is done to records; nothing unless asked for.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ProcessingArgs {
    /// Take the mean off every record.
    #[arg(long)]
    demean: bool,
    /// Pass what lies above this corner in Hz: Butterworth of order 4,
    /// forwards and backwards, with 6/corner s of zeros added at both ends.
    #[arg(long, value_name = "CORNER_HZ")]
    pub high_pass: Option<f64>,
}

impl ProcessingArgs {
    /// What is asked for.
    ///
    /// # Errors
    /// [`Failure`] for a corner that is none.
    pub fn processing(self) -> Result<Processing, Failure> {
        Processing::try_new(self.demean, self.high_pass).at("--high-pass")
    }

    /// The first flag given, to be refused where no record is read.
    pub fn given(self) -> Option<&'static str> {
        if self.demean {
            Some("--demean")
        } else {
            self.high_pass.map(|_| "--high-pass")
        }
    }
}

/// The words for results: `null` in JSON where nothing was done.
pub fn words(processing: &Processing) -> Option<String> {
    (!processing.is_none()).then(|| processing.to_string())
}
