//! Conditions in conditions: sentences, typed values and files are the same tree, and mistakes have their places.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use proptest::prelude::*;
use scenario::model::{Condition, Order, Script, ScriptStep};
use scenario::words::{CONDITIONS, Spoken};
use scenario::{Recording, Scenario};

/// Conditions of every sentence that looks at the world itself.
fn plain() -> impl Strategy<Value = Condition> {
    let read = |example: &str| Condition::from_sentence(example).expect(example);
    let plain: Vec<Condition> = CONDITIONS.iter().map(|sentence| read(sentence.example)).collect();
    proptest::sample::select(plain).prop_filter("it has no parts", |condition| condition.parts().is_empty())
}

fn trees() -> impl Strategy<Value = Condition> {
    plain().prop_recursive(8, 32, 4, |inner| {
        let several = || proptest::collection::vec(inner.clone(), 1..4);
        prop_oneof![
            inner.clone().prop_map(|part| Condition::Not(Box::new(part))),
            several().prop_map(Condition::AllOf),
            several().prop_map(Condition::AnyOf),
        ]
    })
}

proptest! {
    #[test]
    fn a_tree_is_the_same_from_its_sentence_and_from_json(tree in trees()) {
        let sentence = tree.sentence();
        prop_assert_eq!(Condition::from_sentence(&sentence), Ok(tree.clone()), "{}", sentence);
        let json = serde_json::to_string(&tree).expect("a value is JSON");
        prop_assert_eq!(serde_json::from_str::<Condition>(&json).expect(&json), tree);
    }
}

/// The condition of the only step of a file.
fn in_file(step: &str) -> Result<Condition, String> {
    let text = format!("title = \"t\"\nsteps = [{step}]\n");
    let script = Script::parse(&text).map_err(|errors| errors.to_string())?;
    match script.steps.as_slice() {
        [ScriptStep::Step(step)] => match &step.order {
            Order::Expect(expectation) => Ok(expectation.condition.clone()),
            other => panic!("{other:?}"),
        },
        other => panic!("{other:?}"),
    }
}

#[test]
fn sentences_and_typed_values_are_mixed_in_a_file() {
    let sentence = "all of (unit 1 is in OP; any of (50 cycles are done; not (unit 1 has no error)))";
    let expected = Condition::from_sentence(sentence).expect(sentence);
    for step in [
        format!("{{ expect = \"{sentence}\" }}"),
        "{ expect = { all_of = [\"unit 1 is in OP\", { any_of = [{ cycles = { at_least = 50 } }, { not = \"unit 1 has no error\" }] }] } }"
            .to_owned(),
        "{ never = { all_of = [{ state = { units = 1, state = \"OP\" } }, \"any of (50 cycles are done; not (unit 1 has no error))\"] } }"
            .to_owned(),
    ] {
        assert_eq!(in_file(&step).as_ref(), Ok(&expected), "{step}");
    }
}

#[test]
fn the_mistake_of_a_part_has_its_place_and_its_help() {
    for (step, place, message) in [
        (
            "{ expect = { all_of = [\"unit 1 is in OP\", \"unit 1 is in SAVE-OP\"] } }",
            "line 2, column 52",
            "expected INIT, PRE-OP, SAFE-OP, OP or BOOT, found `SAVE-OP`",
        ),
        ("{ expect = { not = 5 } }", "line 2, column 29", "`expect.not` is an integer"),
        (
            "{ until = { any_of = [5] }, expect = \"unit 1 is in OP\" }",
            "column 32",
            "`until.any_of[0]` is an integer",
        ),
        ("{ expect = { all_of = \"unit 1 is in OP\" } }", "column 32", "`expect.all_of` is a string"),
        (
            "{ expect = \"all of (unit 1 is in OP; not (unit 1 is in SAVE-OP))\" }",
            "line 2, column 21",
            "expected INIT, PRE-OP, SAFE-OP, OP or BOOT, found `SAVE-OP`",
        ),
        ("{ expect = \"not (unit 1 is in OP\" }", "column 21", "expected a condition in parentheses"),
        ("{ expect = \"not unit 1 is in OP\" }", "column 21", "expected a condition in parentheses"),
        (
            "{ expect = \"not (unit 1 is in OP; unit 1 is in OP)\" }",
            "column 21",
            "expected a condition in parentheses",
        ),
        ("{ expect = \"any of (unit 1 is in OP;)\" }", "column 21", "expected conditions in parentheses"),
        ("{ expect = \"any of ()\" }", "column 21", "expected conditions in parentheses"),
        ("{ line = \"not (unit 1 is in OP)\" }", "column 19", "of another key"),
    ] {
        let refusal = in_file(step).expect_err(step);
        assert!(refusal.contains(place) && refusal.contains(message), "{step}\n{refusal}");
    }
}

#[test]
fn conditions_are_nested_sixteen_deep_at_most() {
    let sentence = |depth: usize| format!("{}unit 1 is in OP{}", "not (".repeat(depth), ")".repeat(depth));
    let typed =
        |depth: usize| format!("{}\"unit 1 is in OP\"{}", "{ not = ".repeat(depth), " }".repeat(depth));
    for (what, allowed, refused) in [
        ("sentence", format!("\"{}\"", sentence(16)), format!("\"{}\"", sentence(17))),
        ("typed", typed(16), typed(17)),
        ("mixed", format!("{{ not = \"{}\" }}", sentence(15)), format!("{{ not = \"{}\" }}", sentence(16))),
    ] {
        let read = |condition: &str| {
            let text = format!("title = \"t\"\nsteps = [{{ expect = {condition} }}]\n");
            Scenario::parse(&text, |_| Err(String::new())).map(drop).map_err(|errors| errors.to_string())
        };
        assert_eq!(read(&allowed), Ok(()), "{what}");
        let refusal = read(&refused).expect_err(what);
        assert!(refusal.contains("deep"), "{what}: {refusal}");
    }
}

/// Each part is checked like a condition alone: for units, values and controllers that do not exist.
#[test]
fn what_a_part_is_about_must_exist() {
    for (condition, message) in [
        ("not (unit 2 is in OP)", "unit 2 does not exist"),
        ("all of (unit 1 is in OP; object 9999:00 of unit 1 is 00)", "unit 1 has no object 9999:00"),
        ("any of (0 cycles are done; unit 1 is in OP)", "0 cycles are done at the beginning"),
        ("not (no program error of the master)", "the master has no user program"),
        ("not (all of (the capture is replayed))", "the scenario has no capture"),
    ] {
        let text = format!("title = \"t\"\nsteps = [{{ never = \"{condition}\" }}]\n");
        let refusal =
            Scenario::parse(&text, |_| Err(String::new())).map(drop).expect_err(condition).to_string();
        assert!(refusal.contains(message), "{condition}: {refusal}");
    }
}

fn failure(steps: &str) -> Option<String> {
    let text = format!("title = \"t\"\nsteps = [{steps}]\n");
    let scenario = Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.replay(1, Recording::new(false, false)).failure.map(|failure| failure.seen)
}

/// `never C` is `not (C)` at every moment, also for a unit without power, whose conditions are false.
#[test]
fn not_is_what_never_means_at_a_moment() {
    let off = "{ unit = \"power off unit 1\" }, ";
    assert_eq!(failure(&format!("{off}{{ never = \"unit 1 is in INIT\" }}")), None);
    assert_eq!(failure(&format!("{off}{{ expect = \"not (unit 1 is in INIT)\" }}")), None);
    assert_eq!(
        failure("{ expect = \"not (unit 1 is in INIT)\" }"),
        Some("`unit 1 is in INIT` holds".to_owned())
    );
    // No process data yet: the bytes are false, and none of them is beyond the end.
    assert_eq!(failure("{ expect = \"not (input byte 0 of unit 1 is 00)\" }"), None);
}

#[test]
fn the_failing_part_is_seen() {
    let seen = failure("{ expect = \"all of (unit 1 has no error; unit 1 is in OP)\" }");
    assert_eq!(seen.as_deref(), Some("`unit 1 is in OP`: unit 1 is in INIT"));
    let seen = failure("{ expect = \"any of (unit 1 is in SAFE-OP; unit 1 is in OP)\", within = \"1ms\" }");
    let both = "`unit 1 is in SAFE-OP`: unit 1 is in INIT; `unit 1 is in OP`: unit 1 is in INIT";
    assert_eq!(seen.as_deref(), Some(both));
}

#[test]
fn a_comparison_that_every_value_passes_or_none_is_refused() {
    for (condition, message) in [
        ("the number of cycles is at least 0", "it always holds"),
        ("the number of cycles is below 0", "it can never hold"),
        ("output byte 0 of unit 1 is at most 255", "it always holds"),
        ("output byte 0 of unit 1 is above 255", "it can never hold"),
        ("the working counter of unit 1 is between 5 and 3", "as 5 is above 3"),
        (
            "the working counter of unit 1 is between 5 and 3",
            "the lower limit is first: `is between 3 and 5`",
        ),
        ("variable N1_UINTs_01_M_to_C[0] is at least 65536", "it can never hold"),
        ("variable N1_UINTs_01_M_to_C[0] is at least T#5ms", "is not of that kind"),
        ("variable N1_UINTs_01_M_to_C is at least 5", "which is no number"),
        ("object 2002:01 of unit 1 is not 00 00", "2 bytes for object 2002:01, which has 1"),
        ("object 2002:01 of unit 1 begins with 00 00", "2 bytes for object 2002:01 of unit 1, which has 1"),
        ("object 2002:01 of unit 1 has bits 0x0100", "has no bits 0x100"),
        ("register 0x0130 of unit 1 has no bits 0", "no bit is named"),
        ("the working counter of unit 1 begins with 00", "has no bytes"),
        ("object 9999:00 of unit 1 changes", "unit 1 has no object 9999:00"),
        ("output byte 5000 of unit 1 is above 3", "has no output byte 5000"),
        ("the outputs of unit 1 have bits 0", "no bit is named"),
        ("the outputs of unit 1 do not begin with 5G", "as in the sentence with `is`"),
        ("program variable n of the master is above 3", "the master has no user program"),
    ] {
        let text = format!("title = \"t\"\nsteps = [{{ never = \"{condition}\" }}]\n");
        let refusal =
            Scenario::parse(&text, |_| Err(String::new())).map(drop).expect_err(condition).to_string();
        assert!(refusal.contains(message), "{condition}: {refusal}");
    }
}

/// `changes` compares with the beginning of its step, and each repetition begins again.
#[test]
fn a_change_needs_time() {
    for (step, is_allowed) in [
        ("{ expect = \"the number of cycles changes\" }", false),
        ("{ expect = \"the number of cycles changes\", for = \"1ms\" }", false),
        ("{ expect = \"all of (unit 1 is in INIT; the number of cycles changes)\" }", false),
        ("{ expect = \"not (the number of cycles changes)\", for = \"1ms\" }", true),
        ("{ expect = \"any of (unit 1 is in INIT; the number of cycles changes)\" }", true),
        ("{ never = \"the number of cycles changes\" }", true),
        ("{ when = \"the number of cycles changes\", expect = \"unit 1 is in INIT\" }", true),
    ] {
        let text = format!("title = \"t\"\nsteps = [{step}]\n");
        let read =
            Scenario::parse(&text, |_| Err(String::new())).map(drop).map_err(|errors| errors.to_string());
        let is_refused =
            read.is_err_and(|refusal| refusal.contains("no value has changed when the step begins"));
        assert_eq!(is_refused, !is_allowed, "{step}");
    }
    let op = "{ master = \"take unit 1 to OP\" }, { expect = \"unit 1 is in OP\", within = \"100ms\" }, ";
    let again =
        "{ expect = \"the number of cycles changes\", within = \"2ms\", repeat = 3, every = \"5ms\" }";
    assert_eq!(failure(&format!("{op}{again}")), None);
    let never = "{ never = \"the number of cycles changes\" }, { after = \"5ms\", line = \"be quiet\" }";
    assert_eq!(
        failure(&format!("{op}{never}")),
        Some("it holds, and `never` expects that it does not".to_owned())
    );
}

/// Variables of type BOOL are TRUE or FALSE; others are neither.
#[test]
fn truth_values_are_compared() {
    let read = |condition: &str| {
        let text = format!("title = \"t\"\nsteps = [{{ expect = \"{condition}\" }}]\n");
        Scenario::parse(&text, |_| Err(String::new())).map_err(|errors| errors.to_string())
    };
    let holds =
        |condition: &str| read(condition).expect(condition).replay(1, Recording::new(false, false)).passes();
    assert!(holds("variable N1_SDO_Communications_Enabled is not TRUE"));
    assert!(!holds("variable N1_SDO_Communications_Enabled is not FALSE"));
    let refused = read("variable N1_UINTs_01_M_to_C[0] is TRUE").map(drop).expect_err("a UINT");
    assert!(refused.contains("is UINT, which is neither TRUE nor FALSE"), "{refused}");
}
