//! Every event of the manual has a scenario that causes it and expects it to be recorded.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use nx_ect101::Event;
use scenario::Scenario;
use scenario::model::{Condition, Mode, Order};

/// The events that the scenarios of a folder expect to be recorded exactly once, by code.
fn expected_events(folder: &Path) -> BTreeSet<String> {
    let files = fs::read_dir(folder).expect("the folder of the events");
    let texts = files.map(|file| fs::read_to_string(file.expect("an entry").path()).expect("a scenario"));
    texts.flat_map(|text| recorded_in(&text)).collect()
}

fn recorded_in(text: &str) -> Vec<String> {
    let scenario =
        Scenario::parse(text, |path| Err(format!("{path}: no unit files here"))).expect("a scenario");
    let recorded = scenario.each_step().into_iter().filter_map(|step| match &step.step.order {
        Order::Expect(expectation) if expectation.mode != Mode::Never => match expectation.condition {
            Condition::Recorded { event, times: Some(1), .. } => Some(event.to_string()),
            _ => None,
        },
        _ => None,
    });
    recorded.collect()
}

#[test]
fn every_event_has_a_scenario_that_expects_it_once() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/events");
    let expected = expected_events(&folder);
    let missing: Vec<_> =
        Event::all().iter().filter(|event| !expected.contains(&event.code.to_string())).collect();
    let names: Vec<_> = missing.iter().map(|event| format!("{} {}", event.code, event.name)).collect();
    assert_eq!(names, Vec::<String>::new(), "events without a scenario under scenarios/events");
}
