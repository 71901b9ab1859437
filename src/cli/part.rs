//! The rows of a scan that one process computes.

use std::ops::Range;

use clap::Args;

use super::Result;
use super::input::pair;

/// The options that choose rows; at most one of them is given.
#[derive(Default, Args)]
#[group(id = "part", multiple = false)]
pub struct RowChoice {
    /// Computes only part K of N (1 <= K <= N); the parts in order make up the whole scan
    #[arg(long, value_name = "K/N", value_parser = |text: &str| shard(text, 1))]
    shard: Option<Shard>,
    /// The same, with parts counted from 0 (0 <= K < N)
    #[arg(long, value_name = "K/N", value_parser = |text: &str| shard(text, 0))]
    shard_index0: Option<Shard>,
    /// Computes only these rows, counted from 1
    #[arg(long, value_name = "FIRST:LAST", value_parser = rows)]
    rows: Option<Range<usize>>,
}

/// Part `number` of `of`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub number: usize,
    pub of: usize,
}

/// Maximum number of shards.
pub const MOST: usize = 1_000_000;

/// Part K of N, where the first part has this number.
fn shard(text: &str, first: usize) -> Result<Shard, String> {
    let allowed = if first == 0 { "0 <= K < N" } else { "1 <= K <= N" };
    pair(text, '/')
        .filter(|(number, of)| *of <= MOST && (first..of + first).contains(number))
        .map(|(number, of)| Shard { number: number + 1 - first, of })
        .ok_or_else(|| format!("{text:?} is not a part; expected K/N with {allowed} <= {MOST}"))
}

/// The points of rows `FIRST` to `LAST`, both included, counted from 1.
fn rows(text: &str) -> Result<Range<usize>, String> {
    pair(text, ':')
        .filter(|(first, last)| (1..=*last).contains(first))
        .map(|(first, last)| first - 1..last)
        .ok_or_else(|| {
            format!("{text:?} is not a range of rows; expected FIRST:LAST with 1 <= FIRST <= LAST")
        })
}

impl Shard {
    /// The points of the shard. Shards are consecutive runs of points whose lengths differ by at most one.
    pub fn points(self, all: usize) -> Range<usize> {
        let end = |number: usize| all / self.of * number + (all % self.of).min(number);
        end(self.number - 1)..end(self.number)
    }

    /// All shards of the scan, this one included.
    pub fn siblings(self) -> impl Iterator<Item = Shard> {
        (1..=self.of).map(move |number| Shard { number, of: self.of })
    }
}

impl RowChoice {
    /// The shard asked for, if any.
    pub fn shard(&self) -> Option<Shard> {
        self.shard.or(self.shard_index0)
    }

    /// The points to compute, of `all` in the scan.
    pub fn points(&self, all: usize) -> Result<Range<usize>> {
        if let Some(shard) = self.shard() {
            return Ok(shard.points(all));
        }
        let rows = self.rows.clone().unwrap_or(0..all);
        if rows.end > all {
            let (first, last) = (rows.start + 1, rows.end);
            return Err(format!("--rows {first}:{last}: the scan has {all} rows").into());
        }
        Ok(rows)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_the_whole_in_order_and_as_long_as_each_other() {
        for all in [2, 7, 100, 101] {
            for of in [1, 2, 3, 7, 150] {
                let parts = Shard { number: 1, of }.siblings().map(|shard| shard.points(all));
                let parts: Vec<_> = parts.collect();
                let lengths: Vec<usize> = parts.iter().map(ExactSizeIterator::len).collect();
                let (least, most) = (lengths.iter().min().unwrap(), lengths.iter().max().unwrap());
                assert!(most - least <= 1, "{lengths:?}");
                assert!(parts.into_iter().flatten().eq(0..all), "{all} in {of}");
            }
        }
    }

    #[test]
    fn parts_that_do_not_exist_are_refused() {
        assert_eq!(shard("2/3", 1), Ok(Shard { number: 2, of: 3 }));
        assert_eq!(shard("1/3", 0), shard("2/3", 1));
        assert_eq!(rows("4:4"), Ok(3..4));
        for text in ["0/3", "4/3", "1", "1/0", "a/b", "-1/2", "1/2/3", "1/1000001"] {
            assert!(shard(text, 1).unwrap_err().contains("1 <= K <= N"), "{text}");
        }
        for text in ["3/3", "0/0", "-1/3", "0/1000001"] {
            assert!(shard(text, 0).unwrap_err().contains("0 <= K < N"), "{text}");
        }
        for text in ["0:3", "4:3", "1", "1:", "a:b"] {
            assert!(rows(text).unwrap_err().contains("FIRST:LAST"), "{text}");
        }
        let beyond = RowChoice { rows: Some(2..8), ..RowChoice::default() };
        assert!(beyond.points(7).is_err());
        assert_eq!(beyond.points(8).unwrap(), 2..8);
    }
}
