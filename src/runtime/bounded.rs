//! Files that are read up to a maximum length, because a device or a pipe could be endless.

use std::fs::OpenOptions;
use std::io::{self, ErrorKind, IsTerminal, Read};
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
    let mut file = system::at_once(OpenOptions::new().read(true)).open(path)?;
    let kind = file.metadata()?;
    if file.is_terminal() {
        return Err(io::Error::other("a terminal, not a file"));
    }
    let mut held = Vec::new();
    if system::is_pipe(&kind) {
        // A pipe without a writer is at its end; one whose writer is not ready yet would block.
        let mut first = [0; 1 << 12];
        match file.read(&mut first) {
            Ok(0) => return Err(io::Error::other("nothing is written to this pipe")),
            Ok(length) => held.extend_from_slice(&first[..length]),
            Err(why) if why.kind() == ErrorKind::WouldBlock => {}
            Err(why) => return Err(why),
        }
    }
    system::block(&file)?;
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
