//! Words for numbers, quantities and answers, the same on the screen, in tables and in figures.

pub mod claim;
pub mod fit;
pub mod measured;
pub mod motion;
pub mod number;
pub mod printable;
pub mod provenance;
pub mod quantity;
pub mod similar;
pub mod statement;

/// `no limit cycle`, `1 cycle`, `2 cycles`.
pub fn cycles(count: usize) -> String {
    match count {
        0 => "no limit cycle".to_owned(),
        1 => "1 cycle".to_owned(),
        more => format!("{more} cycles"),
    }
}

/// `stable` or `unstable`.
pub fn stability(stable: bool) -> &'static str {
    if stable { "stable" } else { "unstable" }
}
