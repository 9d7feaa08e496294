//! Every function with any arguments that its pins accept: a result or a fault, never a panic.

use proptest::prelude::*;

use super::bench::Bench;
use crate::elementary::{Class, Elementary};
use crate::library::{Function, Native, Takes, functions};
use crate::types::STRING_CHARACTERS_MAX;
use crate::value::wrap;

/// Elements are in the slots of the third text, variables in the first.
const ELEMENTS: u64 = 500;
const ELEMENTS_COUNT: u64 = 60;

fn of_class(classes: &[Class], choice: usize) -> Elementary {
    let all: Vec<_> =
        Elementary::ALL.into_iter().filter(|elementary| classes.contains(&elementary.class())).collect();
    all[choice % all.len()]
}

/// The type of the generic pins of a call.
fn generic(function: &Function, choice: usize) -> Elementary {
    let classes = function.pins.iter().find_map(|pin| match pin.takes {
        Takes::Generic(classes) | Takes::GenericOrText(classes) | Takes::Variable(classes) => Some(classes),
        _ => None,
    });
    classes.map_or(Elementary::Bool, |classes| of_class(classes, choice))
}

fn arguments(
    bench: &mut Bench,
    takes: Takes,
    elementary: Elementary,
    (bits, choice): (u64, usize),
) -> Vec<u64> {
    match takes {
        Takes::Generic(_) | Takes::GenericOrText(_) => vec![wrap(elementary, bits)],
        Takes::Any(classes) => vec![wrap(of_class(classes, choice), bits)],
        Takes::Fixed(fixed) => vec![wrap(fixed, bits)],
        Takes::Text => {
            let text = vec![bits as u8; choice % (STRING_CHARACTERS_MAX + 1)];
            vec![bench.text((choice % 2) as u32, &text)]
        }
        Takes::Variable(_) => {
            bench.memory.set(ELEMENTS as u32, wrap(elementary, bits));
            vec![ELEMENTS]
        }
        Takes::Elements { .. } => {
            let first = choice as u64 % ELEMENTS_COUNT;
            vec![ELEMENTS + first * 3, ELEMENTS_COUNT - first, 3]
        }
        Takes::Reference => unreachable!("for the prelude alone"),
    }
}

/// Numbers near some limit, and others.
fn bits() -> impl Strategy<Value = u64> {
    prop_oneof![
        0..70_u64,
        (-3..3_i64).prop_map(|number| number as u64),
        any::<u64>(),
        any::<f64>().prop_map(f64::to_bits)
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_result_or_a_fault(
        native in prop::sample::select(functions().map(Native).collect::<Vec<_>>()),
        kind in any::<usize>(),
        given in prop::collection::vec((bits(), 0..5000_usize), 4),
    ) {
        let function = native.0;
        let mut bench = Bench::new();
        bench.budget = 1000;
        let elementary = generic(function, kind);
        let mut all = Vec::new();
        for (pin, given) in function.pins.iter().zip(given) {
            let ulint = matches!(pin.takes, Takes::Any(classes) if of_class(classes, given.1) == Elementary::Ulint);
            bench.ulints |= u64::from(ulint) << all.len();
            all.extend(arguments(&mut bench, pin.takes, elementary, given));
        }
        let result = bench.call(function.name, elementary, &all);
        if let (Ok(bits), Some(of)) = (result, function.result.elementary(elementary)) {
            // A value is represented according to its type.
            prop_assert!(of.class() == Class::Real || bits == wrap(of, bits), "{}{:?} gives {:#x}", function.name, all, bits);
        }
    }
}
