//! What a frame costs with the faults of the line, without any and with some: `cargo bench -p ectwin-plant`. Figures:
//! docs/performance.md.

use criterion::{Criterion, criterion_group, criterion_main};
use device::Network;
use plant::line::{Choice, Disturbance, FrameFault, FrameKind, Frames, LineEnds, LineFaults, Met};
use plant::{PowerConditions, UnitFile};
use std::hint::black_box;
use time::Instant;
use unit_model::ModelUnit;
use wire::{Command, FrameBuilder};

type Units = Network<Box<dyn ModelUnit>>;

/// A master that drops its answers.
struct Drops;

impl LineEnds<()> for Drops {
    fn returns(&mut self, _: Instant, (): (), answer: Vec<u8>, _: &[Met]) {
        black_box(answer);
    }
}

fn units(count: usize) -> Units {
    let Ok(file) = UnitFile::parse("model = \"digital\"\noutputs = 8") else { panic!("a unit file") };
    let powered = (0..count).map(|_| {
        let powered = file.power_on(Instant::ZERO, &PowerConditions::default(), Box::new(plc::Echo));
        (powered.config, powered.unit)
    });
    let mut units = Network::power_on(powered.collect::<Vec<_>>(), Instant::ZERO);
    units.poll(Instant::ZERO);
    units
}

/// As a live line passes a frame: in place if no fault can meet it.
fn pass(faults: &mut LineFaults<()>, units: &mut Units, frame: &mut [u8]) {
    if faults.is_quiet() {
        units.frame(Instant::ZERO, frame);
        return;
    }
    let met = faults.meet(Instant::ZERO, frame, units);
    if met.is_empty() {
        units.frame(Instant::ZERO, frame);
        faults.has_passed(Instant::ZERO);
    } else {
        faults.send(Instant::ZERO, (), frame.to_vec(), met, units, &mut Drops);
    }
}

fn faults_of(count: usize, criterion: &mut Criterion) {
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0; 2]).finish();
    let mut group = criterion.benchmark_group(format!("BRD 2 bytes, {count} units"));
    group.bench_function("without faults of the line", |bencher| {
        let mut units = units(count);
        bencher.iter(|| units.frame(Instant::ZERO, black_box(&mut frame)));
    });
    let of = |kind, choice| Disturbance::new(FrameFault::LoseAnswer, Frames::of(choice).with_kind(kind));
    let cases = [
        ("no fault at work", None),
        ("a fault of other frames", Some(of(FrameKind::ProcessData, Choice::All))),
        ("a fault that it does not meet", Some(of(FrameKind::Brd, Choice::Every(u64::MAX)))),
        ("a fault that it meets", Some(of(FrameKind::Brd, Choice::All))),
    ];
    for (name, disturbance) in cases {
        let (mut units, mut faults) = (units(count), LineFaults::new(1));
        if let Some(disturbance) = disturbance {
            assert_eq!(faults.disturb(Instant::ZERO, disturbance), Ok(()), "{name}");
        }
        group.bench_function(name, |bencher| {
            bencher.iter(|| pass(&mut faults, &mut units, black_box(&mut frame)));
        });
    }
    group.finish();
}

fn faults(criterion: &mut Criterion) {
    [1, 100].into_iter().for_each(|count| faults_of(count, criterion));
}

criterion_group!(benches, faults);
criterion_main!(benches);
