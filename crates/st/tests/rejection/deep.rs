//! The deepest programs that are accepted, on a small stack.

use st::{Fault, NoHost};

use crate::on_a_small_stack;

/// Compiles a program and runs a scan of it.
fn run(source: String) -> Result<Result<(), Fault>, String> {
    on_a_small_stack(move || {
        let program = st::compile(&source, &[]).map_err(|problems| problems.to_string())?;
        let mut instance = program.start();
        Ok(instance.scan(0, 1_000_000, &mut NoHost).map_err(|stopped| stopped.fault))
    })
}

/// An expression of 500 operands around one operand, with a native call for each of a few of them.
fn wide(operand: &str) -> String {
    format!("{operand}{}", " + x".repeat(490))
}

#[test]
fn blocks_of_statements_with_wide_expressions() {
    let nesting = 55;
    let open: String = (0..nesting)
        .map(|level| match level % 4 {
            0 => "IF b THEN x := x; ".to_owned(),
            1 => "WHILE b DO ".to_owned(),
            2 => "REPEAT ".to_owned(),
            _ => "CASE x OF 0..32767: ".to_owned(),
        })
        .collect();
    let close: String = (0..nesting)
        .rev()
        .map(|level| match level % 4 {
            0 => "END_IF; ",
            1 => "EXIT; END_WHILE; ",
            2 => "UNTIL b END_REPEAT; ",
            _ => "END_CASE; ",
        })
        .collect();
    let inner = format!("x := {}; ", wide("ABS(MAX(x, 1, 2, 3))"));
    let source = format!("VAR x : INT; b : BOOL := TRUE; END_VAR {open} {inner} {close}");
    assert_eq!(run(source), Ok(Ok(())));
}

#[test]
fn texts_in_each_other() {
    let nesting = 30;
    let text = format!("{}s{}", "CONCAT(LEFT(".repeat(nesting), ", 200), 'x')".repeat(nesting));
    let source = format!("VAR s : STRING[1986] := 'text'; END_VAR s := {text};");
    assert_eq!(run(source), Ok(Ok(())));
}

/// A chain of functions, each with an expression of this number of operands around the call of the next.
fn chain(length: usize, operands: usize) -> String {
    let functions = (0..length).map(|place| {
        let rest = " + x".repeat(operands);
        let next = place + 1;
        format!(
            "FUNCTION F{place} : INT VAR_INPUT x : INT; END_VAR F{place} := F{next}(x){rest}; END_FUNCTION\n"
        )
    });
    let last = format!("FUNCTION F{length} : INT VAR_INPUT x : INT; END_VAR F{length} := x; END_FUNCTION\n");
    let main = "PROGRAM Main VAR y : INT; END_VAR y := F0(1); END_PROGRAM";
    functions.collect::<String>() + &last + main
}

#[test]
fn a_chain_of_calls_is_accepted_as_deep_as_it_can_run_and_refused_beyond() {
    let mut accepted = 0;
    for (length, operands) in
        [(1, 490), (2, 300), (4, 150), (8, 80), (16, 50), (16, 490), (50, 10), (150, 3), (400, 0)]
    {
        match run(chain(length, operands)) {
            Ok(result) => {
                assert_eq!(result, Ok(()));
                accepted += 1;
            }
            Err(problems) => assert!(problems.contains("nested more than"), "{problems}"),
        }
    }
    assert!(accepted >= 5, "{accepted} chains are accepted");
}

#[test]
fn a_chain_of_calls_as_statements() {
    for length in [100, 200, 300, 400, 990] {
        let functions: String =
            (0..length).map(|place| format!("FUNCTION F{place} F{}(); END_FUNCTION\n", place + 1)).collect();
        let last = format!("FUNCTION F{length} VAR s : STRING; END_VAR s := CONCAT(s, 'x'); END_FUNCTION\n");
        match run(functions + &last + "PROGRAM Main F0(); END_PROGRAM") {
            Ok(result) => assert_eq!(result, Ok(())),
            Err(problems) => assert!(length > 200 && problems.contains("nested more than"), "{problems}"),
        }
    }
}

#[test]
fn instances_in_instances() {
    for depth in [10, 30, 60, 100, 300] {
        let blocks = (0..depth).map(|place| {
            let next = place + 1;
            format!(
                "FUNCTION_BLOCK B{place} VAR b : B{next}; x : INT; END_VAR VAR_INPUT i : INT; END_VAR
                b(i := i{}); END_FUNCTION_BLOCK\n",
                " + i".repeat(3)
            )
        });
        let blocks: String = blocks.collect();
        let source = format!(
            "{blocks} FUNCTION_BLOCK B{depth} VAR_INPUT i : INT; END_VAR END_FUNCTION_BLOCK
            PROGRAM Main VAR b : B0; END_VAR b(i := 1); END_PROGRAM"
        );
        match run(source) {
            Ok(result) => assert_eq!(result, Ok(())),
            Err(problems) => assert!(problems.contains("levels deep"), "{problems}"),
        }
    }
}

#[test]
fn texts_at_the_bottom_of_the_deepest_chain() {
    let mut source = chain(16, 40);
    let text = "LEN(CONCAT(LEFT(INT_TO_STRING(x), 3), REPLACE('abc', 'x', 1, 2)))";
    source = source.replace("F16 := x;", &format!("F16 := UINT_TO_INT({text}){};", " + x".repeat(100)));
    assert_eq!(run(source), Ok(Ok(())));
}
