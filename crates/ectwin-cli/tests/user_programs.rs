//! The reports of the built command about a user program while it runs.

mod running;

use std::path::{Path, PathBuf};

use running::{Running, must};

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
    running.wait_for("line 3, column 3: index 4 lies outside 0..3");
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
