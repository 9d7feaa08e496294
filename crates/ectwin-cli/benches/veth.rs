//! Round trips over a veth pair: `ectwin run` compared with a process that only echoes, in the same run.
//!
//! `cargo bench -p ectwin-cli --bench veth` creates its own network namespace. Each line is one placement of
//! the two processes; the echo blocks in its receive call, and is the lower limit for any emulation.

use std::io::{Read, Write};
use std::os::fd::IntoRawFd;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use pnet_datalink::Config;
use socket2::{Domain, Socket, Type};
use testbed::{Process, add_veth_pair, in_network_namespace, skip};

const ROUND_TRIPS: usize = 20_000;
const WARM_UP: usize = 1_000;
/// An LRW of 1,200 bytes, the size for the largest unit.
const DATA_BYTES: usize = 1_200;
const NAME: &str = "veth";

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    match arguments.get(1..).unwrap_or_default() {
        [role, interface] if role == "echo" => echo(interface),
        _ => in_network_namespace(NAME, compare),
    }
}

fn compare() {
    // The namespace helper of the tests waits for this line.
    println!("running 1 test");
    add_veth_pair("veth0", "veth1");
    for (placement, cores) in [("same core", ["0", "0"]), ("two cores", ["0", "1"])] {
        let floor = measure(cores, &echo_command());
        let ectwin = measure(cores, &ectwin_command());
        report(placement, &floor, &ectwin);
    }
}

fn echo_command() -> Vec<String> {
    let this = std::env::current_exe().unwrap_or_default();
    vec![this.display().to_string(), "echo".into(), "veth1".into()]
}

fn ectwin_command() -> Vec<String> {
    let unit = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/nx-ect101.toml");
    let words = [env!("CARGO_BIN_EXE_ectwin"), "run", &unit.display().to_string(), "--link", "raw:veth1"];
    words.map(str::to_owned).to_vec()
}

/// Sorted round-trip times in nanoseconds against `answerer`, the master on the first core.
fn measure([master, answerer]: [&str; 2], command: &[String]) -> Vec<u64> {
    let this = std::process::id().to_string();
    let pinned = Command::new("taskset").args(["-cp", master, &this]).output();
    if !pinned.is_ok_and(|output| output.status.success()) {
        skip(NAME, "processes cannot be pinned to a core by taskset");
    }
    let mut process = Process::start(Command::new("taskset").args(["-c", answerer]).args(command));
    process.wait_for_line("ready");
    let mut socket = open("veth0");
    let (frame, mut answer) = (lrw(), [0; 2048]);
    let mut times = Vec::with_capacity(ROUND_TRIPS);
    for _ in 0..WARM_UP + ROUND_TRIPS {
        let sent = Instant::now();
        let _ = socket.write(&frame);
        // The kernel also sends IPv6 frames of its own here.
        while socket.read(&mut answer).is_ok_and(|length| length != frame.len()) {}
        times.push(u64::try_from(sent.elapsed().as_nanos()).unwrap_or(u64::MAX));
    }
    times.drain(..WARM_UP);
    times.sort_unstable();
    times
}

fn report(placement: &str, floor: &[u64], ectwin: &[u64]) {
    let at =
        |times: &[u64], percent: usize| times.get(times.len() * percent / 100).copied().unwrap_or(0) as f64;
    for percent in [50, 99] {
        let (floor, ectwin) = (at(floor, percent), at(ectwin, percent));
        eprintln!(
            "{placement}  p{percent}  echo {:6.2} µs  ectwin {:6.2} µs  {:.2} ×",
            floor / 1e3,
            ectwin / 1e3,
            ectwin / floor
        );
    }
}

fn lrw() -> Vec<u8> {
    let mut frame = vec![0xFF; 6];
    frame.extend([0x10; 6]);
    frame.extend([0x88, 0xA4]);
    frame.extend((0x1000 | (DATA_BYTES as u16 + 12)).to_le_bytes());
    frame.extend([12, 0, 0, 0, 0, 0]);
    frame.extend((DATA_BYTES as u16).to_le_bytes());
    frame.resize(16 + 10 + DATA_BYTES + 2, 0);
    frame
}

/// Answers every frame with the same frame, marked like by an ESC, and blocks in between.
fn echo(interface: &str) {
    let mut socket = open(interface);
    println!("ready");
    let mut frame = [0; 2048];
    while let Ok(length) = socket.read(&mut frame) {
        if frame[12..14] == [0x88, 0xA4] {
            frame[6] |= 0x02;
            let _ = socket.write(&frame[..length]);
        }
    }
}

/// A raw socket that blocks, bound by pnet.
fn open(name: &str) -> Socket {
    let interface = pnet_datalink::interfaces().into_iter().find(|interface| interface.name == name);
    let Some(interface) = interface else { panic!("there is no interface {name}") };
    let bound = || {
        let socket = Socket::new(Domain::PACKET, Type::RAW, None)?;
        let frames = socket.try_clone()?;
        let config = Config { socket_fd: Some(socket.into_raw_fd()), ..Config::default() };
        drop(pnet_datalink::channel(&interface, config)?);
        frames.set_nonblocking(false)?;
        Ok::<_, std::io::Error>(frames)
    };
    bound().unwrap_or_else(|error| panic!("{name}: {error}"))
}
