//! What a line refuses, and the words of the refusal.

use ectwin::scenario::model::{CableNumber, LineOrder, UnitOrder};
use ectwin::scenario::words::MASTER;
use ectwin::{Duration, NotHeld, Reason, Refused};

use crate::places::Files;
use crate::{Line, SOON, twin};

fn refused(line: &mut Line, order: &str) -> Refused {
    match line.apply(order) {
        Ok(()) => panic!("`{order}` is carried out"),
        Err(refused) => refused,
    }
}

#[test]
fn each_order_to_the_scripted_master_is_refused_as_such() {
    for mut line in Line::both() {
        for row in MASTER {
            let refused = refused(&mut line, row.example);
            assert_eq!(refused.reason, Reason::ScriptedMaster, "{}", row.example);
        }
    }
}

#[test]
fn a_refusal_says_what_is_wrong_and_what_is_possible() {
    let files = Files::new();
    let cases = [
        ("brake Processing of unit 1", Reason::NoSentence, "break Processing of unit 1"),
        ("break Procesing of unit 1", Reason::NoSentence, "Processing"),
        ("break Processing of unit 3", Reason::NotThere, "the line has 2 units"),
        ("unplug cable 3", Reason::NotThere, "the line has 2 units"),
        ("write N1_Nothing as 1", Reason::NotThere, "N1_Nothing"),
        ("force N1_UINTs_01_C_to_M[0] to 70000", Reason::NotThere, "70000"),
        ("load nowhere.st into unit 1", Reason::NotThere, "nowhere.st"),
        ("load @wrong.st into unit 1", Reason::NotThere, "wrong.st:1:"),
        ("load @other.toml into the SII of unit 1", Reason::NotThere, "other.toml"),
        ("replace unit 1 by nowhere.toml", Reason::NotThere, "nowhere.toml"),
        ("end storm", Reason::NotNow, "storm"),
        ("power on unit 1", Reason::WithoutEffect, "unit 1 has power"),
        ("take unit 1 to OP", Reason::ScriptedMaster, "take unit 1 to OP"),
    ];
    for mut line in Line::both() {
        for (order, reason, words) in cases {
            let refused = refused(&mut line, &files.in_place(order));
            assert_eq!(refused.reason, reason, "{order}: {refused}");
            let said = format!("{refused} {}", refused.nearest.join(" "));
            assert!(said.contains(words), "{order}: {said}");
        }
        line.apply("lose all frames called storm").unwrap();
        assert_eq!(refused(&mut line, "lose all frames called storm").reason, Reason::NotNow);
        line.apply("power off unit 2").unwrap();
        assert_eq!(refused(&mut line, "restart unit 2").reason, Reason::WithoutEffect);
        line.apply("restart all units").unwrap();
    }
}

#[test]
fn an_expectation_that_is_not_fulfilled_says_what_is_seen() {
    for mut line in Line::both() {
        let within = Duration::from_millis(20);
        let error = line.expect("unit 1 is in OP", within).unwrap_err();
        assert_eq!(error.to_string(), "`unit 1 is in OP` was not true within 20ms: unit 1 is in INIT");
        let error = line.expect("unit 9 is in OP", within).unwrap_err();
        assert!(matches!(error, NotHeld::Refused(Refused { reason: Reason::NotThere, .. })), "{error}");
        let error = line.expect("program variable nothing of unit 1 is 1", within).unwrap_err();
        assert!(error.to_string().contains("no variable nothing"), "{error}");
        let error = line.expect("program variable counter of unit 1 is yes", within).unwrap_err();
        assert!(error.to_string().contains("`yes` is not a value of counter"), "{error}");
    }
}

#[test]
fn values_of_programs_are_compared_in_their_notation() {
    for mut line in Line::both() {
        line.apply("force N1_UINTs_01_M_to_C[0] to 16#1F").unwrap();
        line.expect("program variable counter of unit 1 is 16#1F", SOON).unwrap();
        line.expect("program variable counter of unit 1 is 31", SOON).unwrap();
        assert_eq!(line.holds("program variable counter of unit 1 is 30"), Ok(false));
    }
}

#[test]
fn orders_are_also_typed_values() {
    let mut twin = twin();
    let cable = CableNumber::new(1).unwrap();
    twin.apply(LineOrder::Unplug { cable }).unwrap();
    assert_eq!(twin.holds("L/A IN of unit 1 is not_lit"), Ok(true));
    let unit = ectwin::scenario::model::UnitNumber::new(2).unwrap();
    twin.apply(UnitOrder::PowerOff { units: unit.into() }).unwrap();
    assert_eq!(twin.holds("unit 2 is in INIT"), Ok(false));
}
