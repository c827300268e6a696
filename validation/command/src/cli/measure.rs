//! Intensity measures of the records of a suite.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use rocking::block::Block;
use rocking::integrator::uplift_threshold;
use rocking_exchange::ida::IdaTable;
use rocking_exchange::read::{no_csv, reader};
use rocking_procedures::ranking::CandidateMeasure;
use rocking_records::intensity::{
    AtUplift, IntensityMeasure, Measures, Settings,
};
use rocking_records::{SetAside, SuiteMember};

use super::processing::{RecordArgs, words};
use crate::failure::{Failure, bail, ensure};
use crate::input;
use rocking_common::suites::inputs::read_suite;
use rocking_common::suites::remarks::Remarks;

/// The records from which the table was made.
#[derive(clap::Args, Clone, Debug)]
pub struct GroundArgs {
    /// The suite of --ida: folder, index or zip; for measures that the table
    /// does not contain.
    #[arg(long, value_name = "PATH", requires = "ida")]
    pub suite: Option<PathBuf>,
    #[command(flatten)]
    input: RecordArgs,
    /// Attributes by record: CSV with a column `record`, whose names are those
    /// of --ida. Columns of the suite's index are attributes, too.
    #[arg(long, value_name = "FILE.csv", requires = "suite")]
    attributes: Option<PathBuf>,
}

/// The unscaled records of a table, in its order.
pub struct SuiteMeasures {
    /// Source of the attributes.
    place: PathBuf,
    periods_s: Vec<f64>,
    uplift: AtUplift,
    records: Vec<MeasuredRecord>,
    /// Files set aside of the suite.
    pub set_aside: SetAside,
}

struct MeasuredRecord {
    name: String,
    measures: Measures,
    attributes: BTreeMap<String, String>,
}

impl GroundArgs {
    /// The files to be read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        self.suite.iter().chain(&self.attributes).cloned().collect()
    }

    /// Reads the records of the table and measures them.
    ///
    /// # Errors
    /// [`Failure`] for a suite that is refused, one that is not the table's,
    /// or a table whose intensities are not scale factors.
    pub fn ground(
        &self,
        table: &IdaTable,
        measures: &[IntensityMeasure],
    ) -> Result<SuiteMeasures, Failure> {
        let Some(path) = &self.suite else {
            let measure =
                measures.iter().find(|m| m.dimensionless().is_none());
            let measure =
                measure.map_or(String::new(), |m| format!("{}: ", m.words()));
            bail!(
                "{measure}expected --suite, the records that the table was made \
                 of"
            );
        };
        let setting = &table.setting;
        let gravity = setting.gravity_m_s2;
        let Some(alpha_rad) = table.alpha_rad() else {
            bail!(
                "the table adjusts slenderness: expected one of \
                 record-scaling, whose intensities are scale factors"
            );
        };
        let block = Block::try_new(alpha_rad, setting.p_rad_s)?;
        let processing = self.input.processing()?;
        let done = words(&processing).unwrap_or("none".into());
        ensure!(
            done == setting.processing,
            "processing of the table: {}; of the records here: {done}; \
             expected the same",
            setting.processing
        );
        let options = self.input.reading.options(gravity);
        let suite = read_suite(path, options)?.processed(&processing)?;
        let set_aside = suite.set_aside().clone();
        self.input.reading.judge(&set_aside, &Remarks::on(&suite))?;
        let mut members: BTreeMap<&str, &SuiteMember> = BTreeMap::new();
        for member in suite.members() {
            let name = member.accelerogram.name();
            ensure!(
                members.insert(name, member).is_none(),
                "{}: two records named {name}: expected one",
                path.display()
            );
        }
        let own = self.attributes.as_deref().map(read_attributes);
        let own = own.transpose()?.unwrap_or_default();
        let settings = Settings::of(gravity, measures)?;
        let names: Vec<&str> = table.records().collect();
        let measured = names.par_iter().map(|&name| {
            let member = members.get(name).ok_or_else(|| {
                Failure::input(format!(
                    "{}: no record {name}: expected the suite of the table",
                    path.display()
                ))
            })?;
            let measures = Measures::of(&member.accelerogram, &settings)?;
            let mut attributes = member.attributes_by_name();
            attributes.extend(own.get(name).cloned().unwrap_or_default());
            Ok(MeasuredRecord { name: name.to_owned(), measures, attributes })
        });
        let records = measured.collect::<Result<Vec<_>, Failure>>()?;
        let place = self.attributes.as_ref().unwrap_or(path).clone();
        let periods_s = settings.periods_s().to_vec();
        let uplift = AtUplift {
            pga_g: uplift_threshold(&block, setting.model),
            p_rad_s: setting.p_rad_s,
            gravity_m_s2: gravity,
        };
        Ok(SuiteMeasures { place, periods_s, uplift, records, set_aside })
    }
}

impl SuiteMeasures {
    /// The measures as candidates of a ranking.
    ///
    /// # Errors
    /// As [`SuiteMeasures::at_uplift`].
    pub fn candidates(
        &self,
        measures: &[IntensityMeasure],
    ) -> Result<Vec<CandidateMeasure>, Failure> {
        let candidate = |measure: &IntensityMeasure| {
            Ok(CandidateMeasure {
                im: measure.words(),
                at_uplift: self.at_uplift(measure)?,
                squared: measure.is_squared(),
            })
        };
        measures.iter().map(candidate).collect()
    }

    /// The measure of each record where PGA/(g tan alpha) is 1.
    ///
    /// # Errors
    /// [`Failure`] for a column that a record lacks, or whose cell is not
    /// positive.
    pub fn at_uplift(
        &self,
        measure: &IntensityMeasure,
    ) -> Result<Vec<f64>, Failure> {
        let of = |record: &MeasuredRecord| {
            let (measures, periods_s) = (&record.measures, &self.periods_s);
            let cell = match measure {
                IntensityMeasure::Column(name) => self.cell(record, name)?,
                _ => f64::NAN,
            };
            Ok(self.uplift.value(measure, measures, periods_s, cell))
        };
        self.records.iter().map(of).collect()
    }

    /// The positive numbers of a column.
    ///
    /// # Errors
    /// As [`SuiteMeasures::at_uplift`].
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Failure> {
        self.records.iter().map(|record| self.cell(record, name)).collect()
    }

    fn cell(
        &self,
        record: &MeasuredRecord,
        column: &str,
    ) -> Result<f64, Failure> {
        let cell = record.attributes.get(column);
        let value = cell.and_then(|cell| cell.trim().parse::<f64>().ok());
        let value = value.filter(|x| *x > 0.0 && x.is_finite());
        value.ok_or_else(|| {
            let found = cell.map_or("no such column".to_owned(), |cell| {
                format!("`{cell}`")
            });
            let place = self.place.display();
            Failure::input(format!(
                "{place}: record {}, column {column}: found {found}: \
                 expected a positive number",
                record.name
            ))
        })
    }
}

/// Attributes of records, by their names.
type Attributes = BTreeMap<String, BTreeMap<String, String>>;

fn read_attributes(path: &Path) -> Result<Attributes, Failure> {
    let place = path.display();
    let mut reader = reader(input::open(path)?, csv::Trim::All, None);
    let header = reader.headers().map_err(|e| no_csv(path, e))?.clone();
    let Some(key) = header.iter().position(|name| name == "record") else {
        bail!(
            "{place}:1: found columns `{}`: expected one named `record`",
            header.iter().collect::<Vec<_>>().join(",")
        );
    };
    let mut rows = Attributes::new();
    for row in reader.records() {
        let row = row.map_err(|e| no_csv(path, e))?;
        let line = row.position().map_or(0, csv::Position::line);
        let own = header.iter().zip(&row);
        let own = own.map(|(name, cell)| (name.to_owned(), cell.to_owned()));
        ensure!(
            rows.insert(row[key].to_owned(), own.collect()).is_none(),
            "{place}:{line}: record {} is repeated: expected it once",
            &row[key]
        );
    }
    Ok(rows)
}
