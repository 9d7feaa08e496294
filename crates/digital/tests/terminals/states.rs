//! The state machine of a terminal: that of reference 5, without a mailbox.

use device::OutputsBeforeOp;
use digital::TerminalSettings;
use time::Duration;

use crate::bench::{Bench, terminal};

#[test]
fn a_coupler_comes_to_op_without_any_settings() {
    let mut bench = Bench::of(&[terminal(0, 0)]);
    for state in [2, 4, 8, 4, 2, 1] {
        bench.request(0, state);
        assert_eq!(bench.status(0), (state, 0));
    }
}

/// C066, C067: outputs off, and their SyncManager closed until the error is acknowledged.
#[test]
fn the_watchdog_switches_the_outputs_off_and_drops_to_safe_op() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    bench.cycle(&[0xFF]);
    bench.access.run_for(Duration::from_micros(99_999));
    assert_eq!((bench.status(0), bench.wiring(0).outputs), ((0x08, 0), 0xFF));
    bench.access.run_for(Duration::from_micros(2));
    assert_eq!((bench.status(0), bench.wiring(0).outputs), ((0x14, 0x1B), 0));
    assert_eq!(bench.cycle(&[0xFF]).1, 0);
    bench.request(0, 0x18);
    assert_eq!(bench.status(0), (0x08, 0));
    bench.cycle(&[0x0F]);
    assert_eq!(bench.wiring(0).outputs, 0x0F);
}

/// C068
#[test]
fn a_watchdog_that_is_off_leaves_the_outputs() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    bench.write(0, 0x0420, &[0, 0]);
    bench.cycle(&[0xFF]);
    bench.access.run_for(Duration::from_secs(10));
    assert_eq!((bench.status(0), bench.wiring(0).outputs), ((0x08, 0), 0xFF));
}

/// C050, C072
#[test]
fn a_wrong_sync_manager_is_refused() {
    let wrong: [(u8, u8, [u8; 8], u16); 5] = [
        (8, 0, [0x00, 0x0F, 2, 0, 0x44, 0, 1, 0], 0x1D),
        (8, 0, [0x00, 0x10, 1, 0, 0x44, 0, 1, 0], 0x1D),
        (8, 0, [0x00, 0x0F, 1, 0, 0x44, 0, 0, 0], 0x1D),
        (0, 8, [0x00, 0x10, 1, 0, 0x04, 0, 1, 0], 0x1E),
        (0, 8, [0x00, 0x10, 1, 0, 0x02, 0, 1, 0], 0x29),
    ];
    for (outputs, inputs, settings, code) in wrong {
        let mut bench = Bench::of(&[terminal(outputs, inputs)]);
        bench.request(0, 2);
        bench.write(0, 0x0800, &settings);
        bench.request(0, 4);
        assert_eq!(bench.status(0), (0x12, code), "{settings:02X?}");
    }
}

/// C042
#[test]
fn there_is_no_boot() {
    let mut bench = Bench::of(&[terminal(8, 0)]);
    bench.request(0, 3);
    assert_eq!(bench.status(0), (0x11, 0x13));
}

/// It has no processor that supports SYNC0.
#[test]
fn dc_activation_is_refused() {
    let mut bench = Bench::of(&[terminal(8, 0)]);
    bench.set_up(0, 0);
    bench.request(0, 2);
    bench.write(0, 0x0981, &[3]);
    bench.request(0, 4);
    assert_eq!(bench.status(0), (0x12, 0x30));
}

/// A terminal without a processor does not wait for outputs, unless configured to do so.
#[test]
fn op_comes_without_outputs_unless_they_are_required() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    bench.access.run_for(Duration::from_secs(10));
    assert_eq!((bench.status(0), bench.wiring(0).outputs), ((0x08, 0), 0));

    let outputs_before_op = OutputsBeforeOp::Within(Duration::from_millis(200));
    let mut bench = Bench::of(&[TerminalSettings { outputs_before_op, ..terminal(8, 0) }]);
    bench.set_up(0, 0);
    for state in [2, 4, 8] {
        bench.request(0, state);
    }
    assert_eq!(bench.status(0), (0x04, 0));
    bench.access.run_for(Duration::from_millis(200));
    assert_eq!(bench.status(0), (0x14, 0x1B));
    bench.request(0, 0x18);
    bench.cycle(&[3]);
    assert_eq!((bench.status(0), bench.wiring(0).outputs), ((0x08, 0), 3));
}

#[test]
fn a_blank_sii_keeps_it_in_init() {
    let mut bench = Bench::of(&[TerminalSettings { is_sii_blank: true, ..terminal(8, 0) }]);
    bench.request(0, 2);
    assert_eq!(bench.status(0), (0x11, 0x51));
}
