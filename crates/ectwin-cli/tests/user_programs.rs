//! The reports of the built command about a user program while it runs.

mod running;
#[expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]
mod started;

use std::path::{Path, PathBuf};

use running::{Running, must};
use started::{Started, folder_of, free_link};

/// A program in a file of the test.
fn written(name: &str, source: &str) -> PathBuf {
    let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.st"));
    change(&program, source);
    program
}

fn change(program: &Path, source: &str) {
    must(std::fs::write(program, source));
}

#[test]
fn a_built_in_program_is_run_and_refused_beside_a_file() {
    let folder = folder_of("builtin");
    must(std::fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\n"));
    must(std::fs::write(folder.join("a.st"), ";\n"));
    let link = free_link();
    let run = ["run", "unit.toml", "--link", &link, "--program", "builtin:copy"];
    assert_eq!(Started::new(&folder, "", &run).ready().interrupt().code, Some(0));
    let refused = started::ended(&folder, "", &[&run[..], &["--program", "a.st"]].concat());
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("builtin:copy is a whole program"), "{}", refused.stderr);
    assert!(refused.stderr.contains("./builtin:copy"), "{}", refused.stderr);
}

#[test]
fn a_program_that_never_ends_is_told() {
    let program = written("never_ends", "WHILE TRUE DO ; END_WHILE;");
    let mut running = Running::start(&program);
    running.wait_for("task overrun: a scan had used up its 100000 statements");
}

#[test]
fn an_error_in_a_program_is_told_with_its_place() {
    let source = "VAR a : ARRAY[0..3] OF INT; i : INT; END_VAR\ni := i + 1;\na[i] := 1;\n";
    let program = written("index", source);
    let mut running = Running::start(&program);
    running.wait_for("line 3, column 3: index 4 is outside 0..3");
}

#[test]
fn sigusr1_resets_the_errors_of_the_nx_bus_function_modules() {
    let program = written("counts", "SetAlarm(1);");
    let mut running = Running::start(&program);
    running.wait_for("user-defined error 16#1 ");
    let kill = std::process::Command::new("kill").args(["-USR1", &running.id().to_string()]).status();
    assert!(must(kill).success());
    running.wait_for("the errors of all NX Bus Function Modules are reset");
}

#[test]
fn a_changed_program_is_loaded_and_a_wrong_one_is_not() {
    let program = written("changed", "SetAlarm(1);");
    let mut running = Running::start(&program);
    running.wait_for("user-defined error 16#1 ");
    change(&program, "SetAlarm(2, Misspelt);");
    running.wait_for("changed.st:1:13: there is no variable `Misspelt`");
    running.wait_for("the old program continues");
    change(&program, "SetAlarm(3);");
    running.wait_for("a user program was loaded");
    running.wait_for_before("user-defined error 16#3 ", "has changed");
}

/// A unit whose program is `source`, in a folder of the test's own, without `-v`; and the file of the program.
fn started(test: &str, keys: &str, source: &str) -> (Started, PathBuf) {
    let folder = folder_of(test);
    let program = folder.join("p.st");
    change(&program, source);
    let unit = format!("model = \"nx-ect101\"\n[cpu]\nprogram = \"p.st\"\n{keys}");
    must(std::fs::write(folder.join("unit.toml"), unit));
    (Started::new(&folder, "", &["run", "unit.toml", "--link", &free_link()]).ready(), program)
}

fn signal(name: &str, id: &str) {
    assert!(must(std::process::Command::new("kill").args([name, id]).status()).success());
}

/// Its first scan would take half a minute and longer.
#[test]
fn an_endless_scan_is_reported_and_ends_when_a_correct_program_is_there() {
    let keys = "fail_soft = false\nstatement_budget = 1_000_000_000\n";
    let (mut unit, program) =
        started("endless", keys, "VAR n : LINT; END_VAR WHILE TRUE DO n := n + 1; END_WHILE;");
    let line = unit.wait_for("CPU Unit of unit 1: the program has not returned for ");
    assert!(line.contains("80200000"), "{line}");
    signal("-USR1", &unit.id());
    unit.wait_for("the errors are reset when the program of unit 1 has returned");
    change(&program, "SetAlarm(7, Misspelt);");
    unit.wait_for("the old program continues");
    change(&program, "SetAlarm(7);");
    unit.wait_for("p.st is correct again, and is loaded in unit 1");
    unit.wait_for("the errors of all NX Bus Function Modules are reset");
    unit.wait_for("user-defined error 16#7 ");
    let ended = unit.interrupt();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(!ended.stderr.contains("overrun"), "{}", ended.stderr);
}

/// What the user asks for, and the end of a warning, are seen without `-v`.
#[test]
fn the_end_of_a_mistake_and_the_reset_of_errors_are_logged_without_v() {
    let (mut unit, program) = started("quiet", "", "SetAlarm(1);");
    signal("-USR1", &unit.id());
    unit.wait_for("the errors of all NX Bus Function Modules are reset");
    for _ in 0..2 {
        change(&program, "SetAlarm(2, Misspelt);");
        unit.wait_for("the old program continues in unit 1");
        change(&program, "SetAlarm(1);");
        unit.wait_for("p.st is correct again, and is the program that runs");
    }
    change(&program, "SetAlarm(2, Misspelt);");
    unit.wait_for("the old program continues in unit 1");
    change(&program, "SetAlarm(3);");
    unit.wait_for("p.st is correct again, and is loaded in unit 1");
}
