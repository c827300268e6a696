//! `rocking fragility transform`: Eqs. 5 to 7 of given numbers.

use rocking_procedures::fit::Transformation;

use crate::cli::shared::JsonArg;
use crate::failure::Failure;

/// Eqs. 5 to 7: a shifted fragility from unshifted numbers.
///
/// Eq. 5 and Eq. 7 need --im50 and --beta, Eq. 6 needs --im16 and --im84.
#[derive(clap::Args)]
pub(super) struct FragilityTransformCommand {
    /// Shift IM_R, not negative.
    #[arg(long, value_name = "X")]
    shift: f64,
    /// Unshifted median IM50.
    #[arg(long, value_name = "X", required_unless_present = "im16")]
    im50: Option<f64>,
    /// Unshifted dispersion beta_o.
    #[arg(long, value_name = "B", requires = "im50")]
    beta: Option<f64>,
    /// Unshifted 16 % quantile IM16.
    #[arg(long, value_name = "X", requires = "im84")]
    im16: Option<f64>,
    /// Unshifted 84 % quantile IM84.
    #[arg(long, value_name = "X", requires = "im16")]
    im84: Option<f64>,
    /// Constant c of Eq. 7.
    #[arg(long, default_value_t = 1.0)]
    c: f64,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking fragility transform`.
///
/// # Errors
/// [`Failure`] if the result cannot be printed.
pub(super) fn run_fragility_transform(
    args: &FragilityTransformCommand,
) -> Result<(), Failure> {
    let found = Transformation::new(
        (args.im50, args.beta),
        (args.im16, args.im84),
        args.shift,
        args.c,
    );
    let sentences = [
        "Above a shift of {shift} the log mean is {eq5}, the dispersion \
         {eq7}.",
        "Above a shift of {shift} the dispersion is {eq6}.",
        "Above a shift of {shift} not all numbers are known.",
    ];
    args.json.show(&sentences, &found)
}
