//! The signals of Windows: Ctrl-C, which in raw mode is a key, and an end that is asked for. The console itself tells its
//! size, and no shell continues a program.

use signal_hook::consts::{SIGINT, SIGTERM};

pub const STOPPING: [i32; 2] = [SIGINT, SIGTERM];

pub fn can_be_continued() -> bool {
    false
}
