//! Both ends of the gateway, on one thread and on two.

use nx_ect101::{Direction, IoAllocation};
use proptest::prelude::*;
use time::Duration;

use super::*;
use crate::{CpuSettings, CpuUnit, Echo, Io, OperatingMode, Program, Target, VariableError, VariableId};

const PERIOD: Duration = Duration::from_millis(1);

/// A CPU Unit with an outside end, its bus, and the time.
struct Bench {
    cpu: CpuUnit,
    unit: nx_bus::UnitEnd,
    end: OutsideEnd,
}

impl Bench {
    fn with(user_program: impl Program + Send + 'static) -> Self {
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()));
        let (unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
        let settings = CpuSettings { task_period: PERIOD, ..CpuSettings::default() };
        let mut cpu = CpuUnit::power_on(Instant::ZERO, settings, variables, bus, Box::new(user_program));
        let (program, end) = connect(cpu.io().variables());
        cpu.attach(Box::new(program));
        Self { cpu, unit, end }
    }

    fn without_program() -> Self {
        Self::with(|_: &mut Io| {})
    }

    fn id(&self, direction: Direction, number: u8) -> VariableId {
        let set = if direction == Direction::MToC { "M_to_C" } else { "C_to_M" };
        self.end.variables().find(&format!("N1_UINTs_{number:02}_{set}")).expect("allocated")
    }

    fn cycle(&mut self) {
        self.cpu.cycle(self.cpu.deadline());
    }

    fn uint(&mut self, target: Target) -> u16 {
        let value = self.end.newest().read(target).expect("it is there");
        u16::from_le_bytes(value.as_slice().try_into().expect("two bytes"))
    }
}

fn value(number: u16) -> crate::VariableValue {
    number.to_le_bytes().into_iter().collect()
}

fn write(target: Target, number: u16) -> Change {
    Change { target, operation: Operation::Write(value(number)) }
}

fn force(target: Target, number: u16) -> Change {
    Change { target, operation: Operation::Force(value(number)) }
}

#[test]
fn who_has_written_reads_it_in_the_image_that_says_so() {
    let mut bench = Bench::without_program();
    let target = bench.id(Direction::CToM, 2).element(3);
    let ticket = bench.end.send(&[write(target, 0x1234)]).expect("there is room");
    assert!(!bench.end.newest().has_taken(ticket));
    bench.cycle();
    assert!(bench.end.newest().has_taken(ticket));
    assert_eq!(bench.uint(target), 0x1234);
    bench.cycle();
    assert_eq!(bench.unit.c_to_m.newest().bytes()[36..38], [0x34, 0x12], "the unit gets it");
}

#[test]
fn in_run_mode_the_user_program_writes_over_it_and_not_over_what_is_forced() {
    let mut bench = Bench::with(|io: &mut Io| {
        io.set_uints(1, [7; 15]);
    });
    let id = bench.id(Direction::CToM, 1);
    let changes = [write(id.element(0), 100), force(id.element(1), 101)];
    bench.end.send(&changes).expect("there is room");
    bench.cycle();
    bench.cycle();
    assert_eq!(bench.unit.c_to_m.newest().bytes()[..6], [7, 0, 101, 0, 7, 0]);
    assert_eq!((bench.uint(id.element(0)), bench.uint(id.element(1))), (7, 101));
    let newest = bench.end.newest();
    assert_eq!((newest.is_forced(id.element(1)), newest.is_forced(id)), (Ok(true), Ok(false)));

    bench.cpu.set_mode(OperatingMode::Program);
    bench
        .end
        .send(&[write(id.element(0), 200), Change { target: id.element(1), operation: Operation::Release }])
        .expect("room");
    bench.cycle();
    bench.cycle();
    assert_eq!((bench.uint(id.element(0)), bench.uint(id.element(1))), (200, 101), "nobody writes over it");
}

#[test]
fn forced_inputs_are_what_the_user_program_sees() {
    let mut bench = Bench::with(Echo);
    let target = bench.id(Direction::MToC, 1).element(14);
    bench.end.send(&[force(target, 99)]).expect("there is room");
    bench.cycle();
    assert_eq!(bench.cpu.io().uints(1).expect("allocated")[14], 99);
    let as_it_is = Change { target: bench.id(Direction::MToC, 1).into(), operation: Operation::ForceAsItIs };
    bench.end.send(&[as_it_is]).expect("there is room");
    bench.cycle();
    let id = bench.id(Direction::MToC, 1);
    assert_eq!(bench.end.newest().is_forced(id), Ok(true));
    assert_eq!(bench.uint(target), 99);
}

#[test]
fn what_cannot_be_done_is_refused_at_once_and_all_of_it() {
    let mut bench = Bench::without_program();
    let (input, output) = (bench.id(Direction::MToC, 1).element(0), bench.id(Direction::CToM, 1).element(0));
    let refused = |change, error| Err(ChangeRefused::Variable { change, error });
    assert_eq!(bench.end.send(&[write(output, 1), write(input, 1)]), refused(1, VariableError::NotWritable));
    let too_long = Change { target: output, operation: Operation::Write([0; 3].into_iter().collect()) };
    let wrong_length = VariableError::WrongLength { length_bytes: 3, expected_bytes: 2 };
    assert_eq!(bench.end.send(&[too_long]), refused(0, wrong_length));
    bench.cycle();
    assert_eq!(bench.uint(output), 0);
}

#[test]
fn a_full_queue_is_told_and_has_room_after_a_task_period() {
    let mut bench = Bench::without_program();
    let target = bench.id(Direction::CToM, 1).element(0);
    let half = vec![write(target, 1); CHANGES_MAX / 2 + 1];
    let first = bench.end.send(&half).expect("there is room");
    let room = CHANGES_MAX - half.len();
    assert_eq!(bench.end.send(&half), Err(ChangeRefused::Full { room }));
    bench.cycle();
    assert!(bench.end.newest().has_taken(first));
    assert!(bench.end.send(&half).is_ok());
}

#[test]
fn without_a_cpu_unit_nothing_is_sent() {
    let Bench { mut end, cpu, .. } = Bench::without_program();
    let target = end.variables().find("N1_UINTs_01_C_to_M").expect("allocated").element(0);
    drop(cpu);
    assert_eq!(end.send(&[write(target, 1)]), Err(ChangeRefused::NotReachable));
}

#[test]
fn a_request_is_made_whole_in_one_task_period_whatever_the_threads_do() {
    let mut bench = Bench::without_program();
    let id = bench.id(Direction::CToM, 1);
    let mut end = bench.end;
    let cpu = &mut bench.cpu;
    std::thread::scope(|scope| {
        let writing = scope.spawn(move || {
            for number in 0..5_000_u16 {
                let changes: Vec<_> = (0..15).map(|element| write(id.element(element), number)).collect();
                // With a full queue the request is not made at all.
                let _ = end.send(&changes);
                let newest = end.newest().read(id).expect("it is there");
                assert!(newest.chunks(2).all(|element| element == &newest[..2]), "torn: {newest:?}");
            }
        });
        while !writing.is_finished() {
            cpu.cycle(cpu.deadline());
            let elements = cpu.io().c_to_m();
            assert!(elements[..30].chunks(2).all(|element| element == &elements[..2]), "torn");
        }
    });
}

proptest! {
    #[test]
    fn every_snapshot_is_what_the_cpu_unit_has(
        data in proptest::collection::vec(any::<u8>(), 180),
        elements in proptest::collection::vec((1..=6_u8, 0..15_u16, any::<u16>(), any::<bool>()), 0..40),
    ) {
        let mut bench = Bench::without_program();
        bench.unit.m_to_c.publish(Default::default(), &data);
        for (number, element, new, forced) in elements {
            let target = bench.id(Direction::CToM, number).element(element);
            bench.end.send(&[if forced { force(target, new) } else { write(target, new) }]).expect("room");
        }
        bench.cycle();
        let io = bench.cpu.io();
        let snapshot = bench.end.newest();
        for (id, variable) in io.variables().iter() {
            prop_assert_eq!(snapshot.read(id), io.read(id), "{}", &variable.name);
            prop_assert_eq!(snapshot.is_forced(id), io.is_forced(id));
            prop_assert_eq!(snapshot.validity(id), io.validity(id));
        }
        prop_assert_eq!(snapshot.now(), io.now());
    }
}
