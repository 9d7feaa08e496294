//! A unit that falls back while the master waits for a state: the master reports it immediately, and does not
//! wait for a state that cannot be reached.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Scenario};

const TO_SAFE_OP: &str =
    r#"{ master = "take unit 1 to SAFE-OP" }, { expect = "unit 1 is in SAFE-OP", within = "1s" }"#;
const TO_OP: &str = r#"{ master = "take unit 1 to OP" }, { expect = "unit 1 is in OP", within = "1s" }"#;
/// The master gives up within the few polls that are necessary, and not after its 10 s.
const GIVEN_UP: &str = r#"{ expect = "the master has given up", within = "5ms" }"#;

/// The steps, and then the last reason for which the master gave up.
fn reason(steps: &[&str]) -> String {
    let text = format!("title = \"fallen back\"\nsteps = [\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    let replay = scenario.replay(1, Recording::new(true, false));
    assert_eq!(replay.failure.map(|failure| failure.text), None, "{steps:?}");
    let trace = replay.recording.trace().expect("a trace");
    let mut reasons = trace.lines().filter_map(|line| line.split_once("gives up: "));
    reasons.next_back().map_or_else(String::new, |(_, reason)| reason.to_owned())
}

#[test]
fn a_unit_whose_power_is_cycled_on_its_way_up_is_in_init() {
    for (before, slow, wanted) in [
        (
            r#"{ master = "take unit 1 to PRE-OP" }, { expect = "unit 1 is in PRE-OP", within = "1s" }"#,
            "PS",
            "SAFE-OP",
        ),
        (TO_SAFE_OP, "SO", "OP"),
    ] {
        let reason = reason(&[
            before,
            &format!(r#"{{ unit = "let transition {slow} of unit 1 take 1s" }}"#),
            &format!(r#"{{ master = "take unit 1 to {wanted}" }}"#),
            r#"{ after = "500ms", unit = "cycle the power of unit 1" }"#,
            GIVEN_UP,
        ]);
        assert_eq!(reason, format!("unit 1 fell back to INIT, asked for {wanted}"));
    }
}

#[test]
fn a_unit_whose_power_is_cycled_on_its_way_down_is_below_the_state() {
    let reason = reason(&[
        TO_OP,
        r#"{ unit = "let transition OS of unit 1 take 1s" }"#,
        r#"{ master = "take unit 1 to SAFE-OP" }"#,
        r#"{ after = "500ms", unit = "cycle the power of unit 1" }"#,
        GIVEN_UP,
    ]);
    assert_eq!(reason, "unit 1 fell back to INIT, asked for SAFE-OP");
}

/// The state and the AL status code of the unit are both reported.
#[test]
fn a_unit_that_fails_on_its_way_up_shows_its_error() {
    let reason = reason(&[
        TO_SAFE_OP,
        r#"{ unit = "let transition SO of unit 1 take 1s" }"#,
        r#"{ master = "take unit 1 to OP" }"#,
        r#"{ after = "500ms", unit = "break Processing of unit 1" }"#,
        GIVEN_UP,
    ]);
    assert_eq!(reason, "unit 1 fell back to INIT with 0x0001, asked for OP");
}

#[test]
fn a_refused_request_leaves_the_unit_where_it_was() {
    let reason = reason(&[
        TO_SAFE_OP,
        r#"{ unit = "let unit 1 refuse OP with AL status code 0x001D" }"#,
        r#"{ master = "take unit 1 to OP" }"#,
        r#"{ after = "20ms", expect = "the master has given up" }"#,
    ]);
    assert_eq!(reason, "unit 1 stays in SAFE-OP with 0x001D, asked for OP");
}

#[test]
fn a_way_down_is_no_fall_back() {
    for target in ["SAFE-OP", "PRE-OP", "INIT"] {
        let reason = reason(&[
            TO_OP,
            r#"{ unit = "let transition OI of unit 1 take 100ms" }"#,
            &format!(r#"{{ master = "take unit 1 to {target}" }}"#),
            &format!(r#"{{ expect = "unit 1 is in {target}", within = "1s" }}"#),
            r#"{ expect = "the master has nothing to do", within = "1s" }"#,
        ]);
        assert_eq!(reason, "");
    }
}
