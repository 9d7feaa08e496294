//! Scripts: every scenario file is one, and its JSON has the same replay as the file.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::fs;
use std::path::{Path, PathBuf};

use scenario::model::{
    Bytes, Condition, Expectation, LineOrder, MasterOrder, Mode, Order, Repetition, Script, ScriptStep, Step,
    Trigger, UnitNumber, UnitSet,
};
use scenario::{ErrorPlace, Files, Recording, Scenario, Wanted};
use time::Duration;
use wire::AlState;

/// Files of a folder.
struct Folder(PathBuf);

impl Files for Folder {
    fn text(&mut self, path: &str, _wanted: Wanted) -> Result<String, String> {
        fs::read_to_string(self.0.join(path)).map_err(|error| error.to_string())
    }
}

/// No files.
struct Nothing;

impl Files for Nothing {
    fn text(&mut self, path: &str, _wanted: Wanted) -> Result<String, String> {
        Err(format!("{path}: no files here"))
    }
}

fn scenario_files() -> Vec<PathBuf> {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    files
}

/// The frames of a replay, and its result.
fn replayed(scenario: &Scenario) -> (Option<String>, Option<Vec<u8>>) {
    let report = scenario.replay(scenario.seed, Recording::new(false, true));
    (report.failure.map(|failure| failure.seen), report.recording.into_capture())
}

#[test]
fn every_scenario_file_is_a_script_whose_json_and_typed_toml_replay_as_the_file_does() {
    for file in scenario_files() {
        let text = fs::read_to_string(&file).expect("a scenario");
        let name = file.display();
        if text.contains("\nuse = ") {
            // A prelude is another file, which a script does not name.
            continue;
        }
        let script = Script::parse(&text).unwrap_or_else(|errors| panic!("{name}: {errors}"));
        let json = serde_json::to_string(&script).expect("a script is JSON");
        let back: Script =
            serde_json::from_str(&json).unwrap_or_else(|error| panic!("{name}: {error}\n{json}"));
        assert_eq!(back, script, "{name}");
        let typed = toml::to_string(&script).expect("a script is TOML");
        assert_eq!(Script::parse(&typed).as_ref(), Ok(&script), "{name}\n{typed}");

        let mut folder = Folder(file.parent().expect("a folder").to_owned());
        let of_file = Scenario::parse_with(&text, &mut folder).expect("a right file");
        let of_json = Scenario::of(back, &mut folder).expect("a right script");
        assert!(replayed(&of_file) == replayed(&of_json), "{name}");
    }
}

fn unit_1_is_in(state: AlState) -> Condition {
    Condition::State { units: UnitNumber::at(0).into(), state, al_status_code: None }
}

/// A script that is built in code.
fn built() -> Script {
    let mut script = Script::new("built");
    let take = MasterOrder::Take { units: UnitSet::All, state: AlState::Op };
    let within = Mode::Within(Duration::from_millis(100));
    let reached = Expectation { condition: unit_1_is_in(AlState::Op), mode: within };
    script.steps =
        vec![Step::at_once(Order::Master(take)).into(), Step::at_once(Order::Expect(reached)).into()];
    script
}

#[test]
fn a_script_that_is_built_in_code_replays_and_names_steps_by_their_numbers() {
    let scenario = Scenario::of(built(), &mut Nothing).expect("a right script");
    let report = scenario.replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None);
    assert!(report.recording.trace().unwrap_or_default().contains("step      take all units to OP"));

    let mut wrong = built();
    let hasty = Expectation { condition: unit_1_is_in(AlState::Init), mode: Mode::Now };
    wrong.steps.push(Step::at_once(Order::Expect(hasty)).into());
    let scenario = Scenario::of(wrong, &mut Nothing).expect("a right script");
    let failure = scenario.replay(1, Recording::new(false, false)).failure.expect("it is not in INIT");
    assert_eq!((failure.line, failure.text.as_str()), (3, "unit 1 is in INIT"));
}

#[test]
fn what_is_wrong_with_a_script_is_told_with_the_number_of_the_step() {
    let refused = |step: Step| {
        let mut script = built();
        script.steps.push(ScriptStep::Step(step));
        let errors = Scenario::of(script, &mut Nothing).expect_err("a wrong step");
        let error = errors.iter().next().expect("an error").clone();
        assert_eq!(error.place, ErrorPlace::Step(3));
        error.to_string()
    };
    let unit_2 = UnitNumber::at(1);
    let order = |order| Step::at_once(Order::Master(order));
    let nothing = Bytes::default();
    for (step, words) in [
        (
            order(MasterOrder::UseMailboxCounter { counter: 8 }),
            "step 3: expected a mailbox counter from 0 to 7",
        ),
        (order(MasterOrder::SetOutputs { unit: unit_2.into(), at: 0, bytes: [1].into() }), "does not exist"),
        (
            order(MasterOrder::SetOutputs { unit: UnitNumber::at(0).into(), at: 0, bytes: nothing }),
            "expected bytes",
        ),
        (
            Step {
                trigger: Trigger::At(Duration::from_secs(61)),
                ..Step::at_once(Order::Line(LineOrder::BeQuiet))
            },
            "is after the limit of 60s",
        ),
        (
            Step {
                repetition: Some(Repetition { times: 0, every: Duration::ZERO, jitter: Duration::ZERO }),
                ..Step::at_once(Order::Line(LineOrder::BeQuiet))
            },
            "`repeat` is 1 to 10000 times",
        ),
        (
            Step {
                trigger: Trigger::When(Condition::SdoGave { unit: None, value: Bytes::default() }),
                ..order(MasterOrder::Behave)
            },
            "expected bytes",
        ),
    ] {
        let message = refused(step);
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn steps_are_tables_of_the_same_keys_in_json_and_toml() {
    let json = |step: &str| serde_json::from_str::<ScriptStep>(step);
    for step in [
        r#"{"after":"5ms","line":{"unplug":{"cable":1}}}"#,
        r#"{"when":{"master_idle":{}},"expect":{"cycles":{"at_least":3}},"until":{"master_gave_up":{}}}"#,
        r#"{"never":{"sdo_taken":{}},"until":{"master_idle":{}}}"#,
        r#"{"unit":{"restart":{"units":"all"}},"repeat":3,"every":"10ms","jitter":"1ms"}"#,
        r#"{"within":"3s","random":30}"#,
    ] {
        let read = json(step).expect(step);
        assert_eq!(serde_json::to_string(&read).expect("JSON"), step);
    }
    for (step, words) in [
        (
            r#"{ "at": "1ms", "after": "1ms", "line": { "be_quiet": {} } }"#,
            "at most one of `at`, `after` and `when`",
        ),
        (r#"{ "line": { "be_quiet": {} }, "within": "1ms" }"#, "belong to `expect`"),
        (
            r#"{ "never": { "master_idle": {} }, "for": "1ms" }"#,
            "`never` has no `for`; `never` is checked to the end",
        ),
        (r#"{ "expect": { "master_idle": {} }, "within": "1ms", "for": "1ms" }"#, "contradict"),
        (r#"{ "repeat": 3, "line": { "be_quiet": {} } }"#, "`repeat` needs `every`"),
        (r#"{ "random": 3 }"#, "needs the time"),
        (r#"{ "after": "1ms" }"#, "this one has none"),
        (r#"{ "line": { "be_quiet": {} }, "never": { "master_idle": {} } }"#, "this one has 2"),
        (r#"{ "lines": {} }"#, "unknown field `lines`"),
        (r#"{ "at": "5", "line": { "be_quiet": {} } }"#, "not a duration"),
    ] {
        let refusal = json(step).expect_err(step).to_string();
        assert!(refusal.contains(words), "{step}: {refusal}");
    }
}
