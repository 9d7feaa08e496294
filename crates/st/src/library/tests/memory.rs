//! MemCopy and SetBlock, against a slice.

use proptest::prelude::*;

use super::bench::Bench;
use crate::elementary::Elementary::Bool;
use crate::fault::Fault;

/// Slots of the row that contains both arrays.
const SLOTS: u64 = 60;

fn filled() -> (Bench, Vec<u64>) {
    let mut bench = Bench::new();
    let slots: Vec<u64> = (0..SLOTS).map(|slot| 1000 + slot).collect();
    for (slot, value) in slots.iter().enumerate() {
        bench.memory.set(slot as u32, *value);
    }
    (bench, slots)
}

proptest! {
    #[test]
    fn elements_are_copied_also_where_they_overlap(
        each in 1..4_u64, from in 0..10_u64, to in 0..10_u64, size in 0..12_u64,
        name in prop::sample::select(vec!["MemCopy", "AryMove"]),
    ) {
        // Both pins are in one array of ten elements.
        let (mut bench, mut expected) = filled();
        let arguments = [from * each, 10 - from, each, to * each, 10 - to, each, size];
        let result = bench.call(name, Bool, &arguments);
        let available = (10 - from).min(10 - to);
        if size <= available {
            expected.copy_within((from * each) as usize..((from + size) * each) as usize, (to * each) as usize);
            prop_assert_eq!(result, Ok(1));
        } else {
            let available = if size > 10 - from { 10 - from } else { 10 - to };
            prop_assert_eq!(result, Err(Fault::TooManyElements { asked: size, available }));
        }
        prop_assert_eq!(bench.memory.slice(0, SLOTS as u32), expected.as_slice());
    }

    #[test]
    fn elements_are_filled_with_one_value(
        each in 1..4_u64, from in 0..10_u64, to in 0..10_u64, size in 0..12_u64,
    ) {
        let (mut bench, mut expected) = filled();
        let arguments = [from * each, 10 - from, each, to * each, 10 - to, each, size];
        let result = bench.call("SetBlock", Bool, &arguments);
        if size <= 10 - to {
            let value = expected[(from * each) as usize..][..each as usize].to_vec();
            for element in to..to + size {
                expected[(element * each) as usize..][..each as usize].copy_from_slice(&value);
            }
            prop_assert_eq!(result, Ok(1));
        } else {
            prop_assert_eq!(result, Err(Fault::TooManyElements { asked: size, available: 10 - to }));
        }
        prop_assert_eq!(bench.memory.slice(0, SLOTS as u32), expected.as_slice());
    }
}

#[test]
fn copies_cost_budget_by_their_size() {
    let mut bench = Bench::new();
    bench.budget = 3;
    assert_eq!(bench.call("MemCopy", Bool, &[0, 100, 1, 200, 100, 1, 63]), Ok(1));
    assert_eq!(bench.call("MemCopy", Bool, &[0, 100, 1, 200, 100, 1, 64]), Err(Fault::BudgetUsedUp));
    assert_eq!(bench.call("SetBlock", Bool, &[0, 100, 1, 200, 100, 1, 64]), Err(Fault::BudgetUsedUp));
}

#[test]
fn a_negative_size_is_a_fault() {
    let fault = Fault::NegativeNumber { value: -1 };
    for name in ["MemCopy", "AryMove", "SetBlock"] {
        let arguments = [0, 10, 1, 20, 10, 1, (-1_i64) as u64];
        assert_eq!(Bench::new().call(name, Bool, &arguments), Err(fault), "{name}");
    }
}

#[test]
fn a_size_beyond_every_array_is_a_fault_with_its_number() {
    let mut bench = Bench::new();
    bench.ulints = 1 << 6;
    let fault = Fault::TooManyElements { asked: u64::MAX, available: 10 };
    assert_eq!(bench.call("MemCopy", Bool, &[0, 10, 1, 20, 10, 1, u64::MAX]), Err(fault));
}

#[test]
fn the_size_of_an_array_is_counted_from_the_element_on() {
    assert_eq!(Bench::new().call("SizeOfAry", Bool, &[0, 7, 3]), Ok(7));
}
