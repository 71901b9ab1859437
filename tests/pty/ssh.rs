//! The explorer behind a real SSH connection over a slow line.
//!
//! An SSH server on the loopback interface, an SSH client in a pty, and between them a relay that acts like a
//! line of modems and mobile networks: 64 kbit/s, a round trip of 150 ms, and an unbounded queue. Needs `sshd`,
//! `ssh` and `ssh-keygen`, so it is left out of a plain `cargo test`:
//!
//!     cargo test --test pty ssh -- --ignored

use std::fs;
use std::io::{Read, Write};
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::support::{Answers, Terminal};
use tempfile::TempDir;

/// Bytes per second on the line: 64 kbit/s.
const BYTES_PER_SECOND: f64 = 8_000.0;

/// Latency from one end of the line to the other.
const ONE_WAY: Duration = Duration::from_millis(75);

/// A pause after which the slow line has nothing more to deliver: several round trips.
const QUIET: Duration = Duration::from_millis(800);

/// An SSH server for the user who runs the test; it ends when dropped.
struct Server {
    process: Child,
    files: TempDir,
    address: SocketAddr,
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.process.kill());
        drop(self.process.wait());
    }
}

/// Path of a system program; `sshd` must be called by its full path.
fn program(name: &str) -> PathBuf {
    let folders =
        ["/usr/sbin", "/usr/bin", "/usr/local/sbin", "/usr/local/bin", "/opt/homebrew/bin"];
    let mut places = folders.iter().map(|folder| Path::new(folder).join(name));
    places.find(|path| path.exists()).unwrap_or_else(|| panic!("{name} is not installed"))
}

fn key(path: &Path) {
    let made = Command::new(program("ssh-keygen"))
        .args(["-q", "-t", "ed25519", "-N", "", "-f"])
        .arg(path)
        .status();
    assert!(made.unwrap().success());
}

/// A free port of the loopback interface.
fn free() -> SocketAddr {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap()
}

fn server() -> Server {
    /// How often a port is tried: another program may take a free one before the server does.
    const PORTS: usize = 5;
    let files = TempDir::new().unwrap();
    let file = |name: &str| files.path().join(name);
    key(&file("host"));
    key(&file("user"));
    fs::copy(file("user.pub"), file("authorized")).unwrap();
    // A server run by root needs this folder, which is normally made by the system's start script.
    drop(fs::create_dir_all("/run/sshd"));
    let log = || fs::read_to_string(file("log")).unwrap_or_default();
    // Connections are no test: many of them to a port that nobody holds yet may meet themselves there, and keep the server out.
    let listens = || log().contains("Server listening");
    for _ in 0..PORTS {
        let address = free();
        let settings = [
            format!("ListenAddress {address}"),
            format!("HostKey {}", file("host").display()),
            format!("AuthorizedKeysFile {}", file("authorized").display()),
            format!("PidFile {}", file("pid").display()),
            "StrictModes no\nUsePAM no\nPermitRootLogin yes\nPasswordAuthentication no".to_owned(),
            "KbdInteractiveAuthentication no\nUseDNS no\nPrintMotd no\nPrintLastLog no".to_owned(),
        ];
        fs::write(file("settings"), settings.join("\n")).unwrap();
        let mut process = Command::new(program("sshd"))
            .args(["-D", "-e", "-f"])
            .arg(file("settings"))
            .stderr(fs::File::create(file("log")).unwrap())
            .stdin(Stdio::null())
            .spawn()
            .unwrap();
        crate::support::poll("an SSH server", || {
            listens() || process.try_wait().unwrap().is_some()
        });
        if listens() {
            return Server { process, files, address };
        }
    }
    panic!("no SSH server on {PORTS} ports: {}", log());
}

/// A slow line to an address; returns the address to connect to instead.
fn line(to: SocketAddr) -> SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let here = listener.local_addr().unwrap();
    thread::spawn(move || {
        for near in listener.incoming().map_while(Result::ok) {
            let Ok(far) = TcpStream::connect(to) else { return };
            for (from, to) in [(&near, &far), (&far, &near)] {
                let (from, to) = (from.try_clone().unwrap(), to.try_clone().unwrap());
                from.set_nodelay(true).unwrap();
                let (send, queue) = channel();
                thread::spawn(move || receive(from, &send));
                thread::spawn(move || deliver(&queue, to));
            }
        }
    });
    here
}

fn receive(mut from: TcpStream, queue: &Sender<(Instant, Vec<u8>)>) {
    let mut buffer = [0; 256];
    while let Ok(count @ 1..) = from.read(&mut buffer) {
        if queue.send((Instant::now(), buffer[..count].to_vec())).is_err() {
            return;
        }
    }
}

fn deliver(queue: &Receiver<(Instant, Vec<u8>)>, mut to: TcpStream) {
    let mut free = Instant::now();
    for (sent, bytes) in queue {
        #[expect(clippy::cast_precision_loss, reason = "a few hundred bytes")]
        let time = Duration::from_secs_f64(bytes.len() as f64 / BYTES_PER_SECOND);
        free = free.max(sent) + time;
        thread::sleep((free + ONE_WAY).saturating_duration_since(Instant::now()));
        if to.write_all(&bytes).is_err() {
            return;
        }
    }
    drop(to.shutdown(Shutdown::Write));
}

/// The explorer behind the slow line, with its first picture complete.
fn explorer(server: &Server, arguments: &str) -> Terminal {
    let near = line(server.address);
    let port = near.port().to_string();
    let user = server.files.path().join("user");
    let ssh = program("ssh");
    let user_name = Command::new("id").arg("-un").output().unwrap().stdout;
    let remote = format!("{}@{}", String::from_utf8(user_name).unwrap().trim(), near.ip());
    let command = format!("env LANG=C.UTF-8 {} {arguments}", env!("CARGO_BIN_EXE_hopfscope"));
    let words = [
        ssh.to_str().unwrap(),
        "-tt",
        "-F",
        "none",
        "-p",
        &port,
        "-i",
        user.to_str().unwrap(),
        "-o",
        "StrictHostKeyChecking=no",
        "-o",
        "UserKnownHostsFile=/dev/null",
        "-o",
        "LogLevel=ERROR",
        &remote,
        &command,
    ];
    let mut terminal = Terminal::start(&words, &[], (80, 24), Answers::AtOnce);
    terminal.wait("the first picture", |terminal| terminal.screen().alternate_screen());
    terminal.quiet(QUIET);
    terminal
}

#[test]
#[ignore = "needs sshd; run by .ci/run"]
fn a_held_key_over_a_slow_line_skips_pictures_and_ends_on_the_right_one() {
    /// Repetitions of a key held down for three seconds, at 30 per second.
    const KEYS: usize = 90;
    let server = server();
    let mut terminal = explorer(&server, "--set D=-0.95 --set D3=0.5");
    assert!(terminal.text().contains("-0.95"), "{}", terminal.text());
    let before = (terminal.frames(), terminal.written.len());
    for _ in 0..KEYS {
        terminal.types("\x1b[C");
        terminal.watch(Duration::from_millis(33));
    }
    let held = terminal.frames();
    assert!(held > before.0 + 2, "no picture while the key was down");
    // The picture of the keys so far may still be in transit, and one more follows it.
    terminal.wait_for("-0.05");
    terminal.quiet(QUIET);
    let after = terminal.frames() - held;
    assert!(after <= 4, "{after} frames had queued behind the last key");
    let (frames, bytes) = (terminal.frames() - before.0, terminal.written.len() - before.1);
    eprintln!(
        "{KEYS} keys in 3 s: {frames} frames, {bytes} bytes, {after} frames after the last key"
    );
    assert!(frames < KEYS / 2, "{frames} frames");

    terminal.leave();
}

#[test]
#[ignore = "needs sshd; run by .ci/run"]
fn a_key_is_answered_by_one_picture_over_a_slow_line() {
    let server = server();
    let mut terminal = explorer(&server, "--set D=-0.95");
    for value in ["-0.94", "-0.93", "-0.92"] {
        let before = (terminal.frames(), terminal.written.len());
        terminal.types("\x1b[C");
        terminal.wait_for(value);
        terminal.quiet(QUIET);
        let (frames, bytes) = (terminal.frames() - before.0, terminal.written.len() - before.1);
        assert!(frames <= 2 && bytes < 2_600, "{frames} frames, {bytes} bytes for one key");
    }
    // Escape alone is a key, although over a line that splits sequences its byte could begin another one.
    terminal.types("?");
    terminal.wait_for("choose a number");
    terminal.types("\x1b");
    terminal.wait("the help is closed", |terminal| !terminal.text().contains("choose a number"));
    terminal.leave();
}

#[test]
#[ignore = "needs sshd; run by .ci/run"]
fn a_connection_that_breaks_leaves_no_process_behind() {
    let server = server();
    let marker = "--set D=-0.9375";
    let terminal = explorer(&server, marker);
    let running = || {
        let mut processes = fs::read_dir("/proc").unwrap().flatten();
        processes.any(|process| {
            let words = fs::read(process.path().join("cmdline")).unwrap_or_default();
            let words = String::from_utf8_lossy(&words).replace('\0', " ");
            words.contains(marker)
                && words.split(' ').next().is_some_and(|program| program.ends_with("hopfscope"))
        })
    };
    assert!(running());
    // Ends the client, and with it the connection.
    drop(terminal);
    crate::support::poll("end of the explorer", || !running());
}
