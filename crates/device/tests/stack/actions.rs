//! The actions that a unit requests of the stack, and when they are performed.

use crate::bench::Bench;
use device::{Action, Start};
use wire::AlState::{Init, Op, PreOp};
use wire::{AlStatusCode, Emergency};

/// Adds an action to the unit; the next poll performs it.
fn want(bench: &mut Bench, action: Action) {
    bench.unit().actions.push_back(action);
    bench.network.poll(bench.now);
    let Some((device, esc)) = bench.network.slave_mut(0) else { panic!("there is one unit") };
    device.poll(esc, bench.now);
}

#[test]
fn a_fault_that_is_over_lets_requests_through_once_it_is_acknowledged() {
    let mut bench = Bench::in_state(Op);
    want(&mut bench, Action::Fault(AlStatusCode(0x8004)));
    assert_eq!(bench.status(), (0x11, 0x8004));
    want(&mut bench, Action::FaultEnded);
    assert_eq!(bench.status(), (0x11, 0x8004), "the error stays");
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x11, 0x8004));
    bench.request(PreOp.bits() | 0x10);
    assert_eq!(bench.status(), (0x02, 0));
    want(&mut bench, Action::FaultEnded);
    assert_eq!(bench.status(), (0x02, 0), "there is none");
}

/// A unit whose fault persists reports it again after a restart.
#[test]
fn a_restart_forgets_the_fault() {
    let mut bench = Bench::in_state(Init);
    want(&mut bench, Action::Fault(AlStatusCode(0x8004)));
    bench.network.restart(0, bench.now, Start::PowerOn);
    bench.request(PreOp.bits());
    assert_eq!(bench.status(), (0x02, 0));
    bench.unit().actions.push_back(Action::Fault(AlStatusCode(0x8004)));
    bench.network.restart(0, bench.now, Start::PowerOn);
    assert_eq!(bench.status(), (0x11, 0x8004), "with its first step");
}

#[test]
fn the_last_fault_is_shown() {
    let mut bench = Bench::in_state(Op);
    bench.unit().actions.push_back(Action::Fault(AlStatusCode(0x8004)));
    want(&mut bench, Action::Fault(AlStatusCode(0x8005)));
    assert_eq!(bench.status(), (0x11, 0x8005));
    assert_eq!(bench.unit().states.last(), Some(&Init));
}

#[test]
fn a_station_alias_is_in_the_register_at_once() {
    let mut bench = Bench::in_state(PreOp);
    want(&mut bench, Action::StationAlias(0x1234));
    assert_eq!(bench.word(0x0012), 0x1234);
}

#[test]
fn a_refresh_comes_without_waiting_for_the_timer() {
    let mut bench = Bench::in_state(Op);
    bench.unit().inputs = 0x3C;
    assert_eq!(bench.cycle(0).0, 0);
    want(&mut bench, Action::Refresh);
    assert_eq!(bench.cycle(0).0, 0x3C);
}

#[test]
fn an_emergency_without_a_mailbox_is_lost_and_counted() {
    let mut bench = Bench::in_state(Op);
    want(&mut bench, Action::Emergency(Emergency::default()));
    assert_eq!(bench.network.device(0).map(device::Device::emergencies_lost), Some(1));
}
