//! Files that are read up to a maximum length, because a device or a pipe could be endless.

use std::io::{self, IsTerminal, Read};
use std::path::Path;

use super::{Failure, system};

/// Longest file that is read, in bytes.
const LONGEST: u64 = 64 << 20;

/// The content of a file or a pipe. Fails if it cannot be read or is too long, if nothing writes to the pipe,
/// and for a terminal: it would wait there for an end that the user does not know about.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    read(path).map_err(|error| Failure::file(path, &error))
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    let (file, mut held) = system::open(path)?;
    let kind = file.metadata()?;
    if file.is_terminal() {
        return Err(io::Error::other("a terminal, not a file"));
    }
    if kind.len() <= LONGEST {
        (&file).take(LONGEST + 1 - held.len() as u64).read_to_end(&mut held)?;
    }
    if held.len() as u64 > LONGEST || kind.len() > LONGEST {
        let line = format!("longer than {} MB, the most that is read", LONGEST >> 20);
        return Err(io::Error::other(line));
    }
    Ok(held)
}

/// The content of a file as text. Fails like [`bytes`], and if the file is not UTF-8.
pub fn text(path: &Path) -> Result<String, Failure> {
    let refused = |_| Failure::file(path, "not a text: it holds bytes that are not UTF-8");
    String::from_utf8(bytes(path)?).map_err(refused)
}
