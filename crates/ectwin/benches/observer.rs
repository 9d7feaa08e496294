//! What an observer costs: the same frames through a line with one and through a line without one, in the same run.
//!
//! `cargo bench -p ectwin --bench observer`. The two lines take turns; each row compares the medians of their turns.

use std::time::Instant as WallInstant;

use ectwin::master::{Connected, Master};
use ectwin::{AlState, Duration, Happenings, Setup, Twin};
use wire::{Command, FrameBuilder};

/// Turns of each line, and cycles of a turn.
const TURNS: usize = 400;
const CYCLES: usize = 250;
/// The target of docs/performance.md.
const COST_MAX_PERCENT: f64 = 2.0;

const NX_ECT101: &str = "model = \"nx-ect101\"\noutputs_before_op = \"not-required\"\n";
const TERMINAL: &str = "model = \"digital\"\noutputs = 8\n";

fn main() {
    let rows: [(&str, &str, usize, usize); 4] = [
        ("1 NX-ECT101, a frame each 1 ms", NX_ECT101, 1, 363),
        ("8 NX-ECT101, a frame each 1 ms", NX_ECT101, 8, 1_400),
        ("20 terminals, a frame each 1 ms", TERMINAL, 20, 20),
        ("100 terminals, a frame each 1 ms", TERMINAL, 100, 100),
    ];
    println!("{:<36} {:>10} {:>10} {:>8}", "ns of a cycle", "without", "with", "cost");
    for (name, unit, units, data_bytes) in rows {
        compare(name, || line(unit, units), data_bytes);
    }
}

fn line(unit: &str, units: usize) -> Twin {
    let setup = || Setup::from_toml(unit).unwrap_or_else(|error| panic!("{unit}: {error}"));
    let twin = Twin::power_on((0..units).map(|_| setup()));
    let mut bench = Connected::new(Master::default(), twin, ectwin::Instant::ZERO);
    let found = bench.search();
    assert_eq!(found, Ok(units));
    assert_eq!(bench.take_all_to(AlState::Op), Ok(()));
    let Connected { line, .. } = bench;
    line
}

fn compare(name: &str, line: impl Fn() -> Twin, data_bytes: usize) {
    let (mut without, mut with) = (line(), line());
    let mut happenings = with.observe();
    let frame = FrameBuilder::new().logical(Command::Lrw, 0, &vec![1; data_bytes]).finish();
    let mut times = [Vec::with_capacity(TURNS), Vec::with_capacity(TURNS)];
    for _ in 0..TURNS {
        times[0].push(turn(&mut without, &frame));
        times[1].push(turn(&mut with, &frame));
        drain(&mut happenings);
    }
    let [without, with] = times.map(|mut times| {
        times.sort_unstable();
        times[TURNS / 2] as f64 / CYCLES as f64
    });
    let percent = (with / without - 1.0) * 100.0;
    let verdict = if percent > COST_MAX_PERCENT { " missed: 2 %" } else { "" };
    println!("{name:<36} {without:>10.0} {with:>10.0} {percent:>7.1} %{verdict}");
}

/// Time of a turn in nanoseconds.
fn turn(twin: &mut Twin, frame: &[u8]) -> u64 {
    let mut buffer = frame.to_vec();
    let began = WallInstant::now();
    for _ in 0..CYCLES {
        buffer.copy_from_slice(frame);
        let _ = twin.frame(&mut buffer);
        twin.run_for(Duration::from_millis(1));
    }
    u64::try_from(began.elapsed().as_nanos()).unwrap_or(u64::MAX)
}

/// Another thread does this on a link.
fn drain(happenings: &mut Happenings) {
    drop(happenings.take());
}
