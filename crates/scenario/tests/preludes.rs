//! Preludes of scenario files: keys and steps that several files share.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Files, Recording, Scenario, ScenarioErrors, Wanted};

/// Files by their paths.
struct Shelf(&'static [(&'static str, &'static str)]);

impl Files for Shelf {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "there is no such file".to_owned())
    }
}

const SHELF: &[(&str, &str)] = &[
    (
        "shared/common.toml",
        "limit = \"5s\"\nseed = 7\nunits = [\"units/one.toml\", { file = \"units/two.toml\", program = \"copy.st\" }]\n\
         steps = [\n  { master = \"take all units to {state}\" },\n  { expect = \"all units are in {state}\", within = \"1s\" },\n]\n",
    ),
    ("shared/units/one.toml", "model = \"nx-ect101\""),
    ("shared/units/two.toml", "model = \"nx-ect101\"\nname = \"N2\"\nserial = 2"),
    ("shared/copy.st", "N2_UINTs_01_C_to_M := N2_UINTs_01_M_to_C;"),
    ("shared/more.toml", "use = \"common.toml\"\nseed = 8\nsteps = [{ line = \"be quiet\" }]"),
    ("circle-a.toml", "use = \"circle-b.toml\""),
    ("circle-b.toml", "use = \"./x/../circle-a.toml\""),
    ("wrong.toml", "limt = \"5s\"\nsteps = [\n  { line = \"unplg cable 1\" },\n]"),
    ("far.toml", "steps = [\n  { line = \"be quiet\" },\n  { line = \"unplug cable 9\" },\n]"),
    ("far-again.toml", "use = \"far.toml\""),
    ("wrong-again.toml", "use = \"wrong.toml\""),
    ("farther.toml", "steps = [\n  { line = \"unplug cable 9\" },\n  { line = \"plug cable 9\" },\n]"),
    ("idle.toml", "steps = [{ expect = \"unit 1 is in INIT\" }]"),
    ("dice.toml", "steps = [{ random = 3, within = \"1s\" }]"),
    ("with.toml", "with = { a = [1] }"),
    ("keys.toml", "title = \"from the prelude\"\nlimit = \"2s\""),
];

fn cases(text: &str) -> Result<Vec<Scenario>, ScenarioErrors> {
    Scenario::cases(text, &mut Shelf(SHELF))
}

fn one(text: &str) -> Scenario {
    cases(text).unwrap_or_else(|errors| panic!("{text}\n{errors}")).remove(0)
}

fn errors(text: &str) -> String {
    cases(text).expect_err(text).to_string()
}

#[test]
fn a_prelude_gives_what_the_file_leaves_out_and_its_steps_come_first() {
    let text = "title = \"t\"\nuse = \"shared/common.toml\"\nseed = 9\nwith = { state = [\"OP\"] }\nsteps = [\n  { expect = \"unit 2 is in INIT\" },\n]";
    let scenario = one(text);
    assert_eq!((scenario.seed, scenario.limit.to_string().as_str(), scenario.units.len()), (9, "5s", 2));
    let texts: Vec<_> =
        scenario.each_step().into_iter().map(|step| (step.line, step.text.as_str())).collect();
    assert_eq!(
        texts,
        [
            (2, "shared/common.toml:5: take all units to OP"),
            (2, "shared/common.toml:6: all units are in OP"),
            (6, "unit 2 is in INIT"),
        ]
    );
    let failure = scenario.replay(9, Recording::new(false, false)).failure.expect("it is in OP");
    assert_eq!((failure.line, failure.text.as_str()), (6, "unit 2 is in INIT"));
}

#[test]
fn a_prelude_uses_others_by_paths_from_its_folder() {
    let text = "title = \"t\"\nuse = \"shared/more.toml\"\nwith = { state = [\"PRE-OP\", \"OP\"] }";
    let all = cases(text).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((all.len(), all[0].seed), (2, 8), "the nearer one counts");
    let texts: Vec<_> = all[0].each_step().into_iter().map(|step| step.text.as_str()).collect();
    assert_eq!(
        texts,
        [
            "shared/common.toml:5: take all units to PRE-OP",
            "shared/common.toml:6: all units are in PRE-OP",
            "shared/more.toml:3: be quiet",
        ]
    );
}

#[test]
fn several_preludes_come_in_their_order() {
    let text = "use = [\"keys.toml\", \"shared/more.toml\"]\nwith = { state = [\"OP\"] }\nsteps = [{ line = \"be quiet\" }]";
    let scenario = one(text);
    assert_eq!((scenario.title.as_str(), scenario.limit.to_string().as_str()), ("from the prelude", "2s"));
    assert_eq!(scenario.each_step().len(), 4);
}

#[test]
fn mistakes_of_preludes_are_told_with_their_place() {
    let file = |used: &str| format!("title = \"t\"\nuse = {used}\nsteps = [{{ line = \"be quiet\" }}]");
    for (used, place, message) in [
        (
            "\"nowhere.toml\"",
            "line 2, column 7",
            "the prelude nowhere.toml cannot be read: there is no such file",
        ),
        ("\"circle-a.toml\"", "line 2, column 7", "in a circle: circle-a.toml, circle-b.toml, circle-a.toml"),
        ("\"wrong.toml\"", "line 2, column 7", "wrong.toml:1:1: unknown key `limt`"),
        ("\"wrong.toml\"", "line 2, column 7", "wrong.toml:3:12: `unplg cable 1` is not a valid sentence"),
        ("\"far.toml\"", "line 2, column 7", "far.toml:3:12: cable 9 does not exist"),
        ("\"dice.toml\"", "line 2, column 7", "a prelude has no random steps"),
        ("\"with.toml\"", "line 2, column 7", "with.toml:1:8: a prelude has no parameters"),
        ("5", "line 2, column 7", "`use` is an integer"),
        ("[]", "line 2, column 7", "`use` is an empty list"),
    ] {
        let errors = errors(&file(used));
        assert!(errors.contains(place) && errors.contains(message), "{used}\n{errors}");
    }
    let uses = |count: usize| format!("[{}]", vec!["\"keys.toml\""; count].join(", "));
    let many = errors(&file(&uses(101)));
    assert!(many.contains("keys.toml: a scenario uses at most 100 preludes"), "{many}");
    assert_eq!(cases(&file(&uses(100))).map(|cases| cases.len()), Ok(1));
    let missing = errors("use = \"keys.toml\"");
    assert!(missing.contains("`steps` is missing, also in the preludes"), "{missing}");
    let unused =
        errors("title = \"t\"\nuse = \"keys.toml\"\nwith = { a = [1] }\nsteps = [{ line = \"be quiet\" }]");
    assert!(unused.contains("`{a}` is not in any text"), "{unused}");
}

#[test]
fn mistakes_of_the_file_and_of_its_preludes_are_found_in_one_run() {
    let lines = |text: &str| errors(text).lines().filter(|line| line.starts_with("line ")).count();
    let own = "{ expect = \"unit 1 is in OPP\" }, { expect = \"unit 1 is in OP\", within = \"5\" }";
    // A prelude with names that do not exist, and one that cannot be read.
    for (prelude, mistakes) in [("far.toml", 1), ("wrong.toml", 2), ("missing.toml", 1)] {
        let text = format!("title = \"t\"\nuse = \"{prelude}\"\nsteps = [{own}]");
        assert_eq!(lines(&text), 2 + mistakes, "{}", errors(&text));
    }
}

#[test]
fn the_mistake_of_a_prelude_is_reported_once() {
    for (used, expected) in [
        ("\"wrong.toml\", \"wrong-again.toml\"", ["unknown key `limt`", "`unplg cable 1`"].as_slice()),
        ("\"far.toml\", \"far-again.toml\"", &["far.toml:3:12: cable 9 does not exist"]),
        // The same words at two places are two mistakes.
        ("\"farther.toml\"", &["farther.toml:2:12: cable 9", "farther.toml:3:12: cable 9"]),
    ] {
        let text = format!(
            "title = \"t {{a}}\"\nuse = [{used}]\nwith = {{ a = [1, 2] }}\nsteps = [{{ line = \"be quiet\" }}]"
        );
        let told = errors(&text);
        assert_eq!(told.lines().filter(|line| line.starts_with("line ")).count(), expected.len(), "{told}");
        assert!(expected.iter().all(|words| told.contains(words)), "{told}");
    }
}

#[test]
fn a_prelude_that_is_twice_in_the_list_has_its_steps_twice() {
    let text = "title = \"t\"\nuse = [\"idle.toml\", \"./idle.toml\"]\nsteps = [{ line = \"be quiet\" }]";
    assert_eq!(one(text).each_step().len(), 3);
}
