//! `--on-failure`: the capture and the command line of a run that fails, and nothing of one that does not.

use std::fs;
use std::path::Path;

use crate::{UNIT, ended, folder_of};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_failure_keeps_its_capture_and_its_command_line() {
    let folder = folder_of("failure");
    let kept = folder.display().to_string();
    for _ in 0..2 {
        let arguments = [UNIT, "--link", "udp", "--on-failure", &kept, "--", "sh", "-c", "exit 3"];
        let (code, _, stderr) = ended(&arguments);
        assert_eq!(code, Some(3), "{stderr}");
        assert!(stderr.contains("exit code 3: capture and events are kept in "), "{stderr}");
    }
    assert_eq!(names(&folder), ["sh-1", "sh-2"]);
    assert_eq!(names(&folder.join("sh-1")), ["capture.pcapng", "command.txt", "events.jsonl"]);
    let report = fs::read_to_string(folder.join("sh-1/command.txt")).unwrap();
    assert_eq!(report, format!("exit code 3\nectwin exec {UNIT} --link udp -- sh -c 'exit 3'\n"));
    let events = fs::read_to_string(folder.join("sh-1/events.jsonl")).unwrap();
    assert!(events.starts_with("{\"at_ns\":0,"), "{events}");
    // The block at the beginning of a pcapng file.
    assert!(fs::read(folder.join("sh-1/capture.pcapng")).unwrap().starts_with(&[0x0A, 0x0D, 0x0D, 0x0A]));
}

#[test]
fn a_success_keeps_nothing() {
    let folder = folder_of("success");
    let kept = folder.display().to_string();
    let (code, _, stderr) = ended(&[UNIT, "--link", "udp", "--on-failure", &kept, "--", "true"]);
    assert_eq!((code, stderr.as_str()), (Some(0), ""));
    assert_eq!(names(&folder), [""; 0]);
}

#[test]
fn units_that_do_not_start_keep_no_capture() {
    let folder = folder_of("no-start");
    let kept = folder.display().to_string();
    let (code, _, stderr) = ended(&["nope.toml", "--link", "udp", "--on-failure", &kept, "--", "true"]);
    assert_eq!(code, Some(125), "{stderr}");
    assert_eq!(names(&folder.join("true-1")), ["command.txt"]);
}

#[test]
fn stdout_is_that_of_the_command() {
    for option in ["--pcap", "--events"] {
        let (code, stdout, stderr) = ended(&[UNIT, "--link", "udp", option, "-", "--", "echo", "it runs"]);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{stderr}");
        let message = format!("error: {option} - means stdout, and that of the command is there");
        assert!(stderr.starts_with(&message), "{stderr}");
    }
}

/// A folder in which no file can be written, as on a full disk: the limit of the size of files is 0.
#[test]
fn a_full_disk_does_not_change_the_exit_code() {
    for (command, code) in [("exit 0", 0), ("exit 3", 3)] {
        let folder = folder_of(&format!("full-{code}"));
        let limited = "ulimit -f 0; exec \"$0\" \"$@\"";
        let output = std::process::Command::new("sh")
            .args(["-c", limited, env!("CARGO_BIN_EXE_ectwin"), "exec", UNIT, "--link", "udp"])
            .arg("--on-failure")
            .arg(&folder)
            .args(["--", "sh", "-c", command])
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{stderr}");
        let says_so = stderr.contains("not everything could be kept in ");
        assert_eq!(says_so, code != 0, "{stderr}");
        if code == 0 {
            assert_eq!(names(&folder), [""; 0]);
        }
    }
}
