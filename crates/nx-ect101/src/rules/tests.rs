//! The table of rules, compared with the folder, the events and the times in the manual.

use std::collections::BTreeSet;

use super::*;
use crate::events::Event;
use crate::rule_kind::{Moment, RuleId};

#[test]
fn every_rule_has_its_file_and_every_file_its_rule() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/rules");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder of the rules")
        .map(|file| file.expect("readable").file_name().into_string().expect("a name"))
        .filter(|name| name != "tests.rs")
        .collect();
    let rules: BTreeSet<String> = RULES.iter().map(|rule| format!("{}.rs", rule.id.id())).collect();
    assert_eq!(files, rules);
    for file in files {
        let text = std::fs::read_to_string(format!("{folder}/{file}")).expect("readable");
        assert!(text.starts_with("//! "), "{file} opens with what it asks for");
        for opening in ["//! Passes: ", "//! Fails:  "] {
            assert!(text.contains(opening), "{file} opens with `{opening}`");
        }
    }
}

#[test]
fn rules_are_checked_in_the_order_of_the_table() {
    let ids: Vec<RuleId> = RULES.iter().map(|rule| rule.id).collect();
    assert!(ids.is_sorted(), "{ids:?}");
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), 7);
}

#[test]
fn every_event_of_a_rule_is_one_of_the_manual_and_says_its_direction() {
    for rule in RULES {
        for events in rule.events {
            for direction in Direction::ALL {
                let code = events.of(direction);
                let event = Event::find(code).expect("an event of the manual");
                let words = match direction {
                    Direction::MToC => ["M to C", "RxPDO"],
                    Direction::CToM => ["C to M", "TxPDO"],
                };
                assert!(words.iter().any(|word| event.name.contains(word)), "{code}: {}", event.name);
                let keeps_in_pre_op =
                    matches!(events.moment, Moment::PreOpToSafeOp) && !event.changeable_level;
                assert_eq!(event.al_status_code.is_some(), keeps_in_pre_op, "{code}");
            }
        }
    }
}
