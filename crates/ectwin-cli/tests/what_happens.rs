//! What happens to a running twin: in the log, as JSON lines, and in the event log that a unit has stored.
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::net::UdpSocket;
use std::path::Path;
use std::process::{Command, Stdio};

use ectwin::{Duration, EventLog, Fault, Setup, Twin};
use serde_json::Value;
use started::{Started, ended, folder_of, free_link};
use wire::{Command as DatagramCommand, FrameBuilder};

const UNIT: &str = "model = \"nx-ect101\"\nname = \"press\"\ntiming = \"fast\"\n\
                    [io_allocation]\nm_to_c.uints = 4\nc_to_m.uints = 6\n";
const AL_CONTROL: u16 = 0x0120;
const AL_STATUS: u16 = 0x0130;

/// A folder with a unit file.
fn folder_with_unit(test: &str) -> std::path::PathBuf {
    let folder = folder_of(test);
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    folder
}

/// Sends a datagram to the units at a link, and waits for its answer.
fn exchange(link: &str, frame: &FrameBuilder) {
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    let ethernet_header_bytes = 14;
    let frame = frame.clone().finish();
    socket.send_to(&frame[ethernet_header_bytes..], link.strip_prefix("udp:").unwrap()).unwrap();
    let mut answer = [0; 1_500];
    socket.recv(&mut answer).unwrap();
}

fn physical(command: DatagramCommand, offset: u16, data: &[u8]) -> FrameBuilder {
    FrameBuilder::new().physical(command, 0, offset, data)
}

fn records(text: &str) -> Vec<Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{line}: {error}")))
        .collect()
}

fn kinds(records: &[Value]) -> Vec<&str> {
    records.iter().filter_map(|record| record["kind"].as_str()).collect()
}

#[test]
fn a_run_tells_what_happens_in_its_log_and_in_json_lines() {
    let folder = folder_with_unit("log_and_lines");
    let link = free_link();
    let arguments = ["-vvv", "run", "unit.toml", "--link", &link, "--events", "events.jsonl"];
    let mut running = Started::new(&folder, "", &arguments).ready();
    running.wait_for("unit 1 press: model nx-ect101");
    running.wait_for("unit 1 press: 39170000 Data Size Mismatched");
    exchange(&link, &physical(DatagramCommand::Brd, AL_STATUS, &[0; 2]));
    running.wait_for("a master sends frames");
    running.wait_for("BRD 0x0001 0x0130, 2 bytes, WKC 1");
    // OP cannot be reached from INIT.
    exchange(&link, &physical(DatagramCommand::Apwr, AL_CONTROL, &[8, 0]));
    running.wait_for("unit 1 press: is in INIT with AL status code 0x0011 (invalid requested state change)");
    running.wait_for("the master has sent no frame for 1s");
    let ended = running.interrupt();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);

    let records = records(&fs::read_to_string(folder.join("events.jsonl")).unwrap());
    assert_eq!(kinds(&records)[..3], ["ready", "unit", "finding"], "{records:?}");
    assert_eq!((&records[0]["link"], &records[0]["units"]), (&Value::from(link), &Value::from(1)));
    let state = records.iter().find(|record| record["kind"] == "state").unwrap();
    assert_eq!(
        (&state["unit"], &state["name"], &state["to"], &state["error"], &state["al_status_code"]),
        (&1.into(), &"press".into(), &"INIT".into(), &true.into(), &"0x0011".into())
    );
    let masters: Vec<&Value> =
        records.iter().filter(|record| record["kind"] == "master").map(|record| &record["present"]).collect();
    assert_eq!(masters, [true, false]);
}

#[test]
fn events_go_to_stdout_and_the_ready_line_to_stderr() {
    let folder = folder_with_unit("stdout");
    let mut run = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    run.args(["run", "unit.toml", "--link", "udp:127.0.0.1:0", "--events", "-"]).current_dir(&folder);
    let mut running = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut stdout = BufReader::new(running.stdout.take().unwrap());
    let mut first = String::new();
    stdout.read_line(&mut first).unwrap();
    assert_eq!(kinds(&records(&first)), ["ready"], "{first}");
    assert!(
        Command::new("sh").args(["-c", &format!("kill -TERM {}", running.id())]).status().unwrap().success()
    );
    let ended = running.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(0), "{stderr}");
    assert!(stderr.starts_with("ready link=udp:127.0.0.1:"), "{stderr}");
    let mut rest = String::new();
    stdout.read_to_string(&mut rest).unwrap();
    assert_eq!(kinds(&records(&rest))[..2], ["unit", "finding"], "{rest}");
}

#[test]
fn events_that_go_to_a_closed_stdout_are_not_lost_in_silence() {
    let folder = folder_with_unit("closed");
    let arguments =
        ["run", "unit.toml", "--link", "udp:127.0.0.1:0", "--events", "-", "--until-stdin-closes"];
    for (limits, words) in [("exec >&- </dev/null;", "stdout is closed"), ("exec >/dev/null </dev/null;", "")]
    {
        let ended = ended(&folder, limits, &arguments);
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        assert_eq!(ended.stderr.contains("nobody can read"), !words.is_empty(), "{}", ended.stderr);
        assert!(ended.stderr.contains(words), "{}", ended.stderr);
    }
}

#[test]
fn a_full_disk_is_reported_and_the_twin_goes_on() {
    let folder = folder_with_unit("full");
    let link = free_link();
    let arguments = ["run", "unit.toml", "--link", &link, "--events", "/dev/full"];
    let mut running = Started::new(&folder, "", &arguments).ready();
    running.wait_for("the events cannot be written to /dev/full: No space left on device");
    exchange(&link, &physical(DatagramCommand::Brd, AL_STATUS, &[0; 2]));
    let ended = running.interrupt();
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("error: cannot write /dev/full"), "{}", ended.stderr);
}

#[test]
fn the_file_of_events_is_no_file_that_the_command_uses() {
    let folder = folder_with_unit("overwrite");
    let refused =
        ended(&folder, "", &["run", "unit.toml", "--link", "udp:127.0.0.1:0", "--events", "unit.toml"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("--events unit.toml would overwrite unit.toml"), "{}", refused.stderr);
    assert_eq!(fs::read_to_string(folder.join("unit.toml")).unwrap(), UNIT);
}

/// Stores the memory of a unit with an error and a cleared log.
fn store_memory(folder: &Path) {
    let setup = Setup::from_toml("model = \"nx-ect101\"\nserial = 7\nstorage = \"N1.nvm\"\n").unwrap();
    let setup = setup.system_time_ns(1_767_225_600_000_000_000).with_storage(folder).unwrap();
    let mut twin = Twin::power_on([setup]);
    twin.run_for(Duration::from_secs(20));
    twin.unit(0).inject(Fault::MessageCommunications);
    twin.unit(0).clear_event_log(EventLog::Access);
    twin.run_for(Duration::from_millis(10));
}

fn log(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_ectwin")).arg("log").args(arguments).current_dir(folder).output();
    let output = output.unwrap();
    let [stdout, stderr] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), stdout, stderr)
}

#[test]
fn a_stored_event_log_is_printed_with_causes_and_corrections() {
    let folder = folder_of("stored_log");
    store_memory(&folder);
    let (code, text, _) = log(&folder, &["N1.nvm"]);
    assert_eq!(code, Some(0));
    assert!(text.starts_with("N1.nvm: nx-ect101, serial number 7: 3 records\n"), "{text}");
    let head = "2026-01-01T00:00:20.000Z  system event log  80220000 NX Message Communications Error (observation)\n";
    assert!(text.contains(head), "{text}");
    assert!(text.contains("\n  attached    2: 0x0 ") && text.contains("\n  cause       "), "{text}");
    assert!(text.contains("\n  correction  ") && text.contains("access event log  90400000"), "{text}");

    let (code, json, _) = log(&folder, &["N1.nvm", "--json"]);
    let document: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((code, &document["serial"]), (Some(0), &7.into()));
    let record = &document["records"][0];
    assert_eq!((&record["event"], &record["log"]), (&"80220000".into(), &"system".into()));
    assert_eq!((&record["level"], &record["attached"]), (&"observation".into(), &Value::from(vec![0, 0])));
    assert!(record["causes"][0]["correction"].as_str().is_some_and(|words| !words.is_empty()), "{json}");
}

#[test]
fn a_file_without_an_event_log_is_refused_with_a_way_out() {
    let folder = folder_of("no_log");
    store_memory(&folder);
    let mut damaged = fs::read(folder.join("N1.nvm")).unwrap();
    damaged[100] ^= 1;
    fs::write(folder.join("damaged.nvm"), damaged).unwrap();
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    for (file, words) in [
        ("no-such.nvm", "there is no such file"),
        ("unit.toml", "it is not the memory of a unit"),
        ("damaged.nvm", "the memory is damaged: wrong checksum"),
    ] {
        let (code, text, error) = log(&folder, &[file]);
        assert_eq!((code, text.as_str()), (Some(2), ""));
        assert!(error.contains(&format!("error: cannot read {file}: {words}")), "{error}");
        assert!(error.contains("help: "), "{error}");
    }
}
