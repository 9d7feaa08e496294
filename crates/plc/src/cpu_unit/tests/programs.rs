//! User programs and outside runtimes: when they start, when they run, what they report.

use std::sync::mpsc::{Receiver, Sender, channel};

use super::*;
use crate::{CpuEvent, ProgramEvent, ProgramTrouble, StructuredText};

/// Reports every call, with its time.
struct Told {
    name: &'static str,
    calls: Sender<String>,
}

impl Program for Told {
    fn start(&mut self, io: &mut Io) {
        let _ = self.calls.send(format!("{} starts at {} ms", self.name, ms(io)));
    }

    fn scan(&mut self, io: &mut Io) {
        let _ = self.calls.send(format!("{} at {} ms", self.name, ms(io)));
    }
}

fn ms(io: &Io) -> u64 {
    io.now().as_nanos() / 1_000_000
}

fn told(name: &'static str) -> (Box<Told>, Receiver<String>) {
    let (calls, heard) = channel();
    (Box::new(Told { name, calls }), heard)
}

fn cpu_unit(settings: CpuSettings, program: Box<dyn Program + Send>) -> (NxEct101, CpuUnit) {
    let unit_settings = UnitSettings::default();
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &unit_settings.io_allocation));
    let (unit, bus) = NxEct101::power_on(&unit_settings);
    (unit, CpuUnit::power_on(at_ms(100), settings, variables, bus, program))
}

/// The CPU Unit is powered on at 100 ms: its own time begins there.
fn at_ms(ms: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(ms)
}

fn stop() -> ProgramEvent {
    ProgramEvent::Stopped(ProgramTrouble {
        what: "array index 15 of 15".into(),
        line: 3,
        column: 7,
        file: None,
    })
}

fn events(cpu: &mut CpuUnit) -> Vec<CpuEvent> {
    cpu.take_events().map(|record| record.event).collect()
}

#[test]
fn a_user_program_starts_before_its_first_scan_and_again_with_run_mode() {
    let (program, heard) = told("user");
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), program);
    let calls = || heard.try_iter().collect::<Vec<_>>();
    cpu.cycle(at_ms(100));
    cpu.cycle(at_ms(101));
    assert_eq!(calls(), ["user starts at 0 ms", "user at 0 ms", "user at 1 ms"]);
    cpu.set_mode(OperatingMode::Program);
    cpu.cycle(at_ms(102));
    cpu.set_mode(OperatingMode::Program);
    cpu.set_mode(OperatingMode::Run);
    assert_eq!(calls().len(), 0);
    cpu.cycle(at_ms(103));
    assert_eq!(calls(), ["user starts at 3 ms", "user at 3 ms"]);
    let [program, run] = [OperatingMode::Program, OperatingMode::Run].map(CpuEvent::ModeChanged);
    assert_eq!(events(&mut cpu), [program, run]);
}

#[test]
fn an_outside_runtime_runs_first_and_in_every_mode() {
    let (program, user) = told("user");
    let settings = CpuSettings { mode: OperatingMode::Program, ..CpuSettings::default() };
    let (_unit, mut cpu) = cpu_unit(settings, program);
    let (runtime, outside) = told("outside");
    cpu.attach(runtime);
    let (runtime, second) = told("second");
    cpu.attach(runtime);
    cpu.cycle(at_ms(100));
    assert_eq!(outside.try_iter().count(), 2, "start and scan");
    assert_eq!((second.try_iter().count(), user.try_iter().count()), (2, 0));
    cpu.set_mode(OperatingMode::Run);
    cpu.cycle(at_ms(101));
    assert_eq!(outside.try_iter().collect::<Vec<_>>(), ["outside at 1 ms"], "it is not started anew");
    assert_eq!(user.try_iter().count(), 2);
}

#[test]
fn what_an_outside_runtime_writes_the_user_program_reads() {
    let program = |io: &mut Io| {
        let first = io.c_to_m()[0];
        io.c_to_m_mut()[1] = first + 1;
    };
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(program));
    cpu.attach(Box::new(|io: &mut Io| io.c_to_m_mut()[0] = 7));
    cpu.cycle(at_ms(100));
    assert_eq!(cpu.io().c_to_m()[..2], [7, 8]);
}

#[test]
fn a_forced_output_is_forced_for_the_next_program_and_for_raw_bytes_too() {
    let (times, heard) = channel();
    let program = move |io: &mut Io| times.send(io.c_to_m()[0]).expect("someone listens");
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(program));
    cpu.attach(Box::new(|io: &mut Io| io.c_to_m_mut()[0] = 7));
    let output = cpu.io().find("N1_UINTs_01_C_to_M").expect("allocated").element(0);
    cpu.io_mut().force(output, &[9, 0]).expect("it fits");
    cpu.io_mut().write(output, &[8, 0]).expect("an output");
    assert_eq!(cpu.io().c_to_m()[0], 9);
    cpu.cycle(at_ms(100));
    assert_eq!(heard.try_iter().collect::<Vec<_>>(), [9]);
}

#[test]
fn a_program_is_loaded_in_program_mode_only() {
    let (old, heard_old) = told("old");
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), old);
    let (new, heard_new) = told("new");
    cpu.cycle(at_ms(100));
    assert_eq!(cpu.load(new), Err(NotInProgramMode));
    cpu.cycle(at_ms(101));
    assert_eq!((heard_old.try_iter().count(), heard_new.try_iter().count()), (3, 0));
    cpu.set_mode(OperatingMode::Program);
    let (new, heard_new) = told("new");
    assert_eq!(cpu.load(new), Ok(()));
    cpu.set_mode(OperatingMode::Run);
    cpu.cycle(at_ms(102));
    assert_eq!(heard_new.try_iter().collect::<Vec<_>>(), ["new starts at 2 ms", "new at 2 ms"]);
    assert_eq!(heard_old.try_iter().count(), 0);
    assert!(events(&mut cpu).contains(&CpuEvent::ProgramLoaded));
}

#[test]
fn a_program_that_stops_runs_again_when_it_is_started() {
    let mut scans = 0;
    let program = move |io: &mut Io| {
        scans += 1;
        io.set_udint(1, 1);
        io.c_to_m_mut()[0] = scans;
        if scans == 2 {
            io.report(stop());
        }
    };
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(program));
    let (runtime, outside) = told("outside");
    cpu.attach(runtime);
    for ms in 100..110 {
        cpu.cycle(at_ms(ms));
    }
    assert_eq!(cpu.io().c_to_m()[0], 2);
    assert!(cpu.has_program_stopped());
    assert_eq!(outside.try_iter().count(), 11, "the others go on");
    assert_eq!(events(&mut cpu), [CpuEvent::Program(stop())]);
    cpu.set_mode(OperatingMode::Program);
    cpu.set_mode(OperatingMode::Run);
    cpu.cycle(at_ms(110));
    assert_eq!((cpu.io().c_to_m()[0], cpu.has_program_stopped()), (3, false));
}

#[test]
fn a_program_that_stops_at_its_start_does_not_scan() {
    struct Broken;
    impl Program for Broken {
        fn start(&mut self, io: &mut Io) {
            io.report(stop());
        }

        fn scan(&mut self, io: &mut Io) {
            io.c_to_m_mut()[0] = 1;
        }
    }
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(Broken));
    cpu.cycle(at_ms(100));
    assert_eq!((cpu.io().c_to_m()[0], cpu.has_program_stopped()), (0, true));
}

#[test]
fn task_periods_that_are_left_out_are_told() {
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(Echo));
    cpu.cycle(at_ms(100));
    cpu.cycle(at_ms(101) + Duration::from_micros(999));
    assert_eq!(events(&mut cpu), [], "late, but none is left out");
    cpu.cycle(at_ms(104));
    cpu.cycle(at_ms(106));
    let record = cpu.take_events().next().expect("a record");
    assert_eq!(record.event, CpuEvent::TaskPeriodExceeded { missed_periods: 3 });
    let (first_at, last_at) = (at_ms(4), at_ms(6));
    assert_eq!((record.first_at, record.last_at, record.count), (first_at, last_at, 2));
}

#[test]
fn an_error_in_every_scan_is_counted_and_not_logged_endlessly() {
    let overrun = ProgramEvent::TaskOverrun { budget_statements: 1_000 };
    let alarm = ProgramEvent::UserDefinedError { code: 0x101, info1: 20_000_000, info2: 1 };
    let reported = [overrun, alarm];
    let program = {
        let reported = reported.clone();
        move |io: &mut Io| reported.iter().for_each(|event| io.report(event.clone()))
    };
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(program));
    for ms in 100..1_100 {
        cpu.cycle(at_ms(ms));
    }
    let records: Vec<_> = cpu.take_events().map(|record| (record.event, record.count)).collect();
    assert_eq!(records, reported.map(|event| (CpuEvent::Program(event), 1_000)));
    assert_eq!(cpu.events_lost(), 0);
}

/// So that the time of a report on the line is known, whenever it is taken.
#[test]
fn a_record_knows_from_when_its_times_are_counted() {
    let program =
        |io: &mut Io| io.report(ProgramEvent::TaskOverrun { budget_statements: io.now().as_nanos() });
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), Box::new(program));
    cpu.cycle(at_ms(100));
    cpu.cycle(at_ms(101));
    cpu.cycle_power(at_ms(200));
    cpu.set_mode(OperatingMode::Program);
    let times: Vec<_> = cpu.take_events().map(|record| (record.powered_on, record.first_at)).collect();
    assert_eq!(times, [(at_ms(100), at_ms(0)), (at_ms(100), at_ms(1)), (at_ms(200), at_ms(0))]);
}

#[test]
fn a_program_knows_the_time() {
    let (times, heard) = channel();
    let program = move |io: &mut Io| times.send((io.now(), io.system_time_ns())).expect("someone listens");
    let settings = CpuSettings { system_time_ns: Some(1_000), ..CpuSettings::default() };
    let (_unit, mut cpu) = cpu_unit(settings, Box::new(program));
    cpu.cycle(at_ms(100));
    cpu.jump_system_time(Duration::from_millis(5));
    cpu.cycle(at_ms(101));
    let expected = [(at_ms(0), Some(1_000)), (at_ms(1), Some(6_001_000))];
    assert_eq!(heard.try_iter().collect::<Vec<_>>(), expected);
}

const PLANT: &str = "PROGRAM Lamp VAR Runs : INT; END_VAR Runs := Runs + 1; END_PROGRAM
    CONFIGURATION Plant
        TASK Slow(INTERVAL := T#20ms); TASK Fast(INTERVAL := T#5ms);
        PROGRAM A WITH Slow : Lamp; PROGRAM B WITH Fast : Lamp;
    END_CONFIGURATION";

fn structured_text(source: &str) -> Box<StructuredText> {
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()));
    Box::new(StructuredText::compile(source, &variables).expect("a program"))
}

#[test]
fn the_shortest_interval_of_a_configuration_is_the_task_period() {
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), structured_text(PLANT));
    for period in 0..9 {
        assert_eq!(cpu.deadline(), at_ms(100 + 5 * period));
        cpu.cycle(cpu.deadline());
    }
    let runs = ["A.Runs", "B.Runs", "Lamp.Runs"].map(|name| cpu.program_variable(name));
    assert_eq!(runs, ["3", "9", "3"].map(|runs| Some(runs.to_owned())));
}

#[test]
fn a_program_without_an_interval_has_the_period_of_the_settings() {
    let settings = CpuSettings { mode: OperatingMode::Program, ..CpuSettings::default() };
    let (_unit, mut cpu) = cpu_unit(settings, structured_text(PLANT));
    cpu.cycle(at_ms(100));
    assert_eq!(cpu.deadline(), at_ms(105));
    cpu.load(structured_text("VAR x : INT; END_VAR x := 1;")).expect("PROGRAM mode");
    cpu.cycle(at_ms(105));
    assert_eq!(cpu.deadline(), at_ms(106));
    cpu.load(structured_text(PLANT)).expect("PROGRAM mode");
    cpu.cycle(at_ms(106));
    assert_eq!(cpu.deadline(), at_ms(111));
}

#[test]
fn the_first_run_flag_is_true_in_the_first_scan_with_run_mode() {
    let source = "VAR RETAIN Starts : INT; END_VAR IF P_First_RunMode THEN Starts := Starts + 1; END_IF;";
    let (_unit, mut cpu) = cpu_unit(CpuSettings::default(), structured_text(source));
    let starts = |cpu: &CpuUnit| cpu.program_variable("Starts").expect("a variable");
    cpu.cycle(at_ms(100));
    cpu.cycle(at_ms(101));
    assert_eq!(starts(&cpu), "1");
    cpu.set_mode(OperatingMode::Program);
    cpu.cycle(at_ms(102));
    cpu.set_mode(OperatingMode::Run);
    cpu.cycle(at_ms(103));
    cpu.cycle(at_ms(104));
    assert_eq!(starts(&cpu), "2");
}
