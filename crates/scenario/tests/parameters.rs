//! Parameters of a scenario file: a case of each combination of their values.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use proptest::prelude::*;
use scenario::{Files, Recording, Scenario, ScenarioErrors, Wanted};

/// One unit file, and how often it is read.
#[derive(Default)]
struct OneUnit {
    reads: usize,
}

impl Files for OneUnit {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        self.reads += 1;
        if path == "unit.toml" { Ok("model = \"nx-ect101\"".to_owned()) } else { Err(format!("no {path}")) }
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        if path == "blank.bin" { Ok(vec![0xFF; 2_048]) } else { Err(format!("no {path}")) }
    }
}

fn cases(text: &str) -> Result<Vec<Scenario>, ScenarioErrors> {
    Scenario::cases(text, &mut OneUnit::default())
}

fn names(text: &str) -> Vec<String> {
    cases(text).expect("a right file").into_iter().filter_map(|scenario| scenario.case).collect()
}

fn errors(text: &str) -> String {
    match cases(text) {
        Ok(cases) => panic!("{} cases of {text}", cases.len()),
        Err(errors) => errors.to_string(),
    }
}

const TWO: &str = r#"title = "{state} with {loss} % loss"
seed = "{loss}"
with = { loss = [1, 5], state = ["PRE-OP", "SAFE-OP"] }
steps = [
  { line = "lose {loss} % of the frames" },
  { master = "take unit 1 to {state}" },
  { expect = "unit 1 is in {state}", within = "{loss}s" },
  { expect = { cycles = { at_least = "{loss}" } }, within = "1s" },
]
"#;

#[test]
fn each_combination_of_values_is_a_case() {
    let all = cases(TWO).expect("a right file");
    let seen: Vec<_> =
        all.iter().map(|case| (case.case.as_deref(), case.title.as_str(), case.seed)).collect();
    assert_eq!(
        seen,
        [
            (Some("loss = 1, state = PRE-OP"), "PRE-OP with 1 % loss", 1),
            (Some("loss = 1, state = SAFE-OP"), "SAFE-OP with 1 % loss", 1),
            (Some("loss = 5, state = PRE-OP"), "PRE-OP with 5 % loss", 5),
            (Some("loss = 5, state = SAFE-OP"), "SAFE-OP with 5 % loss", 5),
        ]
    );
}

/// A number of a range is an integer, as one of a list.
#[test]
fn numbers_of_a_range_are_as_those_of_a_list() {
    let text = |values: &str| {
        format!(
            "title = \"t\"\nwith = {{ n = {values} }}\nseed = \"{{n}}\"\nsteps = [{{ line = \"lose {{n}} % of the frames\" }}]"
        )
    };
    let seeds =
        |values: &str| cases(&text(values)).expect(values).iter().map(|case| case.seed).collect::<Vec<_>>();
    assert_eq!(seeds("[3, 4, 5]"), [3, 4, 5]);
    assert_eq!(seeds("{ from = 3, to = 5 }"), [3, 4, 5]);
    assert_eq!(seeds("[{ from = 0, to = 1 }, 7]"), [0, 1, 7]);
    let last = text("{ from = 65534, to = 65535 }").replace("lose {n} %", "lose 5 %");
    assert_eq!(cases(&last).map(|cases| cases.len()), Ok(2));
    let told = errors(&last.replace("65535", "65536"));
    assert!(told.contains("they end at 65535"), "{told}");
}

#[test]
fn each_file_is_read_once_for_all_cases() {
    let mut files = OneUnit::default();
    let text = TWO.replace("with =", "units = [\"unit.toml\"]\nwith =");
    let all = Scenario::cases(&text, &mut files).expect("a right file");
    assert_eq!((all.len(), files.reads), (4, 1));
}

#[test]
fn files_that_are_no_texts_are_read_too() {
    let order = "load blank.bin as it is into the SII of unit 1";
    let text = format!("title = \"t\"\nsteps = [{{ unit = \"{order}\" }}]");
    assert_eq!(cases(&text).map(|cases| cases.len()), Ok(1));
}

#[test]
fn the_value_of_a_case_decides_how_it_ends() {
    let text = r#"title = "t"
with = { time = ["1us", "1s"] }
steps = [{ master = "take unit 1 to OP" }, { expect = "unit 1 is in OP", within = "{time}" }]
"#;
    let ends = |case: &Scenario| case.replay(1, Recording::new(false, false)).passes();
    let ends: Vec<bool> = cases(text).expect("a right file").iter().map(ends).collect();
    assert_eq!(ends, [false, true]);
}

#[test]
fn without_parameters_braces_are_text_and_there_is_one_case_without_a_name() {
    let all = cases("title = \"a {b}\"\nsteps = [{ line = \"be quiet\" }]").expect("a right file");
    assert_eq!(all.iter().map(|case| (&*case.title, &case.case)).collect::<Vec<_>>(), [("a {b}", &None)]);
}

#[test]
fn braces_that_are_meant_are_written_twice() {
    let text = TWO.replace("with {loss} %", "with {{loss}} {loss} {");
    assert_eq!(cases(&text).expect("a right file")[0].title, "PRE-OP with {loss} 1 { loss");
}

#[test]
fn a_value_is_written_as_in_the_list() {
    let text = "title = \"t{a}\"\nwith = { a = [0x0A, 1_000, -5, 1.50, true, 'x y'] }\nsteps = [{ line = \"be quiet\" }]";
    let names = names(text);
    assert_eq!(names, ["a = 0x0A", "a = 1000", "a = -5", "a = 1.50", "a = true", "a = x y"]);
}

#[test]
fn mistakes_of_parameters_are_told_with_their_place() {
    let with =
        |with: &str| format!("title = \"t\"\n{with}\nsteps = [{{ line = \"lose {{a}} % of the frames\" }}]");
    for (text, place, message) in [
        (with("with = { a = [] }"), "line 2, column 14", "`with.a` is an empty list"),
        (with("with = {}"), "line 2, column 8", "`with` has no parameter"),
        (with("with = 5"), "line 2, column 8", "`with` is an integer"),
        (with("with = { a = 5 }"), "line 2, column 14", "a list of values, such as [0, 1, 5]"),
        (with("with = { a = [[1]] }"), "line 2, column 15", "a number, a text, true, false, or a range"),
        (with("with = { a = [1, 1] }"), "line 2, column 18", "the value 1 twice"),
        (with("with = { \"a b\" = [1] }"), "line 2, column 10", "`a b` cannot be in braces"),
        (with("with = { a = [1], b = [2] }"), "line 2, column 19", "`{b}` is not in any text"),
        (with("with = { aa = [1] }"), "line 3, column 19", "nothing has the name `{a}`"),
        (with("with = { ab = [1] }"), "line 3, column 19", "did you mean `ab`?"),
        (with("wiht = { a = [1] }"), "line 2, column 1", "did you mean `with`?"),
        (with("with = { a = [5, 101] }"), "line 3, column 19", "found `101`"),
        (
            format!(
                "title = \"t\"\nwith = {{ a = {0:?}, b = {0:?} }}\nsteps = []",
                (0..101).collect::<Vec<_>>()
            ),
            "line 2, column 8",
            "make 10201 cases, and a file has at most 10000",
        ),
    ] {
        let errors = errors(&text);
        assert!(errors.contains(place) && errors.contains(message), "{text}\n{errors}");
    }
}

#[test]
fn where_one_case_is_needed_several_are_refused() {
    let refused = Scenario::parse(TWO, |_| Err(String::new())).expect_err("four cases").to_string();
    assert!(refused.contains("line 3, column 8: the parameters make 4 cases"), "{refused}");
    assert!(
        Scenario::parse(&TWO.replace("1, 5", "1").replace(", \"SAFE-OP\"", ""), |_| Err(String::new()))
            .is_ok()
    );
}

proptest! {
    /// The model: nested loops, the first parameter outermost.
    #[test]
    fn cases_are_the_product_of_all_values(counts in proptest::collection::vec(1..5_usize, 1..5)) {
        let lists = counts.iter().enumerate().map(|(at, count)| format!("p{at} = {:?}", (0..*count).collect::<Vec<_>>()));
        let title: String = (0..counts.len()).map(|at| format!("{{p{at}}}")).collect();
        let text = format!(
            "title = \"a{title}\"\nwith = {{ {} }}\nsteps = [{{ line = \"be quiet\" }}]",
            lists.collect::<Vec<_>>().join(", ")
        );
        let mut expected = vec![String::new()];
        for (at, count) in counts.iter().enumerate() {
            let comma = if at == 0 { "" } else { ", " };
            let longer = |name: &String| (0..*count).map(move |value| format!("{name}{comma}p{at} = {value}")).collect::<Vec<_>>();
            expected = expected.iter().flat_map(longer).collect();
        }
        prop_assert_eq!(names(&text), expected);
    }
}

/// The first case is the line without loss.
#[test]
fn a_list_of_losses_begins_with_none() {
    let text = r#"title = "t"
with = { loss = [0, 1, 100] }
steps = [
  { line = "lose {loss} % of the frames called rain" },
  { master = "take unit 1 to OP" },
  { expect = "unit 1 is in OP", within = "5s" },
  { line = "end rain" },
]
"#;
    let cases = cases(text).expect("three cases");
    let reports: Vec<_> = cases.iter().map(|case| case.replay(1, Recording::new(true, false))).collect();
    let passes: Vec<bool> = reports.iter().map(scenario::Report::passes).collect();
    assert_eq!(passes, [true, true, false]);
    let trace = reports[0].recording.trace().expect("a trace");
    assert!(trace.contains("lose 0 % of the frames called rain") && !trace.contains("is lost"), "{trace}");
}

/// The text of a case is a file with one value of each parameter, wherever and however they are written.
#[test]
fn the_text_of_a_case_has_one_value_of_each_parameter() {
    for with in [
        "with = { loss = [0, 1_0, 2], word = [\"a\", 'the \"b\"'], unit = { from = 1, to = 2 } }\nsteps = STEPS\n",
        "steps = STEPS\n[with]\nloss = [ 0,\n  1_0, 2 ] # three\nunit = { from = 1, to = 2 }\nword = [\"a\", 'the \"b\"']\n",
        "with.loss = [0, 1_0, 2]\nwith.word = [\"a\", 'the \"b\"']\nwith.unit = [{ from = 1, to = 2 }]\nsteps = STEPS\n",
    ] {
        let steps = "[{ line = \"lose {loss} % of the frames\" }, { unit = \"restart unit {unit}\" }]";
        let with = with.replace("STEPS", steps);
        let text = format!(
            "title = \"{{word}}\"\nunits = [{{ model = \"nx-ect101\" }}, {{ model = \"nx-ect101\", serial = 2 }}]\n{with}"
        );
        let cases = cases(&text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
        let texts = Scenario::texts_of_cases(&text).expect("it has cases");
        assert_eq!((cases.len(), texts.len()), (12, 12), "{with}");
        for (case, text) in cases.iter().zip(&texts) {
            let own = self::cases(text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
            assert_eq!(own.len(), 1, "{text}");
            assert_eq!((&own[0].case, &own[0].title), (&case.case, &case.title), "{text}");
        }
    }
    assert_eq!(Scenario::texts_of_cases("title = \"t\"\n").ok(), Some(vec!["title = \"t\"\n".to_owned()]));
    assert!(Scenario::texts_of_cases("with = { a = [] }\n").is_err());
}

#[test]
fn values_of_for_can_have_the_values_of_parameters() {
    let text = r#"title = "{first} and 3"
with.first = [2]
units = [{ model = "nx-ect101" }, { model = "nx-ect101", name = "B" }, { model = "nx-ect101", name = "C" }]
steps = [
  { for.unit = ["{first}", 3], steps = [{ expect = "unit {unit} is in INIT" }] },
]"#;
    let scenario = Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    let texts: Vec<&str> = scenario.each_step().into_iter().map(|step| step.text.as_str()).collect();
    assert_eq!(texts, ["unit 2 is in INIT", "unit 3 is in INIT"]);
    let unknown = text.replace("\"{first}\", 3", "\"{second}\", 3");
    let errors =
        Scenario::parse(&unknown, |_| Err(String::new())).map(drop).map_err(|errors| errors.to_string());
    assert!(errors.as_ref().is_err_and(|errors| errors.contains("second")), "{errors:?}");
}

#[test]
fn the_ranges_of_for_can_have_the_values_of_parameters() {
    let file = |values: &str| {
        let units = "{ model = \"nx-ect101\" }, { model = \"nx-ect101\" }, { model = \"nx-ect101\" }";
        let steps =
            format!("{{ for.unit = {values}, steps = [{{ expect = \"unit {{unit}} is in INIT\" }}] }}");
        format!("title = \"t\"\nwith = {{ last = [2, 3] }}\nunits = [{units}]\nsteps = [{steps}]")
    };
    for values in
        ["{ from = 1, to = \"{last}\" }", "[1, { from = 2, to = 3 }]", "[{ from = 1, to = \"{last}\" }]"]
    {
        let cases = cases(&file(values));
        if values.contains("last") {
            let steps: Vec<_> = cases
                .unwrap_or_else(|errors| panic!("{errors}"))
                .iter()
                .map(|case| case.each_step().len())
                .collect();
            assert_eq!(steps, [2, 3], "{values}");
        } else {
            assert!(errors(&file(values)).contains("`{last}` is not in any text"), "{values}");
        }
    }
    assert!(errors(&file("{ from = 1, to = \"{lst}\" }")).contains("nothing has the name `{lst}`"));
    assert!(errors(&file("{ from = \"{last}\", to = 2 }")).contains("one value is `[2]`"));
}
