//! Tables of reference values in `tests/data`, computed with 60 digits (mpmath) and rounded.

/// The numbers of each row; a cell without one is left out.
pub fn rows(table: &str) -> Vec<Vec<f64>> {
    assert!(table.lines().count() > 5, "rows below a heading");
    let numbers = |row: &str| {
        let cells = row.split(',').filter(|cell| !cell.is_empty());
        cells.map(|cell| cell.parse().expect("a number")).collect()
    };
    table.lines().skip(1).map(numbers).collect()
}
