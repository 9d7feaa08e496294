//! Groups of steps: rounds, sequences that are played together, and steps for each value.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::fmt::Write;

use proptest::prelude::*;
use scenario::model::Script;
use scenario::{Recording, Report, Scenario, ScenarioBuilder};
use time::Duration;

fn parse(text: &str) -> Scenario {
    Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{text}\n{errors}"))
}

fn file(steps: &str) -> String {
    format!("title = \"t\"\nsteps = [\n{steps}\n]\n")
}

fn replay(text: &str) -> Report {
    parse(text).replay(1, Recording::new(true, false))
}

fn errors(steps: &str) -> String {
    let text = file(steps);
    Scenario::parse(&text, |_| Err(String::new())).expect_err(&text).to_string()
}

/// The steps of a trace with their times in microseconds, sorted, without the lines of rounds.
fn steps(report: &Report) -> Vec<(u64, String)> {
    let trace = report.recording.trace().expect("a trace");
    let step = |line: &str| {
        let (time, rest) = line.split_once(" ms  step ")?;
        let (ms, ns) = time.trim().split_once('.')?;
        let time_us = ms.parse::<u64>().ok()? * 1_000 + ns.parse::<u64>().ok()? / 1_000;
        (!rest.trim().starts_with("round ")).then(|| (time_us, rest.trim().to_owned()))
    };
    let mut steps: Vec<_> = trace.lines().filter_map(step).collect();
    steps.sort();
    steps
}

fn played(text: &str) -> Vec<(u64, String)> {
    let report = replay(text);
    assert_eq!(report.failure, None, "{text}");
    steps(&report)
}

fn expected(steps: &[(u64, &str)]) -> Vec<(u64, String)> {
    steps.iter().map(|(time, text)| (*time, (*text).to_owned())).collect()
}

#[test]
fn each_round_begins_on_time_and_the_step_after_the_group_waits_for_the_last_one() {
    let text = file(
        r#"{ after = "1ms", repeat = 3, every = "10ms", steps = [
            { line = "unplug cable 1" },
            { after = "2ms", line = "plug cable 1" },
        ] },
        { line = "be quiet" }"#,
    );
    let (unplug, plug) = ("unplug cable 1", "plug cable 1");
    assert_eq!(
        played(&text),
        expected(&[
            (1_000, unplug),
            (3_000, plug),
            (11_000, unplug),
            (13_000, plug),
            (21_000, unplug),
            (23_000, "be quiet"),
            (23_000, plug),
        ])
    );
}

#[test]
fn a_round_that_is_longer_than_the_period_is_a_failure_that_says_so() {
    let text = file(
        r#"{ repeat = 3, every = "10ms", steps = [
            { line = "be quiet" },
            { after = "11ms", line = "be quiet" },
        ] }"#,
    );
    let failure = replay(&text).failure.expect("too long");
    assert_eq!((failure.line, failure.at), (3, Duration::from_millis(10)));
    assert_eq!(failure.text, "repeat = 3, every = \"10ms\"");
    let seen =
        "round 1 of 3 has not ended after 10ms, when the next one is due: line 5 `be quiet` still waits";
    assert_eq!(failure.seen, seen);
    assert_eq!(replay(&text.replace("11ms", "10ms")).failure, None, "it ends when the next one begins");
    assert_eq!(replay(&text.replace("repeat = 3", "repeat = 1")).failure, None, "nothing is due");
}

#[test]
fn jitter_moves_each_round_about_its_time() {
    let text = file(r#"{ repeat = 50, every = "10ms", jitter = "3ms", steps = [{ line = "be quiet" }] }"#);
    let times: Vec<u64> = played(&text).into_iter().map(|(time, _)| time).collect();
    assert_eq!((times.len(), times[0]), (50, 0));
    let off = |(number, time): (usize, &u64)| time.abs_diff(number as u64 * 10_000);
    let off: Vec<u64> = times.iter().enumerate().map(off).collect();
    assert!(off.iter().all(|off| *off <= 3_000) && off.iter().any(|off| *off > 2_000), "{off:?}");
}

#[test]
fn sequences_begin_together_and_the_next_step_waits_for_the_last_one() {
    let text = file(
        r#"{ together = [
            [{ after = "5ms", line = "unplug cable 1" }, { after = "10ms", line = "plug cable 1" }],
            { after = "1ms", master = "behave" },
            { when = "the master has nothing to do", repeat = 2, every = "3ms", steps = [{ cpu = "release all of unit 1" }] },
        ] },
        { line = "be quiet" }"#,
    );
    assert_eq!(
        played(&text),
        expected(&[
            (0, "release all of unit 1"),
            (1_000, "behave"),
            (3_000, "release all of unit 1"),
            (5_000, "unplug cable 1"),
            (15_000, "be quiet"),
            (15_000, "plug cable 1"),
        ])
    );
}

#[test]
fn a_sequence_sees_at_once_what_a_later_one_does() {
    let text = file(
        r#"{ together = [
            [{ when = "unit 1 has the error 40200000", line = "unplug cable 1" }],
            [{ after = "2ms", unit = "break Processing of unit 1" }, { expect = "unit 1 has the error 40200000", within = "1s" }],
        ] }"#,
    );
    let report = replay(&text);
    assert_eq!(report.failure, None);
    let unplugged =
        steps(&report).into_iter().find(|(_, text)| text == "unplug cable 1").expect("it is done");
    assert!(unplugged.0 < 10_000, "{unplugged:?}");
}

#[test]
fn steps_are_made_for_each_value_with_their_own_line() {
    let text = r#"title = "t"
units = [{ model = "digital", outputs = 8 }, { model = "digital", name = "B", outputs = 8 }]
steps = [
  { for.unit = [1, 2], for.cable = [2, 1], after = "1ms", steps = [
    { line = "unplug cable {cable}" },
    { after = "1ms", expect = "unit {unit} is in OP" },
  ] },
]
"#;
    let failure = replay(text).failure.expect("no unit is in OP");
    assert_eq!((failure.line, failure.text.as_str()), (6, "unit 1 is in OP"));
    let expectation = "{ after = \"1ms\", expect = \"unit {unit} is in OP\" }";
    let plug = "{ after = \"1ms\", line = \"plug cable {cable}\" }, { expect = \"unit {unit} is in INIT\" }";
    let never = text.replace(expectation, plug);
    let texts: Vec<_> = played(&never).into_iter().map(|(_, text)| text).collect();
    let each = |cable: u8| [format!("unplug cable {cable}"), format!("plug cable {cable}")];
    let mut expected: Vec<String> = [2, 1, 2, 1].into_iter().flat_map(each).collect();
    expected.sort();
    let mut sorted = texts.clone();
    sorted.sort();
    assert_eq!(sorted, expected);
}

#[test]
fn values_of_nested_loops_and_parameters_meet_in_one_text() {
    let text = r#"title = "t"
with = { first = [1, 2] }
steps = [
  { for.second = [3, 4], steps = [
    { for.third = [5], together = [{ master = "set the outputs of unit 1 to 0{first} 0{second} 0{third}" }] },
  ] },
]
"#;
    let texts = |scenario: &Scenario| {
        let steps = scenario.each_step().into_iter().map(|step| step.text.clone());
        steps.collect::<Vec<_>>()
    };
    struct Nothing;
    impl scenario::Files for Nothing {
        fn text(&mut self, _: &str, _: scenario::Wanted) -> Result<String, String> {
            Err(String::new())
        }
    }
    let cases = Scenario::cases(text, &mut Nothing).unwrap_or_else(|errors| panic!("{errors}"));
    let texts: Vec<_> = cases.iter().flat_map(texts).collect();
    let all = ["01 03 05", "01 04 05", "02 03 05", "02 04 05"];
    assert_eq!(texts, all.map(|bytes| format!("set the outputs of unit 1 to {bytes}")));
}

#[test]
fn many_rounds_of_many_rounds_need_no_memory_for_each() {
    let text = file(
        r#"{ repeat = 10000, every = "10s", steps = [
            { repeat = 10000, every = "1ms", steps = [{ line = "be quiet" }] },
        ] }"#,
    );
    let text = text.replacen("steps = [\n", "limit = \"90s\"\nsteps = [\n", 1);
    let failure = parse(&text).replay(1, Recording::new(false, false)).failure.expect("the limit");
    assert!(failure.seen.contains("limit"), "{failure}");
}

#[test]
fn mistakes_in_groups_are_told_with_their_place() {
    let deep = |depth: usize| {
        format!("{}{{ line = \"be quiet\" }}{}", "{ steps = [".repeat(depth), "] }".repeat(depth))
    };
    parse(&file(&deep(16)));
    for (steps, place, message) in [
        (
            r#"{ repeat = 3, every = "1ms", steps = [] }"#.to_owned(),
            "line 3, column 38",
            "`steps[0].steps` is an empty list",
        ),
        (
            r#"{ repeat = 3, every = "1ms", steps = [{ line = "unplg cable 1" }] }"#.to_owned(),
            "line 3, column 48",
            "did you mean `unplug cable 1`?",
        ),
        (
            r#"{ repeat = 3, every = "1ms", steps = [{ line = "unplug cable 2" }] }"#.to_owned(),
            "line 3, column 48",
            "cable 2 does not exist",
        ),
        (
            r#"{ repeat = 3, steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 1",
            "`repeat` needs `every`",
        ),
        (
            r#"{ repeat = 3, every = "1ms", together = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 1",
            "`together` is not repeated",
        ),
        (
            r#"{ repeat = 0, every = "1ms", steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 12",
            "1 to 10000 times",
        ),
        (
            r#"{ repeat = 3, every = "0ms", steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 1",
            "a period of 0",
        ),
        (
            r#"{ repeat = 3, every = "2ms", jitter = "1500us", steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 1",
            "more than half of the period",
        ),
        (
            r#"{ repeat = 3, every = "2ms", steps = [{ at = "1ms", line = "be quiet" }] }"#.to_owned(),
            "line 3, column 39",
            "`at` is a time from the beginning",
        ),
        (
            r#"{ steps = [{ line = "be quiet" }], master = "behave" }"#.to_owned(),
            "line 3, column 36",
            "unknown key `master`",
        ),
        (
            r#"{ steps = [{ random = 3, within = "1s" }] }"#.to_owned(),
            "line 3, column 12",
            "random steps are not in a group",
        ),
        (r#"{ steps = 5 }"#.to_owned(), "line 3, column 11", "`steps[0].steps` is an integer"),
        (r#"{ together = [[]] }"#.to_owned(), "line 3, column 1", "a group without steps"),
        (
            r#"{ together = [[5]] }"#.to_owned(),
            "line 3, column 16",
            "`steps[0].together[0][0]` is an integer",
        ),
        (r#"{ for.unit = [1] }"#.to_owned(), "line 3, column 1", "`for` needs `steps`"),
        (
            r#"{ for.unit = [], steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 14",
            "`for.unit` is an empty list",
        ),
        (
            r#"{ for.unit = [1], steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 7",
            "`{unit}` is not in any text",
        ),
        (
            r#"{ for.unit = [1], steps = [{ expect = "unit {unti} is in INIT" }] }"#.to_owned(),
            "line 3, column 39",
            "did you mean `unit`?",
        ),
        (
            r#"{ for.unit = [1, 2, 3], steps = [{ expect = "unit {unit} is in INIT" }] }"#.to_owned(),
            "line 3, column 45",
            "unit 2 does not exist",
        ),
        (
            r#"{ for.a = [1], steps = [{ for.a = [1], steps = [{ line = "plug cable {a}" }] }] }"#.to_owned(),
            "line 3, column 31",
            "`{a}` has a value here already",
        ),
        (
            r#"{ for = "5ms", steps = [{ line = "be quiet" }] }"#.to_owned(),
            "line 3, column 9",
            "names with lists of values",
        ),
        (
            format!(
                "{{ for.a = {0:?}, for.b = {0:?}, steps = [{{ line = \"plug cable {{a}}{{b}}\" }}] }}",
                (0..101).collect::<Vec<_>>()
            ),
            "line 3",
            "more than 10000 steps",
        ),
        (deep(17), "line 3", "a group cannot be in more"),
        (deep(30), "line 3", "a group cannot be in more"),
    ] {
        let errors = errors(&steps);
        assert!(errors.contains(place) && errors.contains(message), "{steps}\n{errors}");
        assert_eq!(errors.matches(message).count(), 1, "{errors}");
    }
}

#[test]
fn a_group_is_the_same_in_json_and_in_code() {
    let json = r#"{ "title": "t", "steps": [
        { "after": "1ms", "repeat": 3, "every": "10ms", "steps": [
            { "line": { "unplug": { "cable": 1 } } },
            { "together": [[{ "after": "1ms", "line": { "plug": { "cable": 1 } } }], { "master": { "behave": {} } }] }
        ] }
    ] }"#;
    let script: Script = serde_json::from_str(json).expect("right");
    let again: Script = serde_json::from_str(&serde_json::to_string(&script).expect("JSON")).expect("right");
    assert_eq!(script, again);
    let built = ScenarioBuilder::new("t")
        .after(Duration::from_millis(1))
        .repeat(3, Duration::from_millis(10), |round| {
            round.line("unplug cable 1").together([
                |one| one.after(Duration::from_millis(1)).line("plug cable 1"),
                |other| other.master("behave"),
            ])
        })
        .finish()
        .expect("right");
    struct Nothing;
    impl scenario::Files for Nothing {
        fn text(&mut self, _: &str, _: scenario::Wanted) -> Result<String, String> {
            Err(String::new())
        }
    }
    let of_json = Scenario::of(script, &mut Nothing).expect("right");
    let trace = |scenario: &Scenario| steps(&scenario.replay(1, Recording::new(true, false)));
    assert_eq!(trace(&of_json), trace(&built));
    assert_eq!(trace(&built).len(), 9);
    let wrong = r#"{ "steps": [{ "line": { "be_quiet": {} } }], "master": { "behave": {} } }"#;
    let refusal = serde_json::from_str::<scenario::model::ScriptStep>(wrong).expect_err("both").to_string();
    assert!(refusal.contains("no order and no expectation beside its steps"), "{refusal}");
}

#[test]
fn in_code_a_mistake_in_a_group_has_the_number_of_its_step() {
    let errors = ScenarioBuilder::new("t")
        .line("be quiet")
        .repeat(2, Duration::from_millis(1), |round| round.line("be quiet").line("unplug cable 2"))
        .finish()
        .expect_err("no cable 2");
    assert!(errors.to_string().starts_with("step 4: "), "{errors}");
}

/// A tree of steps: the model of groups.
#[derive(Clone, Debug)]
enum Tree {
    /// A pause in microseconds, then an order.
    Step(u64),
    Sequence(Vec<Tree>),
    /// The number of rounds, and the pause in microseconds from the end of a round to the next.
    Repeat(u64, u64, Vec<Tree>),
    Together(Vec<Vec<Tree>>),
}

fn trees() -> impl Strategy<Value = Vec<Tree>> {
    let step = (1..3_000_u64).prop_map(Tree::Step);
    let tree = step.prop_recursive(4, 24, 4, |inner| {
        let steps = || proptest::collection::vec(inner.clone(), 1..4);
        prop_oneof![
            steps().prop_map(Tree::Sequence),
            (1..4_u64, 0..2_000_u64, steps())
                .prop_map(|(times, pause, steps)| Tree::Repeat(times, pause, steps)),
            proptest::collection::vec(steps(), 1..4).prop_map(Tree::Together),
        ]
    });
    proptest::collection::vec(tree, 1..4)
}

/// The text of steps in a file, and their times from `begun` on; returns the time of their end.
fn write(trees: &[Tree], begun: u64, text: &mut String, times: &mut Vec<u64>) -> u64 {
    trees.iter().fold(begun, |now, tree| match tree {
        Tree::Step(pause) => {
            write!(text, "{{ after = \"{pause}us\", line = \"be quiet\" }}, ").expect("a text");
            times.push(now + pause);
            now + pause
        }
        Tree::Sequence(steps) => {
            text.push_str("{ steps = [");
            let end = write(steps, now, text, times);
            text.push_str("] }, ");
            end
        }
        Tree::Repeat(number, pause, steps) => {
            let lasts = write(steps, 0, &mut String::new(), &mut Vec::new());
            let every = lasts + pause;
            write!(text, "{{ repeat = {number}, every = \"{every}us\", steps = [").expect("a text");
            write(steps, now, text, times);
            for round in 1..*number {
                write(steps, now + round * every, &mut String::new(), times);
            }
            text.push_str("] }, ");
            now + (number - 1) * every + lasts
        }
        Tree::Together(sequences) => {
            text.push_str("{ together = [");
            let ends = sequences.iter().map(|steps| {
                text.push('[');
                let end = write(steps, now, text, times);
                text.push_str("], ");
                end
            });
            let end = ends.max().unwrap_or(now);
            text.push_str("] }, ");
            end
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Groups are played as the flat list of their steps at the computed times.
    #[test]
    fn groups_are_the_flat_list_of_their_steps(trees in trees()) {
        let (mut text, mut times) = (String::new(), Vec::new());
        let end = write(&trees, 0, &mut text, &mut times);
        times.sort_unstable();
        let flat: String = times.iter().map(|time| format!("{{ at = \"{time}us\", line = \"be quiet\" }}, ")).collect();
        let behind = "{ after = \"1us\", line = \"be quiet\" }".to_owned();
        let in_groups = played(&file(&format!("{text}{behind}")));
        let one_by_one = played(&file(&format!("{flat}{{ at = \"{}us\", line = \"be quiet\" }}", end + 1)));
        prop_assert_eq!(in_groups, one_by_one);
    }
}
