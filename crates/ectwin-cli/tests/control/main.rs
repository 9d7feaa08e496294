//! `ectwin run --control`: where the socket is, whose it is, and what is left of it.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::fs::{DirBuilderExt, PermissionsExt};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rustix::process::{Pid, Signal, kill_process};
use testbed::Process;

const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");

/// A folder of this test that only its user reaches. It is short: the path of a socket has a limit.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("ectwin-run-control-{}-{test}", std::process::id()));
        fs::DirBuilder::new().mode(0o700).create(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).unwrap();
    }
}

/// `ectwin run` with these arguments; without them, the folder of sockets is in this one.
fn run(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    command.args(["run", UNIT, "--link", "udp:127.0.0.1:0"]).args(arguments);
    command.env("XDG_RUNTIME_DIR", folder).env("TMPDIR", folder).env("NO_COLOR", "1").env_remove("RUST_LOG");
    command
}

/// Starts it, and waits until it is ready.
fn started(command: &mut Command) -> (Process, PathBuf) {
    let mut process = Process::start(command);
    let ready = process.wait_for_line("ready ").to_owned();
    let path = ready.split(' ').find_map(|word| word.strip_prefix("control="));
    let path = PathBuf::from(path.unwrap_or_else(|| panic!("no control= in `{ready}`")));
    (process, path)
}

/// What a command that refuses to start says, and its exit code.
fn refused(command: &mut Command) -> (Option<i32>, String) {
    let Output { status, stderr, .. } = command.output().unwrap();
    (status.code(), String::from_utf8(stderr).unwrap())
}

/// The answer to a request.
fn answer(path: &Path, request: &str) -> String {
    let mut stream = UnixStream::connect(path).unwrap();
    writeln!(stream, "{request}").unwrap();
    let mut line = String::new();
    BufReader::new(stream).read_line(&mut line).unwrap();
    line
}

fn mode(path: &Path) -> u32 {
    fs::symlink_metadata(path).unwrap().permissions().mode() & 0o777
}

fn signal(process: &Process, signal: Signal) {
    kill_process(Pid::from_raw(i32::try_from(process.id()).unwrap()).unwrap(), signal).unwrap();
}

#[test]
fn without_a_path_it_is_in_the_runtime_folder_of_the_user() {
    let folder = Folder::new("default");
    let (mut process, path) = started(&mut run(&folder.0, &["--control"]));
    assert_eq!(path, folder.0.join(format!("ectwin/{}.sock", process.id())));
    assert_eq!((mode(&path), mode(path.parent().unwrap())), (0o600, 0o700));
    assert!(answer(&path, r#"{"id":1,"expect":"unit 1 is in INIT"}"#).contains("\"held\":true"));
    process.interrupt();
    assert!(process.wait().success());
    assert!(!path.exists());
}

#[test]
fn without_a_runtime_folder_it_is_in_a_folder_for_temporary_files_that_only_the_user_reaches() {
    let folder = Folder::new("temporary");
    let user = rustix::process::geteuid().as_raw();
    for runtime in ["", "relative", "/no/such/folder"] {
        let (process, path) = started(run(&folder.0, &["--control"]).env("XDG_RUNTIME_DIR", runtime));
        let own = folder.0.join(format!("ectwin-{user}"));
        assert_eq!(path, own.join(format!("{}.sock", process.id())), "`{runtime}`");
        assert_eq!((mode(&path), mode(&own)), (0o600, 0o700));
    }
    let own = folder.0.join(format!("ectwin-{user}"));
    fs::set_permissions(&own, fs::Permissions::from_mode(0o755)).unwrap();
    let (code, words) = refused(run(&folder.0, &["--control"]).env("XDG_RUNTIME_DIR", ""));
    assert_eq!(code, Some(3), "{words}");
    assert!(words.contains("is not one that only you reach") && words.contains("--control PATH"), "{words}");
}

#[test]
fn a_second_twin_on_the_same_path_is_refused_and_the_first_one_goes_on() {
    let folder = Folder::new("second");
    let path = folder.0.join("twin.sock");
    let arguments = ["--control", path.to_str().unwrap(), "--modbus", "0"];
    let mut first = Process::start(&mut run(&folder.0, &arguments));
    let ready = first.wait_for_line("ready ").to_owned();
    assert!(ready.contains(&format!(" units=1 control={} modbus=127.0.0.1:", path.display())), "{ready}");
    let (code, words) = refused(&mut run(&folder.0, &arguments));
    assert_eq!(code, Some(3), "{words}");
    assert!(
        words.starts_with(&format!("error: another twin uses the control socket {}", path.display())),
        "{words}"
    );
    assert!(words.contains("help: end that twin, or choose another path"), "{words}");
    assert!(answer(&path, r#"{"id":1,"status":true}"#).contains("\"state\":\"INIT\""));
}

#[test]
fn the_socket_of_a_killed_twin_is_taken_over_and_every_orderly_end_removes_it() {
    let folder = Folder::new("killed");
    let path = folder.0.join("twin.sock");
    let arguments = ["--control", path.to_str().unwrap(), "--until-stdin-closes"];
    let (mut killed, _) = started(&mut run(&folder.0, &arguments));
    signal(&killed, Signal::KILL);
    killed.wait();
    assert!(path.exists(), "nobody could remove it");
    for end in [Some(Signal::INT), Some(Signal::TERM), Some(Signal::HUP), None] {
        let (mut process, there) = started(&mut run(&folder.0, &arguments));
        assert_eq!(there, path);
        match end {
            Some(end) => signal(&process, end),
            None => process.close_stdin(),
        }
        assert!(process.wait().success());
        assert!(!path.exists(), "{end:?}");
    }
}

#[test]
fn what_is_no_request_has_an_answer_and_a_trace_in_the_log_and_the_twin_goes_on() {
    let folder = Folder::new("bad");
    let path = folder.0.join("twin.sock");
    let arguments = ["--control", path.to_str().unwrap()];
    let log = folder.0.join("log");
    let (mut process, _) = started(run(&folder.0, &arguments).stderr(fs::File::create(&log).unwrap()));
    assert!(answer(&path, "hello").contains("\"ok\":false"));
    assert!(answer(&path, r#"{"do":"brek Processing of unit 1"}"#).contains("break Processing of unit 1"));
    let long = format!("{}\n{{\"id\":2,\"status\":true}}", "x".repeat(10_000_000));
    assert!(answer(&path, &long).contains("a request has more than 65536 bytes"));
    for number in 0..1_000 {
        assert!(
            answer(&path, &format!("{{\"id\":{number},\"expct\":1}}")).contains("did you mean `expect`?")
        );
    }
    process.interrupt();
    assert!(process.wait().success());
    let log = fs::read_to_string(&log).unwrap();
    assert!(log.contains("client 1: no request: expected value"), "{log}");
    assert!(log.contains("further messages about clients are not shown"), "{log}");
    assert!(log.lines().count() < 500, "the log is bounded: {} lines", log.lines().count());
}
