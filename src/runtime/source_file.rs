//! What identifies a file that an answer was computed from: its name, its date and its SHA-256.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::Path;

use sha2::{Digest, Sha256};
use time::OffsetDateTime;

use crate::report::page::SourceFile;

/// The file that held these bytes when it was read.
pub fn of(path: &Path, bytes: &[u8]) -> SourceFile {
    let regular = fs::metadata(path).ok().filter(fs::Metadata::is_file);
    SourceFile {
        name: path.display().to_string(),
        changed: regular.map(|file| date(file.mtime())),
        sha256: sha256(bytes),
    }
}

/// The SHA-256 in hexadecimal digits.
fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |hex, byte| format!("{hex}{byte:02x}"))
}

/// Seconds since 1970 as `2026-03-02 10:11:12 UTC`.
fn date(seconds: i64) -> String {
    let Ok(at) = OffsetDateTime::from_unix_timestamp(seconds) else { return String::new() };
    let ((hours, minutes, seconds), month) = (at.to_hms(), u8::from(at.month()));
    format!("{}-{month:02}-{:02} {hours:02}:{minutes:02}:{seconds:02} UTC", at.year(), at.day())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // By `date -u -d @..`.
        for (seconds, shown) in [
            (0, "1970-01-01 00:00:00 UTC"),
            (-1, "1969-12-31 23:59:59 UTC"),
            (951_782_399, "2000-02-28 23:59:59 UTC"),
            (951_782_400, "2000-02-29 00:00:00 UTC"),
            (1_709_251_199, "2024-02-29 23:59:59 UTC"),
            (1_772_446_272, "2026-03-02 10:11:12 UTC"),
            (4_107_542_400, "2100-03-01 00:00:00 UTC"),
        ] {
            assert_eq!(date(seconds), shown);
        }
    }
}
