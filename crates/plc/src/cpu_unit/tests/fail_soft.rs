//! The effect of the fail-soft operation on the errors to which the manual applies it (8-3-4, 10410000 and 80200000).

use nx_ect101::Fault;

use super::*;
use crate::CpuEvent;

fn bench(fail_soft: FailSoftOperation) -> Bench {
    let settings = CpuSettings { fail_soft, ..CpuSettings::default() };
    let mut bench = Bench::in_op(IoAllocation::factory(), settings, Echo);
    bench.outputs = Some(vec![1; 180]);
    bench.run_to_ms(10);
    assert_eq!(bench.inputs[2..182], [1; 180]);
    bench
}

/// Data are exchanged in both directions, and the CPU Unit indicates this.
fn exchanges(bench: &mut Bench, end_ms: u64, fill: u8) -> bool {
    bench.outputs = Some(vec![fill; 180]);
    bench.run_to_ms(end_ms);
    let exchanged = bench.inputs[2..182] == [fill; 180];
    assert_eq!(bench.cpu.io().io_data_active(), exchanged);
    exchanged
}

fn flags(bench: &Bench) -> Vec<u8> {
    let io = bench.cpu.io();
    let id = io.find("_NXB_UnitErrFlagTbl").expect("always there");
    io.read(id).expect("a table")[..2].to_vec()
}

fn events(bench: &mut Bench) -> Vec<CpuEvent> {
    bench.cpu.take_events().map(|record| record.event).collect()
}

#[test]
fn with_fail_soft_a_reset_in_the_unit_is_enough() {
    let mut bench = bench(FailSoftOperation::FailSoft);
    bench.unit.inject(Fault::IoCommunications);
    assert!(!exchanges(&mut bench, 20, 2), "the unit itself stops");
    assert_eq!(flags(&bench), [0, 1], "the NX Bus Function Module has no error");
    bench.unit.remove(Fault::IoCommunications);
    bench.unit.reset_errors();
    assert!(exchanges(&mut bench, 30, 3));
    assert_eq!((flags(&bench), events(&mut bench)), (vec![0, 0], vec![]));
}

#[test]
fn with_stop_it_needs_a_reset_in_the_nx_bus_function_module() {
    let mut bench = bench(FailSoftOperation::Stop);
    bench.unit.inject(Fault::IoCommunications);
    assert!(!exchanges(&mut bench, 20, 2));
    assert_eq!((flags(&bench), bench.cpu.is_io_stopped()), (vec![1, 1], true));
    assert_eq!(bench.inputs[..2], [0x11, 0x00], "neither direction is valid");
    bench.unit.remove(Fault::IoCommunications);
    bench.unit.reset_errors();
    assert!(!exchanges(&mut bench, 30, 3), "a reset in the unit is not enough");
    assert_eq!(flags(&bench), [1, 0]);
    bench.cpu.reset_errors();
    assert!(exchanges(&mut bench, 40, 4));
    assert_eq!((flags(&bench), bench.cpu.is_io_stopped()), (vec![0, 0], false));
    assert_eq!(events(&mut bench), [CpuEvent::IoRefreshingStopped, CpuEvent::IoRefreshingResumed]);
}

#[test]
fn with_stop_a_reset_in_the_nx_bus_function_module_resets_the_unit_too() {
    let mut bench = bench(FailSoftOperation::Stop);
    bench.unit.inject(Fault::IoCommunications);
    assert!(!exchanges(&mut bench, 20, 2));
    bench.cpu.reset_errors();
    assert!(!exchanges(&mut bench, 30, 3), "the cause is still there");
    bench.unit.remove(Fault::IoCommunications);
    assert!(!exchanges(&mut bench, 40, 4), "the reset is over");
    bench.cpu.reset_errors();
    assert!(exchanges(&mut bench, 50, 5));
}

#[test]
fn with_stop_lost_control_parameters_need_a_restart_of_the_unit_before_the_reset() {
    let mut bench = bench(FailSoftOperation::Stop);
    let restart = |bench: &mut Bench| {
        bench.unit.restart(Instant::ZERO, device::Start::Restart, &mut [0; 2048]);
    };
    bench.unit.inject(Fault::ControlParameters);
    assert!(exchanges(&mut bench, 20, 2), "it is found at power-on");
    restart(&mut bench);
    assert!(!exchanges(&mut bench, 30, 3));
    bench.unit.remove(Fault::ControlParameters);
    bench.cpu.reset_errors();
    assert!(!exchanges(&mut bench, 40, 4), "the unit has not been restarted");
    restart(&mut bench);
    assert!(!exchanges(&mut bench, 50, 5), "a restart is not enough");
    bench.cpu.reset_errors();
    assert!(exchanges(&mut bench, 60, 6));
}

#[test]
fn with_fail_soft_lost_control_parameters_need_a_restart_before_the_reset_in_the_unit() {
    let mut bench = bench(FailSoftOperation::FailSoft);
    let restart = |bench: &mut Bench| {
        bench.unit.restart(Instant::ZERO, device::Start::Restart, &mut [0; 2048]);
    };
    bench.unit.inject(Fault::ControlParameters);
    restart(&mut bench);
    assert!(!exchanges(&mut bench, 20, 2));
    bench.unit.remove(Fault::ControlParameters);
    bench.unit.reset_errors();
    assert!(!exchanges(&mut bench, 30, 3), "the unit has not been restarted");
    restart(&mut bench);
    bench.unit.reset_errors();
    assert!(exchanges(&mut bench, 40, 4));
    assert_eq!((flags(&bench), events(&mut bench)), (vec![0, 0], vec![]));
}

#[test]
fn other_errors_stop_nothing_on_the_nx_bus() {
    let mut bench = bench(FailSoftOperation::Stop);
    bench.unit.inject(Fault::MessageCommunications);
    bench.run_to_ms(20);
    assert_eq!((flags(&bench), bench.cpu.is_io_stopped()), (vec![0, 1], false));
    assert!(exchanges(&mut bench, 30, 2));
}

#[test]
fn a_cpu_unit_that_stops_refreshing_itself_resumes_as_the_setting_says() {
    for (fail_soft, resumes_by_the_unit) in
        [(FailSoftOperation::FailSoft, true), (FailSoftOperation::Stop, false)]
    {
        let mut bench = bench(fail_soft);
        bench.cpu.set_io_refreshing(false);
        assert!(!exchanges(&mut bench, 20, 2));
        bench.cpu.set_io_refreshing(true);
        bench.run_to_ms(30);
        bench.unit.reset_errors();
        assert_eq!(exchanges(&mut bench, 40, 3), resumes_by_the_unit, "{fail_soft:?}");
        bench.cpu.reset_errors();
        assert!(exchanges(&mut bench, 50, 4), "{fail_soft:?}");
    }
}
