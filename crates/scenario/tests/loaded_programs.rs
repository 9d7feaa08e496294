//! Programs that steps load: in every mode, and with the variables that the expectations name.

use scenario::{Recording, Report, Scenario};

const PROGRAMS: [(&str, &str); 5] = [
    ("one.st", "VAR a, both : UINT; kind : WORD; END_VAR a := 1; both := 1; kind := 31;"),
    ("two.st", "VAR b, both : UINT; kind : UINT; END_VAR b := 2; both := 2; kind := 31;"),
    ("kept.st", "VAR a, both : UINT; kind : WORD; END_VAR a := 1; both := 3; kind := 31;"),
    ("wrong.st", "VAR a : UINT; END_VAR a := nothing;"),
    ("error.st", "VAR a : UINT; t : ARRAY[0..1] OF UINT; END_VAR a := a + 5; t[a] := 1;"),
];

fn read(unit: &str, steps: &[&str]) -> Result<Scenario, Vec<String>> {
    let steps: Vec<String> = steps.iter().map(|step| format!("{{ {step} }}")).collect();
    let text = format!(
        "title = \"t\"\nunits = [{{ model = \"nx-ect101\"{unit} }}]\nsteps = [\n{}\n]",
        steps.join(",\n")
    );
    let program = |path: &str| {
        let program = PROGRAMS.iter().find(|(name, _)| *name == path);
        program.map(|(_, text)| (*text).to_owned()).ok_or_else(|| format!("no {path}"))
    };
    let words = |error: &scenario::ScenarioError| format!("{} / {}", error.message, error.help);
    Scenario::parse(&text, program).map_err(|errors| errors.iter().map(words).collect())
}

const ONE: &str = ", cpu.program = \"one.st\"";

fn replay(steps: &[&str]) -> Report {
    let scenario = read(ONE, steps).unwrap_or_else(|errors| panic!("{errors:?}"));
    scenario.replay(1, Recording::new(true, false))
}

fn refused(steps: &[&str]) -> Vec<String> {
    read(ONE, steps).err().unwrap_or_default()
}

const LOAD_TWO: &str = "after = \"5ms\", cpu = \"load two.st into unit 1\"";
const LOAD_KEPT: &str = "after = \"5ms\", cpu = \"load kept.st into unit 1\"";
const B_IS_2: &str = "after = \"5ms\", expect = \"program variable b of unit 1 is 2\"";
const A_IS_1: &str = "after = \"5ms\", expect = \"program variable a of unit 1 is 1\"";

/// As a changed file: through PROGRAM mode, and back.
#[test]
fn a_program_is_loaded_in_run_mode_too() {
    let report = replay(&[A_IS_1, LOAD_TWO, B_IS_2]);
    let trace = report.recording.trace().unwrap_or_default();
    assert_eq!(report.failure, None, "{trace}");
    let told: Vec<&str> =
        trace.lines().filter_map(|line| line.split_once("cpu 1     ")).map(|(_, words)| words).collect();
    assert_eq!(told, ["PROGRAM mode", "a user program was loaded", "RUN mode"], "{trace}");
}

#[test]
fn a_cpu_unit_in_program_mode_stays_in_it() {
    let report = replay(&[
        "cpu = \"set unit 1 to PROGRAM mode\"",
        LOAD_TWO,
        "after = \"5ms\", expect = \"program variable b of unit 1 is 0\"",
    ]);
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

#[test]
fn expectations_are_checked_with_the_program_of_their_time() {
    let of = |variable: &str| format!("the program of unit 1 has no variable {variable}");
    assert!(refused(&[B_IS_2])[0].starts_with(&of("b")));
    assert!(refused(&[LOAD_TWO, A_IS_1])[0].starts_with(&of("a")));
    assert_eq!(refused(&[LOAD_TWO, B_IS_2, LOAD_KEPT, A_IS_1]), [""; 0]);
    // Each in the notation of its type.
    let kind = "after = \"5ms\", expect = \"program variable kind of unit 1 is 16#1F\"";
    let report = replay(&[kind, LOAD_TWO, kind, LOAD_KEPT, kind]);
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

/// An expectation to the end meets the programs that later steps load.
#[test]
fn never_is_checked_with_later_programs_too() {
    let never = |variable: &str| format!("never = \"program variable {variable} of unit 1 is 2\"");
    let way_out = "end the expectation before it is loaded, with `until`";
    let lost = refused(&[&never("a"), LOAD_TWO]);
    assert_eq!(
        lost,
        [format!("the program two.st, which a later step loads into unit 1, has no variable a / {way_out}")]
    );
    let other = refused(&["never = \"program variable kind of unit 1 is 5\"", LOAD_TWO]);
    assert_eq!(other.len(), 1, "{other:?}");
    assert!(
        other[0].starts_with(
            "the program two.st, which a later step loads into unit 1, has another type for kind"
        )
    );
    assert!(refused(&[&never("b"), LOAD_TWO])[0].starts_with("the program of unit 1 has no variable b"));

    assert_eq!(replay(&[&never("a"), LOAD_KEPT, A_IS_1]).failure, None);
    let failure = replay(&[&never("both"), LOAD_TWO, B_IS_2]).failure.map(|failure| failure.seen);
    assert_eq!(failure.as_deref(), Some("it holds, and `never` expects that it does not"));
    let until =
        "never = \"program variable a of unit 1 is 2\", until = \"program variable a of unit 1 is 1\"";
    assert_eq!(replay(&[until, LOAD_TWO, B_IS_2]).failure, None);
}

#[test]
fn a_unit_without_a_program_has_one_after_a_load() {
    let without = |steps: &[&str]| read("", steps).err().unwrap_or_default();
    let no_error = "expect = \"no program error of unit 1\"";
    let load = "cpu = \"load error.st into unit 1\"";
    assert_eq!(without(&[load, no_error]), [""; 0]);
    assert_eq!(without(&["never = \"program error of unit 1\"", load]), [""; 0]);
    assert!(without(&[no_error, load])[0].starts_with("unit 1 has no user program"));
    let scenario =
        read("", &["never = \"program error of unit 1\"", load, "after = \"9ms\", line = \"be quiet\""]);
    let failure = scenario
        .unwrap_or_else(|errors| panic!("{errors:?}"))
        .replay(1, Recording::new(false, false))
        .failure;
    assert!(failure.is_some());
}

/// One mistake is one message.
#[test]
fn a_program_that_cannot_be_loaded_gives_no_more_mistakes() {
    let errors =
        refused(&["cpu = \"load wrong.st into unit 1\"", "expect = \"program variable c of unit 1 is 5\""]);
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].contains("wrong.st:1:"), "{errors:?}");
}

/// A program of a test has its variables only when it runs.
#[test]
fn a_variable_that_is_not_there_when_it_is_checked_is_a_failure() {
    use scenario::UserProgram;
    for step in
        ["expect = \"program variable a of unit 1 is 1\"", "never = \"program variable a of unit 1 is 2\""]
    {
        let mut scenario = read(ONE, &[step]).unwrap_or_else(|errors| panic!("{errors:?}"));
        scenario.units[0].program = UserProgram::Custom(|| Box::new(|_: &mut plc::Io| {}));
        let failure = scenario.replay(1, Recording::new(false, false)).failure.map(|failure| failure.seen);
        assert_eq!(failure.as_deref(), Some("it is not there"), "{step}");
    }
}
