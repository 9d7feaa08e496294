//! What a frame costs in process: `cargo bench -p ectwin-segment`. Targets and figures: docs/performance.md.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use esc::{Esc, EscConfig, SmIndex};
use segment::Segment;
use std::hint::black_box;
use time::Instant;
use wire::{Command, FrameBuilder};

const OUTPUTS: u8 = 0x64;
const INPUTS: u8 = 0x20;

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

/// Outputs and inputs of a full unit in two frames; the application takes and provides complete images.
fn full_unit(criterion: &mut Criterion) {
    let mut segment = line(1, 1_200, 1_204);
    let mut outputs = FrameBuilder::new().logical(Command::Lwr, 0, &[0x5A; 1_200]).finish();
    let mut inputs = FrameBuilder::new().logical(Command::Lrd, 0, &[0; 1_204]).finish();
    let mut group = criterion.benchmark_group("full unit");
    group.throughput(Throughput::Bytes(2_404));
    group.bench_function("LWR 1200 + LRD 1204", |bencher| {
        bencher.iter(|| {
            segment.frame(Instant::ZERO, black_box(&mut outputs));
            segment.frame(Instant::ZERO, black_box(&mut inputs));
        });
    });
    group.bench_function("LWR 1200 + LRD 1204 + refresh", |bencher| {
        bencher.iter(|| {
            segment.frame(Instant::ZERO, black_box(&mut outputs));
            if let Some(esc) = segment.esc_mut(0) {
                esc.pdi().exchange(Some(SmIndex::OUTPUTS), Some(SmIndex::INPUTS), |outputs, inputs| {
                    inputs[..outputs.len()].copy_from_slice(outputs);
                });
            }
            segment.frame(Instant::ZERO, black_box(&mut inputs));
        });
    });
    group.finish();
}

/// One LRW of 1,200 bytes through 100 units of 6 + 6 bytes.
fn hundred_units(criterion: &mut Criterion) {
    let mut lrw = FrameBuilder::new().logical(Command::Lrw, 0, &[0; 1_200]).finish();
    criterion.bench_function("100 units of 6 + 6 bytes: LRW 1200", |bencher| {
        let mut segment = line(100, 6, 6);
        bencher.iter(|| segment.frame(Instant::ZERO, black_box(&mut lrw)));
    });
}

fn broadcast(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("BRD 2 bytes");
    for units in [1, 100, 1_000, 10_000] {
        let mut brd = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish();
        group.throughput(Throughput::Elements(units as u64));
        group.bench_function(BenchmarkId::from_parameter(units), |bencher| {
            let mut segment = line(units, 6, 6);
            bencher.iter(|| segment.frame(Instant::ZERO, black_box(&mut brd)));
        });
    }
    group.finish();
}

/// A logical datagram that no unit maps: the cost of a unit that is not addressed.
fn untouched(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("untouched units, LRW 6 bytes");
    for units in [1, 100, 1_000, 10_000] {
        let mut lrw = FrameBuilder::new().logical(Command::Lrw, 0x4000_0000, &[0; 6]).finish();
        group.throughput(Throughput::Elements(units as u64));
        group.bench_function(BenchmarkId::from_parameter(units), |bencher| {
            let mut segment = line(units, 6, 6);
            bencher.iter(|| segment.frame(Instant::ZERO, black_box(&mut lrw)));
        });
    }
    group.finish();
}

/// One unit of a line, by its station address: the cost of the others.
fn configured_address(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("FPRD 2 bytes of the last unit");
    for units in [1, 100, 1_000, 10_000] {
        let mut fprd = FrameBuilder::new().physical(Command::Fprd, 0x1234, 0x0130, &[0; 2]).finish();
        group.bench_function(BenchmarkId::from_parameter(units), |bencher| {
            let mut segment = line(units, 6, 6);
            let last = (units as u16 - 1).wrapping_neg();
            let address = FrameBuilder::new().physical(Command::Apwr, last, 0x0010, &[0x34, 0x12]);
            segment.frame(Instant::ZERO, &mut address.finish());
            bencher.iter(|| segment.frame(Instant::ZERO, black_box(&mut fprd)));
        });
    }
    group.finish();
}

/// What masters send in each cycle to synchronise the clocks: the first unit is read, all others are written.
fn system_time(criterion: &mut Criterion) {
    let mut frmw = FrameBuilder::new().physical(Command::Frmw, 0, 0x0910, &[0; 8]).finish();
    criterion.bench_function("100 units: FRMW 8 of the system time", |bencher| {
        let mut segment = line(100, 6, 6);
        bencher.iter(|| segment.frame(Instant::ZERO, black_box(&mut frmw)));
    });
}

/// Registers of one unit that are calculated when they are read.
fn live_registers(criterion: &mut Criterion) {
    let mut aprd = FrameBuilder::new().physical(Command::Aprd, 0, 0x080D, &[0]).finish();
    criterion.bench_function("mailbox status: APRD 1", |bencher| {
        let mut segment = line(1, 6, 6);
        bencher.iter(|| {
            aprd[18..20].fill(0);
            segment.frame(Instant::ZERO, black_box(&mut aprd))
        });
    });
}

criterion_group!(
    benches,
    full_unit,
    hundred_units,
    broadcast,
    untouched,
    configured_address,
    system_time,
    live_registers
);
criterion_main!(benches);
