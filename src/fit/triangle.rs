//! The triangular factor of a tall matrix, a block of rows at a time.

use nalgebra::DMatrix;

/// Rows that are factored together: they stay in the cache.
const BLOCK: usize = 128;

/// The factor R of a matrix with `width` columns whose rows `fill` writes one after the other.
///
/// `fill(index, row)` writes row `index` of `count`. The orthogonal factor is never formed: what it would be
/// applied to is appended as a further column.
pub fn triangle(
    width: usize,
    count: usize,
    mut fill: impl FnMut(usize, &mut [f64]),
) -> DMatrix<f64> {
    let mut factor = DMatrix::zeros(width, width);
    let mut row = vec![0.0; width];
    let mut begin = 0;
    while begin < count {
        let end = (begin + BLOCK).min(count);
        let mut block = DMatrix::zeros(width + end - begin, width);
        block.rows_mut(0, width).copy_from(&factor);
        for index in begin..end {
            fill(index, &mut row);
            for (column, value) in row.iter().enumerate() {
                block[(width + index - begin, column)] = *value;
            }
        }
        factor = block.qr().r().rows(0, width).into_owned();
        begin = end;
    }
    factor
}
