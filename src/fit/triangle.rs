//! The triangular factor of a tall matrix, computed by blocks of rows.

use nalgebra::DMatrix;

/// Number of rows that are factored together, few enough to stay in the cache.
const BLOCK: usize = 128;

/// The factor R of a matrix with `count` rows and `width` columns.
///
/// `fill(index, row)` writes row `index`. The orthogonal factor is never formed: a vector to which it would be
/// applied is appended as another column.
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
