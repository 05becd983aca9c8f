//! Rows as text: a table in CSV, to which each match is added as soon as it is over.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, WriterBuilder};

use super::metric::Metric;
use super::plan::ExperimentPlan;
use super::row::{AFTER, BEFORE, ExperimentRow, MatchResult, VERSION, check_version, columns};
use crate::data::DataError;

/// The columns of a table of an experiment.
pub(super) fn header(plan: &ExperimentPlan) -> Vec<String> {
    columns(plan.file.factors.iter().map(|factor| factor.name.as_str()))
}

/// A row as the fields of its columns.
pub(super) fn fields(row: &ExperimentRow) -> Vec<String> {
    let ExperimentRow { key, levels, strategies, assets, result } = row;
    let mut fields = vec![
        key.row.to_string(),
        key.treatment.to_string(),
        key.seed.to_string(),
        u8::from(key.swapped).to_string(),
    ];
    fields.extend(levels.iter().chain(strategies).cloned());
    fields.extend([VERSION.to_owned(), format!("{assets:016x}")]);
    match result {
        Ok(MatchResult { digest, seconds, played, values }) => {
            fields.extend([format!("{digest:016x}"), String::new(), seconds.to_string(), played.to_string()]);
            let word = |value: &Option<f64>| value.map_or_else(String::new, |value| value.to_string());
            fields.extend(values.iter().flatten().map(word));
        }
        Err(error) => {
            fields.extend([String::new(), error.clone(), String::new(), String::new()]);
            fields.extend((0..2 * Metric::ALL.len()).map(|_| String::new()));
        }
    }
    fields
}

/// Writes whole tables.
///
/// # Errors
/// If the bytes cannot be written.
pub fn write_csv<'a>(
    plan: &ExperimentPlan,
    rows: impl IntoIterator<Item = &'a ExperimentRow>,
    out: impl Write,
) -> io::Result<()> {
    let mut table = WriterBuilder::new().from_writer(out);
    table.write_record(header(plan))?;
    for row in rows {
        table.write_record(fields(row))?;
    }
    table.flush()
}

/// A table to which rows are added.
pub struct TableWriter(csv::Writer<BufWriter<File>>);

impl TableWriter {
    /// Begins the table, or goes on where it ends.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn open(path: &Path, plan: &ExperimentPlan) -> io::Result<TableWriter> {
        let file = File::options().create(true).append(true).open(path)?;
        let is_new = file.metadata()?.len() == 0;
        let mut writer = TableWriter(WriterBuilder::new().from_writer(BufWriter::new(file)));
        if is_new {
            writer.0.write_record(header(plan))?;
            writer.0.flush()?;
        }
        Ok(writer)
    }

    /// Adds a row, and sees to it that it is in the file.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn add(&mut self, row: &ExperimentRow) -> io::Result<()> {
        self.0.write_record(fields(row))?;
        self.0.flush()
    }
}

/// Reads the rows of a table of the experiment, in the order of their numbers. A last line that was not written to its end does
/// not count.
///
/// # Errors
/// If the text is not a table of this experiment, or if the rows were played by another program or from other files.
pub fn read_csv(plan: &ExperimentPlan, path: &Path, text: &str) -> Result<Vec<ExperimentRow>, DataError> {
    let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
    let mut table = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(whole.as_bytes());
    let mut rows = Vec::new();
    for (place, record) in table.records().enumerate() {
        let fault = |message: &str| DataError { line: Some(place + 1), ..DataError::new(path, message) };
        let record = record.map_err(|error| fault(&error.to_string()))?;
        if place == 0 {
            if !record.iter().eq(header(plan)) {
                return Err(fault("has other columns than this experiment"));
            }
            continue;
        }
        rows.push(parse(plan, &record).map_err(|message| fault(&message))?);
    }
    rows.sort_by_key(|row| row.key.row);
    if let Some(twice) = rows.windows(2).find(|pair| pair[0].key.row == pair[1].key.row) {
        return Err(DataError::new(path, format!("row {} is there twice", twice[0].key.row)));
    }
    Ok(rows)
}

fn parse(plan: &ExperimentPlan, record: &StringRecord) -> Result<ExperimentRow, String> {
    let fields: Vec<&str> = record.iter().collect();
    let factors = plan.file.factors.len();
    if fields.len() != BEFORE.len() + factors + AFTER.len() + 2 * Metric::ALL.len() {
        return Err("has too few or too many fields".into());
    }
    let number: u64 = fields[0].parse().map_err(|_| format!("no number of a row: {}", fields[0]))?;
    if number >= plan.matches() {
        return Err(format!("row {number} is not of this experiment"));
    }
    let key = plan.key(number);
    let (after, figures) = fields[BEFORE.len() + factors..].split_at(AFTER.len());
    let [strategy, opponent, version, assets, digest, error, seconds, played] = after else {
        return Err("has too few fields".into());
    };
    check_version(version)?;
    let hash = |text: &str| u64::from_str_radix(text, 16).map_err(|_| format!("no hash: {text}"));
    let assets = hash(assets)?;
    if assets != plan.assets_hash(key.treatment) {
        return Err("was played from other files than there are now".into());
    }
    let value = |text: &&str| text.parse::<f64>().map_err(|_| format!("no number: {text}"));
    let figure = |text: &&str| if text.is_empty() { Ok(None) } else { value(text).map(Some) };
    let result = if error.is_empty() {
        let (own, opponents) = figures.split_at(Metric::ALL.len());
        let values = [own, opponents].map(|values| values.iter().map(figure).collect::<Result<Vec<_>, _>>());
        let [own, opponents] = values;
        let values = [own?, opponents?];
        Ok(MatchResult { digest: hash(digest)?, seconds: value(seconds)?, played: value(played)?, values })
    } else {
        Err((*error).to_owned())
    };
    let strategies = [strategy, opponent].map(|name| (*name).to_owned());
    let row = ExperimentRow { levels: plan.level_names(key.treatment), key, strategies, assets, result };
    let same = self::fields(&row).iter().map(String::as_str).eq(fields.iter().copied());
    if same { Ok(row) } else { Err("is not as this program writes it".into()) }
}
