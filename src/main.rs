//! The program `hopfscope`: parse, run one command, turn an error into an exit code.

use std::process::ExitCode;

/// Runs before the runtime of the language, which replaces a closed standard output by /dev/null: an answer would
/// then be lost with exit code 0.
#[cfg(unix)]
#[expect(unsafe_code, reason = "only a pointer in this section is called before the runtime")]
#[cfg_attr(target_vendor = "apple", unsafe(link_section = "__DATA,__mod_init_func"))]
#[cfg_attr(not(target_vendor = "apple"), unsafe(link_section = ".init_array"))]
#[used]
static BEFORE_MAIN: extern "C" fn() = {
    extern "C" fn look() {
        let closed = rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err();
        hopfscope::runtime::standard::CLOSED.store(closed, std::sync::atomic::Ordering::Relaxed);
    }
    look
};

fn main() -> color_eyre::Result<ExitCode> {
    // For defects of the program only: what users do wrong is said in one line.
    color_eyre::install()?;
    Ok(hopfscope::cli::main().into())
}
