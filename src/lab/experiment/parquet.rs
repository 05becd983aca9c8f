//! Rows as a Parquet file, for tools that read large tables by column.

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as PhysicalType};
use parquet::column::writer::ColumnWriter;
use parquet::data_type::ByteArray;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use super::metric::Metric;
use super::plan::ExperimentPlan;
use super::row::{ExperimentRow, MatchResult, VERSION};
use super::table::header;

/// A column of values of one kind; what a row without a result lacks is null.
enum TableColumn {
    Whole(Vec<i64>),
    Truth(Vec<bool>),
    Text(Vec<String>),
    Real(Vec<Option<f64>>),
}

/// Writes a whole table.
///
/// # Errors
/// If the bytes cannot be written.
pub fn write_parquet(
    plan: &ExperimentPlan,
    rows: &[ExperimentRow],
    out: impl Write + Send,
) -> io::Result<()> {
    let (names, values) = (header(plan), columns(plan, rows));
    let fields = names.iter().zip(&values).map(|(name, values)| values.field(name));
    let fields = fields.collect::<parquet::errors::Result<Vec<TypePtr>>>().map_err(io::Error::other)?;
    let schema = Type::group_type_builder("match").with_fields(fields).build().map_err(io::Error::other)?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut file = SerializedFileWriter::new(out, Arc::new(schema), properties).map_err(io::Error::other)?;
    let mut group = file.next_row_group().map_err(io::Error::other)?;
    for values in &values {
        if let Some(mut column) = group.next_column().map_err(io::Error::other)? {
            values.write(column.untyped()).map_err(io::Error::other)?;
            column.close().map_err(io::Error::other)?;
        }
    }
    group.close().map_err(io::Error::other)?;
    file.close().map_err(io::Error::other)?;
    Ok(())
}

impl TableColumn {
    fn field(&self, name: &str) -> parquet::errors::Result<TypePtr> {
        let (kind, logical) = match self {
            TableColumn::Whole(_) => (PhysicalType::INT64, None),
            TableColumn::Truth(_) => (PhysicalType::BOOLEAN, None),
            TableColumn::Text(_) => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String)),
            TableColumn::Real(_) => (PhysicalType::DOUBLE, None),
        };
        let repetition =
            if matches!(self, TableColumn::Real(_)) { Repetition::OPTIONAL } else { Repetition::REQUIRED };
        let field = Type::primitive_type_builder(name, kind);
        Ok(Arc::new(field.with_repetition(repetition).with_logical_type(logical).build()?))
    }

    fn write(&self, column: &mut ColumnWriter) -> parquet::errors::Result<usize> {
        match (self, column) {
            (TableColumn::Whole(values), ColumnWriter::Int64ColumnWriter(column)) => {
                column.write_batch(values, None, None)
            }
            (TableColumn::Truth(values), ColumnWriter::BoolColumnWriter(column)) => {
                column.write_batch(values, None, None)
            }
            (TableColumn::Text(values), ColumnWriter::ByteArrayColumnWriter(column)) => {
                let values: Vec<ByteArray> = values.iter().map(|text| text.as_str().into()).collect();
                column.write_batch(&values, None, None)
            }
            (TableColumn::Real(values), ColumnWriter::DoubleColumnWriter(column)) => {
                let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
                let values: Vec<f64> = values.iter().flatten().copied().collect();
                column.write_batch(&values, Some(&levels), None)
            }
            _ => Ok(0),
        }
    }
}

/// In the order of the header.
fn columns(plan: &ExperimentPlan, rows: &[ExperimentRow]) -> Vec<TableColumn> {
    let whole = |of: &dyn Fn(&ExperimentRow) -> u64| {
        TableColumn::Whole(rows.iter().map(|row| of(row) as i64).collect())
    };
    let text = |of: &dyn Fn(&ExperimentRow) -> String| TableColumn::Text(rows.iter().map(of).collect());
    let real = |of: &dyn Fn(&MatchResult) -> Option<f64>| {
        TableColumn::Real(rows.iter().map(|row| row.result.as_ref().ok().and_then(of)).collect())
    };
    let digest = |row: &ExperimentRow| {
        row.result.as_ref().map_or_else(|_| String::new(), |result| format!("{:016x}", result.digest))
    };
    let mut columns = vec![
        whole(&|row| row.key.row),
        whole(&|row| row.key.treatment as u64),
        whole(&|row| row.key.seed),
        TableColumn::Truth(rows.iter().map(|row| row.key.swapped).collect()),
    ];
    columns.extend((0..plan.file.factors.len()).map(|factor| text(&|row| row.levels[factor].clone())));
    columns.extend([
        text(&|row| row.strategies[0].clone()),
        text(&|row| row.strategies[1].clone()),
        text(&|_| VERSION.to_owned()),
        text(&|row| format!("{:016x}", row.assets)),
        text(&digest),
        text(&|row| row.result.as_ref().err().cloned().unwrap_or_default()),
        real(&|result| Some(result.seconds)),
        real(&|result| Some(result.played)),
    ]);
    for side in [0, 1] {
        columns.extend((0..Metric::ALL.len()).map(|metric| real(&|result| result.values[side][metric])));
    }
    columns
}
