//! Edges, bistable blocks and counters, each by a table of calls.

use super::bench::Recorder;
use crate::host::{Alarm, NoHost};
use crate::program::compile;

/// Calls a block once per row: the arguments, and then the outputs.
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
        ("TRUE, FALSE, 2", "TRUE 2"),
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
        ("TRUE, FALSE, 2", "TRUE 0"),
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

/// Monitoring of a pulse, by pins in their order, as in A-4-3 of the unit's manual.
#[test]
fn a_pulse_that_stops_raises_an_alarm_after_the_monitoring_time() {
    let source = "PROGRAM Main
        VAR
            Pulse, Edge, Late, Running : BOOL; Elapsed : TIME;
            EdgeOfPulse : R_TRIG; Keep : RS; Monitor : AccumulationTimer;
        END_VAR
        EdgeOfPulse(Pulse, Edge);
        Keep(Edge, FALSE, Running);
        Monitor(TRUE, T#20ms, Edge, Late, Elapsed);
        IF Late = TRUE THEN
            SetAlarm(16#101, Elapsed, Late);
            Running := FALSE;
        END_IF;
        END_PROGRAM";
    let mut instance = compile(source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
    let mut host = Recorder::default();
    let mut late_ms = None;
    for now_ms in 0..70 {
        // The pulse changes every 5 ms until 40 ms; its last rising edge is at 30 ms.
        let pulse = now_ms < 40 && now_ms / 5 % 2 == 0;
        instance.set("Pulse", if pulse { "TRUE" } else { "FALSE" });
        instance.scan(now_ms * 1_000_000, 1000, &mut host).unwrap();
        if !host.alarms.is_empty() {
            late_ms.get_or_insert(now_ms);
        }
        assert_eq!(instance.value("Running").unwrap() == "TRUE", late_ms.is_none());
    }
    assert_eq!(late_ms, Some(50));
    assert_eq!(host.alarms[0], Alarm { code: 0x101, info_1: 20_000_000, info_2: 1 });
}

#[test]
fn powers_are_the_same_by_operator_and_by_function() {
    let source = "PROGRAM Main
        VAR r : REAL := 1.1; x : LREAL := 1.1; a, b : REAL; c, d : LREAL; END_VAR
        a := r ** r; b := EXPT(r, r); c := x ** x; d := EXPT(In := x, Pwr := x);
        END_PROGRAM";
    let mut instance = compile(source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
    instance.scan(0, 1000, &mut NoHost).unwrap();
    assert_eq!(instance.value("a"), instance.value("b"));
    assert_eq!(instance.value("c"), instance.value("d"));
}

#[test]
fn the_hidden_functions_are_for_the_prelude_alone() {
    for call in ["_Now()", "_ToText(5)", "_NxWriteResult(1)"] {
        let source = format!("PROGRAM Main {call}; END_PROGRAM");
        assert!(compile(&source, &[]).is_err(), "{call}");
    }
}
