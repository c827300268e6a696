//! The native half of the Python package `rocking`.
//!
//! Functions on numbers and numpy arrays; `python/rocking` builds the public
//! objects on them. Errors have the core's text.

mod assess;
mod exchange;
mod files;
mod given;
mod ida;
mod measures;
mod mechanics;
mod peak;
mod procedures;
mod score;
mod shaking;
mod work;

/// Name, version and commit of the program, for tables and assessments.
const SOFTWARE: &str = concat!(
    "rocking ",
    env!("CARGO_PKG_VERSION"),
    " (commit ",
    env!("ROCKING_COMMIT"),
    ")"
);

/// Native functions of the package `rocking`; its public names are in
/// `rocking` itself.
#[pyo3::pymodule(gil_used = false)]
mod _rocking {
    use pyo3::prelude::*;
    use rocking_exchange::ExchangeFormat;
    use rocking_records::Format;

    #[pymodule_export]
    use crate::{
        assess::assess,
        exchange::{exchange, hazard, law, risk},
        files::{embedded_suite, read_record, read_suite},
        given::{
            block, block_of_size, block_size, measure, pulse, pulses, samples,
            sampling_interval, uplift_threshold,
        },
        ida::{IdaCurves, PyIdaTable, ida, ida_of_csv, read_ida},
        measures::{average_sa, cloud, intensity_measures, velocity_pulse},
        mechanics::respond,
        peak::peak,
        procedures::{
            compare, contrast, fit, fit_stripes, lognormal, summarise,
            test_normality,
        },
        score::{score, score_scenes},
        shaking::{compare_with_tests, read_tests},
    };

    #[pymodule_init]
    fn init(m: &Bound<'_, PyModule>) -> PyResult<()> {
        let formats = Format::by_name().into_iter();
        let words = formats.map(|f| format!("{} ({})", f.files, f.source));
        m.add("RECORD_FORMATS", words.collect::<Vec<_>>())?;
        let formats = ExchangeFormat::ALL.iter();
        let words = formats.map(|f| format!("{:?} ({})", f.name, f.help));
        m.add("EXCHANGE_FORMATS", words.collect::<Vec<_>>())?;
        m.add("__version__", env!("CARGO_PKG_VERSION"))?;
        m.add("STANDARD_GRAVITY", rocking::units::STANDARD_GRAVITY_M_S2)
    }
}
