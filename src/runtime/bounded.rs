//! Files that are read up to a maximum length, because a device or a pipe could be endless.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Longest file that is read, in bytes.
const LONGEST: u64 = 64 << 20;

/// The content of a file. Fails if the file cannot be read or is too long.
pub fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let mut held = Vec::new();
    File::open(path)?.take(LONGEST + 1).read_to_end(&mut held)?;
    if held.len() as u64 > LONGEST {
        let line = format!("longer than {} MB, the most that is read", LONGEST >> 20);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, line));
    }
    Ok(held)
}

/// The content of a file as text. Fails like [`bytes`], and if the file is not UTF-8.
pub fn text(path: &Path) -> io::Result<String> {
    String::from_utf8(bytes(path)?).map_err(|_| {
        let line = "not a text: it holds bytes that are not UTF-8";
        io::Error::new(io::ErrorKind::InvalidData, line)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endless_file_is_refused() {
        let why = bytes(Path::new("/dev/zero")).unwrap_err();
        assert_eq!(why.to_string(), "longer than 64 MB, the most that is read");
    }
}
