//! SAFE-OP to OP waits for outputs (reference 5.4, C055, C056).

use crate::bench::{Bench, config};
use device::{DeviceConfig, OutputsBeforeOp};
use time::Duration;
use wire::AlState::{Init, Op, PreOp, SafeOp};

const LIMIT: Duration = Duration::from_millis(200);

/// A unit in SAFE-OP that waits for outputs and has not received any.
fn waiting_bench() -> Bench {
    let mut bench =
        Bench::with(DeviceConfig { outputs_before_op: OutputsBeforeOp::Within(LIMIT), ..config() });
    bench.bring_to(SafeOp);
    bench
}

/// C055
#[test]
fn op_comes_with_the_first_outputs() {
    let mut bench = waiting_bench();
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x04, 0), "SAFE-OP, without an error");
    bench.run_for(Duration::from_millis(150));
    assert_eq!(bench.status(), (0x04, 0));
    assert_eq!(bench.cycle(1).1, 3);
    assert_eq!(bench.status(), (0x08, 0));
    bench.run_for(Duration::from_millis(99));
    assert_eq!(bench.status(), (0x08, 0), "the time of the request is over");
}

#[test]
fn outputs_that_came_in_safe_op_are_enough() {
    let mut bench = waiting_bench();
    bench.cycle(1);
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x08, 0));
}

/// C056
#[test]
fn without_outputs_the_request_is_refused_in_time() {
    let mut bench = waiting_bench();
    bench.request(Op.bits());
    bench.run_for(Duration::from_micros(199_999));
    assert_eq!(bench.status(), (0x04, 0));
    bench.run_for(Duration::from_micros(2));
    assert_eq!(bench.status(), (0x14, 0x1B));
    bench.cycle(1);
    assert_eq!(bench.status(), (0x14, 0x1B), "outputs come too late");
    bench.request(Op.bits() | 0x10);
    assert_eq!(bench.status(), (0x08, 0));
}

/// Outputs of an earlier SAFE-OP do not count for this one.
#[test]
fn outputs_have_to_come_since_safe_op() {
    let mut bench = waiting_bench();
    bench.cycle(1);
    bench.request(PreOp.bits());
    bench.request(SafeOp.bits());
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x04, 0));
    bench.run_for(LIMIT);
    assert_eq!(bench.status(), (0x14, 0x1B));
}

/// When the watchdog has ended OP, new outputs are required too.
#[test]
fn an_acknowledged_fall_back_waits_again() {
    let mut bench = waiting_bench();
    bench.cycle(1);
    bench.request(Op.bits());
    bench.run_for(Duration::from_millis(101));
    assert_eq!(bench.status(), (0x14, 0x1B));
    bench.request(Op.bits() | 0x10);
    assert_eq!(bench.status(), (0x04, 0));
    bench.cycle(1);
    assert_eq!(bench.status(), (0x08, 0));
}

#[test]
fn a_repeated_request_gets_no_more_time() {
    let mut bench = waiting_bench();
    for _ in 0..4 {
        bench.request(Op.bits());
        assert_eq!(bench.status(), (0x04, 0));
        bench.run_for(Duration::from_millis(50));
    }
    assert_eq!(bench.status(), (0x14, 0x1B));
}

#[test]
fn another_request_ends_the_wait() {
    for (state, status) in [(SafeOp, 0x04), (PreOp, 0x02), (Init, 0x01)] {
        let mut bench = waiting_bench();
        bench.request(Op.bits());
        bench.request(state.bits());
        assert_eq!(bench.status(), (status, 0));
        bench.cycle(1);
        bench.run_for(LIMIT * 2);
        assert_eq!(bench.status(), (status, 0), "{state}");
    }
}

/// The Explicit Device ID is shown when OP is reached.
#[test]
fn a_wait_keeps_what_was_asked_for() {
    let mut bench = waiting_bench();
    bench.request(Op.bits() | 0x20);
    assert_eq!(bench.status(), (0x04, 0));
    bench.cycle(1);
    assert_eq!(bench.status(), (0x28, 5));
}

/// The slave does not wait for outputs that are not monitored: no trigger, or a watchdog time of 0.
#[test]
fn outputs_without_a_watchdog_are_not_waited_for() {
    let mut bench = waiting_bench();
    bench.write(0x0420, &[0, 0]);
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x08, 0));

    let mut bench = waiting_bench();
    bench.request(PreOp.bits());
    bench.write(0x0816, &[0]);
    bench.write(0x0810, &[0x00, 0x10, 1, 0, 0x24, 0, 1, 0]);
    bench.request(SafeOp.bits());
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x08, 0));
}

#[test]
fn a_unit_may_not_care() {
    let mut bench = Bench::in_state(SafeOp);
    bench.request(Op.bits());
    assert_eq!(bench.status(), (0x08, 0));
}
