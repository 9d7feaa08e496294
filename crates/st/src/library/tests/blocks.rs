//! Edges, bistable blocks and counters, each by a table of calls.

use crate::host::NoHost;
use crate::program::compile;

/// Calls a block once a row: the arguments, and then the outputs.
fn follow(block: &str, outputs: &str, rows: &[(&str, &str)]) {
    let arms: Vec<_> =
        rows.iter().enumerate().map(|(row, (arguments, _))| format!("{row}: b({arguments});")).collect();
    let source = format!(
        "PROGRAM Main VAR b : {block}; row : DINT := -1; END_VAR
        row := row + 1;
        CASE row OF {} END_CASE;
        END_PROGRAM",
        arms.join("\n")
    );
    let mut instance = compile(&source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
    for (row, (arguments, expected)) in rows.iter().enumerate() {
        instance.scan(0, 1000, &mut NoHost).unwrap();
        let names = outputs.split(' ').map(|name| instance.value(&format!("b.{name}")).unwrap());
        let seen = names.collect::<Vec<_>>().join(" ");
        assert_eq!(seen, *expected, "{block}, row {row}: {arguments}");
    }
}

#[test]
fn a_rising_edge() {
    let rows = [
        ("TRUE", "TRUE"),
        ("TRUE", "FALSE"),
        ("FALSE", "FALSE"),
        ("Clk := FALSE", "FALSE"),
        ("CLK := TRUE", "TRUE"),
    ];
    follow("R_TRIG", "Q", &rows);
}

#[test]
fn a_falling_edge() {
    let rows = [("FALSE", "FALSE"), ("TRUE", "FALSE"), ("FALSE", "TRUE"), ("FALSE", "FALSE")];
    follow("F_TRIG", "Q", &rows);
}

#[test]
fn what_was_set_stays_until_it_is_reset() {
    let rows = [
        ("FALSE, FALSE", "FALSE"),
        ("TRUE, FALSE", "TRUE"),
        ("FALSE, FALSE", "TRUE"),
        ("FALSE, TRUE", "FALSE"),
    ];
    follow("RS", "Q1", &[rows.as_slice(), &[("TRUE, TRUE", "FALSE")]].concat());
    follow("SR", "Q1", &[rows.as_slice(), &[("TRUE, TRUE", "TRUE")]].concat());
}

#[test]
fn counting_up() {
    let rows = [
        ("TRUE, FALSE, 2", "FALSE 1"),
        ("TRUE, FALSE, 2", "FALSE 1"),
        ("FALSE, FALSE, 2", "FALSE 1"),
        ("TRUE, FALSE, 2", "TRUE 2"),
        ("FALSE, FALSE, 2", "TRUE 2"),
        ("TRUE, FALSE, 2", "TRUE 3"),
        ("TRUE, TRUE, 2", "FALSE 0"),
        // The edge during the reset is gone.
        ("TRUE, FALSE, 2", "FALSE 0"),
        ("TRUE, FALSE, 0", "TRUE 0"),
    ];
    follow("CTU", "Q CV", &rows);
}

#[test]
fn counting_down() {
    let rows = [
        ("FALSE, TRUE, 2", "FALSE 2"),
        ("TRUE, FALSE, 2", "FALSE 1"),
        ("FALSE, FALSE, 2", "FALSE 1"),
        ("TRUE, FALSE, 2", "TRUE 0"),
        ("FALSE, FALSE, 2", "TRUE 0"),
        ("TRUE, FALSE, 2", "TRUE -1"),
        ("TRUE, TRUE, -32768", "TRUE -32768"),
        ("FALSE, FALSE, 0", "TRUE -32768"),
        ("TRUE, FALSE, 0", "TRUE -32768"),
    ];
    follow("CTD", "Q CV", &rows);
}

#[test]
fn counting_up_and_down() {
    let rows = [
        ("TRUE, FALSE, FALSE, FALSE, 1", "TRUE FALSE 1"),
        ("FALSE, TRUE, FALSE, FALSE, 1", "FALSE TRUE 0"),
        ("TRUE, FALSE, FALSE, FALSE, 1", "TRUE FALSE 1"),
        ("FALSE, FALSE, FALSE, FALSE, 1", "TRUE FALSE 1"),
        // Both edges at once.
        ("TRUE, TRUE, FALSE, FALSE, 1", "TRUE FALSE 1"),
        ("FALSE, FALSE, FALSE, TRUE, 32767", "TRUE FALSE 32767"),
        ("TRUE, FALSE, FALSE, FALSE, 32767", "TRUE FALSE 32767"),
        ("FALSE, FALSE, TRUE, TRUE, 5", "FALSE TRUE 0"),
    ];
    follow("CTUD", "QU QD CV", &rows);
}

#[test]
fn functions_in_a_program() {
    let source = "PROGRAM Main
        VAR a, b : ARRAY[0..14] OF UINT := [15(7)]; s : STRING[40]; w : WORD; d : DINT; r : REAL := 2.5; q : BOOL; END_VAR
        MemCopy(a[0], b[0], 10#15);
        OutABit(w, 16#0, TRUE);
        SetABit(InOut := w, Pos := 15);
        q := TestABit(w, 16#0) AND NOT TestABit(w, 1);
        d := TRUNC(r) + ROUND(In := r) + MAX(1, 5, 3);
        s := CONCAT('d=', DINT_TO_STRING(d), ' ', WORD_TO_STRING(w), ' ', SEL(q, 'no', 'yes'));
        SetAlarm(16#101, T#5ms, q);
        END_PROGRAM";
    let mut instance = compile(source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
    instance.scan(0, 1000, &mut NoHost).unwrap();
    assert_eq!(instance.value("s").as_deref(), Some("'d=9 8001 yes'"));
}

#[test]
fn the_hidden_functions_are_for_the_prelude_alone() {
    for call in ["_Now()", "_ToText(5)", "_NxWriteResult(1)"] {
        let source = format!("PROGRAM Main {call}; END_PROGRAM");
        assert!(compile(&source, &[]).is_err(), "{call}");
    }
}
