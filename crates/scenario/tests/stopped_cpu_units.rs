//! CPU Units whose task stops and starts again: what the unit notices (80200000), and what ends it.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Scenario};

const SEEDS: core::ops::Range<u64> = 1..11;
const STOP: &str = r#"{ after = "10ms", cpu = "stop the task of unit 1" }"#;
const NOTICED: &str = r#"{ expect = "unit 1 has the error 80200000", within = "1s" }"#;
const START: &str = r#"{ cpu = "start the task of unit 1" }"#;
const RESET: &str = r#"{ unit = "reset the errors of unit 1" }"#;
const NOTHING_NEW: &str = r#"{ expect = "unit 1 has no error", for = "2s" }"#;
const NOTHING_NEW_SOON: &str = r#"{ after = "10ms", expect = "unit 1 has no error", for = "2s" }"#;
const ACTIVE: &str = r#"{ expect = "the I/O data of unit 1 is active", within = "1s" }"#;

const CPU_RACK: &str = r#"{ cpu = "cycle the power of the CPU Rack of unit 1" }"#;
const RESTART: &str = r#"{ unit = "restart unit 1" }"#;
const POWER: &str = r#"{ unit = "cycle the power of unit 1" }"#;

/// What is wrong with these steps when they are replayed with each seed, if anything.
fn failure(unit: &str, steps: &[&str]) -> Option<String> {
    let text = format!("title = \"t\"\nunits = [{{ {unit} }}]\nsteps = [\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    SEEDS.into_iter().find_map(|seed| {
        let report = scenario.replay(seed, Recording::new(true, false));
        let trace = report.recording.trace().unwrap_or_default().to_owned();
        report.failure.map(|failure| format!("{steps:#?}\nseed {seed}: {failure:?}\n{trace}"))
    })
}

/// With both fail-soft operations.
fn expect_in_both(steps: &[&str]) {
    for fail_soft in [true, false] {
        let unit = format!(r#"model = "nx-ect101", cpu.fail_soft = {fail_soft}"#);
        assert_eq!(failure(&unit, steps).unwrap_or_default(), "", "fail_soft = {fail_soft}");
    }
}

fn expect_with_fail_soft(steps: &[&str]) {
    assert_eq!(failure(r#"model = "nx-ect101""#, steps).unwrap_or_default(), "");
}

#[test]
fn a_start_of_the_unit_ends_an_error_whose_cause_is_gone() {
    for pause in ["0s", "100us", "500us", "1ms", "300ms"] {
        let rack = format!(r#"{{ after = "{pause}", cpu = "cycle the power of the CPU Rack of unit 1" }}"#);
        expect_in_both(&[STOP, NOTICED, START, &rack, NOTHING_NEW, ACTIVE]);
        for start in ["restart unit 1", "cycle the power of unit 1"] {
            let order = format!(r#"{{ after = "{pause}", unit = "{start}" }}"#);
            expect_with_fail_soft(&[STOP, NOTICED, START, &order, NOTHING_NEW, ACTIVE]);
        }
    }
}

#[test]
fn the_power_of_the_cpu_rack_starts_the_task_too() {
    expect_in_both(&[STOP, NOTICED, CPU_RACK, NOTHING_NEW, ACTIVE]);
    let refreshing = r#"{ after = "10ms", cpu = "stop I/O refreshing of unit 1" }"#;
    expect_in_both(&[refreshing, NOTICED, CPU_RACK, NOTHING_NEW, ACTIVE]);
}

#[test]
fn without_a_start_up_time_it_is_the_same() {
    for start in [CPU_RACK, POWER, RESTART] {
        let steps = [STOP, NOTICED, START, start, NOTHING_NEW, ACTIVE];
        assert_eq!(failure(r#"model = "nx-ect101", start_up = "0s""#, &steps).unwrap_or_default(), "");
    }
}

#[test]
fn a_task_that_starts_during_the_start_up_is_in_time() {
    for start in [RESTART, POWER] {
        let during = r#"{ after = "100ms", cpu = "start the task of unit 1" }"#;
        expect_with_fail_soft(&[STOP, NOTICED, start, during, NOTHING_NEW, ACTIVE]);
    }
}

#[test]
fn a_task_that_is_still_stopped_after_the_start_is_noticed_again() {
    for start in [RESTART, POWER] {
        let none = r#"{ after = "310ms", expect = "unit 1 has no error" }"#;
        expect_in_both(&[STOP, NOTICED, start, none, NOTICED]);
    }
}

#[test]
fn a_reset_ends_the_error_as_soon_as_the_task_runs() {
    expect_with_fail_soft(&[STOP, NOTICED, START, RESET, NOTHING_NEW, ACTIVE]);
    let reset = r#"{ cpu = "reset the errors of the NX Bus Function Module of unit 1" }"#;
    expect_in_both(&[STOP, NOTICED, START, reset, NOTHING_NEW_SOON, ACTIVE]);
}

#[test]
fn a_reset_ends_nothing_while_the_task_is_stopped() {
    expect_in_both(&[STOP, NOTICED, RESET, r#"{ expect = "unit 1 has the error 80200000" }"#]);
}

#[test]
fn what_stops_before_its_first_task_period_is_noticed() {
    for order in ["stop the task of unit 1", "stop I/O refreshing of unit 1"] {
        for after in ["0s", "100us", "500us", "1ms"] {
            let stop = format!(r#"{{ after = "{after}", cpu = "{order}" }}"#);
            expect_in_both(&[&stop, NOTICED]);
        }
    }
}

#[test]
fn a_stopped_task_is_noticed_after_five_long_periods() {
    let unit = r#"model = "nx-ect101", cpu.task_period = "32ms""#;
    let stop = r#"{ cpu = "stop the task of unit 1" }"#;
    let steps = [stop, r#"{ expect = "unit 1 has no error", for = "158ms" }"#, NOTICED];
    assert_eq!(failure(unit, &steps).unwrap_or_default(), "");
}

/// The values start at 0 when the CPU Unit gets power, as the page for programs says: nothing has been refreshed.
#[test]
fn a_status_that_was_never_refreshed_is_0() {
    let status = r#"{ expect = "variable N1_EtherCAT_Slave_Status has the value 0" }"#;
    let later = r#"{ expect = "variable N1_EtherCAT_Slave_Status has the value 16#0240", within = "1s" }"#;
    let unit = r#"model = "nx-ect101", start_up = "300ms""#;
    assert_eq!(failure(unit, &[status, later]).unwrap_or_default(), "");
    let again = r#"{ after = "50ms", expect = "variable N1_EtherCAT_Slave_Status has the value 0" }"#;
    assert_eq!(failure(unit, &[later, CPU_RACK, again]).unwrap_or_default(), "");
    let breaks_a_rule = r#"model = "nx-ect101", io_allocation = { m_to_c = { uints = ["6000:01", "6000:03"] }, c_to_m = { uints = 6 } }"#;
    assert_eq!(
        failure(
            breaks_a_rule,
            &[status, r#"{ after = "1s", expect = "variable N1_EtherCAT_Slave_Status has the value 0" }"#]
        )
        .unwrap_or_default(),
        ""
    );
}
