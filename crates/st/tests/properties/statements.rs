//! Whole programs of branches and loops, compared with the interpreter.

use proptest::prelude::*;

use crate::interpreter::{Interpreter, LOOPS};
use crate::statement::{ELEMENTS, NUMBERS, statements, text};
use crate::tape::Tape;
use crate::values::run;

const DECLARATIONS: &str = "VAR
    x0, x1, x2, x3 : INT;
    f0, f1, f2, f3 : INT;
    w0, w1, w2, w3 : INT;
    a : ARRAY[0..3] OF INT;
END_VAR
";

fn shown(interpreter: &Interpreter) -> Vec<(String, i16)> {
    let named = |name: &str, values: &[i16]| {
        values.iter().enumerate().map(|(place, value)| (format!("{name}{place}"), *value)).collect::<Vec<_>>()
    };
    let elements =
        interpreter.elements.iter().enumerate().map(|(place, value)| (format!("a[{place}]"), *value));
    let [x, f, w] =
        [named("x", &interpreter.numbers), named("f", &interpreter.counters), named("w", &interpreter.turns)];
    x.into_iter().chain(f).chain(w).chain(elements).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn a_program_does_what_its_statements_say(
        numbers in prop::array::uniform4(any::<i16>()),
        elements in prop::array::uniform4(-5..5_i16),
        choices in prop::collection::vec(any::<u32>(), 300),
    ) {
        const { assert!(NUMBERS == 4 && ELEMENTS == 4 && LOOPS == 4) };
        let mut tape = Tape::new(&choices);
        let mut statements = statements(&mut tape, LOOPS, 0);
        statements.extend(self::statements(&mut tape, LOOPS, 0));
        let source = format!("{DECLARATIONS};{}", text(&statements));
        let program = st::compile(&source, &[]);
        prop_assert!(program.is_ok(), "{}\n{}", source, program.unwrap_err());

        let mut interpreter = Interpreter { numbers, elements, ..Interpreter::default() };
        let set = shown(&interpreter).into_iter().map(|(name, value)| (name, value.to_string())).collect::<Vec<_>>();
        interpreter.run(&statements);
        let (instance, fault) = run(&program.unwrap(), &set, 10_000_000);
        prop_assert_eq!(fault, None);
        for (name, expected) in shown(&interpreter) {
            prop_assert_eq!(instance.value(&name), Some(expected.to_string()), "{} of\n{}", name, source);
        }
        // The evaluation in a statement has a small additional cost.
        let statements = interpreter.used;
        prop_assert!((statements..=2 * statements + 1).contains(&instance.used()), "statements of\n{}", source);
    }
}
