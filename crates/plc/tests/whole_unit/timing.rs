//! Response times compared with the manual's formulas (7-9), for any periods and phases.

use nx_ect101::performance::{IoResponse, sdo_response_time, transmission_time};
use nx_ect101::{DataSetKind, Direction, IoAllocation, layout};
use plc::{CpuSettings, Echo};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder};

use crate::bench::{Bench, Random};

const RUNS: u64 = 10_000;
const BYTES: usize = 180;

/// A master with its own period, whose frames take time on the cable.
struct Master {
    bench: Bench,
    period: Duration,
    /// From sending a frame to its passage through the unit.
    to_unit: Duration,
    transmission: Duration,
    next: Instant,
}

impl Master {
    /// Sends outputs and reads inputs in one frame, and waits for the next cycle. Returns the time of sending,
    /// and the inputs.
    fn cycle(&mut self, outputs: &[u8]) -> (Instant, Vec<u8>) {
        let sent = self.next;
        let mut frame = exchange_frame(outputs);
        self.bench.access.run_to(sent + self.to_unit);
        let inputs = self.bench.access.pass(&mut frame).remove(1).data;
        self.next = sent + self.period;
        (sent, inputs)
    }

    /// Sends new outputs; returns the time until they return.
    fn response(&mut self, outputs: &[u8]) -> Duration {
        let (first, mut inputs) = self.cycle(outputs);
        let mut last = first;
        while inputs[2..2 + BYTES] != *outputs {
            (last, inputs) = self.cycle(outputs);
        }
        (last + self.transmission).saturating_since(first)
    }
}

fn exchange_frame(outputs: &[u8]) -> Vec<u8> {
    FrameBuilder::new()
        .physical(Command::Apwr, 0, layout::OUTPUTS_START, outputs)
        .physical(Command::Aprd, 0, layout::INPUTS_START, &[0; BYTES + 3])
        .finish()
}

/// An allocation of 6 or more 15 UINT entries in each direction, for each row of T_slave.
fn allocation(random: &mut Random) -> IoAllocation {
    let entries = [6, 13, 14, 26, 27, 40][random.below(6) as usize];
    let mut allocation = IoAllocation::empty();
    for direction in Direction::ALL {
        allocation.select(direction, DataSetKind::Uints, entries);
    }
    allocation
}

/// A measured I/O response, and the maximum according to the formula.
fn measure_io_response(random: &mut Random) -> (Duration, Duration) {
    let task_period = random.time(125, 10_000);
    let cpu = CpuSettings { task_period, ..CpuSettings::default() };
    let mut bench = Bench::with_program(allocation(random), cpu, Echo).into_pre_op().into_op(180, 183);
    let frame_bytes = exchange_frame(&[0; BYTES]).len() as u64;
    let transmission = transmission_time(1, frame_bytes);
    let times = IoResponse {
        master: random.time(250, 10_000),
        slave: bench.refresh_period(),
        cpu: task_period,
        transmission,
    };
    bench.access.run_for(random.time(0, 20_000));
    let to_unit = Duration::from_nanos(random.below(transmission.as_nanos()));
    let next = bench.access.now();
    let mut master = Master { bench, period: times.master, to_unit, transmission, next };
    // Until data are exchanged; then a new value.
    master.response(&[0x11; BYTES]);
    master.next = master.bench.access.now() + random.time(100, 20_000);
    (master.response(&[0x22; BYTES]), times.maximum())
}

#[test]
fn an_io_response_never_takes_longer_than_the_formula_and_comes_close_to_it() {
    let mut random = Random(1);
    let mut closest = 0.0_f64;
    for run in 0..RUNS {
        let (measured, maximum) = measure_io_response(&mut random);
        assert!(measured <= maximum, "run {run}: {measured} against {maximum}");
        closest = closest.max(measured.as_nanos() as f64 / maximum.as_nanos() as f64);
    }
    println!("the longest response is {closest:.3} of the formula");
    assert!(closest >= 0.9, "the longest response is only {closest:.3} of the formula");
}

/// An SDO with one access of the mailbox in each cycle of `period`: the request, reads of its status, and the read of the
/// response. Returns the total time.
fn sdo_response(bench: &mut Bench, period: Duration) -> Duration {
    let start = bench.access.now();
    bench.access.pace = period;
    assert_eq!(bench.upload(0x1018, 1), Ok(vec![0x83, 0, 0, 0]));
    bench.access.now().saturating_since(start)
}

#[test]
fn an_sdo_response_takes_the_time_of_the_formula() {
    let mut bench = Bench::power_on(IoAllocation::factory()).into_pre_op();
    let mut random = Random(2);
    let worked = [500, 1_000, 2_000, 4_000].map(Duration::from_micros);
    let periods = worked.into_iter().chain((0..RUNS).map(|_| random.time(125, 10_000)));
    for period in periods {
        let measured = sdo_response(&mut bench, period);
        assert_eq!(measured, sdo_response_time(period, 16), "cycle of {period}");
        bench.access.run_for(Duration::from_micros(250));
    }
}
