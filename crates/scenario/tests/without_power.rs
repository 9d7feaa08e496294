//! A unit without power: which orders have an effect on it, and which expectations hold.

use scenario::{Recording, Report, Scenario};

const NO_EFFECT: &str = "unit 1    has no power: the order has no effect";

fn replay(steps: &[String]) -> Report {
    let text = format!("title = \"t\"\nsteps = [\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.replay(1, Recording::new(true, false))
}

fn off_and(steps: &[&str]) -> Report {
    let off = "{ unit = \"power off unit 1\" }".to_owned();
    replay(&[off].into_iter().chain(steps.iter().map(|step| format!("{{ {step} }}"))).collect::<Vec<_>>())
}

/// The events of the unit while it has no power, and whether the trace says that the order has no effect.
fn after_order(order: &str) -> (usize, bool) {
    let report =
        off_and(&[&format!("steps = [{{ unit = \"{order}\" }}]"), "after = \"1s\", line = \"be quiet\""]);
    let trace = report.recording.trace().unwrap_or_default();
    (trace.matches(" records ").count(), trace.contains(NO_EFFECT))
}

#[test]
fn what_the_unit_itself_would_do_has_no_effect() {
    for order in [
        "restart unit 1",
        "power off unit 1",
        "reset the errors of unit 1",
        "clear the system event log of unit 1",
        "clear the access event log of unit 1",
        "break Processing of unit 1",
        "break ClockNotSynchronized of unit 1",
        "break IoCommunications of unit 1",
        "break MessageCommunications of unit 1",
        "keep the SII of unit 1 busy for 100ms",
    ] {
        assert_eq!(after_order(order), (0, true), "{order}");
    }
}

#[test]
fn what_a_hand_does_to_it_has_an_effect() {
    for order in [
        "power on unit 1",
        "cycle the power of unit 1",
        "turn the ID switch of unit 1 to 0x2A",
        "corrupt word 4 of the SII of unit 1",
        "erase the SII of unit 1",
        "break Esc of unit 1",
        "break NonVolatileMemory of unit 1",
        "break SiiVerification of unit 1",
        "repair Processing of unit 1",
        "mend Processing of unit 1",
        "let every transition of unit 1 take 500ms",
        "let transition IP of unit 1 take 500ms",
        "let each SII command of unit 1 take 5ms",
        "let the SDOs of unit 1 take 300ms",
        "let unit 1 refuse OP with AL status code 0x8001",
        "let unit 1 ignore acknowledges",
        "let unit 1 behave",
    ] {
        assert_eq!(after_order(order), (0, false), "{order}");
    }
}

/// A switch that is on cannot be switched on: the unit is not restarted.
#[test]
fn a_unit_with_power_gets_none() {
    let steps = [
        "{ master = \"take unit 1 to OP\" }",
        "{ when = \"unit 1 is in OP\", steps = [{ unit = \"power on unit 1\" }] }",
        "{ expect = \"unit 1 is in OP\", for = \"500ms\" }",
    ];
    let report = replay(&steps.map(str::to_owned));
    let trace = report.recording.trace().unwrap_or_default();
    assert_eq!(report.failure, None, "{trace}");
    assert_eq!(trace.matches("unit 1    has power: the order has no effect").count(), 1, "{trace}");
}

/// A restart by support software does not bring the power back.
#[test]
fn a_restart_starts_no_unit_without_power() {
    let report = off_and(&[
        "unit = \"restart unit 1\"",
        "after = \"1s\", expect = \"RUN of unit 1 is not_lit\"",
        "unit = \"power on unit 1\"",
        "after = \"1s\", expect = \"unit 1 is in INIT\"",
        "expect = \"unit 1 has recorded nothing\"",
    ]);
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

/// Of several units, those with power carry out the order.
#[test]
fn an_order_to_all_units_acts_on_those_with_power() {
    let text = "title = \"t\"\nunits = [{ model = \"nx-ect101\" }, { model = \"nx-ect101\", name = \"N2\", serial = 2 }]\n\
        steps = [\n{ unit = \"power off unit 1\" },\n{ unit = \"restart all units\" },\n\
        { expect = \"unit 2 has recorded 94B80000\" },\n\
        { unit = \"power on unit 1\" },\n{ expect = \"unit 1 has recorded nothing\" },\n]";
    let scenario = Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    let report = scenario.replay(1, Recording::new(true, false));
    let trace = report.recording.trace().unwrap_or_default();
    assert_eq!(report.failure, None, "{trace}");
    assert_eq!(trace.matches("the order has no effect").count(), 1, "{trace}");
    assert!(trace.contains(NO_EFFECT), "{trace}");
}

/// What only a unit with power can show does not hold without power.
#[test]
fn a_unit_without_power_shows_nothing() {
    for condition in [
        "unit 1 is in INIT",
        "unit 1 has no error",
        "all units have no error",
        "unit 1 has no new messages",
        "register 0x0130 of unit 1 is 01 00",
        "object 1018:01 of unit 1 is 83 00 00 00",
        "the data of unit 1 is not valid",
        "the data M to C of unit 1 is not valid",
        "the data C to M of unit 1 is not valid",
        "unit 1 has recorded nothing",
        "unit 1 has recorded 85000000 0 times",
        "the number of records of 85000000 by unit 1 is below 1",
        "the system event log of unit 1 is empty",
        "the access event log of unit 1 has 94B80000 0 times",
        "unit 1 has 0 diagnosis messages",
        "the diagnosis of unit 1 is consistent",
        "no emergency of unit 1 is lost",
        "the outputs of unit 1 begin with 00",
        "output byte 0 of unit 1 is not 01",
        "the I/O data of unit 1 is active",
    ] {
        let step = format!("after = \"1ms\", expect = \"{condition}\"");
        assert_eq!(replay(&[format!("{{ {step} }}")]).failure, None, "{condition}");
        let seen = off_and(&[&step]).failure.map(|failure| failure.seen);
        assert_eq!(seen.as_deref(), Some("unit 1 has no power"), "{condition}");
    }
}

/// Without power nothing is shown that could be contradictory.
#[test]
fn the_diagnosis_of_a_unit_without_power_is_not_contradictory() {
    let seen = off_and(&["after = \"1ms\", expect = \"the diagnosis of unit 1 is contradictory\""])
        .failure
        .map(|failure| failure.seen);
    assert_eq!(seen.as_deref(), Some("unit 1 has no power"));
    let never = off_and(&[
        "never = \"the diagnosis of unit 1 is contradictory\"",
        "after = \"1s\", line = \"be quiet\"",
    ]);
    assert_eq!(never.failure, None);
}

/// What cannot be read is not contradicted either.
#[test]
fn the_contrary_of_what_needs_power_does_not_hold_without_it() {
    let changes = "object 1018:01 of unit 1 changes";
    for (condition, seen) in [
        (format!("not ({changes})"), "unit 1 has no power".to_owned()),
        ("not (output byte 0 of unit 1 changes)".to_owned(), "unit 1 has no power".to_owned()),
        ("not (the diagnosis of unit 1 is contradictory)".to_owned(), "unit 1 has no power".to_owned()),
        (
            format!("any of ({changes}; not ({changes}))"),
            format!("`{changes}`: unit 1 has no power; `not ({changes})`: unit 1 has no power"),
        ),
        (
            format!("not (all of ({changes}; the master has nothing to do))"),
            format!("`{changes}`: unit 1 has no power"),
        ),
    ] {
        let step = format!("after = \"1ms\", expect = \"{condition}\"");
        if !condition.contains("all of") {
            assert_eq!(replay(&[format!("{{ {step} }}")]).failure, None, "{condition}");
        }
        let failure = off_and(&[&step]).failure.map(|failure| failure.seen);
        assert_eq!(failure.as_deref(), Some(seen.as_str()), "{condition}");
    }
    // `never` and a state: nothing of it is there.
    for step in
        [format!("never = \"{changes}\""), "after = \"1ms\", expect = \"not (unit 1 is in INIT)\"".to_owned()]
    {
        assert_eq!(off_and(&[&step]).failure, None, "{step}");
    }
}
