//! Runs the real program without a terminal.

use std::process::{Command, Stdio};

use serde_json::Value;

/// The result of a run.
#[derive(Debug)]
pub struct Ran {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl Ran {
    /// Fails unless the command line was refused as bad input, in one line with all of these words.
    #[allow(dead_code, reason = "not every test program refuses something")]
    pub fn is_refused(&self, words: &[&str]) {
        assert_eq!((self.code, self.err.lines().count()), (2, 1), "{}{}", self.out, self.err);
        for word in words {
            assert!(self.err.contains(word), "{word}: {}", self.err);
        }
    }
}

/// A number in a document.
#[allow(dead_code, reason = "not every test program asks for JSON")]
pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// The command of the program with these arguments, not yet started.
pub fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopfscope"));
    command.args(arguments).stdin(Stdio::null());
    command
}

/// Runs the program to its end.
pub fn run(arguments: &[&str]) -> Ran {
    let output = command(arguments).output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let code = output.status.code().expect("no signal");
    Ran { code, out: text(output.stdout), err: text(output.stderr) }
}

/// Runs a command line given as words, expects an answer without messages, and returns it as JSON.
#[allow(dead_code, reason = "not every test program asks for JSON")]
pub fn json(line: &str) -> Value {
    let mut words: Vec<&str> = line.split_whitespace().collect();
    words.extend(["--format", "json"]);
    let ran = run(&words);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line}");
    serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{line}: {error}: {}", ran.out))
}
