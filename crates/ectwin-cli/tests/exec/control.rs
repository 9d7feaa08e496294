//! `ECTWIN_CONTROL`: the command, an ordinary user too, steers its units; the socket is gone after the run.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use testbed::Process;

use crate::{UNIT, exec, folder_of, has_namespaces};

/// A command that prints the path of the socket, and ends when it is told.
const SHOW: [&str; 3] = ["sh", "-c", "echo control=$ECTWIN_CONTROL; read line"];

fn cables(test: &str) -> Vec<&'static str> {
    if has_namespaces(test) { vec!["udp", "veth"] } else { vec!["udp"] }
}

/// A run whose command waits, and its socket.
fn waiting(cable: &str, command: &mut Command) -> (Process, PathBuf) {
    let command = command.args([UNIT, "--link", cable, "--"]).args(SHOW);
    let mut process = Process::start(command);
    let path = PathBuf::from(process.wait_for_line("control=").trim_start_matches("control="));
    (process, path)
}

fn answer(path: &Path, request: &str) -> String {
    let mut stream = UnixStream::connect(path).unwrap();
    writeln!(stream, "{request}").unwrap();
    let mut line = String::new();
    BufReader::new(stream).read_line(&mut line).unwrap();
    line
}

#[test]
fn a_command_has_the_socket_of_its_units_in_a_folder_of_its_own() {
    for cable in cables("control::a_command_has_the_socket_of_its_units_in_a_folder_of_its_own") {
        let (mut one, path_of_one) = waiting(cable, &mut exec(&[]));
        let (mut other, path_of_other) = waiting(cable, &mut exec(&[]));
        for (path, order) in
            [(&path_of_one, "break Processing of unit 1"), (&path_of_other, "unplug cable 1")]
        {
            let folder = fs::symlink_metadata(path.parent().unwrap()).unwrap();
            assert_eq!(folder.permissions().mode() & 0o777, 0o700);
            assert_eq!(folder.uid(), rustix::process::geteuid().as_raw());
            assert!(answer(path, &format!("{{\"do\":\"{order}\"}}")).contains("\"ok\":true"));
        }
        assert!(answer(&path_of_one, r#"{"faults":true}"#).contains("Processing of unit 1"));
        assert!(
            answer(&path_of_other, r#"{"faults":true}"#).contains("\"faults\":[]"),
            "{cable}: each has its own"
        );
        for (process, path) in [(&mut one, path_of_one), (&mut other, path_of_other)] {
            process.say("");
            assert!(process.wait().success());
            assert!(!path.parent().unwrap().exists(), "{cable}");
        }
    }
}

#[test]
fn a_killed_run_leaves_no_socket_and_no_folder() {
    for cable in cables("control::a_killed_run_leaves_no_socket_and_no_folder") {
        let (mut process, path) = waiting(cable, exec(&[]).stderr(Stdio::null()));
        let id = process.id().to_string();
        assert!(Command::new("kill").args(["-KILL", &id]).status().unwrap().success());
        // Its outputs are closed when the last process has ended.
        process.wait();
        assert!(!path.parent().unwrap().exists(), "{cable}");
    }
}

#[test]
fn a_long_path_of_temporary_files_is_no_obstacle() {
    let long = folder_of("long").join("x".repeat(120));
    fs::create_dir(&long).unwrap();
    let (mut process, path) = waiting("udp", exec(&[]).env("TMPDIR", &long).env_remove("XDG_RUNTIME_DIR"));
    assert!(path.starts_with("/tmp"), "{}", path.display());
    process.say("");
    assert!(process.wait().success());
    assert!(!path.parent().unwrap().exists());
    assert_eq!(fs::read_dir(&long).unwrap().count(), 0);
}
