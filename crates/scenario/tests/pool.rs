//! `random` with what it draws from: groups of the pool, own sentences, weights, several in a file.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::model::{Draws, RandomSteps, Script, ScriptStep};
use scenario::pool::{EVERYDAY, GROUPS, MARKS, ROWS};
use scenario::words::Spoken;
use scenario::{Recording, Scenario};

fn scenario(units: &str, random: &str) -> Result<Scenario, Vec<(String, String)>> {
    let text = format!("title = \"t\"\nunits = [{units}]\nsteps = [\n  {random},\n]\n");
    Scenario::parse(&text, |name| Err(name.to_owned()))
        .map_err(|errors| errors.iter().map(|error| (error.message.clone(), error.help.clone())).collect())
}

/// The steps in the trace of a seed.
fn steps(scenario: &Scenario, seed: u64) -> Vec<String> {
    let report = scenario.replay(seed, Recording::new(true, false));
    let trace = report.recording.trace().unwrap_or_default();
    let steps =
        trace.lines().filter_map(|line| line.split_once("  step      ").map(|(_, step)| step.to_owned()));
    steps.collect()
}

const NX: &str = "{ model = \"nx-ect101\" }";
const LINE: &str = "{ model = \"nx-ect101\" }, { model = \"digital\", outputs = 8 }";

#[test]
fn each_group_gives_steps_that_the_line_can_carry_out_and_each_sentence_is_drawn() {
    for group in GROUPS {
        let random =
            format!("{{ random = {{ steps = 400, from = [\"{}\"] }}, within = \"400ms\" }}", group.name);
        let drawing = scenario(LINE, &random).unwrap_or_else(|errors| panic!("{}: {errors:?}", group.name));
        let drawn = steps(&drawing, 1);
        for row in group.rows() {
            let first: Vec<&str> = row
                .sentence
                .split_whitespace()
                .take_while(|word| !MARKS.iter().any(|mark| mark.word == *word))
                .collect();
            let is_drawn = drawn.iter().any(|step| step.starts_with(&first.join(" ")));
            assert!(is_drawn, "{}: `{}` was not drawn", group.name, row.sentence);
        }
        // Written as steps of a group they are right too, except that the everyday pool is for one model.
        if group.name != "everyday" {
            for step in &drawn {
                let grouped = format!("{{ steps = [{}] }}", plain(step));
                assert!(scenario(LINE, &grouped).is_ok(), "{}: {step}", group.name);
            }
        }
    }
}

#[test]
fn steps_without_from_are_for_units_that_can_carry_them_out() {
    let drawing = scenario(LINE, "{ random = 400, within = \"400ms\" }").expect("a scenario");
    let drawn = steps(&drawing, 1);
    assert!(drawn.len() >= 400, "{}", drawn.len());
    for step in drawn {
        let grouped = format!("{{ steps = [{}] }}", plain(&step));
        assert!(scenario(LINE, &grouped).is_ok(), "{step}");
    }
}

/// The key of a sentence.
fn plain(sentence: &str) -> String {
    let key = [
        ("master", scenario::model::MasterOrder::from_sentence(sentence).is_ok()),
        ("unit", scenario::model::UnitOrder::from_sentence(sentence).is_ok()),
        ("cpu", scenario::model::CpuOrder::from_sentence(sentence).is_ok()),
        ("line", scenario::model::LineOrder::from_sentence(sentence).is_ok()),
    ];
    let (key, _) = key.into_iter().find(|(_, is_it)| *is_it).expect("a sentence");
    format!("{{ {key} = \"{sentence}\" }}")
}

#[test]
fn a_number_alone_draws_from_the_everyday_pool_with_the_numbers_of_before() {
    let drawing = scenario(NX, "{ random = 6, within = \"10ms\" }").expect("right");
    assert_eq!(EVERYDAY.len(), 40);
    assert_eq!(
        steps(&drawing, 7),
        steps(&scenario(NX, "{ random = { steps = 6 }, within = \"10ms\" }").expect("right"), 7)
    );
    assert_eq!(
        steps(&drawing, 7),
        [
            "start the task of unit 1",
            "lose the next 5 process data frames",
            "set unit 1 to PROGRAM mode",
            "break IoCommunications of unit 1",
            "plug cable 1",
            "reset the errors of the NX Bus Function Module of unit 1",
        ]
    );
}

#[test]
fn own_sentences_and_weights_say_what_is_drawn() {
    let random = "{ random = { steps = 300, from = [\"line\", \"break Processing of unit #\", \"lose the next ~ frames\"], \
                  weights = [1, 8, 1] }, within = \"300ms\" }";
    let drawn = steps(&scenario(LINE, random).expect("right"), 3);
    let count = |words: &str| drawn.iter().filter(|step| step.starts_with(words)).count();
    // Only unit 1 has the fault.
    assert_eq!(count("break "), count("break Processing of unit 1"));
    assert!((200..280).contains(&count("break ")), "{}", count("break "));
    assert!(count("unplug cable") > 0 && count("plug cable 2") > 0);
}

#[test]
fn every_sentence_of_the_pool_is_an_own_sentence_too() {
    for row in ROWS {
        let random =
            format!("{{ random = {{ steps = 3, from = [\"{}\"] }}, within = \"3ms\" }}", row.sentence);
        let drawing = scenario(LINE, &random).unwrap_or_else(|errors| panic!("{}: {errors:?}", row.sentence));
        assert_eq!(steps(&drawing, 1).len(), 3, "{}", row.sentence);
    }
}

#[test]
fn several_pools_are_drawn_one_after_the_other() {
    let random = "{ random = { steps = 5, from = [\"cpu\"] }, within = \"5ms\" },\n  \
                  { line = \"be quiet\" },\n  { random = { steps = 5, from = [\"state\"] }, within = \"5ms\" }";
    let drawing = scenario(NX, random).expect("right");
    let drawn = steps(&drawing, 1);
    assert_eq!((drawn.len(), drawn[5].as_str(), drawing.random.len()), (11, "be quiet", 2));
    assert_ne!(drawn[..5], steps(&drawing, 2)[..5]);
    assert_ne!(drawn[6..], steps(&drawing, 2)[6..]);
}

#[test]
fn a_wrong_pool_is_refused_with_a_way_out() {
    for (random, message, help) in [
        (
            "{ steps = 3, from = [\"lin\"] }",
            "`lin` is neither a group of the pool nor a sentence",
            "did you mean `line`?",
        ),
        ("{ steps = 3, from = [\"unplug kable @\"] }", "nor a sentence", "did you mean `unplug cable @`?"),
        (
            "{ steps = 3, from = [\"brek Processing of unit #\"] }",
            "nor a sentence",
            "`break Processing of unit #`?",
        ),
        (
            "{ steps = 3, from = [\"break <fualt> of unit #\"] }",
            "nor a sentence",
            "`<fualt>` is no mark: did you mean `<fault>`?",
        ),
        (
            "{ steps = 3, from = [\"restart unit <whatever>\"] }",
            "nor a sentence",
            "`<whatever>` is no mark: the marks are #, @, ~, <percent>,",
        ),
        ("{ steps = 3, from = [\"stand on the cable\"] }", "nor a sentence", "the groups are everyday, line"),
        (
            "{ steps = 3, from = [\"lose all frames called storm\"] }",
            "a fault that is drawn has no name",
            "leave `called storm` out",
        ),
        (
            "{ steps = 3, from = [\"end storm\"] }",
            "no step before this one makes a fault called storm",
            "`lose all frames called storm`",
        ),
        ("{ steps = 3, from = [] }", "`from` is an empty list", "such as"),
        ("{ steps = 3, weights = [1] }", "`from` is an empty list", "such as"),
        (
            "{ steps = 3, from = [\"line\", \"unit\"], weights = [1] }",
            "`weights` has 1 weight, and `from` has 2 entries",
            "one for each",
        ),
        ("{ steps = 3, from = [\"line\"], weights = [0] }", "a weight of 0, expected 1 to 1000000", ""),
        ("{ steps = 0, from = [\"line\"] }", "`random` is 1 to 10000 steps", ""),
        ("{ steps = 3, form = [\"line\"] }", "unknown key `random.form`", "did you mean `from`?"),
        ("\"line\"", "`random` is a string", "expected a number of steps, or a table"),
    ] {
        let errors =
            scenario(NX, &format!("{{ random = {random}, within = \"1s\" }}")).err().unwrap_or_default();
        let told = |(told, way_out): &(String, String)| {
            told.contains(message) && (told.to_owned() + way_out).contains(help)
        };
        assert!(errors.iter().any(told), "{random}: {errors:?}");
    }
    let digital = scenario(
        "{ model = \"digital\", inputs = 8 }",
        "{ random = { steps = 3, from = [\"sdo\"] }, within = \"1s\" }",
    );
    assert_eq!(digital.err().unwrap_or_default()[0].0, "no unit of this scenario has anything for `sdo`");
    let beside = scenario(NX, "{ at = \"1s\", random = 3, within = \"1s\" }");
    assert_eq!(beside.err().unwrap_or_default()[0].0, "`random` has only `within` beside it");
}

#[test]
fn in_json_it_is_a_number_or_a_table_too() {
    let steps = r#"[{ "random": 3, "within": "1s" }, { "random": { "steps": 3, "from": ["line"] }, "within": "1s" }]"#;
    let steps: Vec<ScriptStep> = serde_json::from_str(steps).expect("right");
    let within = time::Duration::from_secs(1);
    let draws = Draws { from: vec!["line".into()], weights: Vec::new() };
    let random = |draws| ScriptStep::Random(RandomSteps { count: 3, within, draws });
    assert_eq!(steps, [random(None), random(Some(draws))]);
    let script = Script { steps, ..Script::new("t") };
    let text = serde_json::to_string(&script).expect("JSON");
    assert_eq!(serde_json::from_str::<Script>(&text).expect("JSON"), script);
}

#[test]
fn every_mark_is_used_and_no_row_is_twice() {
    for mark in MARKS {
        assert!(
            ROWS.iter().any(|row| row.sentence.split_whitespace().any(|word| word == mark.word)),
            "{}",
            mark.word
        );
    }
    for row in ROWS {
        assert_eq!(
            ROWS.iter().filter(|other| (other.group, other.sentence) == (row.group, row.sentence)).count(),
            1
        );
    }
}
