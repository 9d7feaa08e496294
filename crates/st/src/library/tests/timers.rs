//! Timing diagrams: the time in milliseconds, In, and then Q and ET.

use crate::host::NoHost;
use crate::program::{Instance, compile};

type Row = (u64, bool, bool, u64);

fn start(block: &str, pins: &str, preset: &str) -> Instance {
    let source = format!(
        "PROGRAM Main
        VAR timer : {block}; Input : BOOL; Clear : BOOL; Preset : TIME := {preset}; END_VAR
        timer(In := Input, PT := Preset{pins});
        END_PROGRAM"
    );
    compile(&source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start()
}

fn follow(instance: &mut Instance, rows: &[Row]) {
    for row in rows {
        let (at_ms, input, output, elapsed_ms) = *row;
        assert!(instance.set("Input", if input { "TRUE" } else { "FALSE" }));
        instance.scan(at_ms * 1_000_000, 1000, &mut NoHost).unwrap();
        let seen = ["timer.Q", "timer.ET"].map(|name| instance.value(name).unwrap());
        let elapsed = if elapsed_ms == 0 { "T#0s".to_owned() } else { format!("T#{elapsed_ms}ms") };
        assert_eq!(seen, [output.to_string().to_uppercase(), elapsed], "at {at_ms} ms");
    }
}

#[test]
fn on_delay() {
    follow(
        &mut start("TON", "", "T#10ms"),
        &[
            (0, false, false, 0),
            (1, true, false, 0),
            (6, true, false, 5),
            // In falls too early.
            (8, false, false, 0),
            (20, true, false, 0),
            (29, true, false, 9),
            (30, true, true, 10),
            // ET remains at PT.
            (45, true, true, 10),
            (46, false, false, 0),
            (47, true, false, 0),
        ],
    );
}

#[test]
fn off_delay() {
    follow(
        &mut start("TOF", "", "T#10ms"),
        &[
            (0, false, false, 0),
            (1, true, true, 0),
            (5, true, true, 0),
            (6, false, true, 0),
            (12, false, true, 6),
            // In rises before the time is over.
            (13, true, true, 0),
            (20, false, true, 0),
            (29, false, true, 9),
            (30, false, false, 10),
            (50, false, false, 10),
            (51, true, true, 0),
        ],
    );
}

#[test]
fn pulse() {
    follow(
        &mut start("TP", "", "T#10ms"),
        &[
            (0, true, true, 0),
            (4, false, true, 4),
            // Another edge does not restart it.
            (6, true, true, 6),
            (10, true, false, 10),
            (15, true, false, 10),
            (16, false, false, 0),
            (20, true, true, 0),
            (29, true, true, 9),
            // The pulse ends while In is FALSE.
            (35, false, false, 0),
            (36, true, true, 0),
        ],
    );
}

#[test]
fn accumulation() {
    let mut timer = start("AccumulationTimer", ", Reset := Clear", "T#10ms");
    let rows = [
        (0, false, false, 0),
        (5, true, false, 0),
        (9, true, false, 4),
        (10, false, false, 5),
        // Nothing is added while In is FALSE.
        (50, false, false, 5),
        (60, true, false, 5),
        (64, true, false, 9),
        (65, true, true, 10),
        (99, true, true, 10),
        (100, false, true, 10),
    ];
    follow(&mut timer, &rows);
    assert!(timer.set("Clear", "TRUE"));
    follow(&mut timer, &[(101, true, false, 0), (120, true, false, 0)]);
    assert!(timer.set("Clear", "FALSE"));
    follow(&mut timer, &[(123, true, false, 3), (130, true, true, 10)]);
}

#[test]
fn a_preset_of_nothing_is_over_at_once() {
    for preset in ["T#0s", "T#-5ms"] {
        follow(
            &mut start("TON", "", preset),
            &[(3, false, false, 0), (4, true, true, 0), (5, true, true, 0)],
        );
        follow(
            &mut start("TOF", "", preset),
            &[(3, true, true, 0), (4, false, false, 0), (5, false, false, 0)],
        );
        follow(
            &mut start("TP", "", preset),
            &[(3, true, false, 0), (4, true, false, 0), (5, false, false, 0)],
        );
        let rows = [(3, false, false, 0), (4, true, true, 0), (5, false, true, 0)];
        follow(&mut start("AccumulationTimer", ", Reset := Clear", preset), &rows);
    }
}

#[test]
fn a_preset_that_changes_counts_while_the_time_runs() {
    let mut timer = start("TON", "", "T#10ms");
    follow(&mut timer, &[(0, true, false, 0), (8, true, false, 8)]);
    assert!(timer.set("Preset", "T#20ms"));
    follow(&mut timer, &[(15, true, false, 15), (21, true, true, 20)]);
    assert!(timer.set("Preset", "T#30ms"));
    follow(&mut timer, &[(25, true, true, 20)]);
}
