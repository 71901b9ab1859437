//! What the system does with files and priorities. `windows/system.rs` is the same for Windows.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Read};
use std::os::unix::fs::{FileTypeExt, MetadataExt, OpenOptionsExt, fchown};
use std::path::Path;

use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};

/// Opens a file to read it, and reads the beginning if it is a pipe. Fails if nothing writes to the pipe.
pub fn open(path: &Path) -> io::Result<(File, Vec<u8>)> {
    let mut file = at_once(OpenOptions::new().read(true)).open(path)?;
    let mut held = Vec::new();
    if file.metadata()?.file_type().is_fifo() {
        // A pipe without a writer is at its end; one whose writer is not ready yet would block.
        let mut first = [0; 1 << 12];
        match file.read(&mut first) {
            Ok(0) => return Err(io::Error::other("nothing is written to this pipe")),
            Ok(length) => held.extend_from_slice(&first[..length]),
            Err(why) if why.kind() == ErrorKind::WouldBlock => {}
            Err(why) => return Err(why),
        }
    }
    Ok((block(file)?, held))
}

/// Opens a device or a pipe for writing, without waiting for a reader of the pipe.
pub fn device(path: &Path) -> io::Result<File> {
    let file = at_once(OpenOptions::new().append(true)).open(path);
    let is_pipe = || fs::metadata(path).is_ok_and(|file| file.file_type().is_fifo());
    block(file.map_err(|why| match why.kind() {
        kind if kind != ErrorKind::PermissionDenied && is_pipe() => {
            io::Error::new(kind, "nobody reads from this pipe")
        }
        _ => why,
    })?)
}

/// Opening does not wait for the other end of a pipe, and no terminal becomes that of the process.
fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    options.custom_flags(i32::try_from(flags.bits()).unwrap_or(0))
}

/// Makes a file wait in reads and writes.
fn block(file: File) -> io::Result<File> {
    fcntl_setfl(&file, fcntl_getfl(&file)? - OFlags::NONBLOCK)?;
    Ok(file)
}

/// Creates a file with this mode, but for what the user's umask takes away. Fails if there is one.
pub fn create(path: &Path, mode: u32) -> io::Result<File> {
    OpenOptions::new().write(true).create_new(true).mode(mode).open(path)
}

/// Gives a file the owner of the one that it replaces, which only the superuser can; otherwise it becomes the user's.
pub fn give(file: &File, old: &Metadata) {
    drop(fchown(file, Some(old.uid()), Some(old.gid())));
}

/// Lets other programs have priority over this thread by a niceness.
pub fn give_way(niceness: i32) {
    // If that fails, the rows are the same, but other programs are slowed down more.
    let _ = rustix::process::nice(niceness);
}
