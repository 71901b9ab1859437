//! What the system does with files and priorities. `windows/system.rs` is the same for Windows.

use std::fs::{File, Metadata, OpenOptions};
use std::io;
use std::os::unix::fs::{FileTypeExt, MetadataExt, OpenOptionsExt, fchown};

use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};

/// Opens a file, a pipe without waiting for its other end, or a device; a terminal does not become that of the
/// process. [`block`] makes reads and writes wait again.
pub fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
    options.custom_flags(i32::try_from(flags.bits()).unwrap_or(0))
}

/// Makes a file wait in reads and writes.
pub fn block(file: &File) -> io::Result<()> {
    Ok(fcntl_setfl(file, fcntl_getfl(file)? - OFlags::NONBLOCK)?)
}

/// Whether it is a pipe with a name.
pub fn is_pipe(file: &Metadata) -> bool {
    file.file_type().is_fifo()
}

/// Gives a file that is created this mode, but for what the user's umask takes away.
pub fn with_mode(options: &mut OpenOptions, mode: u32) -> &mut OpenOptions {
    options.mode(mode)
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
