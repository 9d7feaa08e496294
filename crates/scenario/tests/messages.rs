//! The messages of wrong files, whole: each has its way out, and one mistake has one message.

use scenario::{Files, Recording, Scenario, Wanted};

struct NoFiles;

impl Files for NoFiles {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        Err(format!("{path} is not a file"))
    }
}

fn messages(text: &str) -> String {
    match Scenario::cases(text, &mut NoFiles) {
        Ok(_) => panic!("it was read: {text}"),
        Err(errors) => errors.to_string(),
    }
}

/// A step, and all that is said about it.
fn said(step: &str) -> String {
    messages(&format!("title = \"t\"\nsteps = [\n{step},\n]\n"))
}

#[test]
fn keys_that_contradict_each_other_have_a_way_out() {
    for (step, expected) in [
        (
            r#"{ never = "unit 1 is in OP", within = "1s" }"#,
            "line 3, column 1: `never` has no `within`\n  `never` is checked to the end of the run, or `until` a condition is \
             true; `for` a time: `expect = \"not (…)\", for = \"…\"`",
        ),
        (
            r#"{ line = "be quiet", repeat = 4 }"#,
            "line 3, column 1: `repeat` needs `every`, the time from one to the next\n  such as `repeat = 4, every = \"100ms\"`",
        ),
        (
            r#"{ line = "be quiet", every = "7ms" }"#,
            "line 3, column 1: `every` needs `repeat`, the total number of times\n  such as `repeat = 3, every = \"7ms\"`",
        ),
        (
            r#"{ line = "be quiet", jitter = "7ms" }"#,
            "line 3, column 1: `jitter` belongs to `repeat` and `every`\n  such as `repeat = 3, every = \"100ms\", jitter = \"7ms\"`",
        ),
        (
            r#"{ after = "1ms" }"#,
            "line 3, column 1: a step has exactly one of `master`, `unit`, `cpu`, `line`, `expect`, `never`, `random`, `steps` and \
             `together`; this one has none",
        ),
    ] {
        assert_eq!(said(step), expected, "{step}");
    }
}

#[test]
fn a_time_without_a_unit_is_suggested_with_one() {
    for (time, expected) in [
        ("50", "line 3, column 11: `after` is an integer\n  expected a duration such as \"50ms\""),
        (
            "\"50\"",
            "line 3, column 11: `50`: not a duration: a number and one of the units s, ms, us, ns, such as \"50ms\"",
        ),
    ] {
        assert_eq!(said(&format!("{{ after = {time}, line = \"be quiet\" }}")), expected);
    }
}

#[test]
fn a_name_in_braces_with_a_typing_error_is_one_mistake() {
    let with = "title = \"t\"\nwith = { loss = [1, 5], half = [1] }\n";
    let expected = |line: usize, column: usize| {
        format!(
            "line {line}, column {column}: nothing has the name `{{los}}`\n  expected `loss` or `half`; did you mean `loss`?; \
             a text that contains these braces has them twice: `{{{{los}}}}`"
        )
    };
    let used = "{ line = \"lose {half} % of the frames\" }, { line = \"lose {loss} % of the frames\" }";
    for (rest, line, column) in [
        (format!("steps = [{{ line = \"lose {{los}} % of the frames\" }}, {used}]"), 3, 19),
        (format!("steps = [{{ after = \"{{los}}\", line = \"be quiet\" }}, {used}]"), 3, 20),
        (format!("steps = [{{ after = \"{{los}}ms\", steps = [{used}] }}]"), 3, 20),
        (format!("seed = \"{{los}}\"\nsteps = [{used}]"), 3, 8),
        (format!("units = [{{ model = \"{{los}}\" }}]\nsteps = [{used}]"), 3, 20),
    ] {
        assert_eq!(messages(&format!("{with}{rest}\n")), expected(line, column), "{rest}");
    }
}

#[test]
fn a_title_is_a_text_whatever_its_parameter_is() {
    let text = "title = \"{loss}\"\nwith = { loss = [1, 5] }\nsteps = [{ line = \"be quiet\" }]";
    let cases = Scenario::cases(text, &mut NoFiles).unwrap_or_else(|errors| panic!("{errors}"));
    let titles: Vec<&str> = cases.iter().map(|case| case.title.as_str()).collect();
    assert_eq!(titles, ["1", "5"]);
}

#[test]
fn a_folder_is_named_as_it_is_used() {
    let text = "title = \"t\"\nuse = \".\"\nsteps = [{ line = \"be quiet\" }]";
    assert_eq!(messages(text), "line 2, column 7: the prelude . cannot be read: . is not a file");
}

#[test]
fn a_round_that_does_not_end_names_the_time_that_it_had() {
    let failure = |jitter: &str| {
        let text = format!(
            "title = \"t\"\nsteps = [\n{{ repeat = 3, every = \"10ms\"{jitter}, steps = [\n{{ after = \"30ms\", line = \"be quiet\" }},\n] }},\n]"
        );
        let scenario =
            Scenario::cases(&text, &mut NoFiles).unwrap_or_else(|errors| panic!("{errors}")).remove(0);
        scenario
            .replay(1, Recording::new(false, false))
            .failure
            .map(|failure| failure.seen)
            .unwrap_or_default()
    };
    assert_eq!(
        failure(""),
        "round 1 of 3 has not ended after 10ms, when the next one is due: line 4 `be quiet` still waits"
    );
    let jittered = failure(", jitter = \"5ms\"");
    let (time, rest) = jittered
        .strip_prefix("round 1 of 3 has not ended after ")
        .and_then(|rest| rest.split_once(", when the next one is due "))
        .unwrap_or_else(|| panic!("{jittered}"));
    assert_eq!(rest, "(every 10ms, earlier or later by at most 5ms): line 4 `be quiet` still waits");
    assert_ne!(time, "10ms");
}

#[test]
fn a_plus_and_a_minus_are_read_as_one_sign() {
    let text = |sign: &str| {
        format!("title = \"t\"\nsteps = [{{ line = \"delay all frames by 2ms {sign} 1ms normal\" }}]")
    };
    for sign in ["±", "+-", "+/-"] {
        let scenario = Scenario::cases(&text(sign), &mut NoFiles);
        assert!(scenario.is_ok(), "{sign}: {:?}", scenario.err());
    }
}

/// A drawn step may have ended the fault, or not.
#[test]
fn a_fault_can_be_ended_after_random_steps_that_may_have_ended_it() {
    let text = r#"title = "t"
steps = [
  { line = "lose 1 % of the frames called storm" },
  { random = { steps = 5, from = ["end storm", "be quiet"] }, within = "5ms" },
  { line = "end storm" },
]"#;
    let scenario = Scenario::cases(text, &mut NoFiles).unwrap_or_else(|errors| panic!("{errors}")).remove(0);
    assert_eq!(scenario.replay(1, Recording::new(false, false)).failure, None);
}

#[test]
fn each_part_of_a_condition_has_its_mistake_and_none_has_two() {
    for (condition, expected) in [
        (
            "any of (unit 8 is in OP; unit 9 is in OP)",
            ["unit 8 does not exist", "unit 9 does not exist"].as_slice(),
        ),
        ("any of (unit 9 is in OP; not (unit 9 is in OP))", &["unit 9 does not exist"]),
        ("any of (unit 9 is in OP; unit 9 is in INIT)", &["unit 9 does not exist"]),
        ("object 9999:00 of unit 1 changes", &["unit 1 has no object 9999:00"]),
    ] {
        let told = said(&format!("{{ expect = \"{condition}\" }}"));
        let messages: Vec<&str> =
            told.lines().filter_map(|line| line.strip_prefix("line 3, column 12: ")).collect();
        assert_eq!(messages, expected, "{condition}");
    }
}

#[test]
fn a_list_of_units_where_a_sentence_belongs_has_a_way_out() {
    let told = said("{ unit = [1, 2], expect = \"unit 1 is in OP\" }");
    assert!(told.contains("`unit` is an array"), "{told}");
    assert!(told.contains("a sentence names its units, such as `restart units 1, 2`"), "{told}");
    let typed = said("{ master = { read_sdo = { unit = [1, 2], entry = \"1018:04\" } } }");
    assert!(typed.contains("`master.read_sdo.unit` is an array"), "{typed}");
}
