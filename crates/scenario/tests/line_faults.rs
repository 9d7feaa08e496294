//! Faults of frames in files: their mistakes, and names in use.

use scenario::{Recording, Scenario};

fn parse(steps: &[&str]) -> Result<Scenario, String> {
    let steps: Vec<String> = steps.iter().map(|step| format!("{{ {step} }}")).collect();
    let text = format!("title = \"t\"\nlimit = \"10s\"\nsteps = [\n{}\n]\n", steps.join(",\n"));
    Scenario::parse(&text, |_| Err(String::new())).map_err(|errors| errors.to_string())
}

#[test]
fn mistakes_are_reported_with_a_way_out() {
    let cases: &[(&[&str], &str, &str)] = &[
        (
            &[r#"line = "lose all frames for 11s""#],
            "a fault for 11s is longer than the limit of 10s",
            "leave `for` out",
        ),
        (
            &[
                r#"line = "lose all frames called storm""#,
                r#"line = "duplicate 5 % of the frames called storm""#,
            ],
            "a fault called storm is at work already",
            "`end storm` before it",
        ),
        (
            &[r#"line = "end storm""#],
            "no step before this one makes a fault called storm",
            "`lose all frames called storm`",
        ),
        (
            &[r#"line = "lose all frames called storm""#, r#"line = "end strom""#],
            "no step before this one makes a fault called strom",
            "did you mean `end storm`?",
        ),
        (
            &[r#"line = "lose all frames called storm""#, r#"line = "be quiet""#, r#"line = "end storm""#],
            "the fault called storm has ended before this step",
            "a fault gets its name as in",
        ),
        (&[r#"line = "lose all frames on cable 2""#], "cable 2 does not exist", "the line has 1 unit"),
        (&[r#"line = "lose all frames of unit 2""#], "unit 2 does not exist", "the line has 1 unit"),
        (&[r#"line = "lose 1001 ‰ of the frames""#], "found `1001`", "the sentence is `lose {frames}"),
        (
            &[r#"line = "lose numbers 5 to 4 of the frames""#],
            "found `numbers`",
            "the sentence is `lose {frames}",
        ),
        (&[r#"line = "lose the next 0 frames""#], "0 frames get the fault", "a number from 1"),
        (
            &[
                r#"line = { disturb = { fault = "lose_answer", frames = { choice = "all" }, way = { cable = 1 } } }"#,
            ],
            "the fault has no such place",
            "show what each fault has",
        ),
        (
            &[
                r#"line = { disturb = { fault = { lower_working_counter_by = { by = 0 } }, frames = { choice = "all" } } }"#,
            ],
            "its numbers are not possible",
            "show what each fault has",
        ),
    ];
    for (steps, message, help) in cases {
        let errors = parse(steps).err().unwrap_or_else(|| panic!("{steps:?} is accepted"));
        assert!(errors.contains(message) && errors.contains(help), "{steps:?}\n{errors}");
    }
}

#[test]
fn a_name_can_be_used_again_when_its_fault_has_ended() {
    let scenario = parse(&[
        r#"line = "lose the next 1 frames for 5ms called storm""#,
        r#"after = "6ms", line = "lose the next 1 frames called storm""#,
        r#"line = "end storm""#,
        r#"line = "lose all frames called storm""#,
        r#"line = "be quiet""#,
        r#"line = "lose all frames called storm""#,
    ]);
    let report = scenario.expect("a right scenario").replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None);
}

#[test]
fn a_name_in_use_is_a_failure_of_the_step_if_nothing_told_it_before() {
    let scenario = parse(&[
        r#"line = "lose the next 1 frames called storm""#,
        r#"line = "lose the next 1 frames called storm""#,
    ]);
    let failure = scenario.expect("it may have ended").replay(1, Recording::new(false, false)).failure;
    assert_eq!(failure.expect("it has not").seen, "a fault called storm is at work already");
}

#[test]
fn the_end_of_a_fault_that_has_ended_by_itself_is_no_failure_and_in_the_trace() {
    let scenario =
        parse(&[r#"line = "lose all frames for 5ms called storm""#, r#"after = "6ms", line = "end storm""#]);
    let report = scenario.expect("a right scenario").replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None);
    let trace = report.recording.trace().unwrap_or_default();
    assert!(trace.contains("storm has ended already"), "{trace}");
}
