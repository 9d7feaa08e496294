//! What is left when a part of a run ends: nothing. A process that is left would keep the pipe of its output open.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStdout, Command, Stdio};

use crate::{UNIT, ended, exec, has_namespaces};

/// A run whose command has printed its first line.
struct Running {
    child: Child,
    stdout: BufReader<ChildStdout>,
    line: String,
}

impl Running {
    fn start(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        stdout.read_line(&mut line).unwrap();
        Self { child, stdout, line }
    }

    fn signal(&self, name: &str) {
        let id = self.child.id().to_string();
        assert!(Command::new("kill").args([name, &id]).status().unwrap().success());
    }

    /// Waits until no process has its outputs any more: the command, the units, and all between them.
    fn all_gone(mut self) -> (Option<i32>, String) {
        let mut rest = String::new();
        self.stdout.read_to_string(&mut rest).unwrap();
        self.child.stderr.take().unwrap().read_to_string(&mut String::new()).unwrap();
        (self.child.wait().unwrap().code(), rest)
    }
}

/// Both cables, where the system has them.
fn cables(test: &str) -> Vec<&'static str> {
    if has_namespaces(test) { vec!["udp", "veth"] } else { vec!["udp"] }
}

#[test]
fn a_killed_run_leaves_no_process() {
    for cable in cables("left::a_killed_run_leaves_no_process") {
        // A process in the background, which no signal of a terminal reaches, and one that ignores SIGTERM.
        let script = "setsid sleep 1000 & trap '' TERM; echo started; while :; do sleep 1000; done";
        let running = Running::start(&mut exec(&[UNIT, "--link", cable, "--", "sh", "-c", script]));
        assert_eq!(running.line, "started\n");
        running.signal("-KILL");
        running.all_gone();
    }
}

#[test]
fn a_killed_parent_leaves_no_process() {
    for cable in cables("left::a_killed_parent_leaves_no_process") {
        let mut parent = Command::new("sh");
        parent.args(["-c", "\"$@\" & wait", "sh", env!("CARGO_BIN_EXE_ectwin"), "exec", UNIT]);
        parent.args(["--link", cable, "--", "sh", "-c", "echo started; sleep 1000"]);
        let running = Running::start(&mut parent);
        assert_eq!(running.line, "started\n");
        running.signal("-KILL");
        running.all_gone();
    }
}

#[test]
fn what_a_command_leaves_in_the_background_ends() {
    for cable in cables("left::what_a_command_leaves_in_the_background_ends") {
        let script = "setsid sleep 1000 & exit 4";
        let (code, ..) = ended(&[UNIT, "--link", cable, "--", "sh", "-c", script]);
        assert_eq!(code, Some(4), "{cable}");
    }
}

#[test]
fn a_signal_is_handed_on_to_the_command() {
    for cable in cables("left::a_signal_is_handed_on_to_the_command") {
        for (signal, code) in [("-TERM", 143), ("-INT", 130), ("-HUP", 129)] {
            let arguments = [UNIT, "--link", cable, "--", "sh", "-c", "echo started; exec sleep 1000"];
            let running = Running::start(&mut exec(&arguments));
            running.signal(signal);
            assert_eq!(running.all_gone(), (Some(code), String::new()), "{cable} {signal}");
        }
    }
}

#[test]
fn a_command_that_handles_a_signal_ends_as_it_wants() {
    let script = "trap 'echo handled; exit 9' USR1; echo started; while :; do sleep 0.01; done";
    let running = Running::start(&mut exec(&[UNIT, "--link", "udp", "--", "sh", "-c", script]));
    running.signal("-USR1");
    assert_eq!(running.all_gone(), (Some(9), "handled\n".to_owned()));
}

#[test]
fn units_that_are_killed_end_the_command() {
    // The units are the other child of the parent of the command.
    let script = "parent=$PPID; for child in $(cat /proc/$parent/task/$parent/children); do \
                  [ \"$child\" = $$ ] || kill -KILL \"$child\"; done; echo started; sleep 1000";
    for cable in cables("left::units_that_are_killed_end_the_command") {
        let running = Running::start(&mut exec(&[UNIT, "--link", cable, "--", "sh", "-c", script]));
        assert_eq!(running.all_gone().0, Some(143), "{cable}");
    }
}

#[test]
fn a_stdin_that_never_closes_is_refused() {
    let mut run = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    run.args(["run", UNIT, "--link", "udp:127.0.0.1:0", "--until-stdin-closes"]);
    let ended = run.stdin(std::fs::File::open("/").unwrap()).output().unwrap();
    let stderr = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(2), "{stderr}");
    assert!(
        stderr.contains("stdin is a folder") && stderr.contains("help: start the command with a pipe"),
        "{stderr}"
    );
}

#[test]
fn a_run_ends_when_its_stdin_closes() {
    let mut run = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    run.args(["run", UNIT, "--link", "udp:127.0.0.1:0", "--until-stdin-closes"]).stdin(Stdio::piped());
    let mut running = Running::start(&mut run);
    assert!(running.line.starts_with("ready link=udp:127.0.0.1:"), "{}", running.line);
    drop(running.child.stdin.take());
    assert_eq!(running.all_gone(), (Some(0), String::new()));
}
