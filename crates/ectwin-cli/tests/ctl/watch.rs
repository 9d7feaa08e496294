//! `ctl watch`: kinds, variables, JSON lines, and its ends.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStderr, ChildStdout, Stdio};

use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;

use crate::bench::Bench;

/// A watch that has subscribed.
struct Watch {
    child: Child,
    stdout: Option<BufReader<ChildStdout>>,
    stderr: BufReader<ChildStderr>,
    head: String,
}

impl Watch {
    fn start(bench: &Bench, arguments: &[&str]) -> Self {
        let mut command = bench.command(&[&["ctl", "watch"], arguments].concat());
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let stdout = child.stdout.take().map(BufReader::new);
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut head = String::new();
        stderr.read_line(&mut head).unwrap();
        Self { child, stdout, stderr, head }
    }

    fn line(&mut self) -> String {
        let mut line = String::new();
        assert_ne!(self.stdout.as_mut().unwrap().read_line(&mut line).unwrap(), 0, "it has ended");
        line
    }

    fn signal(&self, signal: Signal) {
        kill_process(Pid::from_raw(self.child.id().try_into().unwrap()).unwrap(), signal).unwrap();
    }

    fn end(mut self) -> (Option<i32>, String) {
        let mut rest = String::new();
        self.stderr.read_to_string(&mut rest).unwrap();
        (self.child.wait().unwrap().code(), rest)
    }
}

#[test]
fn what_happens_is_shown_as_in_the_log_until_ctrl_c() {
    let bench = Bench::new("watch");
    let _twin = bench.twin();
    let mut watch = Watch::start(&bench, &[]);
    assert!(watch.head.starts_with("watching ") && watch.head.contains("event"), "{}", watch.head);
    bench.told(&["do", "break Processing of unit 1"]);
    let mut lines = watch.line();
    while !lines.contains(" s unit 1 N1: records 40200000 ") {
        lines.push_str(&watch.line());
    }
    assert!(lines.contains(" s unit 1 N1: fault Processing is injected\n"), "{lines}");
    watch.signal(Signal::INT);
    assert_eq!(watch.end(), (Some(0), String::new()));
}

#[test]
fn kinds_and_variables_are_json_lines_until_the_twin_ends() {
    let bench = Bench::new("watch-json");
    let mut twin = bench.twin();
    let name = "N1_UINTs_01_C_to_M[0]";
    let mut watch = Watch::start(&bench, &["cpu", name, "--json"]);
    // A machine that is busy elsewhere makes the CPU Unit report that too.
    let mut next = |is_awaited: fn(&Value) -> bool| loop {
        let record: Value = serde_json::from_str(&watch.line()).unwrap();
        if is_awaited(&record) {
            break record;
        }
    };
    let first = next(|record| record["kind"] == "variable");
    assert_eq!((&first["variable"], &first["forced"]), (&name.into(), &false.into()), "its present value");
    bench.told(&["force", &format!("{name}=7")]);
    let forced = next(|record| record["kind"] == "variable");
    assert_eq!((&forced["value"], &forced["forced"]), (&7.into(), &true.into()), "{forced}");
    bench.told(&["do", "set unit 1 to PROGRAM mode"]);
    assert_eq!(next(|record| record["report"] == "mode")["mode"], "PROGRAM");
    twin.interrupt();
    assert!(twin.wait().success());
    assert_eq!(watch.end(), (Some(0), "the twin has ended\n".to_owned()));
}

#[test]
fn a_word_that_is_no_kind_and_no_variable_is_refused() {
    let bench = Bench::new("watch-word");
    let _twin = bench.twin();
    let refused = bench.ctl(&["watch", "stat"]);
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""), "{refused:?}");
    assert!(refused.stderr.contains("`state`"), "the nearest kind: {refused:?}");
}

#[test]
fn a_reader_that_is_gone_ends_it() {
    let bench = Bench::new("watch-reader");
    let _twin = bench.twin();
    let mut watch = Watch::start(&bench, &["N1_UINTs_01_C_to_M[0]"]);
    assert!(watch.line().contains("N1_UINTs_01_C_to_M[0] is "));
    watch.stdout = None;
    bench.told(&["force", "N1_UINTs_01_C_to_M[0]=1"]);
    assert_eq!(watch.end().0, Some(0));
}
