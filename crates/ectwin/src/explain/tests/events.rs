//! Events: all channels on which they are seen, and their texts.

use crate::explain::explain;

#[test]
fn every_event_is_explained_on_every_channel() {
    for event in nx_ect101::Event::all() {
        let explanations = explain(&event.code.to_string()).unwrap();
        let [known] = &explanations[..] else { panic!("{}: one meaning", event.code) };
        assert!(!known.advice.is_empty(), "{}", event.code);
        let headings: Vec<&str> = known.sections.iter().map(|section| section.heading.as_ref()).collect();
        for heading in
            ["What the EtherCAT master sees", "What the CPU Unit sees", "Indicators", "Logs and recovery"]
        {
            assert!(headings.contains(&heading), "{}: {heading}", event.code);
        }
        let facts = known.facts.iter().chain(known.sections.iter().flat_map(|section| &section.facts));
        for fact in facts {
            assert!(fact.label.len() <= 11 && !fact.text.is_empty(), "{}: {}", event.code, fact.label);
        }
    }
}

#[test]
fn the_texts_of_events_are_sentences() {
    for event in nx_ect101::Event::all() {
        let texts = event.causes.iter().flat_map(|row| [&row.cause, &row.correction]);
        for text in texts.chain([&event.meaning, &event.in_ectwin]) {
            let is_sentence =
                text.starts_with(|first: char| first.is_ascii_uppercase() || first.is_ascii_digit());
            assert!(is_sentence && text.ends_with('.'), "{}: {text}", event.code);
            assert!(!text.contains(['|', '\n']), "{}: a cell of a table: {text}", event.code);
        }
    }
}

#[test]
fn every_fault_is_named_in_the_text_of_its_event() {
    for fault in nx_ect101::Fault::ALL {
        let event = nx_ect101::Event::find(fault.event()).unwrap();
        assert!(event.in_ectwin.contains(&format!("`{fault:?}`")), "{fault:?}: {}", event.in_ectwin);
    }
}
