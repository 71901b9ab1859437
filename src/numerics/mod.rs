//! Arithmetic that every other ring may build on.

pub mod interval;

pub use interval::Interval;
