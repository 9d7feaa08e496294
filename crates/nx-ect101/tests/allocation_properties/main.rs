//! The allocator, compared with an independent model: findings, their order, and every byte of the exchange.

#![expect(clippy::needless_range_loop, reason = "a data set is its number, in several lists at once")]

mod configurations;
mod exchange;
mod files;
mod model;

use std::collections::BTreeSet;

use nx_ect101::Finding;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

use configurations::{Break, any_break, any_settings, right_settings};

/// Cases of each property; together they are more than the 20,000 that are required for the rules.
const CASES: u32 = 20_000;

/// A finding in the form of the model.
fn told(finding: &Finding) -> model::Told {
    model::Told {
        event: finding.event.0,
        rule: finding.rule.id(),
        side: finding.side.id(),
        direction: finding.direction.id(),
        data_set: finding.data_set.map(|index| index.0),
    }
}

/// The properties would prove little about a rule that random settings never violate.
#[test]
fn random_settings_break_every_rule_and_none() {
    let mut runner = TestRunner::deterministic();
    let mut seen = BTreeSet::new();
    for _ in 0..2_000 {
        let settings = any_settings().new_tree(&mut runner).unwrap().current();
        let told = model::findings(&settings);
        seen.extend(told.iter().map(|finding| finding.event));
        if told.is_empty() {
            seen.insert(0);
        }
    }
    let rules = nx_ect101::RULES.iter().flat_map(|rule| rule.events);
    let all = rules.flat_map(|events| [events.m_to_c.0, events.c_to_m.0]).chain([0]);
    assert_eq!(seen, all.collect());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES))]

    #[test]
    fn findings_are_those_of_the_model(settings in any_settings()) {
        let verdict = settings.configuration().check();
        let found: Vec<model::Told> = verdict.findings.iter().map(told).collect();
        prop_assert_eq!(found, model::findings(&settings));
    }

    #[test]
    fn a_finding_has_words_and_an_al_status_code_when_the_unit_stays_in_pre_op(settings in any_settings()) {
        for finding in settings.configuration().check().findings {
            prop_assert!(!finding.event_name().is_empty());
            prop_assert!(!finding.message().is_empty() && !finding.message().ends_with('.'));
            prop_assert!(finding.correction().ends_with('.'));
            prop_assert_eq!(finding.al_status_code().map(|code| code.0), model::al_status_code(finding.event.0));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(CASES / 4))]

    #[test]
    fn right_settings_have_no_finding(settings in right_settings()) {
        prop_assert!(settings.configuration().check().is_satisfied());
    }

    #[test]
    fn breaking_one_rule_yields_its_event_alone(settings in right_settings(), broken in any_break()) {
        let Break { settings, event } = broken.of(settings);
        let verdict = settings.configuration().check();
        let events: Vec<u32> = verdict.findings.iter().map(|finding| finding.event.0).collect();
        prop_assert_eq!(events, [event]);
    }
}
