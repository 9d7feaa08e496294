//! What clients of the control channel cost a master: its round trips with and without them, in turns, in the same run.
//!
//! `cargo bench -p ectwin --features control --bench control`. The master sends a frame each millisecond over a link in
//! memory. Records are published all the time. Each row compares the round trips of all turns of a kind with those without
//! clients.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, Scope};
use std::time::{Duration, Instant};

use ectwin::control::{Publisher, Socket, serve};
use ectwin::happenings::KINDS;
use ectwin::link::memory::{MemoryPort, pair};
use ectwin::link::{FRAME_BUFFER_BYTES, FramePort};
use ectwin::{Setup, Twin};
use wire::{Command, FrameBuilder};

/// Turns of each kind, and round trips of a turn.
const TURNS: usize = 25;
const ROUND_TRIPS: usize = 400;
const CYCLE: Duration = Duration::from_millis(1);
/// Records that are published every 20 ms.
const RECORDS: usize = 50;
const SUBSCRIBERS: usize = 200;
/// The target of docs/performance.md.
const COST_MAX_PERCENT: f64 = 10.0;

/// Who is connected in a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Clients {
    Nobody,
    /// One that asks without pause: states, variables, orders, conditions.
    Flood,
    /// One that has subscribed everything, asks without pause and never reads.
    Deaf,
    Subscribers,
}

const KINDS_OF_TURNS: [(Clients, &str); 4] = [
    (Clients::Nobody, "nobody"),
    (Clients::Flood, "a flood of requests"),
    (Clients::Deaf, "a client that never reads"),
    (Clients::Subscribers, "200 subscribers"),
];

fn main() {
    let folder = std::env::temp_dir().join(format!("ectwin-bench-{}", std::process::id()));
    must(fs::create_dir(&folder));
    let (mut master, units) = pair();
    let twin = Twin::power_on([must(Setup::from_toml("model = \"nx-ect101\"\nname = \"N1\""))]);
    let live = must(twin.serve(units));
    let socket = must(Socket::bind(&folder.join("twin.sock")));
    let kinds = KINDS.iter().map(|kind| kind.name);
    let (server, publisher) = must(serve(socket, live.handle().steered("memory"), kinds));

    let mut times = KINDS_OF_TURNS.map(|_| Vec::with_capacity(TURNS * ROUND_TRIPS));
    let ends = AtomicBool::new(false);
    thread::scope(|scope| {
        scope.spawn(|| publish(&publisher, &ends));
        for _ in 0..TURNS {
            for ((clients, _), times) in KINDS_OF_TURNS.iter().zip(&mut times) {
                turn(*clients, server.path(), &mut master, times);
            }
        }
        ends.store(true, Ordering::Relaxed);
    });
    drop(server);
    must(fs::remove_dir_all(&folder));
    report(times);
}

fn must<T, E: std::fmt::Display>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|error| panic!("{error}"))
}

fn publish(publisher: &Publisher, ends: &AtomicBool) {
    while !ends.load(Ordering::Relaxed) {
        let record = || {
            (
                "state",
                r#"{"at_ns":123456789,"unit":1,"name":"N1","kind":"state","from":"PRE-OP","to":"SAFE-OP"}"#
                    .to_owned(),
            )
        };
        publisher.publish((0..RECORDS).map(|_| record()));
        thread::park_timeout(Duration::from_millis(20));
    }
}

/// The round trips of a turn, with these clients.
fn turn(clients: Clients, path: &Path, master: &mut MemoryPort, times: &mut Vec<u64>) {
    let ends = AtomicBool::new(false);
    thread::scope(|scope| {
        match clients {
            Clients::Nobody => {}
            Clients::Flood => flood(scope, path, &ends),
            Clients::Deaf => deaf(scope, path, &ends),
            Clients::Subscribers => subscribers(scope, path, &ends),
        }
        exchange(master, times);
        ends.store(true, Ordering::Relaxed);
    });
}

fn exchange(master: &mut MemoryPort, times: &mut Vec<u64>) {
    let frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish();
    let mut buffer = [0; FRAME_BUFFER_BYTES];
    let mut next = Instant::now();
    for _ in 0..ROUND_TRIPS {
        next += CYCLE;
        thread::park_timeout(next.saturating_duration_since(Instant::now()));
        let sent = Instant::now();
        must(master.send(&frame));
        while must(master.receive(&mut buffer, time::Duration::from_millis(100))).is_none() {}
        times.push(u64::try_from(sent.elapsed().as_nanos()).unwrap_or(u64::MAX));
    }
}

fn connected(path: &Path) -> UnixStream {
    must(UnixStream::connect(path))
}

const REQUESTS: &str = "{\"status\":true}\n{\"read\":[\"N1_UINTs_01_M_to_C\"]}\n{\"do\":\"write N1_UINTs_01_C_to_M[0] as 5\"}\n\
     {\"expect\":\"unit 1 is in OP\"}\n{\"nonsense\":1}\n";

fn flood<'s>(scope: &'s Scope<'s, '_>, path: &Path, ends: &'s AtomicBool) {
    let mut stream = connected(path);
    scope.spawn(move || {
        let mut answers = BufReader::new(must(stream.try_clone()));
        let mut line = String::new();
        while !ends.load(Ordering::Relaxed) {
            must(stream.write_all(REQUESTS.as_bytes()));
            for _ in REQUESTS.lines() {
                line.clear();
                must(answers.read_line(&mut line));
            }
        }
    });
}

fn deaf<'s>(scope: &'s Scope<'s, '_>, path: &Path, ends: &'s AtomicBool) {
    let mut stream = connected(path);
    must(stream.write_all(b"{\"subscribe\":[\"all\"]}\n"));
    must(stream.set_write_timeout(Some(Duration::from_millis(10))));
    scope.spawn(move || {
        while !ends.load(Ordering::Relaxed) {
            // It is refused when nothing more has room.
            let _full = stream.write(REQUESTS.as_bytes());
        }
    });
}

fn subscribers<'s>(scope: &'s Scope<'s, '_>, path: &Path, ends: &'s AtomicBool) {
    let mut streams: Vec<UnixStream> = (0..SUBSCRIBERS).map(|_| connected(path)).collect();
    for stream in &mut streams {
        must(stream.write_all(b"{\"subscribe\":[\"state\"]}\n"));
        must(stream.set_nonblocking(true));
    }
    scope.spawn(move || {
        let mut piece = [0; 65_536];
        while !ends.load(Ordering::Relaxed) {
            for stream in &mut streams {
                while stream.read(&mut piece).is_ok_and(|length_bytes| length_bytes > 0) {}
            }
            thread::park_timeout(Duration::from_millis(20));
        }
    });
}

fn report(times: [Vec<u64>; 4]) {
    let [nobody, ..] = &times;
    let nobody = at_p50_and_p99(nobody.clone());
    println!("{:<28} {:>10} {:>8} {:>10} {:>8}", "round trip in µs", "p50", "", "p99", "");
    for ((_, name), times) in KINDS_OF_TURNS.iter().zip(times) {
        let those = at_p50_and_p99(times);
        let costs: Vec<f64> =
            those.iter().zip(nobody).map(|(those, nobody)| (those / nobody - 1.0) * 100.0).collect();
        let missed = costs.iter().any(|cost| *cost > COST_MAX_PERCENT);
        let [p50, p99] = those.map(|ns| ns / 1_000.0);
        let [of_p50, of_p99] = [costs.first(), costs.get(1)].map(|cost| cost.copied().unwrap_or_default());
        let verdict = if missed { " missed: 10 %" } else { "" };
        println!("{name:<28} {p50:>10.1} {of_p50:>6.1} % {p99:>10.1} {of_p99:>6.1} %{verdict}");
    }
}

fn at_p50_and_p99(mut times: Vec<u64>) -> [f64; 2] {
    times.sort_unstable();
    [50, 99].map(|percent| times.get(times.len() * percent / 100).copied().unwrap_or_default() as f64)
}
