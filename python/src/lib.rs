//! The native half of the Python package `rocking`.
//!
//! Functions on numbers and numpy arrays; `python/rocking` makes the objects
//! that people see of them. Errors carry the core's text.

mod exchange;
mod files;
mod given;
mod ida;
mod measures;
mod mechanics;
mod peak;
mod procedures;
mod work;

use pyo3::prelude::*;

/// Native functions of the package `rocking`; its public names are in
/// `rocking` itself.
#[pymodule(gil_used = false)]
fn _rocking(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    m.add("STANDARD_GRAVITY", rocking::units::STANDARD_GRAVITY_M_S2)?;
    m.add_function(wrap_pyfunction!(given::block, m)?)?;
    m.add_function(wrap_pyfunction!(given::block_of_size, m)?)?;
    m.add_function(wrap_pyfunction!(given::block_size, m)?)?;
    m.add_function(wrap_pyfunction!(given::uplift_threshold, m)?)?;
    m.add_function(wrap_pyfunction!(given::samples, m)?)?;
    m.add_function(wrap_pyfunction!(given::pulse, m)?)?;
    m.add_function(wrap_pyfunction!(files::read_record, m)?)?;
    m.add_function(wrap_pyfunction!(files::read_suite, m)?)?;
    m.add_function(wrap_pyfunction!(files::embedded_suite, m)?)?;
    m.add_function(wrap_pyfunction!(mechanics::respond, m)?)?;
    m.add_function(wrap_pyfunction!(peak::peak, m)?)?;
    m.add_function(wrap_pyfunction!(ida::ida, m)?)?;
    m.add_function(wrap_pyfunction!(ida::read_ida, m)?)?;
    m.add_function(wrap_pyfunction!(ida::ida_of_csv, m)?)?;
    m.add_class::<ida::IdaTable>()?;
    m.add_class::<ida::IdaCurves>()?;
    m.add_function(wrap_pyfunction!(measures::intensity_measures, m)?)?;
    m.add_function(wrap_pyfunction!(measures::velocity_pulse, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::fit, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::fit_stripes, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::choose_distribution, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::test_normality, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::summarise, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::compare, m)?)?;
    m.add_function(wrap_pyfunction!(procedures::lognormal, m)?)?;
    m.add_function(wrap_pyfunction!(exchange::exchange, m)?)?;
    m.add_function(wrap_pyfunction!(exchange::hazard, m)?)?;
    m.add_function(wrap_pyfunction!(exchange::risk, m)?)?;
    m.add_function(wrap_pyfunction!(exchange::surface, m)?)?;
    Ok(())
}
