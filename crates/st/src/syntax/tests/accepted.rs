//! Sources without problems.

use super::printed;
use super::read;

/// The statements of a source without a POU, printed.
#[track_caller]
fn body(source: &str) -> String {
    let file = read(source);
    file.units.iter().map(|unit| printed::statements(&unit.body)).collect()
}

#[track_caller]
pub(super) fn value(source: &str) -> String {
    let printed = body(&format!("x := {source};"));
    printed.trim_start_matches("x := ").trim_end_matches(';').to_owned()
}

#[test]
fn operators_bind_as_in_table_71() {
    assert_eq!(value("a OR b XOR c AND d & e"), "(a OR (b XOR ((c AND d) AND e)))");
    assert_eq!(value("a = b <> c < d + e * f ** g"), "((a = b) <> (c < (d + (e * (f ** g)))))");
    assert_eq!(value("-2**2"), "((-2) ** 2)");
    assert_eq!(value("2**-1"), "(2 ** (-1))");
    assert_eq!(value("a**b**c"), "((a ** b) ** c)");
    assert_eq!(value("a - b - c MOD d / e"), "((a - b) - ((c MOD d) / e))");
    assert_eq!(value("NOT a = b"), "((NOT a) = b)");
    assert_eq!(value("- - + NOT a"), "(-(-(+(NOT a))))");
    assert_eq!(value("(a + b) * c"), "((a + b) * c)");
}

#[test]
fn variables_calls_and_enumeration_values() {
    assert_eq!(value("a.b[1,2].c[3][4]"), "a.b[1, 2].c[3][4]");
    assert_eq!(
        value("f(1, In := x, Q => y, NOT Q2 => z, ET =>)"),
        "f(1, In := x, Q => y, NOT Q2 => z, ET => )"
    );
    assert_eq!(value("Colour#red"), "Colour#red");
    assert_eq!(body("t1(); m.t[2](IN := TRUE);"), "t1(); m.t[2](IN := TRUE);");
}

#[test]
fn statements_of_all_kinds() {
    let source = "IF a THEN x := 1; ELSIF b THEN y := 2; ELSE ; END_IF;";
    assert_eq!(body(source), "if a {x := 1;} b {y := 2;} else {;}");
    let source = "CASE n OF 1, 2: a(); 3..5, -1: b(); RED, Colour#GREEN: ; ELSE c(); END_CASE;";
    assert_eq!(body(source), "case n 1, 2: {a();} 3..5, (-1): {b();} RED, Colour#GREEN: {;} else {c();}");
    let source = "FOR i := 0 TO 10 BY 2 DO EXIT; END_FOR; WHILE a DO CONTINUE; END_WHILE;";
    assert_eq!(body(source), "for i 0 to 10 by 2 {exit;} while a {continue;}");
    assert_eq!(body("REPEAT a(); UNTIL b END_REPEAT; RETURN;"), "repeat {a();} until b return;");
}

#[test]
fn comments_pragmas_and_blanks_are_left_aside() {
    let source =
        "\u{FEFF}(* a (* nested *) *) x\u{A0}:=\t1; // end\r\n/* c /* d */ */ {attribute 'x'} y := 2;";
    assert_eq!(body(source), "x := 1; y := 2;");
}
