//! A CPU Unit and a unit in virtual time, each with its own period and phase.

mod fail_soft;
mod forced;
mod programs;

use device::{Check, Exchange, PortLinks, RefreshCause, SmIndex, Unit};
use nx_ect101::{DataSetKind, Direction, IoAllocation, NxEct101, UnitSettings};
use proptest::prelude::*;
use wire::AlState;

use super::*;
use crate::Echo;
use crate::{FailSoftOperation, WithCpu};

struct Bench {
    unit: NxEct101,
    cpu: CpuUnit,
    /// The time of the unit's next refresh.
    refresh_at: Instant,
    outputs: Option<Vec<u8>>,
    inputs: Vec<u8>,
    state: AlState,
}

impl Bench {
    fn in_op(io_allocation: IoAllocation, cpu: CpuSettings, program: impl Program + Send + 'static) -> Self {
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &io_allocation));
        let (mut unit, cpu_end) =
            NxEct101::power_on(&UnitSettings { io_allocation, ..UnitSettings::default() });
        unit.check_transition(Instant::ZERO, Check::ProcessData, &[]).expect("the factory setting");
        unit.entered(Instant::ZERO, AlState::Op);
        let bytes = |index| vec![0; usize::from(unit.mapped_bytes(index))];
        let (outputs, inputs) = (bytes(SmIndex::OUTPUTS), bytes(SmIndex::INPUTS));
        Self {
            unit,
            cpu: CpuUnit::power_on(Instant::ZERO, cpu, variables, cpu_end, Box::new(program)),
            refresh_at: Instant::ZERO,
            outputs: Some(outputs),
            inputs,
            state: AlState::Op,
        }
    }

    fn refresh_period(&self) -> Duration {
        self.unit.refresh_period().expect("the unit runs freely")
    }

    fn echo() -> Self {
        Self::in_op(IoAllocation::factory(), CpuSettings::default(), Echo)
    }

    /// Advances virtual time to `end`; CPU Unit and unit run at their times.
    fn run_to(&mut self, end: Instant) {
        loop {
            let now = self.cpu.deadline().min(self.refresh_at);
            if now > end {
                return;
            }
            if now == self.cpu.deadline() {
                self.cpu.cycle(now);
            } else {
                let outputs = self.outputs.as_deref();
                self.unit.refresh(
                    now,
                    Exchange {
                        cause: RefreshCause::Period,
                        state: self.state,
                        links: PortLinks::default(),
                        outputs,
                        inputs: &mut self.inputs,
                    },
                );
                self.refresh_at = now + self.refresh_period();
            }
        }
    }

    fn run_to_ms(&mut self, end_ms: u64) {
        self.run_to(Instant::ZERO + Duration::from_millis(end_ms));
    }
}

#[test]
fn what_the_master_sends_comes_back() {
    let mut bench = Bench::echo();
    let sent: Vec<u8> = (1..=180).collect();
    bench.outputs = Some(sent.clone());
    bench.run_to_ms(5);
    assert_eq!(bench.inputs[2..182], sent);
    assert_eq!(bench.inputs[..2], [0x17, 0x00], "both data valid, ready for a message");
}

#[test]
fn without_valid_data_nothing_is_copied() {
    let mut bench = Bench::echo();
    bench.outputs = Some(vec![1; 180]);
    bench.run_to_ms(5);
    (bench.outputs, bench.state) = (None, AlState::SafeOp);
    bench.run_to_ms(10);
    (bench.outputs, bench.state) = (Some(vec![2; 180]), AlState::Op);
    bench.run_to_ms(10);
    assert_eq!(bench.inputs[2..182], [1; 180], "the last values stay");
    bench.run_to_ms(15);
    assert_eq!(bench.inputs[2..182], [2; 180]);
}

#[test]
fn in_program_mode_the_exchange_goes_on_and_the_values_stay() {
    let mut bench = Bench::echo();
    bench.outputs = Some(vec![1; 180]);
    bench.run_to_ms(5);
    bench.cpu.set_mode(OperatingMode::Program);
    bench.outputs = Some(vec![2; 180]);
    bench.run_to_ms(10);
    assert_eq!(bench.inputs[2..182], [1; 180]);
    assert_eq!(bench.inputs[0], 0x17, "the flags do not tell the mode");
    assert_eq!(bench.cpu.io().m_to_c(), [2; 180], "the inputs of the CPU Unit go on");
}

#[test]
fn data_sets_of_both_directions_meet_by_name() {
    let mut allocation = IoAllocation::empty();
    allocation.select(Direction::MToC, DataSetKind::Bytes, 1);
    allocation.select(Direction::MToC, DataSetKind::Uints, 2);
    allocation.select(Direction::CToM, DataSetKind::Uints, 6);
    let mut bench = Bench::in_op(allocation, CpuSettings::default(), Echo);
    bench.outputs = Some(vec![3; 180]);
    bench.run_to_ms(5);
    assert_eq!(bench.cpu.io().c_to_m(), [[3; 60].as_slice(), &[0; 120]].concat());
}

#[test]
fn a_closure_is_a_program() {
    let count = |io: &mut Io| {
        let next = io.c_to_m().first().map_or(0, |last| last + 1);
        io.set_uints(1, [u16::from(next); 15]);
    };
    let mut bench = Bench::in_op(IoAllocation::factory(), CpuSettings::default(), count);
    bench.run_to_ms(4);
    assert_eq!(bench.cpu.io().c_to_m()[..2], [5, 0], "five task periods, 0 to 4 ms");
}

#[test]
fn task_periods_keep_their_phase_and_leave_out_what_was_missed() {
    let mut bench = Bench::echo();
    bench.cpu.cycle(Instant::from_nanos(0));
    assert_eq!(bench.cpu.deadline(), Instant::from_nanos(1_000_000));
    bench.cpu.cycle(Instant::from_nanos(1_200_000));
    assert_eq!(bench.cpu.deadline(), Instant::from_nanos(2_000_000));
    bench.cpu.cycle(Instant::from_nanos(5_100_000));
    assert_eq!(bench.cpu.deadline(), Instant::from_nanos(6_000_000));
}

#[test]
fn a_unit_file_sets_up_a_cpu_unit() {
    let text = "[cpu]\ntask_period = \"4ms\"\nmode = \"program\"";
    let file = WithCpu::parse(text, |_, _| Some(())).expect("a right file");
    let settings = CpuSettings::from_section(&file.cpu);
    assert_eq!((settings.task_period, settings.mode), (Duration::from_millis(4), OperatingMode::Program));
}

#[test]
fn the_system_time_goes_on_from_power_on() {
    let settings = CpuSettings { system_time_ns: Some(1_000), ..CpuSettings::default() };
    let mut bench = Bench::in_op(IoAllocation::factory(), settings, Echo);
    bench.run_to_ms(3);
    let objects = bench.unit.objects().expect("a mailbox");
    let mut value = [0; 8];
    objects.read(wire::ObjectIndex(0x10F8), wire::SubIndex::ZERO, &mut value).expect("readable");
    assert_eq!(u64::from_le_bytes(value), 3_001_000);
}

proptest! {
    #[test]
    fn an_echo_comes_back_in_time_for_any_period(task_us in 100..8_000u64, phase_us in 0..1_000u64) {
        let task_period = Duration::from_micros(task_us);
        let settings = CpuSettings { task_period, ..CpuSettings::default() };
        let mut bench = Bench::in_op(IoAllocation::factory(), settings, Echo);
        bench.refresh_at = Instant::ZERO + Duration::from_micros(phase_us);
        let sent = Instant::ZERO + Duration::from_millis(20);
        bench.run_to(sent);
        bench.outputs = Some(vec![9; 180]);
        bench.run_to(sent + bench.refresh_period() * 3 + task_period * 2);
        prop_assert_eq!(&bench.inputs[2..182], &[9; 180]);
    }
}
