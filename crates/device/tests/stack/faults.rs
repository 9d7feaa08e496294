//! Errors inside a unit, and the errors that the stack detects and reports to its unit.

use crate::bench::{Bench, Digital8, config};
use device::{Action, DeviceConfig, Network, RefusedInOp, Start};
use time::Duration;
use wire::AlState::{Init, Op, PreOp, SafeOp};
use wire::{AlState, AlStatusCode, Command, FrameBuilder, returned_datagrams};

fn all_states() -> [AlState; 4] {
    [Init, PreOp, SafeOp, Op]
}

#[test]
fn a_fault_takes_the_slave_to_init_from_every_state_and_keeps_it_there() {
    for state in all_states() {
        let mut bench = Bench::in_state(state);
        bench.unit().actions.push_back(Action::Fault(AlStatusCode(0x8004)));
        bench.run_for(Duration::from_millis(1));
        assert_eq!(bench.status(), (0x11, 0x8004), "from {state:?}");
        for request in all_states().map(AlState::bits) {
            bench.request(request);
            bench.request(request | 0x10);
            assert_eq!(bench.status(), (0x11, 0x8004), "asked for {request:#04X}");
        }
        bench.network.restart(0, bench.now, Start::PowerOn);
        assert_eq!(bench.status(), (0x01, 0));
        bench.bring_to(Op);
    }
}

#[test]
fn a_fault_without_code_refuses_without_an_error_indication() {
    let mut bench = Bench::in_state(Op);
    bench.unit().actions.push_back(Action::Fault(AlStatusCode::NO_ERROR));
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.status(), (0x01, 0));
    for request in all_states().map(AlState::bits) {
        bench.request(request);
        assert_eq!(bench.status(), (0x01, 0), "asked for {request:#04X}");
    }
}

/// Explicit Device ID 5 is shown instead of the code; the fault has the same number.
#[test]
fn a_device_id_does_not_hide_a_fault() {
    let mut bench = Bench::in_state(Init);
    bench.request(0x21);
    assert_eq!(bench.status(), (0x21, 5));
    bench.unit().actions.push_back(Action::Fault(AlStatusCode(5)));
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.status(), (0x11, 5));
}

#[test]
fn the_unit_hears_of_each_sync_manager_that_goes() {
    let mut bench = Bench::in_state(Op);
    bench.write(0x0814, &[0x66, 0, 0, 0, 0x00, 0x11, 1, 0, 0x20, 0, 0, 0]);
    assert_eq!(bench.status(), (0x12, 0x1D));
    assert_eq!(bench.unit().told, [0x1D, 0x1E].map(AlStatusCode));
}

#[test]
fn a_restart_shows_what_the_unit_says_until_it_is_acknowledged() {
    for (start, status) in
        [(Start::Restart, (0x11, 0x0060)), (Start::PowerOn, (0x01, 0)), (Start::EscReset, (0x01, 0))]
    {
        let mut bench = Bench::in_state(Op);
        bench.network.restart(0, bench.now, start);
        assert_eq!(bench.status(), status);
        assert_eq!(bench.unit().restarted, Some(start));
        bench.request(0x11);
        assert_eq!(bench.status(), (0x01, 0));
        bench.bring_to(Op);
    }
}

#[test]
fn a_unit_may_stay_in_op_when_it_refuses() {
    let config = DeviceConfig { refused_in_op: RefusedInOp::StayInOp, ..config() };
    for (request, code) in [(0x05, 0x12), (0x03, 0x11)] {
        let mut bench = Bench::with(config.clone());
        bench.bring_to(Op);
        bench.cycle(1);
        bench.request(request);
        assert_eq!(bench.status(), (0x18, code));
        assert_eq!(bench.cycle(1).1, 3, "process data go on");
        bench.request(0x18);
        assert_eq!(bench.status(), (0x08, 0));
    }
}

#[test]
fn the_unit_hears_all_that_the_stack_finds_and_the_first_is_shown() {
    let mut bench = Bench::in_state(PreOp);
    bench.write(0x0810, &[0x00, 0x10, 2, 0, 0x66, 0, 1, 0]);
    bench.write(0x0818, &[0x00, 0x11, 2, 0, 0x20, 0, 1, 0]);
    bench.write(0x0981, &[1]);
    bench.request(SafeOp.bits());
    assert_eq!(bench.status(), (0x12, 0x1D));
    assert_eq!(bench.unit().told, [0x1D, 0x1E, 0x30, 0x29].map(AlStatusCode));
}

#[test]
fn the_unit_hears_why_it_leaves_a_state() {
    let mut bench = Bench::in_state(Op);
    bench.cycle(1);
    bench.run_for(Duration::from_millis(101));
    bench.request(0x05);
    bench.request(0x15);
    assert_eq!(bench.unit().told, [0x1B, 0x12].map(AlStatusCode), "an error has to be acknowledged first");
}

/// Number of slaves that a frame reaches.
fn count(bench: &mut Bench) -> u16 {
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0, 0]).finish();
    bench.network.frame(bench.now, &mut frame);
    returned_datagrams(&frame).first().map_or(0, |datagram| datagram.working_counter)
}

#[test]
fn a_slave_without_power_closes_the_line_in_front_of_it_and_a_cable_needs_power_at_both_ends() {
    let mut bench = Bench::new();
    bench.network = Network::power_on((0..3).map(|_| (config(), Digital8::default())), bench.now);
    assert_eq!(count(&mut bench), 3);
    bench.network.power_off(1, bench.now);
    bench.run_for(Duration::from_secs(1));
    assert_eq!(count(&mut bench), 1);
    bench.network.set_cable(2, false);
    bench.network.restart(1, bench.now, Start::PowerOn);
    assert_eq!(count(&mut bench), 2, "a cable that was pulled meanwhile stays so");
    bench.network.set_cable(2, true);
    assert_eq!(count(&mut bench), 3);
    bench.network.power_off(1, bench.now);
    bench.network.set_cable(1, false);
    bench.network.set_cable(1, true);
    assert_eq!(count(&mut bench), 1, "a cable without power at its end carries nothing");
}

/// Only power starts a slave without power: support software and the master do not reach it.
#[test]
fn a_slave_without_power_does_not_restart() {
    for start in [Start::Restart, Start::EscReset] {
        let mut bench = Bench::new();
        bench.network = Network::power_on((0..2).map(|_| (config(), Digital8::default())), bench.now);
        bench.network.power_off(1, bench.now);
        bench.network.restart(1, bench.now, start);
        bench.run_for(Duration::from_secs(1));
        let device = bench.network.device(1).expect("two slaves");
        assert!(device.is_off() && device.unit().restarted.is_none(), "{start:?}");
        assert_eq!(count(&mut bench), 1, "{start:?}");
        bench.network.restart(1, bench.now, Start::PowerOn);
        assert_eq!(count(&mut bench), 2, "{start:?}");
    }
}
