//! `rocking validate`: a block against shaking-table tests.

use std::path::PathBuf;

use rocking::block::Restitution;
use rocking::integrator::Model;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_procedures::shaking::{
    ShakingTest, Slenderness, TestOptions, compare_with_tests,
};
use rocking_procedures::shaking_table::{FATE_COLUMN, TestTable};
use rocking_records::intensity::IntensityMeasure as M;
use rocking_records::{Reading, RemarkInput, SuiteError};

use super::names;
use super::processing::{RecordArgs, words};
use super::scene::{BlockArgs, Eta};
use super::shared::{BootstrapArgs, JsonArg, ThreadsArg, positive};
use super::show::json;
use crate::failure::{Failure, bail};
use crate::input;
use crate::terminal::{SOFTWARE, note, print, say};
use rocking_assessment::{About, PAGE, shaking};
use rocking_common::files::{OutputFolder, SUMS, sums};
use rocking_common::suites::inputs::visit;
use rocking_common::suites::remarks::Remarks;

/// A rigid block against shaking-table tests: how many outcomes it predicts,
/// its bias, and the scatter that it leaves out.
///
/// TESTS.csv is an index of the motions of the table, one row a test, with two
/// more columns: the outcome of the specimen (overturned, stood or unknown, or
/// 1, 0 or empty), and the motion that the test repeats (event, or motion). A
/// column scale is a factor on the motion of the file. Tests of one motion are
/// not independent, so the intervals resample motions. With only --p, the
/// slenderness is fitted to the outcomes.
#[derive(clap::Args)]
#[command(mut_arg("p", |arg| arg.help(
    "Frequency parameter p in rad/s; without --alpha the slenderness is \
     fitted to the outcomes"
)))]
#[command(after_help = "Examples:\n  \
    rocking validate tests.csv --alpha 0.15 --p 4.5 --out page\n  \
    rocking validate tests.csv --fate overturned_specimen_1 --p 4.55")]
pub struct ValidateCommand {
    /// Table of the tests.
    #[arg(value_name = "TESTS.csv")]
    tests: PathBuf,
    /// Column of the outcomes.
    #[arg(long, value_name = "COLUMN", default_value = FATE_COLUMN)]
    fate: String,
    #[command(flatten)]
    block: BlockArgs,
    /// Coefficient of restitution (ratio of angular velocities), or
    /// `housner` for 1 - 1.5 sin^2(alpha) of a block whose alpha is given.
    #[arg(long, value_name = "E|housner", default_value = "0.92")]
    eta: Eta,
    /// Equation of motion: Eq. 1 or Eq. 2.
    #[arg(long, value_parser = names::model(), default_value = "nonlinear")]
    model: Model,
    /// Gravity in m/s2, for sizes and for records in SI units.
    #[arg(
        long,
        value_name = "G",
        value_parser = positive,
        default_value_t = STANDARD_GRAVITY_M_S2
    )]
    gravity: f64,
    /// An intensity measure that predicts the same outcomes by itself: pga,
    /// pgv, pgd, arias, cav, pgv-d575, sa:T, avgsa:T1,T2,.. (periods in s) or
    /// avgsa:rocking (0.15 to 1.0 times 2 pi/p); may be repeated [default:
    /// pga, pgv and avgsa:rocking].
    #[arg(long, value_name = "MEASURE")]
    im: Vec<M>,
    #[command(flatten)]
    input: RecordArgs,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    threads: ThreadsArg,
    /// Folder for a page with three figures; must be new or empty.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking validate`.
///
/// # Errors
/// [`Failure`] for a table that is refused, with all its faults, or a folder
/// that is not empty.
pub fn run_validate(args: &ValidateCommand) -> Result<(), Failure> {
    // All of it: a signal that stops it finds the threads that heed it.
    args.threads.run(|| in_threads(args))?
}

fn in_threads(args: &ValidateCommand) -> Result<(), Failure> {
    let options = args.options()?;
    let (tests, remarks) = args.tests()?;
    let folder = args.out.as_deref().map(OutputFolder::open_new);
    let folder = folder.transpose()?;
    let found = compare_with_tests(&tests, &options)?;
    if let Some(folder) = folder {
        let about = args.about(&remarks)?;
        let mut files = shaking::files(&found, &about)?;
        files.insert(SUMS.into(), sums(&files));
        folder.write(&files, &[PAGE, SUMS])?;
    }
    if args.json.json {
        return print(&json(&found)?);
    }
    if let Some(words) = remarks.words() {
        note(&format!("remarks on {words}"));
    }
    let mut text = shaking::text(&found);
    if let Some(out) = &args.out {
        text += &format!("\nPage: {}\n", out.join(PAGE).display());
    }
    say(&text)
}

impl ValidateCommand {
    fn options(&self) -> Result<TestOptions, Failure> {
        let slenderness = match (self.block.alpha, self.block.p) {
            (None, Some(p_rad_s)) => Slenderness::Fitted { p_rad_s },
            _ => Slenderness::Given(self.block.block(self.gravity)?),
        };
        let measures = match self.im.as_slice() {
            [] => M::usual_of_tests(),
            given => given.to_vec(),
        };
        let restitution = match (self.eta, slenderness) {
            (eta, Slenderness::Given(block)) => eta.restitution(&block)?,
            (Eta::Constant(eta), _) => Restitution::constant(eta)?,
            (Eta::Housner, _) => bail!(
                "--eta housner: alpha is fitted: expected a number, or \
                 --alpha"
            ),
        };
        Ok(TestOptions {
            slenderness,
            restitution,
            model: self.model,
            gravity_m_s2: self.gravity,
            measures,
            draws: self.bootstrap.draws(),
        })
    }

    /// The tests, and the remarks on their motions.
    fn tests(&self) -> Result<(Vec<ShakingTest>, Remarks), Failure> {
        let options = self.input.reading.options(self.gravity);
        let reading = Reading::all(&options);
        let survey = visit(&self.tests, &reading, Ok::<_, SuiteError>)?;
        let members = survey.members.iter().flatten();
        let remarks = members.map(RemarkInput::from).collect::<Vec<_>>();
        let remarks = Remarks::of(&remarks);
        let table = TestTable {
            path: &self.tests.display().to_string(),
            fate: &self.fate,
            processing: self.input.processing()?,
        };
        let tests = table.tests(survey.members)?;
        self.input.reading.judge(&survey.set_aside, &remarks)?;
        Ok((tests, remarks))
    }

    fn about(&self, remarks: &Remarks) -> Result<About, Failure> {
        let name = self.tests.file_name().unwrap_or_default();
        let name = name.to_string_lossy();
        let table = input::named(&self.tests)?;
        let draws = self.bootstrap.draws();
        let some = [
            ("Program", Some(SOFTWARE.to_owned())),
            ("Table of tests", Some(table)),
            ("Column of the outcomes", Some(self.fate.clone())),
            ("Processing", words(&self.input.processing()?)),
            ("Remarks", remarks.words()),
            ("Draws of the intervals", Some(draws.replicates.to_string())),
            ("Repetition of the draws", Some(draws.seed.to_string())),
        ];
        let ground = format!("The motions are those of {name}.");
        Ok(About::of(ground, some))
    }
}
