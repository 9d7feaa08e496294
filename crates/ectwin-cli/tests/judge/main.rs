//! `run --scenario`: a scenario against a real master, its verdict, and its output files.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
#[path = "../started/mod.rs"]
mod started;
mod udp_master;

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};
use std::thread;

use ectwin::master::{Counter, Habits, MailboxConduct};
use ectwin::wire::{Command as DatagramCommand, datagrams};
use serde_json::Value;
use started::{Started, command, folder_of, free_link};
use udp_master::UdpMaster;

const UNIT: &str = "model = \"nx-ect101\"\nname = \"press\"\ntiming = \"fast\"\n";

/// A folder with a unit file and a scenario.
fn folder_with(test: &str, scenario: &str) -> PathBuf {
    let folder = folder_of(test);
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    fs::write(folder.join("judge.toml"), scenario).unwrap();
    folder
}

/// Plays a scenario to its end, against this master.
fn play(folder: &Path, more: &[&str], master: impl FnOnce(UdpMaster) + Send + 'static) -> Output {
    play_file(folder, "judge.toml", more, Habits::default(), master)
}

/// Plays a scenario to its end, against a master with these habits.
fn play_file(
    folder: &Path,
    scenario: &str,
    more: &[&str],
    habits: Habits,
    master: impl FnOnce(UdpMaster) + Send + 'static,
) -> Output {
    let link = free_link();
    let arguments: Vec<&str> =
        ["run", "--link", &link, "--scenario", scenario].into_iter().chain(more.iter().copied()).collect();
    let mut run =
        command(folder, "", &arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut stdout = BufReader::new(run.stdout.take().unwrap());
    let mut ready = String::new();
    stdout.read_line(&mut ready).unwrap();
    let master =
        ready.starts_with("ready ").then(|| thread::spawn(move || master(UdpMaster::new(&link, habits))));
    let errors = thread::spawn(move || run.wait_with_output().unwrap());
    let mut printed = ready.into_bytes();
    stdout.read_to_end(&mut printed).unwrap();
    let output = errors.join().unwrap();
    master.into_iter().for_each(|master| master.join().unwrap());
    Output { stdout: printed, ..output }
}

fn right_master(mut master: UdpMaster) {
    if let Some(taken) = master.take_to_op() {
        taken.unwrap();
        master.run_to_the_end();
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const FAULT_IN_OP: &str = r#"title = "a fault in OP"
limit = "60s"
steps = [
    { expect = "unit 1 is in OP", within = "20s" },
    { unit = "break Processing of unit 1" },
    { expect = "unit 1 is in SAFE-OP with AL status code 0x8000", within = "5s" },
]
"#;

#[test]
fn a_master_that_does_what_is_expected_gets_ok_and_exit_code_0() {
    let folder = folder_with(
        "right",
        &FAULT_IN_OP
            .replace("unit 1 is in SAFE-OP with AL status code 0x8000", "unit 1 has the error 40200000"),
    );
    let output =
        play(&folder, &["unit.toml", "--json", "verdict.json", "--junit", "verdict.xml"], right_master);
    let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{stdout}{stderr}");
    assert!(stdout.contains("ok      judge.toml: a fault in OP ("), "{stdout}");
    assert!(stderr.contains("step      break Processing of unit 1"), "the progress is on stderr: {stderr}");
    let verdict: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("verdict.json")).unwrap()).unwrap();
    assert_eq!((&verdict["verdict"], &verdict["file"]), (&"passed".into(), &"judge.toml".into()));
    let junit = fs::read_to_string(folder.join("verdict.xml")).unwrap();
    assert!(junit.contains("<testsuites name=\"ectwin run\" tests=\"1\""), "{junit}");
    assert!(junit.contains("failures=\"0\""), "{junit}");
}

#[test]
fn an_expectation_that_is_not_fulfilled_is_named_and_the_exit_code_is_1() {
    let folder = folder_with(
        "failed",
        &FAULT_IN_OP.replace("within = \"5s\"", "within = \"200ms\"").replace("0x8000", "0x0001"),
    );
    let output =
        play(&folder, &["unit.toml", "--json", "verdict.json", "--junit", "verdict.xml"], right_master);
    let (stdout, stderr) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(1), "{stdout}{stderr}");
    for words in [
        "FAILED  judge.toml: a fault in OP (",
        "judge.toml:6: `unit 1 is in SAFE-OP with AL status code 0x0001`",
        "repeat  ectwin run unit.toml --link udp:127.0.0.1:",
        " --scenario judge.toml\n",
    ] {
        assert!(stdout.contains(words), "`{words}` is not in {stdout}");
    }
    let verdict: Value =
        serde_json::from_str(&fs::read_to_string(folder.join("verdict.json")).unwrap()).unwrap();
    assert_eq!((&verdict["verdict"], &verdict["failure"]["line"]), (&"failed".into(), &6.into()));
    assert!(verdict["command"].as_str().unwrap().starts_with("ectwin run unit.toml"), "{verdict}");
    assert!(verdict["trace"].as_str().unwrap().contains("break Processing of unit 1"), "{verdict}");
    let junit = fs::read_to_string(folder.join("verdict.xml")).unwrap();
    assert!(junit.contains("<failure message=\"judge.toml:6:"), "{junit}");
}

/// Without a master and without its sentences: one file for both times.
#[test]
fn a_file_without_the_scripted_master_runs_in_both_times() {
    let folder = folder_with(
        "both",
        r#"title = "a fault comes and goes"
units = ["unit.toml"]
steps = [
    { at = "20ms", unit = "break Processing of unit 1" },
    { expect = "unit 1 has the error 40200000", within = "100ms" },
    { never = "unit 1 is in OP" },
    { repeat = 3, every = "5ms", steps = [{ unit = "unplug nothing" }] },
]
"#
        .replace(
            "{ unit = \"unplug nothing\" }",
            "{ line = \"unplug cable 1\" }, { after = \"1ms\", line = \"plug cable 1\" }",
        )
        .as_str(),
    );
    let output = play(&folder, &[], |_| ());
    assert_eq!(output.status.code(), Some(0), "{}{}", text(&output.stdout), text(&output.stderr));
    let replay = command(&folder, "", &["replay", "judge.toml"]).output().unwrap();
    assert_eq!(replay.status.code(), Some(0), "{}{}", text(&replay.stdout), text(&replay.stderr));
}

#[test]
fn sentences_of_the_scripted_master_are_refused_all_at_once_with_place_and_way_out() {
    let folder = folder_with(
        "refused",
        r#"title = "another master"
steps = [
    { master = "take unit 1 to OP" },
    { expect = "the master has nothing to do", within = "5s" },
    { when = "100 cycles are done", unit = "restart unit 1" },
]
"#,
    );
    let output = play(&folder, &["unit.toml"], |_| ());
    let stderr = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    for words in [
        "judge.toml:3:16",
        "`take unit 1 to OP` is an order to the scripted master, and another master is here",
        "judge.toml:4:16",
        "`the master has nothing to do` is about the scripted master, and another master is here",
        "judge.toml:5:14",
        "expect what",
    ] {
        assert!(stderr.contains(words), "`{words}` is not in {stderr}");
    }
}

#[test]
fn the_units_of_the_scenario_are_those_of_the_line() {
    let scenario = "title = \"one unit\"\nunits = [{ model = \"digital\", name = \"K1\" }]\n\
                    steps = [{ expect = \"unit 1 is in INIT\" }]\n";
    let folder = folder_with("units", scenario);
    let own = play(&folder, &[], |_| ());
    assert_eq!(own.status.code(), Some(0), "{}", text(&own.stderr));
    let other = play(&folder, &["unit.toml"], |_| ());
    let stderr = text(&other.stderr);
    assert_eq!(other.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("unit 1 is K1 (digital) here, and press (nx-ect101) on the line"), "{stderr}");
    let two = play(&folder, &["unit.toml", "unit.toml"], |_| ());
    let stderr = text(&two.stderr);
    assert!(stderr.contains("the scenario has 1 unit, and the line has 2 units"), "{stderr}");
}

#[test]
fn a_signal_ends_the_run_without_a_verdict_and_the_files_say_so() {
    let scenario = "title = \"waits\"\nsteps = [{ expect = \"unit 1 is in OP\", within = \"50s\" }]\n";
    let folder = folder_with("signal", scenario);
    let link = free_link();
    let arguments = [
        "run",
        "unit.toml",
        "--link",
        &link,
        "--scenario",
        "judge.toml",
        "--junit",
        "v.xml",
        "--json",
        "v.json",
    ];
    let mut started = Started::new(&folder, "", &arguments).ready();
    started.wait_for("unit 1 is in OP");
    let ended = started.interrupt();
    assert_eq!(ended.code, Some(130), "{}", ended.stderr);
    assert!(
        ended.stderr.contains("SIGINT has ended the run before the scenario judge.toml"),
        "{}",
        ended.stderr
    );
    let junit = fs::read_to_string(folder.join("v.xml")).unwrap();
    assert!(junit.contains("errors=\"1\"") && junit.contains("type=\"interrupted\""), "{junit}");
    assert_eq!(fs::read_to_string(folder.join("v.json")).unwrap(), "");
}

/// The scenario for masters that the project ships.
const SHIPPED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/judge/start-and-recovery.judge");

/// Plays the shipped scenario against a master with these habits, which sends all frames but those that are left out.
fn shipped(
    test: &str,
    habits: Habits,
    leaves_out: fn(&[u8]) -> bool,
    after_op: impl FnOnce(&mut UdpMaster) + Send + 'static,
) -> Output {
    let folder = folder_with(test, "");
    play_file(&folder, SHIPPED, &["unit.toml", "--pcap", "frames.pcapng"], habits, move |mut master| {
        master.leaves_out = leaves_out;
        if master.take_to_op().is_some() {
            after_op(&mut master);
        }
    })
}

const NOTHING: fn(&[u8]) -> bool = |_| false;

fn recovers(master: &mut UdpMaster) {
    let _units_are_gone = master.keep_in_op();
}

#[test]
fn a_right_master_passes_the_shipped_scenario() {
    let output = shipped("shipped_right", Habits::default(), NOTHING, recovers);
    assert_eq!(output.status.code(), Some(0), "{}{}", text(&output.stdout), text(&output.stderr));
}

/// The verdict names the mistake, and has the frames that prove it.
fn is_failed_by(output: &Output, words: &[&str]) {
    let stdout = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{stdout}{}", text(&output.stderr));
    for words in words.iter().chain(&["        frame   ", " in the capture: "]) {
        assert!(stdout.contains(words), "`{words}` is not in {stdout}");
    }
}

#[test]
fn a_master_that_never_acknowledges_is_named() {
    let output = shipped("shipped_silent", Habits::default(), NOTHING, UdpMaster::run_to_the_end);
    let step = "`the master has acknowledged the error of unit 1`";
    is_failed_by(&output, &[step, "seen    the master has not done so", "LRW"]);
}

#[test]
fn a_master_without_outputs_before_op_is_named() {
    let has_outputs = |frame: &[u8]| {
        let mut all = datagrams(frame);
        all.any(|datagram| [DatagramCommand::Lrw, DatagramCommand::Lwr].contains(&datagram.header.command))
    };
    let output = shipped("shipped_outputs", Habits::default(), has_outputs, recovers);
    let step = "`the master has sent outputs to unit 1 before it has requested OP of unit 1`";
    let seen = "`requested OP of unit 1`: the master has done so once, at ";
    is_failed_by(&output, &[step, "`sent outputs to unit 1`: the master has not done so", seen]);
}

#[test]
fn a_master_with_a_wrong_mailbox_counter_is_named() {
    let counter = Counter { last: 0, fixed: Some(3) };
    let mailbox = MailboxConduct { counter, ..MailboxConduct::default() };
    let habits = Habits { mailbox, ..Habits::default() };
    let output = shipped("shipped_counter", habits, NOTHING, recovers);
    is_failed_by(
        &output,
        &[
            "`the master has sent a wrong mailbox counter to unit 1`",
            "it holds, and `never` expects that it does not",
        ],
    );
}
