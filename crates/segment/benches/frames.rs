//! What a frame costs in process: `cargo bench -p ectwin-segment`. Targets and figures: docs/performance.md.
//!
//! `… --bench frames -- once "BRD 2 bytes/100" 300` sends the frames of one row 300 times, to count instructions: the
//! difference between two numbers is free of the preparation.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use esc::{Esc, EscConfig, SmIndex};
use segment::Segment;
use time::Instant;
use wire::{Command, FrameBuilder};

const OUTPUTS: u8 = 0x64;
const INPUTS: u8 = 0x20;
/// Units of the lines that show how a cost increases with them.
const LINES: [usize; 4] = [1, 100, 1_000, 10_000];

/// A line of ESCs, each with this number of bytes of outputs and inputs, mapped one after the other; outputs
/// and inputs share their logical bytes, as SOEM and ethercrab map them for LRW.
fn line(units: usize, outputs_bytes: u16, inputs_bytes: u16) -> Segment {
    let escs = (0..units).map(|_| Esc::power_on(EscConfig::default(), Vec::new(), Instant::ZERO));
    let mut segment = Segment::new(escs.collect());
    for unit in 0..units {
        let logical = unit as u32 * u32::from(outputs_bytes.max(inputs_bytes));
        let position = (unit as u16).wrapping_neg();
        let mut write = |offset: u16, data: &[u8]| {
            let mut frame = FrameBuilder::new().physical(Command::Apwr, position, offset, data).finish();
            segment.frame(Instant::ZERO, &mut frame);
        };
        write(0x0810, &sync_manager(0x13A0, outputs_bytes, OUTPUTS));
        write(0x0818, &sync_manager(0x21B0, inputs_bytes, INPUTS));
        write(0x0600, &fmmu(logical, outputs_bytes, 0x13A0, 2));
        write(0x0610, &fmmu(logical, inputs_bytes, 0x21B0, 1));
    }
    segment
}

fn sync_manager(start: u16, length_bytes: u16, control: u8) -> [u8; 8] {
    let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
    [s0, s1, l0, l1, control, 0, 1, 0]
}

fn fmmu(logical: u32, length_bytes: u16, physical: u16, kind: u8) -> [u8; 16] {
    let mut bytes = [0; 16];
    bytes[..4].copy_from_slice(&logical.to_le_bytes());
    bytes[4..6].copy_from_slice(&length_bytes.to_le_bytes());
    bytes[7] = 7;
    bytes[8..10].copy_from_slice(&physical.to_le_bytes());
    bytes[11] = kind;
    bytes[12] = 1;
    bytes
}

/// What measures the rows.
trait Meter {
    /// Measures a round of the row with this name. `prepare` makes the round, and is not measured.
    fn row<O, R: FnMut() -> O>(&mut self, name: &str, throughput: Throughput, prepare: impl Fn() -> R);
}

/// In time.
impl Meter for Criterion {
    fn row<O, R: FnMut() -> O>(&mut self, name: &str, throughput: Throughput, prepare: impl Fn() -> R) {
        let Some((group, name)) = name.split_once('/') else {
            self.bench_function(name, |bencher| bencher.iter(prepare()));
            return;
        };
        let mut group = self.benchmark_group(group);
        group.throughput(throughput);
        group.bench_function(name, |bencher| bencher.iter(prepare()));
        group.finish();
    }
}

/// By another program, which counts the instructions of some rounds of one row.
struct Once<'a> {
    name: &'a str,
    rounds: u32,
    is_found: bool,
}

impl Meter for Once<'_> {
    fn row<O, R: FnMut() -> O>(&mut self, name: &str, _: Throughput, prepare: impl Fn() -> R) {
        if name == self.name {
            self.is_found = true;
            let mut round = prepare();
            (0..self.rounds).for_each(|_| drop(black_box(round())));
        }
    }
}

/// Outputs and inputs of a full unit in two frames; the application takes and provides complete images.
fn full_unit(meter: &mut impl Meter) {
    let outputs = FrameBuilder::new().logical(Command::Lwr, 0, &[0x5A; 1_200]).finish();
    let inputs = FrameBuilder::new().logical(Command::Lrd, 0, &[0; 1_204]).finish();
    meter.row("full unit/LWR 1200 + LRD 1204", Throughput::Bytes(2_404), || {
        let (mut segment, mut outputs, mut inputs) = (line(1, 1_200, 1_204), outputs.clone(), inputs.clone());
        move || {
            segment.frame(Instant::ZERO, black_box(&mut outputs));
            segment.frame(Instant::ZERO, black_box(&mut inputs));
        }
    });
    meter.row("full unit/LWR 1200 + LRD 1204 + refresh", Throughput::Bytes(2_404), || {
        let (mut segment, mut outputs, mut inputs) = (line(1, 1_200, 1_204), outputs.clone(), inputs.clone());
        move || {
            segment.frame(Instant::ZERO, black_box(&mut outputs));
            if let Some(esc) = segment.esc_mut(0) {
                esc.pdi().exchange(Some(SmIndex::OUTPUTS), Some(SmIndex::INPUTS), |outputs, inputs| {
                    inputs[..outputs.len()].copy_from_slice(outputs);
                });
            }
            segment.frame(Instant::ZERO, black_box(&mut inputs));
        }
    });
}

/// One frame through a line of units with 6 + 6 bytes.
fn one_frame(meter: &mut impl Meter, name: &str, units: usize, frame: FrameBuilder) {
    let frame = frame.finish();
    meter.row(name, Throughput::Elements(units as u64), || {
        let (mut segment, mut frame) = (line(units, 6, 6), frame.clone());
        move || segment.frame(Instant::ZERO, black_box(&mut frame))
    });
}

/// One LRW of 1,200 bytes through 100 units.
fn hundred_units(meter: &mut impl Meter) {
    let lrw = FrameBuilder::new().logical(Command::Lrw, 0, &[0; 1_200]);
    one_frame(meter, "100 units of 6 + 6 bytes: LRW 1200", 100, lrw);
}

fn broadcast(meter: &mut impl Meter, units: usize) {
    let brd = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]);
    one_frame(meter, &format!("BRD 2 bytes/{units}"), units, brd);
}

/// A logical datagram that no unit maps: the cost of a unit that is not addressed.
fn untouched(meter: &mut impl Meter, units: usize) {
    let lrw = FrameBuilder::new().logical(Command::Lrw, 0x4000_0000, &[0; 6]);
    one_frame(meter, &format!("untouched units, LRW 6 bytes/{units}"), units, lrw);
}

/// One unit of a line, by its station address: the cost of the others.
fn configured_address(meter: &mut impl Meter, units: usize) {
    let fprd = FrameBuilder::new().physical(Command::Fprd, 0x1234, 0x0130, &[0; 2]).finish();
    let last = (units as u16 - 1).wrapping_neg();
    let address = FrameBuilder::new().physical(Command::Apwr, last, 0x0010, &[0x34, 0x12]).finish();
    let name = format!("FPRD 2 bytes of the last unit/{units}");
    meter.row(&name, Throughput::Elements(1), || {
        let (mut segment, mut fprd) = (line(units, 6, 6), fprd.clone());
        segment.frame(Instant::ZERO, &mut address.clone());
        move || segment.frame(Instant::ZERO, black_box(&mut fprd))
    });
}

/// What masters send in each cycle to synchronise the clocks: the first unit is read, all others are written.
fn system_time(meter: &mut impl Meter) {
    let frmw = FrameBuilder::new().physical(Command::Frmw, 0, 0x0910, &[0; 8]);
    one_frame(meter, "100 units: FRMW 8 of the system time", 100, frmw);
}

/// Registers of one unit that are calculated when they are read.
fn live_registers(meter: &mut impl Meter) {
    let aprd = FrameBuilder::new().physical(Command::Aprd, 0, 0x080D, &[0]).finish();
    meter.row("mailbox status: APRD 1", Throughput::Elements(1), || {
        let (mut segment, mut aprd) = (line(1, 6, 6), aprd.clone());
        move || {
            aprd[18..20].fill(0);
            segment.frame(Instant::ZERO, black_box(&mut aprd))
        }
    });
}

fn all(meter: &mut impl Meter) {
    full_unit(meter);
    hundred_units(meter);
    LINES.into_iter().for_each(|units| broadcast(meter, units));
    LINES.into_iter().for_each(|units| untouched(meter, units));
    LINES.into_iter().for_each(|units| configured_address(meter, units));
    system_time(meter);
    live_registers(meter);
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip_while(|argument| argument != "once").collect();
    if let [_, name, rounds, ..] = arguments.as_slice()
        && let Ok(rounds) = rounds.parse()
    {
        let mut once = Once { name, rounds, is_found: false };
        all(&mut once);
        assert!(once.is_found, "there is no row {name}");
        return;
    }
    let mut criterion = Criterion::default().configure_from_args();
    all(&mut criterion);
    criterion.final_summary();
}
