//! What a replay says of steps although no expectation fails: they test nothing, have no effect, or come too late.

use scenario::{Recording, Report, Scenario};

const OP: &str = r#"{ master = "take unit 1 to OP" }, { expect = "unit 1 is in OP", within = "1s" }"#;

fn scenario(head: &str, steps: &str) -> Scenario {
    let text = format!("title = \"t\"\n{head}\nsteps = [\n{steps}\n]\n");
    Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{text}\n{errors}"))
}

fn replay(steps: &str) -> Report {
    let report = scenario("", steps).replay(1, Recording::new(false, false));
    assert_eq!(report.failure, None, "{steps}");
    report
}

/// The warnings of steps that pass, as words.
fn warnings(steps: &str) -> Vec<String> {
    replay(steps).warnings.iter().map(ToString::to_string).collect()
}

/// The only warning is about this step and has these words.
fn assert_warned(steps: &str, step: &str, words: &str) {
    let warnings = warnings(steps);
    let is_it = |warning: &String| warning.contains(&format!("`{step}`: ")) && warning.contains(words);
    assert!(matches!(warnings.as_slice(), [one] if is_it(one)), "{steps}: {warnings:?}");
}

fn assert_silent(steps: &str) {
    assert_eq!(warnings(steps), [""; 0], "{steps}");
}

#[test]
fn an_expectation_that_the_state_before_the_orders_fulfils_is_named() {
    let slow = r#"{ unit = "let the SDOs of unit 1 take 30ms" }"#;
    let within = r#"{ expect = "unit 1 is in OP", within = "50ms" }"#;
    let words = "true before the order `let the SDOs of unit 1 take 30ms` already";
    assert_warned(&format!("{OP}, {slow}, {within}"), "unit 1 is in OP", words);
    assert_warned(&format!("{OP}, {{ steps = [{slow}] }}, {within}"), "unit 1 is in OP", words);
    assert_silent(&format!("{OP}, {slow}, {{ expect = \"unit 1 is in OP\", for = \"50ms\" }}"));
    assert_silent(&format!(
        "{OP}, {slow}, {{ after = \"1ms\", expect = \"unit 1 is in OP\", within = \"5ms\" }}"
    ));
    let restart = r#"{ unit = "restart unit 1" }"#;
    let recorded = r#"{ expect = "unit 1 has recorded 94B80000", within = "10ms" }"#;
    assert_silent(&format!("{restart}, {slow}, {recorded}"));
    let busy = r#"{ expect = "the master has nothing to do", within = "50ms" }"#;
    assert_silent(&format!(
        "{OP}, {{ when = \"the master has nothing to do\", master = \"set the outputs of unit 1 to 01\" }}, {busy}"
    ));
}

#[test]
fn in_rounds_an_expectation_tests_something_if_it_does_once() {
    let rounds = |steps: &str| format!("{{ repeat = 3, every = \"1s\", steps = [{steps}] }}");
    let take = r#"{ master = "take unit 1 to OP" }, { expect = "unit 1 is in OP", within = "500ms" }"#;
    assert_silent(&rounds(take));
    assert_warned(&format!("{OP}, {}", rounds(take)), "unit 1 is in OP", "`take unit 1 to OP` already");
}

#[test]
fn an_event_from_before_the_orders_is_old_and_again_expects_a_new_one() {
    let restart = r#"{ unit = "restart unit 1" }"#;
    let first = r#"{ expect = "unit 1 has recorded 94B80000", within = "10ms" }"#;
    let quiet = r#"{ after = "1s", line = "lose the next 1 process data frames" }"#;
    let old = "true before the order `restart unit 1` already";
    let again = r#"{ expect = "unit 1 has recorded 94B80000 again", within = "10ms" }"#;
    assert_warned(
        &format!("{restart}, {first}, {{ after = \"1s\", unit = \"restart unit 1\" }}, {first}"),
        "unit 1 has recorded 94B80000",
        old,
    );
    assert_silent(&format!("{restart}, {again}, {{ after = \"1s\", unit = \"restart unit 1\" }}, {again}"));
    let report = scenario("", &format!("{restart}, {again}, {quiet}, {again}"));
    let failure = report.replay(1, Recording::new(false, false)).failure.map(|failure| failure.seen);
    assert_eq!(failure.as_deref(), Some("unit 1 has recorded it once, not since the order before"));
}

#[test]
fn what_the_master_has_given_up_before_is_not_given_up_again() {
    let refuse = r#"{ unit = "let unit 1 refuse SAFE-OP with AL status code 0x0024" }"#;
    let take = r#"{ master = "take unit 1 to SAFE-OP" }"#;
    let up = |again: &str| format!("{{ expect = \"the master has given up{again}\", within = \"1s\" }}");
    let behave = r#"{ unit = "let unit 1 behave" }, { master = "take unit 1 to OP" }, { expect = "unit 1 is in OP", within = "1s" }"#;
    let steps = format!("{refuse}, {take}, {}, {behave}, {{ expect = \"the master has given up\" }}", up(""));
    assert_silent(&steps);
    let failing =
        scenario("", &format!("{refuse}, {take}, {}, {behave}, {take}, {}", up(" again"), up(" again")));
    let failure = failing.replay(1, Recording::new(false, false)).failure.map(|failure| failure.seen);
    assert_eq!(failure.as_deref(), Some("the master has not given up since the order before"));
}

#[test]
fn a_fault_that_no_frame_has_met_is_named() {
    let lose = |frames: &str| {
        format!("{OP}, {{ line = \"lose {frames}\" }}, {{ expect = \"unit 1 is in OP\", for = \"50ms\" }}")
    };
    assert_warned(&lose("all BRD frames"), "lose all BRD frames", "no frame has met it");
    assert_warned(
        &lose("number 9999 of the frames for 20ms"),
        "lose number 9999 of the frames for 20ms",
        "no frame",
    );
    let named = r#"{ line = "lose all BRD frames called storm" }, { after = "10ms", line = "end storm" }"#;
    assert_warned(
        &format!("{OP}, {named}, {{ expect = \"unit 1 is in OP\" }}"),
        "lose all BRD frames called storm",
        "no frame has met it",
    );
    assert_silent(&lose("number 3 of the frames"));
    assert_silent(&lose("0 % of the frames"));
    assert_silent(&lose("1 % of the BRD frames"));
    let rounds = r#"{ repeat = 2, every = "100ms", steps = [{ line = "lose the next 1 SII frames called one" }, { after = "10ms", line = "end one" }] }"#;
    let taken =
        format!("{{ master = \"take unit 1 to PRE-OP\" }}, {rounds}, {{ expect = \"unit 1 is in PRE-OP\" }}");
    let words = warnings(&taken);
    assert!(words.len() <= 1, "a step is named once: {words:?}");
}

#[test]
fn an_order_that_the_master_has_given_up_and_nobody_looks_at_is_named() {
    let refuse = r#"{ unit = "let unit 1 refuse SAFE-OP with AL status code 0x0024" }, { master = "take unit 1 to OP" }"#;
    let idle = r#"{ expect = "the master has nothing to do", within = "1s" }"#;
    let words = "the master has given it up at ";
    assert_warned(&format!("{refuse}, {idle}"), "take unit 1 to OP", words);
    for looked in [
        "unit 1 is in PRE-OP with AL status code 0x0024",
        "the master has given up",
        "all of (unit 1 has no error; all units are in PRE-OP with AL status code 0x0024)",
    ] {
        assert_silent(&format!("{refuse}, {idle}, {{ expect = \"{looked}\" }}"));
    }
}

#[test]
fn a_file_without_an_expectation_is_named() {
    let take = r#"{ master = "take unit 1 to OP" }"#;
    assert_warned(take, "t", "no step expects anything");
    assert_silent(&format!("{take}, {{ when = \"unit 1 is in OP\", line = \"lose the next 1 frames\" }}"));
    assert_silent(&format!("{take}, {{ steps = [{{ never = \"the master has given up\" }}] }}"));
    let mut golden = scenario("", take);
    golden.golden_trace = Some(String::new());
    assert_eq!(golden.replay(1, Recording::new(false, false)).warnings, []);
}

#[test]
fn a_step_that_comes_later_than_its_time_is_named() {
    let late = |at: &str| format!("{OP}, {{ at = \"{at}\", expect = \"unit 1 is in OP\" }}");
    assert_warned(&late("1ms"), "unit 1 is in OP", "it is due at 1ms and comes at ");
    assert_silent(&late("900ms"));
    let group = format!("{OP}, {{ at = \"1ms\", steps = [{{ expect = \"unit 1 is in OP\" }}] }}");
    assert_warned(&group, "steps", "it is due at 1ms");
}

#[test]
fn an_order_that_finds_nothing_to_do_is_named() {
    let stop = r#"{ master = "stop process data" }"#;
    let force = r#"{ cpu = "force N1_UINTs_01_C_to_M[0] to 5" }"#;
    for (steps, step, words) in [
        (r#"{ line = "be quiet" }"#.to_owned(), "be quiet", "no step has begun a fault of frames"),
        (
            r#"{ cpu = "set unit 1 to RUN mode" }"#.to_owned(),
            "set unit 1 to RUN mode",
            "the CPU Unit of unit 1 is in RUN mode already",
        ),
        (format!("{stop}, {stop}"), "stop process data", "the process data are stopped already"),
        (
            r#"{ cpu = "release N1_UINTs_01_C_to_M[0]" }"#.to_owned(),
            "release N1_UINTs_01_C_to_M[0]",
            "no step has forced N1_UINTs_01_C_to_M[0]",
        ),
        (
            r#"{ cpu = "release all of unit 1" }"#.to_owned(),
            "release all of unit 1",
            "no step has forced a variable",
        ),
        (
            r#"{ cpu = "stop the task of unit 1" }, { cpu = "stop the task of unit 1" }"#.to_owned(),
            "stop the task of unit 1",
            "is without its task already",
        ),
    ] {
        let expectation = r#"{ expect = "unit 1 is in INIT" }"#;
        assert_warned(&format!("{steps}, {expectation}"), step, words);
        assert_silent(&format!("{{ steps = [{steps}] }}, {expectation}"));
    }
    for steps in [
        r#"{ cpu = "set unit 1 to PROGRAM mode" }, { cpu = "set unit 1 to RUN mode" }"#.to_owned(),
        format!("{stop}, {{ master = \"exchange process data every 1ms\" }}, {stop}"),
        format!("{force}, {{ cpu = \"release N1_UINTs_01_C_to_M\" }}"),
        format!("{force}, {{ cpu = \"release all of unit 1\" }}"),
        r#"{ cpu = "start the task of unit 1" }"#.to_owned(),
    ] {
        assert_silent(&format!("{steps}, {{ expect = \"unit 1 is in INIT\" }}"));
    }
}

#[test]
fn a_within_of_0_and_an_empty_title_are_named() {
    assert_warned(
        r#"{ expect = "unit 1 is in INIT", within = "0ms" }"#,
        "unit 1 is in INIT",
        "a `within` of 0 looks once",
    );
    let text = "title = \" \"\nsteps = [{ expect = \"unit 1 is in INIT\" }]";
    let scenario = Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    let warnings = scenario.replay(1, Recording::new(false, false)).warnings;
    assert!(matches!(warnings.as_slice(), [one] if one.text == "title"), "{warnings:?}");
}

#[test]
fn the_working_counter_is_that_of_the_last_cycle() {
    for (order, seen) in [
        (r#"{ line = "unplug cable 1" }"#, "no process data came back"),
        (r#"{ master = "stop process data" }"#, "no process data came back"),
    ] {
        let is_3 = "the working counter of unit 1 is 3";
        let steps = format!(
            "{OP}, {{ expect = \"{is_3}\", for = \"20ms\" }}, {order}, {{ after = \"5ms\", expect = \"{is_3}\" }}"
        );
        let failure = scenario("", &steps).replay(1, Recording::new(false, false)).failure;
        assert_eq!(failure.map(|failure| failure.seen).as_deref(), Some(seen), "{order}");
    }
}

#[test]
fn a_terminal_with_an_error_in_its_state_has_an_error() {
    let head = "units = [{ model = \"nx-ect101\" }, { model = \"digital\", outputs = 8 }]";
    let steps = r#"{ master = "take unit 2 to OP" }, { expect = "unit 2 is in OP", within = "1s" }, { expect = "unit 2 has no error" }, { master = "stop process data" }, { expect = "unit 2 is in SAFE-OP with AL status code 0x001B", within = "200ms" }, { expect = "unit 2 has no error" }"#;
    let failure = scenario(head, steps).replay(1, Recording::new(false, false)).failure;
    assert_eq!(
        failure.map(|failure| failure.seen).as_deref(),
        Some("unit 2 is in SAFE-OP with AL status code 0x001B")
    );
}
