//! Expressions of all types, compared with the evaluator.

use proptest::prelude::*;
use st::Fault;

use crate::expression::{VARIABLES, Variables, name_of};
use crate::generator::expression;
use crate::tape::Tape;
use crate::types::{ALL, Kind, LINT, Type};
use crate::values::{DividedByZero, Value, run};

fn variables(tape: &mut Tape<'_>) -> Variables {
    let values =
        |type_: Type, tape: &mut Tape<'_>| (0..VARIABLES).map(|_| Value::random(type_, tape)).collect();
    ALL.into_iter().map(|type_| (type_, values(type_, tape))).collect()
}

fn declarations() -> String {
    let all = ALL.into_iter().flat_map(|type_| {
        (0..VARIABLES).map(move |place| format!("{} : {};\n", name_of(type_, place), type_.name))
    });
    all.collect()
}

fn set(variables: &Variables) -> Vec<(String, String)> {
    let all = variables.iter().flat_map(|(type_, values)| {
        values.iter().enumerate().map(move |(place, value)| (name_of(*type_, place), value.written(*type_)))
    });
    all.collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn an_expression_is_worth_what_the_language_says(
        type_ in prop::sample::select(ALL.to_vec()),
        levels in 1..5_usize,
        values in prop::collection::vec(any::<u32>(), 150),
        choices in prop::collection::vec(any::<u32>(), 200),
    ) {
        let variables = variables(&mut Tape::new(&values));
        let expression = expression(type_, levels, &mut Tape::new(&choices));
        let text = expression.text();
        let (shown, call) = if type_.kind == Kind::Time { (LINT, "TimeToNanoSec") } else { (type_, "") };
        let source = format!("VAR {} result : {}; END_VAR result := {call}({text});", declarations(), shown.name);
        let program = st::compile(&source, &[]);
        prop_assert!(program.is_ok(), "{}: {}", text, program.unwrap_err());
        let (instance, fault) = run(&program.unwrap(), &set(&variables), 100);
        match expression.value(&variables) {
            Err(DividedByZero) => prop_assert_eq!(fault, Some(Fault::DivisionByZero), "{}", text),
            Ok(expected) => {
                prop_assert_eq!(fault, None, "{}", text);
                let found = Value::read(shown, &instance.value("result").expect("a variable"));
                prop_assert!(found.is(expected), "{}: {:?}, not {:?}", text, found, expected);
            }
        }
    }
}
