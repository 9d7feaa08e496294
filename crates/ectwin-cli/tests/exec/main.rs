//! `ectwin exec FILE… -- COMMAND…`: the command finds units, its exit code is handed on, and nothing is left behind.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod control;
mod kept;
mod left;
mod masters;
mod steered;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use testbed::skip;

const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");

/// `ectwin exec` with these arguments.
fn exec(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    command.arg("exec").args(arguments).env("NO_COLOR", "1").env_remove("RUST_LOG");
    command
}

/// Runs it to its end.
fn ended(arguments: &[&str]) -> (Option<i32>, String, String) {
    let Output { status, stdout, stderr } = exec(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (status.code(), text(stdout), text(stderr))
}

/// Whether the system permits network namespaces; otherwise the test is reported as skipped.
fn has_namespaces(test: &str) -> bool {
    let made = Command::new("unshare").args(["-Urn", "true"]).status();
    let is_permitted = made.is_ok_and(|status| status.success());
    if !is_permitted {
        skip(test, "no network namespace: `unshare -Urn` is not permitted here");
    }
    is_permitted
}

/// An empty folder of this test.
fn folder_of(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("exec").join(test);
    let _gone = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn the_exit_code_is_that_of_the_command() {
    for (command, code) in [("exit 0", 0), ("exit 7", 7), ("exit 125", 125), ("kill -KILL $$", 137)] {
        let (ended, stdout, stderr) = ended(&[UNIT, "--link", "udp", "--", "sh", "-c", command]);
        assert_eq!((ended, stdout.as_str(), stderr.as_str()), (Some(code), "", ""), "{command}");
    }
}

#[test]
fn a_command_that_cannot_run_has_the_exit_code_of_a_shell() {
    let (code, _, stderr) = ended(&[UNIT, "--link", "udp", "--", "no-such-program"]);
    assert_eq!(code, Some(127), "{stderr}");
    assert!(stderr.starts_with("error: cannot run no-such-program: No such file or directory"), "{stderr}");
    let (code, _, stderr) = ended(&[UNIT, "--link", "udp", "--", ""]);
    assert_eq!(code, Some(127), "{stderr}");
    assert!(stderr.starts_with("error: cannot run \"\": "), "{stderr}");
    let (code, _, stderr) = ended(&[UNIT, "--link", "udp", "--", UNIT]);
    assert_eq!(code, Some(126), "{stderr}");
}

#[test]
fn without_units_the_command_does_not_run() {
    let (code, stdout, stderr) = ended(&["no-such-unit.toml", "--link", "udp", "--", "echo", "it runs"]);
    assert_eq!((code, stdout.as_str()), (Some(125), ""), "{stderr}");
    assert!(stderr.starts_with("error: cannot read no-such-unit.toml: "), "{stderr}");
}

#[test]
fn a_command_line_without_a_command_is_refused() {
    let (code, _, stderr) = ended(&[UNIT]);
    assert_eq!(code, Some(2));
    assert!(stderr.contains("-- <COMMAND>..."), "{stderr}");
}

#[test]
fn input_and_output_are_those_of_the_command() {
    let arguments = [UNIT, "--link", "udp", "--", "sh", "-c", "cat; echo error >&2"];
    let piped = || std::process::Stdio::piped();
    let mut child = exec(&arguments).stdin(piped()).stdout(piped()).stderr(piped()).spawn().unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), b"bytes").unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!((&output.stdout[..], &output.stderr[..]), (&b"bytes"[..], &b"error\n"[..]));
}

#[test]
fn the_environment_has_the_address_and_no_interface() {
    let print = "echo $ECTWIN_UDP ${ECTWIN_INTERFACE-none}";
    let mut command = exec(&[UNIT, "--link", "udp", "--", "sh", "-c", print]);
    let output = command.env("ECTWIN_INTERFACE", "eth7").output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    let (address, interface) = printed.trim().split_once(' ').unwrap();
    assert_eq!(interface, "none");
    let address: std::net::SocketAddr = address.parse().unwrap();
    assert!(address.ip().is_loopback() && address.port() != 0, "{address}");
}

#[test]
fn the_user_and_its_files_are_the_same_inside() {
    if !has_namespaces("the_user_and_its_files_are_the_same_inside") {
        return;
    }
    let folder = folder_of("user");
    let file = folder.join("made").display().to_string();
    let script =
        format!("echo x > '{file}'; id -u; stat -c %u '{file}'; cat /proc/sys/kernel/random/boot_id");
    let (code, stdout, stderr) = ended(&[UNIT, "--", "sh", "-c", &script]);
    let outside = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!((code, stdout.as_bytes()), (Some(0), &outside.stdout[..]), "{stderr}");
}
