//! Signals: what each does to a running command, and to one that is not ready yet.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs::{self, OpenOptions};
use std::os::unix::fs::OpenOptionsExt;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use rustix::fs::{CWD, FileType, Mode, OFlags, mknodat};
use started::{Started, folder_of, free_link};

const SIGUSR1: u32 = 10;
const SIGHUP: u32 = 1;
const PATIENCE: Duration = Duration::from_secs(20);

fn signal(name: &str, started: &Started) {
    assert!(Command::new("kill").args([name, &started.id()]).status().unwrap().success());
}

/// Whether the process has a handler for this signal.
fn handles(started: &Started, signal: u32) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", started.id())).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap();
    u64::from_str_radix(caught.trim(), 16).unwrap() >> (signal - 1) & 1 == 1
}

#[test]
fn a_closed_terminal_ends_a_run_in_order() {
    let folder = folder_of("terminal");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n").unwrap();
    let link = free_link();
    let arguments = ["run", "unit.toml", "--link", &link, "--pcap", "frames.pcapng"];
    let started = Started::new(&folder, "", &arguments).ready();
    signal("-HUP", &started);
    let ended = started.wait();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let left = |name: &str| folder.join(name).exists();
    assert!(left("N1.nvm") && left("frames.pcapng"));
    assert!(!left(".N1.nvm.ectwin-lock"), "the lock is removed by an owner that ends in order");
}

#[test]
fn nohup_keeps_a_run_when_the_terminal_is_closed() {
    let folder = folder_of("nohup");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\n").unwrap();
    let link = free_link();
    let started = Started::new(&folder, "trap '' HUP;", &["run", "unit.toml", "--link", &link]).ready();
    assert!(!handles(&started, SIGHUP));
    signal("-HUP", &started);
    assert_eq!(started.interrupt().code, Some(0));
}

#[test]
fn sigusr1_does_not_end_a_command_that_is_not_ready_yet() {
    let folder = folder_of("early");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\n").unwrap();
    let pipe = folder.join("pipe");
    mknodat(CWD, &pipe, FileType::Fifo, Mode::RUSR | Mode::WUSR, 0).unwrap();
    let link = free_link();
    // It waits for the reader of its capture.
    let started = Started::new(&folder, "", &["run", "unit.toml", "--link", &link, "--pcap", "pipe"]);
    let begin = Instant::now();
    while !handles(&started, SIGUSR1) {
        assert!(begin.elapsed() < PATIENCE, "there is no handler before the command is ready");
        thread::yield_now();
    }
    signal("-USR1", &started);
    let nonblock = OFlags::NONBLOCK.bits() as i32;
    let _reader = OpenOptions::new().read(true).custom_flags(nonblock).open(&pipe).unwrap();
    assert_eq!(started.ready().interrupt().code, Some(0));
}

#[test]
fn a_log_that_nobody_can_read_any_more_ends_nothing() {
    let folder = folder_of("log");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n").unwrap();
    let link = free_link();
    // Like a terminal that is closed, this device refuses each line.
    let limits = "exec 2>/dev/full;";
    let started = Started::new(&folder, limits, &["-vvv", "run", "unit.toml", "--link", &link]).ready();
    signal("-HUP", &started);
    assert_eq!(started.wait().code, Some(0));
}
