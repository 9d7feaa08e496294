//! "The last SDO" is the one that was ordered last: until it is answered, answers to older ones are ignored.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Scenario};

/// The step that fails; none if all are fulfilled.
fn failed_step(steps: &[&str]) -> Option<String> {
    let before =
        "{ master = \"take unit 1 to PRE-OP\" },\n{ when = \"unit 1 is in PRE-OP\", master = \"behave\" },";
    let text = format!("title = \"the last SDO\"\nsteps = [\n{before}\n{}\n]", steps.join(",\n"));
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    scenario.replay(1, Recording::new(false, false)).failure.map(|failure| failure.text)
}

const READ_VENDOR: &str = r#"{ master = "read SDO 1018:01 of unit 1" }"#;
const VENDOR_READ: &str = r#"{ expect = "the last SDO gave 83 00 00 00", within = "50ms" }"#;
const READ_SERIAL: &str = r#"{ master = "read SDO 1018:04 of unit 1" }"#;
const SERIAL_READ: &str = r#"{ expect = "the last SDO gave 01 00 00 00", within = "50ms" }"#;
const WRITE_VENDOR: &str = r#"{ master = "write SDO 1018:01 of unit 1 as 00 00 00 00" }"#;
const VENDOR_REFUSED: &str = r#"{ expect = "the last SDO was refused with 0x06010002", within = "50ms" }"#;

#[test]
fn each_sentence_holds_once_its_sdo_is_answered() {
    for (order, answer) in
        [(READ_VENDOR, VENDOR_READ), (READ_SERIAL, SERIAL_READ), (WRITE_VENDOR, VENDOR_REFUSED)]
    {
        assert_eq!(failed_step(&[order, answer, &answer.replace(", within = \"50ms\"", "")]), None);
    }
}

#[test]
fn no_sentence_holds_between_the_order_and_the_answer() {
    for (order, answer, sentence) in [
        (READ_VENDOR, VENDOR_READ, "the last SDO gave 83 00 00 00"),
        (READ_VENDOR, VENDOR_READ, "the last SDO was taken"),
        (WRITE_VENDOR, VENDOR_REFUSED, "the last SDO was refused with 0x06010002"),
    ] {
        // Ordered again, and nothing has happened since.
        let now = format!("{{ expect = \"{sentence}\" }}");
        assert_eq!(failed_step(&[order, answer, order, &now]).as_deref(), Some(sentence));
        // It was true, and is not true while the next one is in progress.
        let lasting = format!("{{ expect = \"{sentence}\", for = \"1ms\" }}");
        assert_eq!(failed_step(&[order, answer, READ_SERIAL, &lasting]).as_deref(), Some(sentence));
    }
}

#[test]
fn when_waits_for_the_answer_to_the_sdo_that_was_ordered_last() {
    let when = r#"{ when = "the last SDO was taken", expect = "the last SDO gave 01 00 00 00" }"#;
    assert_eq!(failed_step(&[READ_VENDOR, VENDOR_READ, READ_SERIAL, when]), None);
}

#[test]
fn of_two_that_wait_the_answer_to_the_older_one_does_not_count() {
    let never = r#"{ never = "the last SDO gave 83 00 00 00" }"#;
    assert_eq!(failed_step(&[never, READ_VENDOR, READ_SERIAL, SERIAL_READ]), None);
}

#[test]
fn an_sdo_on_the_way_to_a_state_does_not_answer_for_the_one_that_waits_behind_it() {
    // The start-up SDOs of the master are all accepted, and the one after them is refused.
    let never = r#"{ never = "the last SDO was taken" }"#;
    let take = r#"{ master = "take unit 1 to SAFE-OP" }"#;
    let refused = VENDOR_REFUSED.replace("50ms", "2s");
    assert_eq!(failed_step(&[take, WRITE_VENDOR, never, &refused]), None);
}

#[test]
fn an_sdo_that_is_given_up_has_no_answer() {
    let mute = r#"{ line = "unplug cable 1" }"#;
    let never = r#"{ never = "the last SDO was taken" }"#;
    let gave_up = r#"{ expect = "the master has given up", within = "6s" }"#;
    assert_eq!(failed_step(&[READ_VENDOR, VENDOR_READ, mute, READ_VENDOR, never, gave_up]), None);
}

#[test]
fn the_last_sdo_of_a_unit_is_not_that_of_another() {
    let text = r#"title = "t"
units = [{ model = "nx-ect101" }, { model = "nx-ect101", name = "N2", serial = 2 }]
steps = [
  { master = "take all units to PRE-OP" },
  { expect = "all units are in PRE-OP", within = "1s" },
  { master = "read SDO 1018:01 of unit 2" },
  { master = "write SDO 1018:01 of unit 1 as 00 00 00 00" },
  { expect = "the last SDO was refused with 0x06010002", within = "50ms" },
  { expect = "the last SDO of unit 1 was refused with 0x06010002" },
  { expect = "the last SDO of unit 2 was taken" },
  { expect = "the last SDO of unit 2 gave 83 00 00 00" },
  { master = "read SDO 1018:01 of unit 2" },
  { expect = "the last SDO of unit 1 was refused with 0x06010002" },
  { expect = "the last SDO of unit 2 was taken" },
]"#;
    let scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    let failure = scenario.replay(1, Recording::new(false, false)).failure.expect("it waits");
    assert_eq!((failure.line, failure.seen.as_str()), (14, "the last SDO is not answered yet"));
    let third = text.replace("of unit 2 gave", "of unit 3 gave");
    let refused = Scenario::parse(&third, |_| Err(String::new())).expect_err("two units").to_string();
    assert!(refused.contains("unit 3 does not exist"), "{refused}");
}
