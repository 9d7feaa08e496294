//! Bit strings, against strings of the digits 0 and 1.

use proptest::prelude::*;

use super::bench::{Bench, call};
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::value::wrap;

fn bit_string() -> impl Strategy<Value = (Elementary, u64)> {
    let all: Vec<_> =
        Elementary::ALL.into_iter().filter(|elementary| elementary.class() == Class::BitString).collect();
    (prop::sample::select(all), any::<u64>())
        .prop_map(|(elementary, bits)| (elementary, wrap(elementary, bits)))
}

/// The digits, the highest bit first.
fn digits(elementary: Elementary, bits: u64) -> Vec<char> {
    format!("{bits:0width$b}", width = elementary.bits() as usize).chars().collect()
}

fn number(digits: &[char]) -> u64 {
    u64::from_str_radix(&digits.iter().collect::<String>(), 2).unwrap()
}

proptest! {
    #[test]
    fn rotations_turn_the_digits((elementary, bits) in bit_string(), by in 0..200_usize) {
        let mut left = digits(elementary, bits);
        let width = left.len();
        left.rotate_left(by % width);
        let mut right = digits(elementary, bits);
        right.rotate_right(by % width);
        prop_assert_eq!(call("ROL", elementary, &[bits, by as u64]), Ok(number(&left)));
        prop_assert_eq!(call("ROR", elementary, &[bits, by as u64]), Ok(number(&right)));
    }

    #[test]
    fn shifts_push_zeros_in((elementary, bits) in bit_string(), by in 0..100_usize) {
        let before = digits(elementary, bits);
        let width = before.len();
        let zeros = vec!['0'; by];
        let left = [before.as_slice(), &zeros].concat();
        let right = [zeros.as_slice(), &before].concat();
        prop_assert_eq!(call("SHL", elementary, &[bits, by as u64]), Ok(number(&left[by..])));
        prop_assert_eq!(call("SHR", elementary, &[bits, by as u64]), Ok(number(&right[..width])));
    }

    #[test]
    fn any_number_of_bits_is_shifted_by((elementary, bits) in bit_string(), by in any::<u64>()) {
        let mut bench = Bench::new();
        bench.ulints = 0b10;
        let far = elementary.bits().into()..;
        for name in ["SHL", "SHR"] {
            let shifted = bench.call(name, elementary, &[bits, by]);
            prop_assert!(!far.contains(&by) || shifted == Ok(0), "{} gives {:?}", name, shifted);
        }
        for name in ["ROL", "ROR"] {
            let rest = by % u64::from(elementary.bits());
            prop_assert_eq!(bench.call(name, elementary, &[bits, by]), call(name, elementary, &[bits, rest]));
        }
    }

    #[test]
    fn single_bits_are_found_and_put((elementary, bits) in bit_string(), at in 0..70_u64) {
        let mut expected = digits(elementary, bits);
        expected.reverse();
        let tested = call("TestABit", elementary, &[bits, at]);
        let contrary = call("TestABitN", elementary, &[bits, at]);
        let Some(bit) = expected.get(at as usize).copied() else {
            let fault = Fault::ArgumentOutOfRange { value: at.into(), lower: 0, upper: expected.len() as i64 - 1 };
            prop_assert_eq!([tested, contrary], [Err(fault), Err(fault)]);
            return Ok(());
        };
        prop_assert_eq!(tested, Ok(u64::from(bit == '1')));
        prop_assert_eq!(contrary, Ok(u64::from(bit == '0')));
        for (name, arguments, value) in [
            ("SetABit", vec![0, at], '1'),
            ("ResetABit", vec![0, at], '0'),
            ("OutABit", vec![0, at, 1], '1'),
            ("OutABit", vec![0, at, 0], '0'),
        ] {
            let mut bench = Bench::new();
            bench.memory.set(0, bits);
            prop_assert_eq!(bench.call(name, elementary, &arguments), Ok(1));
            let mut after = expected.clone();
            after[at as usize] = value;
            after.reverse();
            prop_assert_eq!(bench.memory.get(0), number(&after), "{}", name);
        }
    }

    #[test]
    fn rows_of_bits_are_put((elementary, bits) in bit_string(), at in 0..70_usize, size in 0..70_usize) {
        for (name, value) in [("SetBits", '1'), ("ResetBits", '0')] {
            let mut bench = Bench::new();
            bench.memory.set(0, bits);
            let called = bench.call(name, elementary, &[0, at as u64, size as u64]);
            let mut after = digits(elementary, bits);
            after.reverse();
            let fits = at < after.len() && at + size <= after.len();
            prop_assert_eq!(called.is_ok(), fits);
            if fits {
                after[at..at + size].fill(value);
            }
            after.reverse();
            prop_assert_eq!(bench.memory.get(0), number(&after), "{}", name);
        }
    }
}

#[test]
fn swap_exchanges_the_bytes_of_a_word() {
    assert_eq!(call("Swap", Elementary::Bool, &[0x1234]), Ok(0x3412));
}

#[test]
fn a_shift_by_less_than_nothing_is_a_fault() {
    let minus_one = (-1_i64) as u64;
    for name in ["SHL", "SHR", "ROL", "ROR"] {
        let fault = Fault::NegativeNumber { value: -1 };
        assert_eq!(call(name, Elementary::Word, &[1, minus_one]), Err(fault), "{name}");
    }
}
