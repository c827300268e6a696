//! Suites as files: a folder of AT2 records and an index with their hashes. Reading
//! them gives the same accelerograms, bit for bit.

use std::collections::BTreeSet;

use anyhow::bail;
use rocking::accelerogram::Accelerogram;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::{Suite, SuiteMember};
use rocking_synthesis::Pair;

use super::inputs::sha256_hex;
use crate::table::Table;

/// One record of an exported suite.
pub struct ExportRow<'a> {
    /// The component.
    pub motion: &'a Accelerogram,
    /// Name of its pair, if it has a partner.
    pub pair: Option<&'a str>,
    /// Whether the study uses it.
    pub study_component: bool,
    /// Other columns of the index, by name.
    pub attributes: Vec<(&'a str, String)>,
}

/// The members of a suite, with their processing in words.
pub fn members<'a>(
    suite: &'a Suite,
    done: Option<&str>,
) -> Vec<ExportRow<'a>> {
    let row = |member: &'a SuiteMember| {
        let mut row = member_of(&member.accelerogram, member);
        let done = done.map(|words| ("processing", words.to_owned()));
        row.attributes.extend(done);
        row
    };
    suite.members().iter().map(row).collect()
}

/// A member of a suite with its motion.
pub fn member_of<'a, M>(
    motion: &'a Accelerogram,
    member: &'a SuiteMember<M>,
) -> ExportRow<'a> {
    let cells = member.attributes.iter();
    let cells = cells.map(|(name, cell)| (&**name, cell.clone()));
    let event = member.event.clone().map(|event| ("event", event));
    ExportRow {
        motion,
        pair: member.pair.as_deref(),
        study_component: member.study_component,
        attributes: cells.chain(event).collect(),
    }
}

/// The components of embedded pairs, with earthquake and site.
pub fn pairs(pairs: &[Pair]) -> Vec<ExportRow<'_>> {
    let mut rows = Vec::with_capacity(2 * pairs.len());
    for Pair { components, scenario, .. } in pairs {
        for (k, motion) in components.iter().enumerate() {
            let name = motion.name();
            rows.push(ExportRow {
                motion,
                pair: name.rsplit_once('-').map(|(pair, _)| pair),
                study_component: k == 0,
                attributes: scenario.columns().to_vec(),
            });
        }
    }
    rows
}

/// Columns of an index that every record has.
const COLUMNS: [&str; 10] = [
    "file",
    "format",
    "units",
    "dt_s",
    "npts",
    "pga_g",
    "pgv_m_s",
    "pair",
    "study_component",
    "sha256",
];

/// The files of a suite `name`: `name.csv`, the index, and its records in a
/// folder `name`.
///
/// # Errors
/// For a record whose name no file can have.
pub fn files(
    name: &str,
    rows: &[ExportRow<'_>],
) -> anyhow::Result<Vec<(String, String)>> {
    let extra = rows.iter().flat_map(|row| row.attributes.iter());
    let mut packing = Packing::new(name, extra.map(|(name, _)| *name));
    let packed = rows.iter().map(|row| packing.add(row));
    let mut files = packed.collect::<Result<Vec<_>, _>>()?;
    files.push(packing.finish());
    Ok(files)
}

/// A suite that is exported, one record after the other.
pub struct Packing<'a> {
    name: &'a str,
    /// Columns of the index that a record may lack.
    extra: BTreeSet<&'a str>,
    /// Names in small letters.
    names: BTreeSet<String>,
    index: Table,
}

impl<'a> Packing<'a> {
    /// A suite `name` whose index has these further columns.
    pub fn new(name: &'a str, extra: impl Iterator<Item = &'a str>) -> Self {
        let extra: BTreeSet<&str> = extra.collect();
        let header: Vec<&str> =
            COLUMNS.into_iter().chain(extra.iter().copied()).collect();
        Self {
            name,
            index: Table::new(&header),
            extra,
            names: BTreeSet::new(),
        }
    }

    /// The file of the next record: its path and its text.
    ///
    /// # Errors
    /// For a record whose name no file can have, or another file has on a system
    /// that ignores capitals.
    pub fn add(
        &mut self,
        row: &ExportRow<'_>,
    ) -> anyhow::Result<(String, String)> {
        let motion = row.motion;
        if !is_file_name(motion.name()) {
            bail!(
                "record {:?}: expected a name that a file can have",
                motion.name()
            );
        }
        if !self.names.insert(motion.name().to_lowercase()) {
            bail!(
                "record {:?}: another one has this name but for capitals: \
                 expected names that differ on every system",
                motion.name()
            );
        }
        let file = format!("{}/{}.at2", self.name, motion.name());
        let text = at2(motion);
        let mut cells = vec![
            file.clone(),
            "at2".into(),
            "g".into(),
            motion.dt_s().to_string(),
            motion.samples_g().len().to_string(),
            motion.pga_g().to_string(),
            motion.pgv_m_s(STANDARD_GRAVITY_M_S2).to_string(),
            row.pair.unwrap_or_default().into(),
            u8::from(row.study_component).to_string(),
            sha256_hex(text.as_bytes()),
        ];
        for column in &self.extra {
            let own = row.attributes.iter().find(|(name, _)| name == column);
            cells.push(own.map_or(String::new(), |(_, text)| text.clone()));
        }
        self.index.row(cells);
        Ok((file, text))
    }

    /// The index: its path and its text.
    pub fn finish(self) -> (String, String) {
        (format!("{}.csv", self.name), self.index.finish())
    }
}

/// Whether the name of a record can name a file on this system.
pub fn is_file_name(name: &str) -> bool {
    let fits = |c: char| !c.is_control() && !"/\\".contains(c);
    let fits = !name.is_empty() && name.chars().all(fits);
    fits && (!cfg!(windows) || is_windows_name(name))
}

/// Whether Windows takes a name, to which an ending is added: after a colon it
/// would be a stream of another file, and `NUL.at2` is a device.
fn is_windows_name(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or(name);
    let device = match stem.trim_end().to_ascii_uppercase().as_bytes() {
        b"CON" | b"PRN" | b"AUX" | b"NUL" => true,
        [b'C', b'O', b'M', port] | [b'L', b'P', b'T', port] => {
            port.is_ascii_digit()
        }
        _ => false,
    };
    !(device || name.contains(['<', '>', ':', '"', '|', '?', '*']))
}

/// A record as AT2, five numbers of 25 characters per line: 17 digits, which
/// restore every double.
fn at2(motion: &Accelerogram) -> String {
    let samples = motion.samples_g();
    let mut text = format!(
        "Written by rocking\nACCELERATION TIME SERIES IN UNITS OF G\n\
         NPTS= {}, DT= {} SEC\n",
        samples.len(),
        motion.dt_s()
    );
    for line in samples.chunks(5) {
        text.extend(line.iter().map(|sample| fixed(*sample)));
        text.push('\n');
    }
    text
}

/// A number in 25 characters in Fortran's E25.16: an exponent of three digits
/// leaves no room for its letter.
fn fixed(x: f64) -> String {
    let text = format!("{x:.16e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, digits) = match exponent.strip_prefix('-') {
        Some(digits) => ('-', digits),
        None => ('+', exponent),
    };
    let exponent = match digits.len() {
        3 => format!("{sign}{digits}"),
        _ => format!("E{sign}{digits:0>2}"),
    };
    format!("{:>25}", format!("{mantissa}{exponent}"))
}

#[cfg(test)]
mod tests {
    use rocking_records::{ReadOptions, read};

    use super::*;

    #[test]
    fn windows_keeps_names_that_are_no_devices_or_streams() {
        for name in ["RSN6_I-ELC180", "CONE", "a.con", "COM", "COM10", "LPT"] {
            assert!(is_windows_name(name), "{name}");
        }
        for name in ["a:b", "nul", "Con.x", "aux .b", "COM1", "lpt9.c", "a?"] {
            assert!(!is_windows_name(name), "{name}");
        }
    }

    #[test]
    fn every_double_is_read_back() {
        let samples = vec![
            0.1,
            -0.0,
            1.0 / 3.0,
            -f64::MIN_POSITIVE,
            5e-324,
            -1.234e-100,
            f64::MAX,
            -1e23,
            1e99,
            0.5,
            f64::EPSILON,
        ];
        let dt_s = 1.0 / 410.0;
        let motion = Accelerogram::try_new("a.b", dt_s, samples).unwrap();
        let text = at2(&motion);
        let options = ReadOptions::default();
        let found = read("d/a.b.at2", text.as_bytes(), &options).unwrap();
        assert_eq!(found.accelerogram, motion);
        let bits = |m: &Accelerogram| -> Vec<u64> {
            m.samples_g().iter().map(|a| a.to_bits()).collect()
        };
        assert_eq!(bits(&found.accelerogram), bits(&motion));
    }

    #[test]
    fn names_that_no_file_has_are_refused() {
        let motions = ["a/b", "Ab", "aB"].map(|name| {
            Accelerogram::try_new(name, 0.1, vec![0.0; 2]).unwrap()
        });
        fn rows(motions: &[Accelerogram]) -> Vec<ExportRow<'_>> {
            let row = |motion| ExportRow {
                motion,
                pair: None,
                study_component: true,
                attributes: Vec::new(),
            };
            motions.iter().map(row).collect()
        }
        for (motions, refusal) in [
            (&motions[..1], "record \"a/b\": "),
            (&motions[1..], "record \"aB\": "),
        ] {
            let error = files("x", &rows(motions)).unwrap_err();
            assert!(error.to_string().starts_with(refusal), "{error}");
        }
        assert!(files("x", &rows(&motions[2..])).is_ok());
    }
}
