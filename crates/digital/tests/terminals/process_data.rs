//! Levels between frames and the wiring.

use digital::{BitImages, Terminal};
use proptest::prelude::*;
use time::Duration;
use unit_model::{DataValid, ModelUnit};

use crate::bench::{Bench, terminal};

#[test]
fn outputs_go_out_with_their_frame() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    assert_eq!(bench.cycle(&[0xA5]).1, 2);
    assert_eq!(bench.wiring(0).outputs, 0xA5);
}

#[test]
fn inputs_are_there_within_a_millisecond() {
    let mut bench = Bench::in_op(&terminal(0, 16));
    bench.wiring(0).inputs = 0xFFFF_1234;
    bench.access.run_for(Duration::from_millis(1));
    assert_eq!(bench.cycle(&[0, 0]), (vec![0x34, 0x12], 1));
}

/// C082, and below SAFE-OP.
#[test]
fn outputs_are_off_below_op() {
    for state in [4, 2, 1] {
        let mut bench = Bench::in_op(&terminal(8, 0));
        bench.cycle(&[0xFF]);
        bench.request(0, state);
        assert_eq!(bench.wiring(0).outputs, 0, "state {state}");
        bench.cycle(&[0xFF]);
        assert_eq!(bench.wiring(0).outputs, 0, "state {state}");
    }
}

#[test]
fn outputs_are_off_without_power() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    bench.cycle(&[0xFF]);
    let now = bench.access.now();
    bench.access.line.network.power_off(0, now);
    assert_eq!(bench.wiring(0).outputs, 0);
}

#[test]
fn an_esc_reset_switches_the_outputs_off() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    bench.cycle(&[0xFF]);
    for letter in *b"RES" {
        bench.write(0, 0x0040, &[letter]);
    }
    assert_eq!(bench.wiring(0).outputs, 0);
}

/// With its own timer a terminal polls only for inputs.
#[test]
fn a_terminal_without_inputs_sleeps_until_its_watchdog() {
    let mut bench = Bench::in_op(&terminal(8, 0));
    assert_eq!(bench.access.line.network.deadline(), time::Instant::NEVER);
    bench.cycle(&[1]);
    assert_eq!(bench.access.line.network.deadline(), bench.access.now() + Duration::from_millis(100));
}

#[test]
fn process_data_are_valid_where_the_state_has_them_and_outputs_have_come() {
    let mut bench = Bench::in_op(&terminal(8, 8));
    let valid = |bench: &Bench<Terminal<BitImages>>| {
        bench.access.line.network.device(0).expect("a terminal").unit().data_valid()
    };
    assert_eq!(valid(&bench), DataValid { outputs: false, inputs: true });
    bench.cycle(&[1, 0]);
    assert_eq!(valid(&bench), DataValid { outputs: true, inputs: true });
    bench.request(0, 4);
    assert_eq!(valid(&bench), DataValid { outputs: false, inputs: true });
    bench.request(0, 2);
    assert_eq!(valid(&bench), DataValid::default());
}

proptest! {
    /// For all numbers of channels, each channel is its bit, in both directions.
    #[test]
    fn every_channel_is_its_own(outputs in 1..=64u8, inputs in 1..=64u8, levels: u64, wired: u64) {
        let mut bench = Bench::in_op(&terminal(outputs, inputs));
        bench.wiring(0).inputs = wired;
        bench.access.run_for(Duration::from_millis(1));
        let (out_bits, all_bits) = (usize::from(outputs), usize::from(outputs) + usize::from(inputs));
        let mut data = vec![0; all_bits.div_ceil(8)];
        for bit in (0..out_bits).filter(|bit| levels >> bit & 1 != 0) {
            data[bit / 8] |= 1 << (bit % 8);
        }
        let (returned, working_counter) = bench.cycle(&data);
        prop_assert_eq!(working_counter, 3);
        prop_assert_eq!(bench.wiring(0).outputs, levels & (u64::MAX >> (64 - outputs)));
        for bit in out_bits..all_bits {
            let level = returned[bit / 8] >> (bit % 8) & 1;
            prop_assert_eq!(u64::from(level), wired >> (bit - out_bits) & 1);
        }
    }
}
