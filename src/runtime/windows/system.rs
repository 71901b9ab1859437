//! Windows, where the folder of a file says who reads it, and nothing waits for another end.

use std::fs::{File, Metadata, OpenOptions};
use std::io;

pub fn at_once(options: &mut OpenOptions) -> &mut OpenOptions {
    options
}

pub fn block(_: &File) -> io::Result<()> {
    Ok(())
}

pub fn is_pipe(_: &Metadata) -> bool {
    false
}

pub fn with_mode(options: &mut OpenOptions, _: u32) -> &mut OpenOptions {
    options
}

pub fn give(_: &File, _: &Metadata) {}

pub fn give_way(_: i32) {}
