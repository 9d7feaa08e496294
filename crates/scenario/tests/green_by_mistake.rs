//! Passes that would check nothing: they are refused, or waited for.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Failure, Recording, Report, Scenario};
use time::Duration;

/// Steps after the unit is in SAFE-OP.
fn in_safe_op(steps: &str) -> String {
    format!(
        "title = \"t\"\nsteps = [\n{{ master = \"take unit 1 to SAFE-OP\" }},\n{{ expect = \"unit 1 is in SAFE-OP\", within = \"1s\" }},\n{{ master = \"stop process data\" }},\n{steps}\n]"
    )
}

fn replay(text: &str) -> Report {
    let scenario =
        Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    scenario.replay(1, Recording::new(true, false))
}

fn failure(text: &str) -> Failure {
    replay(text).failure.expect(text)
}

fn refused(text: &str) -> String {
    Scenario::parse(text, |_| Err(String::new())).expect_err(text).to_string()
}

#[test]
fn the_state_before_a_request_does_not_fulfil_what_is_expected_after_it() {
    let text = in_safe_op(
        r#"{ master = "request OP of unit 1" }, { expect = "unit 1 is in SAFE-OP", within = "1s" }"#,
    );
    let failure = failure(&text);
    assert_eq!((failure.line, failure.at > Duration::from_secs(1)), (6, true), "{failure}");
    assert!(failure.seen.contains("true before the order `request OP of unit 1`"), "{failure}");
    assert!(failure.seen.contains("`for` checks"), "the way out: {failure}");
}

#[test]
fn the_same_holds_behind_other_orders_and_for_outputs_objects_registers_and_errors() {
    for (order, expectation) in [
        (r#"{ master = "take unit 1 to OP" }, { line = "be quiet" }"#, "unit 1 is in SAFE-OP"),
        (r#"{ master = "set the outputs of unit 1 to 2A" }"#, "the outputs of unit 1 begin with 00 00"),
        (r#"{ master = "write SDO 10F3:05 of unit 1 as 01 00" }"#, "object 10F3:05 of unit 1 is 00 00"),
        (r#"{ master = "write register 0x0310 of unit 1 as 05" }"#, "register 0x0310 of unit 1 is 00"),
        (
            r#"{ master = "write register 0x0310 of unit 1 in two halves as 05 00" }"#,
            "register 0x0310 of unit 1 is 00",
        ),
        (
            r#"{ master = "write SDO 10F3:05 of unit 1 in segments as 01 00" }"#,
            "object 10F3:05 of unit 1 is 00 00",
        ),
        (r#"{ master = "request OP of unit 1" }"#, "all of (unit 1 is in SAFE-OP; unit 1 has no error)"),
        (r#"{ master = "request OP of unit 1" }"#, "any of (unit 1 is in SAFE-OP; all units are in SAFE-OP)"),
        (r#"{ line = "unplug cable 1" }, { master = "request OP of unit 1" }"#, "all units are in SAFE-OP"),
        (
            r#"{ cpu = "stop the task of unit 1" }, { unit = "break Processing of unit 1" }"#,
            "unit 1 has no error",
        ),
        (
            r#"{ unit = "power off unit 1" }, { master = "request OP of unit 1" }, { unit = "power on unit 1" }"#,
            "unit 1 is in SAFE-OP",
        ),
        (r#"{ master = "request OP of unit 1" }"#, "not (unit 1 is in OP)"),
        (r#"{ master = "request OP of unit 1" }"#, "RUN of unit 1 is single_flash"),
        (r#"{ master = "request OP of unit 1" }"#, "the data M to C of unit 1 is not valid"),
        (r#"{ master = "write register 0x0310 of unit 1 as 05" }"#, "register 0x0310 of unit 1 is below 5"),
        (
            r#"{ master = "write SDO 10F3:05 of unit 1 by complete access as 01 00" }"#,
            "object 10F3:05 of unit 1 is 00 00",
        ),
        (r#"{ unit = "break Processing of unit 1" }"#, "unit 1 has no new messages"),
    ] {
        let text = in_safe_op(&format!("{order}, {{ expect = \"{expectation}\", within = \"20ms\" }}"));
        assert!(replay(&text).failure.is_some(), "{text}");
    }
}

#[test]
fn the_state_before_process_data_end_does_not_fulfil_what_is_expected_after_it() {
    let op = r#"title = "t"
steps = [
  { master = "take unit 1 to OP" },
  { expect = "unit 1 is in OP", within = "1s" },"#;
    for order in [
        r#"{ master = "stop process data" }"#,
        r#"{ master = "restart" }"#,
        r#"{ line = "unplug cable 1" }"#,
        r#"{ line = "lose all process data frames" }"#,
    ] {
        let before =
            failure(&format!("{op} {order}, {{ expect = \"unit 1 is in OP\", within = \"20ms\" }}]"));
        assert!(before.seen.contains("and has not been false since"), "{order}: {before}");
        let after = "{ expect = \"unit 1 is in SAFE-OP with AL status code 0x001B\", within = \"101ms\" }";
        assert_eq!(replay(&format!("{op} {order}, {after}]")).failure, None, "{order}");
    }
}

#[test]
fn orders_in_groups_and_expectations_in_groups_and_behind_others_follow_each_other_too() {
    let request = r#"{ master = "request OP of unit 1" }"#;
    let quiet = r#"{ line = "be quiet" }"#;
    let expect = r#"{ expect = "unit 1 is in SAFE-OP", within = "20ms" }"#;
    for steps in [
        format!("{{ steps = [{request}] }}, {expect}"),
        format!("{{ together = [[{request}], [{quiet}]] }}, {expect}"),
        format!("{{ together = [[{quiet}], [{{ steps = [{request}] }}, {quiet}]] }}, {expect}"),
        format!("{{ repeat = 2, every = \"10ms\", steps = [{request}] }}, {expect}"),
        format!("{request}, {{ together = [[{quiet}], [{expect}]] }}"),
        format!("{request}, {{ expect = \"unit 1 has no error\" }}, {expect}"),
    ] {
        let failure = failure(&in_safe_op(&steps));
        assert!(failure.seen.contains("before the order `request OP of unit 1`"), "{steps}: {failure}");
    }
    let later = format!(
        "{{ steps = [{request}] }}, {{ after = \"1ms\", expect = \"unit 1 is in SAFE-OP\", within = \"20ms\" }}"
    );
    assert_eq!(replay(&in_safe_op(&later)).failure, None, "it does not follow at once");
}

#[test]
fn a_state_that_is_left_and_reached_again_is_reached() {
    let text = in_safe_op(
        r#"{ master = "request PRE-OP of unit 1" }, { master = "request SAFE-OP of unit 1" }, { expect = "unit 1 is in SAFE-OP", within = "1s" }"#,
    );
    assert_eq!(replay(&text).failure, None);
    let text = in_safe_op(
        r#"{ master = "request SAFE-OP of unit 1" }, { expect = "unit 1 is in SAFE-OP", within = "1s" }"#,
    );
    assert_eq!(replay(&text).failure, None, "the order asks for it");
}

#[test]
fn an_until_that_is_true_at_once_checks_nothing() {
    for step in [
        r#"{ expect = "unit 1 is in OP", until = "unit 1 is in SAFE-OP" }"#,
        r#"{ never = "unit 1 is in SAFE-OP", until = "unit 1 has no error" }"#,
    ] {
        let failure = failure(&in_safe_op(step));
        assert!(failure.seen.contains("`until` is true already, so nothing is checked"), "{failure}");
    }
}

#[test]
fn a_for_of_no_time_is_refused() {
    let errors = refused(&in_safe_op(r#"{ expect = "unit 1 is in SAFE-OP", for = "0s" }"#));
    assert!(errors.contains("line 6, column 42: a `for` of 0"), "{errors}");
    assert!(errors.contains("such as `for = \"100ms\"`"), "{errors}");
}

#[test]
fn a_never_or_an_order_as_the_last_step_has_its_time() {
    // The watchdog expires 100 ms after the last outputs.
    let op = r#"title = "t"
steps = [
  { master = "take unit 1 to OP" },
  { expect = "unit 1 is in OP", within = "1s" },"#;
    let lose = r#"{ line = "lose all process data frames" }"#;
    let never = r#"{ never = "unit 1 has recorded 85000000" }"#;
    for steps in [format!("{lose}, {never}"), format!("{never}, {lose}")] {
        let failure = failure(&format!("{op} {steps}]"));
        assert_eq!(failure.text, "unit 1 has recorded 85000000");
    }
    let quiet = replay(&format!("{op} {never}]"));
    assert!(quiet.passes() && quiet.lasted > Duration::from_millis(200), "{:?}", quiet.failure);
}

/// What is pending when the last step is done is waited for.
#[test]
fn a_never_as_the_last_step_lasts_until_effects_that_are_pending_have_come() {
    let op = r#"title = "t"
steps = [
  { unit = "let transition OS of unit 1 take 300ms" },
  { master = "take unit 1 to OP" },
  { expect = "unit 1 is in OP", within = "1s" },"#;
    for (steps, condition) in [
        (r#"{ master = "request SAFE-OP of unit 1" }"#, "unit 1 is in SAFE-OP"),
        (
            r#"{ master = "write register 0x0420 of unit 1 as 88 13" }, { expect = "the master has nothing to do", within = "10ms" }, { line = "lose all process data frames" }"#,
            "unit 1 has recorded 85000000",
        ),
        (
            r#"{ line = "lose numbers 400 to 600 of the process data frames" }"#,
            "unit 1 has recorded 85000000",
        ),
    ] {
        let failure = failure(&format!("{op} {steps}, {{ never = \"{condition}\" }}]"));
        assert_eq!(
            (failure.text.as_str(), failure.seen.as_str()),
            (condition, "it holds, and `never` expects that it does not"),
            "{steps}"
        );
    }
    // Frames that do not come, and the limit, end the wait.
    let mailbox =
        r#"{ line = "lose the next 5 mailbox frames of unit 1" }, { never = "unit 1 is in SAFE-OP" }"#;
    let report = replay(&format!("{op} {mailbox}]"));
    assert!(report.passes() && report.lasted < Duration::from_secs(2), "{:?}", report.failure);
    let long =
        r#"{ line = "lose 1 % of the mailbox frames for 1999ms" }, { never = "unit 1 is in SAFE-OP" }"#;
    let report = replay(&format!("{op} {long}]").replace("steps = [", "limit = \"2s\"\nsteps = ["));
    assert!(report.passes() && report.lasted >= Duration::from_secs(2), "{:?}", report.failure);
}

#[test]
fn a_run_ends_when_the_master_has_nothing_to_do() {
    let text = r#"title = "t"
steps = [
  { never = "the master has given up" },
  { master = "take unit 1 to PRE-OP" },
  { expect = "unit 1 is in PRE-OP", within = "1s" },
  { unit = "let the SDOs of unit 1 take 6s" },
  { master = "read SDO 1018:01 of unit 1" },
  { expect = "unit 1 is in PRE-OP" },
]"#;
    let failure = failure(text);
    assert_eq!((failure.line, failure.at), (3, Duration::from_secs(5)), "{failure}");
    let short = failure_of_limit(&text.replace("steps = [", "limit = \"1s\"\nsteps = ["));
    assert!(short.contains("the master is still at: SDO upload 1018:01 of unit 1"), "{short}");
    assert!(short.contains("set `limit` higher"), "{short}");
}

#[test]
fn a_limit_that_leaves_no_time_after_the_last_step_is_a_failure() {
    let text = "title = \"t\"\nlimit = \"100ms\"\nsteps = [{ never = \"unit 1 is in OP\" }]";
    let seen = failure_of_limit(text);
    assert!(seen.contains("before 200ms have passed after the last step; set `limit` higher"), "{seen}");
}

fn failure_of_limit(text: &str) -> String {
    failure(text).seen
}

#[test]
fn an_expectation_while_another_holds_is_checked_to_the_end() {
    let steps = |expectation: &str| {
        format!(
            r#"title = "t"
steps = [
  {{ expect = "{expectation}", while = "unit 1 is in OP" }},
  {{ master = "take unit 1 to OP" }},
  {{ expect = "unit 1 is in OP", within = "1s" }},
  {{ line = "unplug cable 1" }},
  {{ expect = "unit 1 is in SAFE-OP with AL status code 0x001B", within = "1s" }},
]"#
        )
    };
    assert_eq!(replay(&steps("RUN of unit 1 is lit")).failure, None, "it is not lit in SAFE-OP");
    let failure = failure(&steps("unit 1 has new messages"));
    assert_eq!(failure.line, 3, "{failure}");
}

#[test]
fn a_while_that_never_holds_is_a_failure() {
    let text = in_safe_op(
        r#"{ expect = "unit 1 has no error", while = "unit 1 is in OP" }, { expect = "unit 1 is in SAFE-OP", for = "300ms" }"#,
    );
    let failure = failure(&text);
    assert_eq!(failure.line, 6);
    assert!(failure.seen.contains("`while` was never true: unit 1 is in SAFE-OP"), "{failure}");
}

#[test]
fn a_while_has_no_other_time() {
    for step in [
        r#"{ expect = "unit 1 is in OP", while = "unit 1 has no error", within = "1s" }"#,
        r#"{ never = "unit 1 is in OP", while = "unit 1 has no error" }"#,
        r#"{ line = "be quiet", while = "unit 1 has no error" }"#,
    ] {
        let errors = refused(&in_safe_op(step));
        assert!(errors.contains("line 6, column 1") && errors.contains("`while`"), "{errors}");
    }
}

#[test]
fn an_expectation_that_cannot_fail_is_refused() {
    let until = "`until` is the condition of the expectation itself";
    for (step, column, message) in [
        (
            r#"{ expect = "unit 1 is in OP", while = "unit 1 is in OP" }"#,
            39,
            "`while` is the condition of the expectation itself",
        ),
        (r#"{ expect = "unit 1 is in OP", until = "unit 1 is in OP" }"#, 39, until),
        (r#"{ never = "unit 1 is in OP", until = "unit 1 is in OP" }"#, 38, until),
        (
            r#"{ expect = "any of (unit 1 is in OP; not (unit 1 is in OP))", for = "1s" }"#,
            12,
            "it always holds",
        ),
        (r#"{ expect = "not (all of (unit 1 is in OP; unit 1 is in SAFE-OP))" }"#, 12, "it always holds"),
        (
            r#"{ never = "all of (unit 1 is in OP; unit 1 is in SAFE-OP with AL status code 0x001B)" }"#,
            11,
            "it can never hold",
        ),
        (
            r#"{ never = "any of (all of (unit 1 is in OP; unit 1 has no error; not (unit 1 has no error)))", until = "unit 1 is in INIT" }"#,
            11,
            "it can never hold",
        ),
    ] {
        let errors = refused(&in_safe_op(step));
        let place = format!("line 6, column {column}: ");
        assert!(errors.contains(&place) && errors.contains(message), "{step}\n{errors}");
        let way_out = if errors.contains("until") || errors.contains("while") {
            "names another condition"
        } else {
            "leave one of the parts out"
        };
        assert!(errors.contains(way_out), "{errors}");
    }
}

#[test]
fn an_expectation_that_can_fail_is_accepted() {
    for step in [
        r#"{ expect = "unit 1 is in SAFE-OP", while = "unit 1 has no error" }"#,
        r#"{ expect = "any of (unit 1 is in OP; not (unit 1 has no error))", within = "1s" }"#,
        r#"{ never = "all of (unit 1 is in OP; unit 1 has no error)" }"#,
        r#"{ never = "all of (unit 1 is in OP; unit 1 is in OP)" }"#,
        r#"{ never = "all of (unit 1 is in OP; not (unit 1 is in SAFE-OP))" }"#,
        r#"{ expect = "all of (unit 1 is in OP; unit 1 is in SAFE-OP)", within = "1s" }"#,
        // False without power.
        r#"{ expect = "any of (object 1018:01 of unit 1 changes; not (object 1018:01 of unit 1 changes))" }"#,
    ] {
        let text = in_safe_op(step);
        let read = Scenario::parse(&text, |_| Err(String::new()));
        assert!(read.is_ok(), "{step}\n{}", read.err().map(|errors| errors.to_string()).unwrap_or_default());
    }
}
