//! Process data between the ECAT side and a unit that is not an NX unit.

use crate::bench::Bench;
use time::Duration;
use wire::AlState::{Init, Op, PreOp, SafeOp};

#[test]
fn outputs_and_inputs_pass_in_op() {
    let mut bench = Bench::in_state(Op);
    bench.unit().inputs = 0xA5;
    bench.cycle(0x3C);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(0x3C));
    assert_eq!(bench.cycle(0x3C), (0xA5, 3));
}

/// C082: SAFE-OP has inputs, and outputs are not applied.
#[test]
fn safe_op_has_inputs_only() {
    let mut bench = Bench::in_state(PreOp);
    bench.unit().inputs = 0x5A;
    bench.bring_to(SafeOp);
    assert_eq!(bench.cycle(0xFF), (0x5A, 3), "inputs are there with the state");
    bench.run_for(Duration::from_millis(2));
    assert_eq!(bench.unit().outputs, None);
}

#[test]
fn outputs_are_not_valid_before_the_first_came() {
    let mut bench = Bench::in_state(Op);
    bench.run_for(Duration::from_millis(2));
    assert_eq!(bench.unit().outputs, None);
}

#[test]
fn outputs_end_with_the_watchdog() {
    let mut bench = Bench::in_state(Op);
    bench.cycle(1);
    bench.run_for(Duration::from_millis(50));
    assert_eq!(bench.unit().outputs, Some(1));
    bench.run_for(Duration::from_millis(60));
    assert_eq!(bench.unit().outputs, None);
}

/// Outputs have been received since PRE-OP, so OP monitors them from its start.
#[test]
fn op_without_new_outputs_ends_with_the_watchdog() {
    let mut bench = Bench::in_state(SafeOp);
    bench.cycle(1);
    bench.run_for(Duration::from_millis(150));
    for request in [0x08, 0x18] {
        bench.request(request);
        assert_eq!(bench.status(), (0x08, 0));
        bench.run_for(Duration::from_millis(99));
        assert_eq!((bench.status().0, bench.unit().outputs), (0x08, None), "the old ones are not valid");
        bench.run_for(Duration::from_millis(2));
        assert_eq!(bench.status(), (0x14, 0x1B));
    }
}

/// They were received in an earlier SAFE-OP: the next OP waits for its first ones.
#[test]
fn op_waits_for_its_first_outputs() {
    let mut bench = Bench::in_state(SafeOp);
    bench.cycle(1);
    bench.request(PreOp.bits());
    bench.request(SafeOp.bits());
    bench.request(Op.bits());
    bench.run_for(Duration::from_secs(1));
    assert_eq!(bench.status(), (0x08, 0));
    bench.cycle(1);
    bench.run_for(Duration::from_millis(101));
    assert_eq!(bench.status(), (0x14, 0x1B));
}

#[test]
fn op_without_a_trigger_has_no_watchdog() {
    let mut bench = Bench::in_state(PreOp);
    bench.set_process_data();
    bench.write(0x0816, &[0]);
    bench.write(0x0810, &[0x00, 0x10, 1, 0, 0x24, 0, 1, 0]);
    bench.request(SafeOp.bits());
    bench.cycle(1);
    bench.request(Op.bits());
    bench.run_for(Duration::from_secs(1));
    assert_eq!(bench.status(), (0x08, 0));
}

#[test]
fn the_unit_is_told_each_state_once() {
    let mut bench = Bench::in_state(Op);
    bench.request(Init.bits());
    assert_eq!(bench.unit().states, [Init, PreOp, SafeOp, Op, Init]);
}

#[test]
fn a_missed_refresh_is_not_made_up_for() {
    let mut bench = Bench::in_state(Op);
    bench.now += Duration::from_secs(1);
    bench.network.poll(bench.now);
    assert!(bench.network.deadline() > bench.now);
}

/// Reference 5.1: below SAFE-OP there are no process data, and data sent before do not return.
#[test]
fn process_data_end_below_safe_op() {
    let mut bench = Bench::in_state(Op);
    bench.write(0x0420, &[0, 0]);
    assert_eq!(bench.cycle(0x55).1, 3);
    bench.request(PreOp.bits());
    assert_eq!(bench.cycle(0x55).1, 0);
    bench.request(SafeOp.bits());
    bench.request(Op.bits());
    bench.run_for(Duration::from_millis(2));
    assert_eq!(bench.unit().outputs, None, "outputs of an earlier OP are not valid");
    bench.cycle(0x66);
    bench.run_for(Duration::from_millis(1));
    assert_eq!(bench.unit().outputs, Some(0x66));
}
