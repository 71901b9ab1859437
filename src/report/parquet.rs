//! Columns as a Parquet file of one row group, not compressed; NaN and empty words are null.

use std::sync::Arc;

use ::parquet::data_type::{BoolType, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::Result;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::parser::parse_message_type;

use super::arrays::{Array, Data};

/// The file.
///
/// # Errors
/// One line, if the columns are too long for it.
pub fn parquet(columns: &[Array]) -> Result<Vec<u8>, String> {
    written(columns).map_err(|error| error.to_string())
}

fn written(columns: &[Array]) -> Result<Vec<u8>> {
    let field = |column: &Array| {
        let kind = match &column.data {
            Data::Flags(_) => "boolean",
            Data::Bytes(_) | Data::Counts(_) => "int64",
            Data::Numbers(_) => "double",
            Data::Words(_) => "binary",
        };
        let text = if kind == "binary" { " (UTF8)" } else { "" };
        format!("optional {kind} {}{text};", column.name)
    };
    let fields: String = columns.iter().map(field).collect();
    let schema = Arc::new(parse_message_type(&format!("message rows {{ {fields} }}"))?);
    let mut out = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut out, schema, Arc::default())?;
    let mut group = writer.next_row_group()?;
    for Array { data, .. } in columns {
        let Some(mut column) = group.next_column()? else { continue };
        let into = &mut column;
        match data {
            Data::Flags(data) => put::<BoolType>(into, data.iter().map(|it| Some(*it)))?,
            Data::Bytes(data) => put::<Int64Type>(into, data.iter().map(|it| Some((*it).into())))?,
            Data::Counts(data) => put::<Int64Type>(into, data.iter().map(|it| Some(*it)))?,
            Data::Numbers(data) => {
                put::<DoubleType>(into, data.iter().map(|it| Some(*it).filter(|it| !it.is_nan())))?;
            }
            Data::Words(data) => {
                let word = |it: &String| Some(it.as_str().into()).filter(|_| !it.is_empty());
                put::<ByteArrayType>(into, data.iter().map(word))?;
            }
        }
        column.close()?;
    }
    group.close()?;
    writer.close()?;
    Ok(out)
}

/// Writes the cells of a column, of which some may be missing.
fn put<T: DataType>(
    column: &mut SerializedColumnWriter,
    cells: impl Iterator<Item = Option<T::T>> + Clone,
) -> Result<()> {
    let levels: Vec<i16> = cells.clone().map(|cell| cell.is_some().into()).collect();
    let values: Vec<T::T> = cells.flatten().collect();
    column.typed::<T>().write_batch(&values, Some(&levels), None)?;
    Ok(())
}
