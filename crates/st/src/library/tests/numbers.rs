//! Numbers, comparison and selection, against 128-bit integers.

use proptest::prelude::*;

use super::bench::{Bench, call};
use crate::elementary::Elementary::{self, *};
use crate::fault::Fault;
use crate::value::{integer, range, wrap};

const INTEGERS: [Elementary; 8] = [Sint, Int, Dint, Lint, Usint, Uint, Udint, Ulint];

/// An integer type and values of it, among them its limits.
fn integers(count: usize) -> impl Strategy<Value = (Elementary, Vec<u64>)> {
    prop::sample::select(INTEGERS.to_vec()).prop_flat_map(move |elementary| {
        let (least, greatest) = range(elementary);
        let value = prop_oneof![Just(least), Just(greatest), Just(0), Just(1), least..=greatest];
        let bits = value.prop_map(move |number| wrap(elementary, number as u64));
        (Just(elementary), prop::collection::vec(bits, count))
    })
}

fn numbers(elementary: Elementary, values: &[u64]) -> Vec<i128> {
    values.iter().map(|bits| integer(elementary, *bits)).collect()
}

fn holds(values: &[i128], holds: fn(&i128, &i128) -> bool) -> Result<u64, Fault> {
    Ok(values.windows(2).all(|pair| holds(&pair[0], &pair[1])).into())
}

proptest! {
    #[test]
    fn sums_and_products_wrap((elementary, values) in integers(3)) {
        let exact = numbers(elementary, &values);
        let wrapped = |number: i128| Ok(wrap(elementary, number as u64));
        prop_assert_eq!(call("ADD", elementary, &values), wrapped(exact.iter().sum()));
        prop_assert_eq!(call("MUL", elementary, &values), wrapped(exact.iter().fold(1, |all, next| all.wrapping_mul(*next))));
        prop_assert_eq!(call("SUB", elementary, &values[..2]), wrapped(exact[0] - exact[1]));
        prop_assert_eq!(call("ABS", elementary, &values[..1]), wrapped(exact[0].abs()));
        prop_assert_eq!(call("Neg", elementary, &values[..1]), wrapped(-exact[0]));
        let quotient = if exact[1] == 0 { Err(Fault::DivisionByZero) } else { wrapped(exact[0] / exact[1]) };
        prop_assert_eq!(call("DIV", elementary, &values[..2]), quotient);
    }

    #[test]
    fn counting_wraps((elementary, values) in integers(1)) {
        for (name, by) in [("Inc", 1), ("Dec", -1)] {
            let mut bench = Bench::new();
            bench.memory.set(5, values[0]);
            prop_assert_eq!(bench.call(name, elementary, &[5]), Ok(1));
            let expected = wrap(elementary, (integer(elementary, values[0]) + by) as u64);
            prop_assert_eq!(bench.memory.get(5), expected);
        }
    }

    #[test]
    fn the_greatest_the_least_and_the_limited((elementary, values) in integers(4)) {
        let exact = numbers(elementary, &values);
        let as_number = |name: &str, values: &[u64]| call(name, elementary, values).map(|bits| integer(elementary, bits));
        prop_assert_eq!(as_number("MAX", &values), Ok(*exact.iter().max().unwrap()));
        prop_assert_eq!(as_number("MIN", &values), Ok(*exact.iter().min().unwrap()));
        prop_assert_eq!(as_number("LIMIT", &values[..3]), Ok(exact[1].max(exact[0]).min(exact[2])));
    }

    #[test]
    fn comparisons_hold_for_each_and_the_next((elementary, values) in integers(3), equal in any::<bool>()) {
        let values = if equal { vec![values[0]; 3] } else { values };
        let exact = numbers(elementary, &values);
        prop_assert_eq!(call("EQ", elementary, &values), holds(&exact, i128::eq));
        prop_assert_eq!(call("GT", elementary, &values), holds(&exact, i128::gt));
        prop_assert_eq!(call("GE", elementary, &values), holds(&exact, i128::ge));
        prop_assert_eq!(call("LT", elementary, &values), holds(&exact, i128::lt));
        prop_assert_eq!(call("LE", elementary, &values), holds(&exact, i128::le));
        prop_assert_eq!(call("NE", elementary, &values[..2]), holds(&exact[..2], i128::ne));
    }

    #[test]
    fn rounding_gives_the_neighbours(number in -1e15..1e15_f64) {
        let bits = number.to_bits();
        let truncated = call("TRUNC", Lreal, &[bits]).unwrap() as i64;
        prop_assert_eq!(truncated, number as i64);
        let rounded = call("Round", Lreal, &[bits]).unwrap() as i64;
        prop_assert!((rounded as f64 - number).abs() <= 0.5);
        let fraction = f64::from_bits(call("Fraction", Lreal, &[bits]).unwrap());
        prop_assert_eq!(truncated as f64 + fraction, number);
    }
}

#[test]
fn whole_numbers_of_a_real_are_dints() {
    let real = |number: f32| u64::from(number.to_bits());
    let rows = [
        ("Round", 2.5, 2),
        ("Round", 3.5, 4),
        ("Round", -2.6, -3),
        ("TRUNC", 2.9, 2),
        ("TRUNC", -2.9, -2),
        ("TRUNC", 1e20, i64::from(i32::MAX)),
        ("TRUNC", -1e20, i64::from(i32::MIN)),
        ("TRUNC", f32::NAN, 0),
    ];
    for (name, number, expected) in rows {
        assert_eq!(call(name, Real, &[real(number)]), Ok(expected as u64), "{name} of {number}");
    }
}

#[test]
fn functions_of_real_numbers() {
    let half_turn = core::f64::consts::PI;
    let rows: [(&str, &[f64], f64); 15] = [
        ("SQRT", &[2.25], 1.5),
        ("LN", &[core::f64::consts::E], 1.0),
        ("LOG", &[1000.0], 3.0),
        ("EXP", &[0.0], 1.0),
        ("EXPT", &[2.0, 10.0], 1024.0),
        ("SIN", &[half_turn / 2.0], 1.0),
        ("COS", &[half_turn], -1.0),
        ("TAN", &[half_turn / 4.0], 1.0),
        ("ASIN", &[1.0], half_turn / 2.0),
        ("ACOS", &[-1.0], half_turn),
        ("ATAN", &[1.0], half_turn / 4.0),
        ("ATAN2", &[1.0, -1.0], 3.0 * half_turn / 4.0),
        ("RadToDeg", &[half_turn], 180.0),
        ("DegToRad", &[90.0], half_turn / 2.0),
        ("ModReal", &[-7.5, 2.0], -1.5),
    ];
    for (name, arguments, expected) in rows {
        let bits: Vec<_> = arguments.iter().map(|number| number.to_bits()).collect();
        let given = f64::from_bits(call(name, Lreal, &bits).unwrap());
        assert!((given - expected).abs() < 1e-12, "{name}{arguments:?} gives {given}");
        let bits: Vec<_> = arguments.iter().map(|number| u64::from((*number as f32).to_bits())).collect();
        let given = f32::from_bits(call(name, Real, &bits).unwrap() as u32);
        assert!((given - expected as f32).abs() < 1e-5, "{name}{arguments:?} gives {given} as REAL");
    }
}

#[test]
fn outside_their_range_they_give_what_ieee_754_says() {
    let of = |name: &str, number: f64| f64::from_bits(call(name, Lreal, &[number.to_bits()]).unwrap());
    assert!(of("SQRT", -1.0).is_nan());
    assert!(of("ASIN", 1.5).is_nan());
    assert_eq!(of("LN", 0.0), f64::NEG_INFINITY);
    assert_eq!(of("EXP", 1000.0), f64::INFINITY);
}

#[test]
fn sel_and_mux_give_the_chosen_value() {
    assert_eq!(call("MOVE", Int, &[9]), Ok(9));
    assert_eq!(call("SEL", Int, &[0, 10, 20]), Ok(10));
    assert_eq!(call("SEL", Int, &[1, 10, 20]), Ok(20));
    assert_eq!(call("MUX", Int, &[2, 10, 20, 30]), Ok(30));
    let fault = |value| Err(Fault::ArgumentOutOfRange { value, lower: 0, upper: 2 });
    assert_eq!(call("MUX", Int, &[3, 10, 20, 30]), fault(3));
    assert_eq!(call("MUX", Int, &[(-1_i64) as u64, 10, 20, 30]), fault(-1));
}
