//! Indicators, their patterns and colours.

use coe_kit::indicators::Pattern;

use super::{explained, refused, subjects};
use crate::explain::{Subject, explain, indicator, names};

#[test]
fn every_indicator_and_pattern_is_explained_by_its_name() {
    for name in indicator::names() {
        let known = subjects(&name.to_lowercase());
        assert!(known.contains(&Subject::Indicator(name)), "{name}");
        assert_eq!(known, names::subjects(name), "{name} is a name, not only a part of names");
    }
    for pattern in Pattern::ALL {
        let written = pattern.id().replace('_', " ");
        assert!(subjects(&written).contains(&Subject::Pattern(pattern)), "{written}");
    }
    let err = explained("ERR");
    assert!(err.contains("red         double_flash (200 ms lit, 200 ms dark, 200 ms lit, 1000 ms dark): process data stopped in OP"), "{err}");
    assert!(err.contains("85000000"), "{err}");
    assert_eq!(subjects("L/A").len(), 2, "IN and OUT");
}

/// With `led` next to the name, before and after it, with the pattern, and without.
#[test]
fn every_light_of_every_indicator_is_explained() {
    for indicator in nx_ect101::Indicator::all() {
        for (name, status) in
            indicator.names.iter().flat_map(|name| indicator.status.iter().map(move |row| (name, row)))
        {
            let dark = status.pattern == Pattern::NotLit;
            let colour = if dark { "dark" } else { status.colour.id() };
            let pattern = if dark { "off".to_owned() } else { status.pattern.id().replace('_', " ") };
            for text in [
                format!("{name} {colour}"),
                format!("{colour} {name}"),
                format!("{name} {pattern}"),
                format!("{name} LED {colour}"),
                format!("{pattern} {name} led"),
            ] {
                assert!(subjects(&text).contains(&Subject::Indicator(name)), "{text}");
            }
        }
    }
    let [ts] = &explain("TS green").unwrap()[..] else { panic!("one meaning") };
    assert!(ts.to_string().contains("normal, ready for I/O refreshing"), "{ts}");
    for text in [
        "TS red",
        "red TS",
        "TS flashing",
        "TS flashing red",
        "TS red flashing 1s",
        "L/A green",
        "RUN LED off",
    ] {
        assert!(subjects(text).iter().any(|subject| matches!(subject, Subject::Indicator(_))), "{text}");
    }
    assert!(refused("TS blue").contains("is not known"));
}
