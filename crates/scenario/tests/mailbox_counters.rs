//! The mailbox counters of a master are judged as it sends them, whatever the line does to its messages.

use scenario::{Recording, Report, Scenario};

const NEVER_WRONG: &str = r#"{ never = "the master has sent a wrong mailbox counter to unit 1" }"#;
const PRE_OP: &str =
    r#"{ master = "take unit 1 to PRE-OP" }, { expect = "unit 1 is in PRE-OP", within = "100ms" }"#;
const READ: &str = r#"{ master = "read SDO 1018:04 of unit 1" }"#;
const IDLE: &str = r#"{ expect = "the master has nothing to do", within = "30s" }"#;
/// Reads the same object again and again: requests that have nothing but their counters to tell them apart.
const READ_MUCH: &str =
    r#"{ repeat = 40, every = "5ms", steps = [{ master = "read SDO 1018:04 of unit 1" }] }"#;

fn replay(steps: &[&str]) -> Report {
    let text = format!("title = \"t\"\nlimit = \"60s\"\nsteps = [\n{}\n]\n", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.replay(7, Recording::new(false, false))
}

#[test]
fn a_right_master_is_right_whatever_the_line_does() {
    let faults = [
        r#"{ line = "lose 20 % of the mailbox frames" }"#,
        r#"{ line = "lose the next 1 mailbox frames" }"#,
        r#"{ line = "lose the answers of 20 % of the mailbox frames" }"#,
        r#"{ line = "delay 30 % of the mailbox frames by 3ms" }"#,
        r#"{ line = "delay 30 % of the mailbox frames by 30ms" }"#,
        r#"{ line = "duplicate 30 % of the mailbox frames" }"#,
        r#"{ line = "swap every 7th of the mailbox frames with the next one" }"#,
        r#"{ line = "corrupt 20 % of the mailbox frames on cable 1" }"#,
    ];
    for fault in faults {
        let report =
            replay(&[NEVER_WRONG, PRE_OP, fault, READ_MUCH, r#"{ line = "be quiet" }"#, IDLE, READ, IDLE]);
        assert_eq!(report.failure, None, "{fault}");
    }
}

#[test]
fn a_cable_that_is_pulled_is_no_mistake_of_the_master() {
    let (pull, plug) = (r#"{ line = "unplug cable 1" }"#, r#"{ after = "20ms", line = "plug cable 1" }"#);
    let report = replay(&[NEVER_WRONG, PRE_OP, READ, pull, READ_MUCH, plug, READ_MUCH, IDLE, READ, IDLE]);
    assert_eq!(report.failure, None);
    let again = r#"{ master = "take unit 1 to INIT" }, { expect = "unit 1 is in INIT", within = "1s" }"#;
    let report = replay(&[NEVER_WRONG, PRE_OP, READ, IDLE, pull, plug, again, PRE_OP, READ_MUCH, IDLE]);
    assert_eq!(report.failure, None);
}

#[test]
fn wrong_counters_are_found() {
    let message =
        r#"{ master = "send unit 1 the mailbox message 0A 00 00 00 00 13 00 20 40 18 10 04 00 00 00 00" }"#;
    let answered = r#"{ expect = "the master has nothing to do", within = "100ms" }"#;
    let masters: &[(&str, &[&str])] = &[
        (
            "always the same",
            &[
                r#"{ master = "use mailbox counter 3" }"#,
                READ,
                IDLE,
                r#"{ master = "read SDO 1018:01 of unit 1" }"#,
            ],
        ),
        ("not counted", &[r#"{ master = "use mailbox counter 0" }"#, READ]),
        (
            "in a wrong order",
            &[
                r#"{ master = "use mailbox counter 3" }"#,
                READ,
                IDLE,
                r#"{ master = "use mailbox counter 2" }"#,
                READ,
            ],
        ),
        ("the same message again, after its answer", &[message, answered, message]),
    ];
    for (mistake, steps) in masters {
        let steps: Vec<&str> =
            [NEVER_WRONG, PRE_OP].into_iter().chain(steps.iter().copied()).chain([IDLE]).collect();
        let failure = replay(&steps).failure.unwrap_or_else(|| panic!("{mistake}: no mistake is found"));
        assert!(failure.to_string().contains("a wrong mailbox counter"), "{mistake}: {failure}");
    }
}
