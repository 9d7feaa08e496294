//! Conversions by name, for all pairs of types.

use proptest::prelude::*;

use crate::tape::Tape;
use crate::types::{ALL, Kind, Type};
use crate::values::{Value, run};

/// The result of a conversion of a value.
pub(crate) fn converted(from: Type, to: Type, value: Value) -> Value {
    match (value, to.kind, to.bits) {
        _ if from == to => value,
        (Value::Whole(number), Kind::Real, 32) => Value::Single(number as f32),
        (Value::Whole(number), Kind::Real, _) => Value::Double(number as f64),
        (Value::Whole(number), Kind::Bool, _) => Value::Whole((number != 0).into()),
        (Value::Whole(number), _, _) => Value::Whole(to.wrapped(number)),
        (real, Kind::Real, 32) => Value::Single(real.double() as f32),
        (real, Kind::Real, _) => Value::Double(real.double()),
        (real, Kind::Bool, _) => Value::Whole((real.double() != 0.0).into()),
        // A bit string accepts the pattern of a signed integer as well as of an unsigned one.
        (real, Kind::Bits, _) => {
            let (_, greatest) = to.limits();
            Value::Whole(to.wrapped(nearest(-(1_i128 << (to.bits - 1)), greatest, real.double())))
        }
        (real, _, _) => {
            let (least, greatest) = to.limits();
            Value::Whole(nearest(least, greatest, real.double()))
        }
    }
}

/// The nearest integer between two limits, halves to the even one.
fn nearest(least: i128, greatest: i128, number: f64) -> i128 {
    if number.is_nan() {
        return 0;
    }
    if number.abs() >= 1e30 {
        return if number < 0.0 { least } else { greatest };
    }
    let below = number.floor();
    let fraction = number - below;
    let below = below as i128;
    let up = fraction > 0.5 || (fraction == 0.5 && below % 2 != 0);
    (below + i128::from(up)).clamp(least, greatest)
}

fn pairs() -> impl Iterator<Item = (Type, Type)> {
    ALL.into_iter().flat_map(|from| ALL.into_iter().map(move |to| (from, to)))
}

#[test]
fn a_time_has_no_conversion_to_a_number_by_name() {
    for (from, to) in pairs() {
        let (a, b) = (from.name, to.name);
        let source = format!("VAR a : {a}; b : {b}; END_VAR b := {a}_TO_{b}(a);");
        let is_time = |type_: Type| type_.kind == Kind::Time;
        assert_eq!(st::compile(&source, &[]).is_ok(), is_time(from) == is_time(to), "{a} to {b}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn all_pairs(choices in prop::collection::vec(any::<u32>(), 64)) {
        let mut tape = Tape::new(&choices);
        for (from, to) in pairs().filter(|(from, to)| from.kind != Kind::Time && to.kind != Kind::Time) {
            let (a, b) = (from.name, to.name);
            let source = format!("VAR a : {a}; b, c : {b}; END_VAR b := {a}_TO_{b}(a); c := TO_{b}(a);");
            let program = st::compile(&source, &[]).expect("a conversion");
            let value = Value::random(from, &mut tape);
            let (instance, fault) = run(&program, &[("a".to_owned(), value.written(from))], 100);
            prop_assert_eq!(fault, None);
            let expected = converted(from, to, value);
            for name in ["b", "c"] {
                let found = Value::read(to, &instance.value(name).expect("a variable"));
                prop_assert!(found.is(expected), "{}_TO_{} of {:?}: {:?}, not {:?}", a, b, value, found, expected);
            }
        }
    }

    #[test]
    fn a_text_of_a_value_is_read_back(choices in prop::collection::vec(any::<u32>(), 64)) {
        let mut tape = Tape::new(&choices);
        for type_ in ALL {
            let t = type_.name;
            let source = format!("VAR a, b : {t}; END_VAR b := STRING_TO_{t}({t}_TO_STRING(a));");
            let program = st::compile(&source, &[]).expect("a conversion");
            let value = Value::random(type_, &mut tape);
            let (instance, fault) = run(&program, &[("a".to_owned(), value.written(type_))], 100);
            prop_assert_eq!(fault, None);
            prop_assert_eq!(instance.value("a"), instance.value("b"));
        }
    }
}
