//! Columns as a Parquet file of one row group, not compressed; an empty cell is null.

use std::sync::Arc;

use ::parquet::data_type::{ByteArrayType, DataType, DoubleType};
use ::parquet::errors::Result;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::parser::parse_message_type;

use super::arrays::{Array, ArrayCells};
use crate::words::joined;

/// The file. Fails if the columns are too long for it.
pub fn file(columns: &[Array]) -> Result<Vec<u8>> {
    let field = |Array { name, cells, .. }: &Array| match cells {
        ArrayCells::Codes(_) | ArrayCells::Numbers(_) => format!("optional double {name};"),
        ArrayCells::Words(_) => format!("optional binary {name} (UTF8);"),
    };
    let fields = joined(columns.iter().map(field), " ");
    let schema = Arc::new(parse_message_type(&format!("message rows {{ {fields} }}"))?);
    let mut out = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut out, schema, Arc::default())?;
    let mut group = writer.next_row_group()?;
    for array in columns {
        let Some(mut column) = group.next_column()? else { continue };
        let out = &mut column;
        let code = |cell: &u8| Some((*cell).into());
        let number = |cell: &f64| Some(*cell).filter(|cell| !cell.is_nan());
        let word = |cell: &String| Some(cell.as_str().into()).filter(|_| !cell.is_empty());
        match &array.cells {
            ArrayCells::Codes(cells) => put::<DoubleType>(out, cells.iter().map(code))?,
            ArrayCells::Numbers(cells) => put::<DoubleType>(out, cells.iter().map(number))?,
            ArrayCells::Words(cells) => put::<ByteArrayType>(out, cells.iter().map(word))?,
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
    column.typed::<T>().write_batch(&values, Some(&levels), None).map(drop)
}
