//! The table: names, pins, documents.

use std::collections::HashSet;

use crate::host::NoHost;
use crate::library::blocks::BLOCKS;
use crate::library::table::all;
use crate::library::{block_pin, function, functions, reference};
use crate::program::compile;

#[test]
fn names_stand_once_in_whatever_case() {
    let mut seen = HashSet::new();
    for function in all() {
        assert!(seen.insert(function.name.to_ascii_uppercase()), "{} stands twice", function.name);
    }
}

#[test]
fn pins_have_names_of_their_own_and_defaults_stand_at_the_end() {
    for function in all() {
        let names =
            function.pins.iter().flat_map(|pin| [pin.name, pin.alias]).filter(|name| !name.is_empty());
        let mut seen = HashSet::new();
        for name in names {
            assert!(seen.insert(name.to_ascii_uppercase()), "{}: {name} stands twice", function.name);
        }
        let defaults = function.pins.iter().skip_while(|pin| pin.default.is_none());
        assert!(defaults.into_iter().all(|pin| pin.default.is_some()), "{}", function.name);
        assert!(!function.does.is_empty() && !function.does.ends_with('.'), "{}", function.name);
    }
}

#[test]
fn a_function_is_found_in_whatever_case_and_a_hidden_one_is_not_listed() {
    assert!(function("memCOPY").is_some());
    assert!(function("_now").is_some());
    assert!(function("NoSuchFunction").is_none());
    assert!(functions().all(|function| !function.name.starts_with('_')));
}

#[test]
fn the_documents_know_each_function_and_block_once() {
    let entries = reference();
    assert_eq!(entries.len(), functions().count() + BLOCKS.len());
    let shift = entries.iter().find(|entry| entry.name == "SHL").unwrap();
    assert_eq!(shift.inputs, "In: BYTE … LWORD, Num (N): SINT … LINT, USINT … ULINT");
    assert_eq!((shift.group, shift.outputs.as_str()), ("bit strings", "the type of the inputs"));
}

/// The names in `Set (S): BOOL, Reset1 (R1): BOOL`.
fn names(pins: &str) -> impl Iterator<Item = &str> {
    pins.split(", ").map(|pin| pin.split([' ', ':']).next().unwrap())
}

#[test]
fn the_documents_tell_the_pins_of_each_block_in_their_order() {
    for block in BLOCKS {
        let source = format!("PROGRAM Main VAR b : {}; END_VAR END_PROGRAM", block.name);
        let program = compile(&source, &[]).unwrap_or_else(|problems| panic!("{problems}"));
        let value = program.start().value("b").unwrap();
        let members: Vec<_> = value
            .trim_matches(['(', ')'])
            .split(", ")
            .filter_map(|member| member.trim_matches(['(', ')', '[', ']']).split_once(" := "))
            .map(|(name, _)| name)
            .collect();
        // An in-out has no separate value.
        let pins = names(block.inputs).chain(names(block.outputs)).filter(|name| !name.ends_with("Dat"));
        let mut rest = members.iter();
        for pin in pins {
            assert!(
                rest.any(|member| *member == pin),
                "{}: no {pin} at its place in {members:?}",
                block.name
            );
        }
    }
}

#[test]
fn other_names_of_pins_are_pins() {
    assert_eq!(block_pin("rs", "r1"), Some("Reset1"));
    assert_eq!(block_pin("TON", "IN"), None);
    let source = "PROGRAM Main
        VAR f : RS; g : SR; u : CTU; d : CTD; b : CTUD; q : BOOL; v : INT; END_VAR
        f(S := TRUE, R1 := FALSE, Q1 => q);
        g(S1 := TRUE, R := TRUE);
        u(CU := TRUE, R := FALSE, PV := 1);
        d(CD := FALSE, LD := TRUE, PV := 5, CV => v);
        b(CU := FALSE, CD := FALSE, R := FALSE, LD := TRUE, PV := 7);
        END_PROGRAM";
    let mut instance = compile(source, &[]).unwrap_or_else(|problems| panic!("{problems}")).start();
    instance.scan(0, 1000, &mut NoHost).unwrap();
    let values = ["q", "v", "g.Q1", "u.Q", "b.CV"].map(|name| instance.value(name).unwrap());
    assert_eq!(values, ["TRUE", "5", "TRUE", "TRUE", "7"]);
}
