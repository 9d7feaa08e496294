//! Any source is handled, and printed output is read back as the same tree.

use proptest::prelude::*;

use super::printed;
use super::read;
use crate::SOURCE_BYTES_MAX;
use crate::problem::PROBLEMS_SOUGHT;
use crate::problems::Problems;
use crate::syntax::ast::{Expression, StatementKind};
use crate::syntax::parse;

/// Pieces that are combined in ways that no programmer would choose.
const PIECES: &[&str] = &[
    "PROGRAM",
    "END_PROGRAM",
    "FUNCTION",
    "END_FUNCTION",
    "FUNCTION_BLOCK",
    "END_FUNCTION_BLOCK",
    "TYPE",
    "END_TYPE",
    "STRUCT",
    "END_STRUCT",
    "VAR",
    "VAR_INPUT",
    "VAR_GLOBAL",
    "END_VAR",
    "RETAIN",
    "CONSTANT",
    "AT",
    "AT IOBus://unit#1/UINTs 01",
    "ARRAY",
    "OF",
    "IF",
    "THEN",
    "ELSIF",
    "ELSE",
    "END_IF",
    "CASE",
    "END_CASE",
    "FOR",
    "TO",
    "BY",
    "DO",
    "END_FOR",
    "WHILE",
    "END_WHILE",
    "REPEAT",
    "UNTIL",
    "END_REPEAT",
    "EXIT",
    "RETURN",
    "AND",
    "OR",
    "NOT",
    "MOD",
    "TRUE",
    ":=",
    "=>",
    ":",
    ";",
    ",",
    ".",
    "..",
    "(",
    ")",
    "[",
    "]",
    "^",
    "+",
    "-",
    "*",
    "**",
    "/",
    "&",
    "=",
    "<>",
    "<",
    "==",
    "&&",
    "{",
    "}",
    "(*",
    "*)",
    "/*",
    "*/",
    "//",
    "\n",
    "'",
    "\"",
    "$",
    "a",
    "b",
    "INT",
    "STRING",
    "END",
    "ENDIF",
    "METHOD",
    "END_METHOD",
    "1",
    "16#FF",
    "1.5",
    "1e",
    "T#1s",
    "INT#",
    "D#1",
    "Colour#red",
    "0x1",
    "%IW0",
    "€",
    "#",
];

/// Reads it twice: the reports are equal, everything is inside the source, and there are no more than the
/// maximum number of problems.
fn look_at(source: &str) {
    let (file, problems) = parse(source);
    assert!(problems.len() <= PROBLEMS_SOUGHT);
    for problem in &problems {
        assert!(source.get(problem.span.range()).is_some(), "{:?}", problem);
    }
    assert_eq!(parse(source).1, problems);
    drop(file);
    let _ = Problems::new(source, problems).to_string();
}

fn leaf() -> impl Strategy<Value = String> {
    let leaves =
        ["a", "bc", "TRUE", "15", "1.5", "INT#-5", "WORD#16#FF", "T#5ms", "'x'", "Colour#red", "REAL#2.5"];
    prop::sample::select(leaves.to_vec()).prop_map(str::to_owned)
}

/// Expressions with full parentheses, as they are printed.
fn expression() -> impl Strategy<Value = String> {
    let operators =
        ["**", "*", "/", "MOD", "+", "-", "<", "<=", ">", ">=", "=", "<>", "AND", "XOR", "OR"].to_vec();
    leaf().prop_recursive(6, 40, 3, move |inner| {
        let operator = prop::sample::select(operators.clone());
        let sign = prop::sample::select(vec!["-", "+", "NOT "]);
        prop_oneof![
            (inner.clone(), operator, inner.clone())
                .prop_map(|(left, sign, right)| format!("({left} {sign} {right})")),
            (sign, inner.clone()).prop_map(|(sign, operand)| format!("({sign}{operand})")),
            (inner.clone(), inner.clone()).prop_map(|(first, second)| format!("v[{first}, {second}].m")),
            (inner.clone(), inner)
                .prop_map(|(first, second)| format!("f({first}, In := {second}, NOT Q => v)")),
        ]
    })
}

fn value_of(source: &str) -> Expression {
    let mut file = read(&format!("x := {source};"));
    let body = file.units.pop().map(|unit| unit.body).unwrap_or_default();
    match body.into_iter().next().map(|statement| statement.kind) {
        Some(StatementKind::Assign { value, .. }) => value,
        other => panic!("{other:?}"),
    }
}

proptest! {
    #[test]
    fn any_text_is_read_to_its_end(source in any::<String>()) {
        look_at(&source);
    }

    #[test]
    fn any_order_of_words_and_signs_is_read_to_its_end(
        pieces in prop::collection::vec(prop::sample::select(PIECES.to_vec()), 0..120),
        glue in prop::sample::select(vec!["", " ", "\n"]),
    ) {
        look_at(&pieces.join(glue));
    }

    #[test]
    fn a_printed_expression_reads_back_as_itself(source in expression()) {
        let first = printed::expression(&value_of(&source));
        let second = printed::expression(&value_of(&first));
        prop_assert_eq!(first, second);
    }

    #[test]
    fn parentheses_that_repeat_the_precedence_change_nothing(
        operators in prop::collection::vec(prop::sample::select(
            vec!["**", "*", "/", "MOD", "+", "-", "<", ">=", "=", "<>", "AND", "&", "XOR", "OR"]), 1..12),
    ) {
        let source: String = operators.iter().fold("a".to_owned(), |text, sign| format!("{text} {sign} b"));
        let tree = value_of(&source);
        prop_assert_eq!(source.len(), tree.span.range().len());
        let printed = printed::expression(&tree);
        prop_assert_eq!(printed::expression(&value_of(&printed)), printed);
    }
}

/// Stack enough for the deepest permitted nesting, and far from enough for code that recurses along the source.
const STACK_BYTES: usize = 512 * 1024;

#[test]
fn a_source_full_of_one_thing_is_read_in_bounded_depth() {
    let reader = std::thread::Builder::new().stack_size(STACK_BYTES).spawn(read_sources_full_of_one_thing);
    reader.unwrap().join().unwrap();
}

fn read_sources_full_of_one_thing() {
    let pieces = [
        "(",
        "x := (",
        "IF ",
        "IF a THEN ",
        "a.",
        "[",
        "a[",
        "f(",
        "- ",
        "NOT ",
        "a+",
        "a**",
        "(*",
        "{",
        "'",
        "$",
        "€",
        "CASE n OF 1: ",
        "FOR i := 0 TO 9 DO ",
        "REPEAT ",
        "TYPE a : STRUCT b : ",
        "VAR x : ARRAY[0..1] OF ",
        "VAR ",
        "a,",
        "x := 1 ",
        "x := 1; ",
        "END_IF ",
        "END ",
        "ELSIF a THEN ",
        "PROGRAM a ",
        "a\n",
        "AT a",
        ";",
        "VAR a : P := (b := ",
        "METHOD m ",
        "1(",
        "ARRAY OF ",
        "STRUCT ",
        "AT IOBus:// ",
    ];
    for piece in pieces {
        for opening in ["", "x := ", "VAR x : INT := [", "VAR x : "] {
            let room = SOURCE_BYTES_MAX - opening.len();
            let (_, problems) = parse(&format!("{opening}{}", piece.repeat(room / piece.len())));
            assert!(problems.len() <= PROBLEMS_SOUGHT);
        }
    }
}

#[test]
fn a_long_expression_is_told_and_its_tree_can_be_dropped() {
    let source = format!("x := a{};", "+a".repeat(100_000));
    let (_, problems) = parse(&source);
    assert_eq!(problems.len(), 1);
    assert!(problems[0].message.starts_with("an expression of more than"), "{problems:?}");
}

#[test]
fn a_source_that_is_too_long_is_not_read() {
    let told = |source: &String| crate::compile(source, &[]).expect_err("nothing runs in it").to_string();
    assert!(told(&" ".repeat(SOURCE_BYTES_MAX + 1)).contains("are the most"));
    assert!(!told(&" ".repeat(SOURCE_BYTES_MAX)).contains("are the most"));
}

#[test]
fn names_that_share_a_long_declaration_do_not_multiply_it() {
    let names = "a, ".repeat(1_000);
    let values = "1, ".repeat(100_000);
    let (file, problems) = parse(&format!("VAR {names}b : ARRAY[0..99] OF INT := [{values}1]; END_VAR"));
    assert_eq!(problems.len(), 1);
    assert!(file.units.iter().all(|unit| unit.sections.iter().all(|section| section.variables.is_empty())));
}
