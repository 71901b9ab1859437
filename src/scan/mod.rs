//! Measures at many points, in rows that may be shared out.

#[doc(hidden)]
pub mod grid;
#[doc(hidden)]
pub mod measure;
pub mod sweep;
