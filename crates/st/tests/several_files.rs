//! Programs in several files, and files that are only part of a program.

use st::{NoHost, PROBLEMS_MAX, Sources, compile, judge};

const BLOCK: &str = "FUNCTION_BLOCK Ramp\nVAR_INPUT target : INT; END_VAR\nVAR_OUTPUT now : INT; END_VAR\n\
    now := now + target;\nEND_FUNCTION_BLOCK\n";
const MAIN: &str = "PROGRAM Main\nVAR ramp : Ramp; END_VAR\nramp(target := Step);\nEND_PROGRAM\n";
const GLOBALS: &str = "VAR_GLOBAL CONSTANT Step : INT := 3; END_VAR\n";

fn told(files: &[(&str, &str)]) -> String {
    let sources = Sources::files(files.iter().copied());
    compile(sources, &[]).err().map(|problems| problems.to_string()).unwrap_or_default()
}

#[test]
fn blocks_functions_types_and_globals_alone_are_judged() {
    for part in [
        BLOCK,
        GLOBALS,
        "FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR\nTwice := 2 * x;\nEND_FUNCTION",
        "TYPE Colour : (red, green); END_TYPE",
    ] {
        judge(part, &[]).unwrap_or_else(|problems| panic!("{part}: {problems}"));
        let problems = compile(part, &[]).expect_err("nothing runs in it");
        assert!(problems.to_string().contains("there is no PROGRAM in it"), "{problems}");
    }
    let wrong = BLOCK.replace("now + target", "now + goal");
    let problems = judge(&wrong, &[]).expect_err("it is wrong").to_string();
    assert!(problems.contains("4:14: there is no variable `goal`"), "{problems}");
    let empty = judge("(* nothing *)", &[]).expect_err("it is empty").to_string();
    assert!(empty.contains("it is empty"), "{empty}");
}

#[test]
fn files_see_each_other_in_whatever_order() {
    let mut files = [("main.st", MAIN), ("ramp.st", BLOCK), ("globals.st", GLOBALS)];
    for _ in 0..3 {
        files.rotate_left(1);
        let program = compile(Sources::files(files), &[]).unwrap_or_else(|problems| panic!("{problems}"));
        let mut instance = program.start();
        for _ in 0..2 {
            instance.scan(0, 1_000, &mut NoHost).expect("it runs to its end");
        }
        assert_eq!(instance.value("ramp.now").as_deref(), Some("6"));
    }
}

#[test]
fn a_problem_names_the_file_and_the_line_in_it() {
    let wrong = BLOCK.replace("now + target", "now + goal");
    let text = told(&[("main.st", MAIN), ("globals.st", GLOBALS), ("ramp.st", &wrong)]);
    assert!(text.starts_with("ramp.st:4:14: there is no variable `goal`"), "{text}");
}

#[test]
fn what_one_file_leaves_open_stays_in_it() {
    let open = "PROGRAM Main\nIF TRUE THEN\n;\n";
    let text = told(&[("ramp.st", BLOCK), ("main.st", open), ("globals.st", GLOBALS)]);
    let problems = text.strip_suffix("\nnames and types are checked when the syntax is correct");
    assert!(problems.is_some_and(|text| text.lines().all(|line| line.starts_with("main.st:"))), "{text}");
    assert!(text.contains("IF of line 2"), "{text}");
    let comment =
        told(&[("a.st", "PROGRAM A ; END_PROGRAM (* open"), ("b.st", "*) PROGRAM B ; END_PROGRAM")]);
    assert!(comment.contains("a.st:1:25") && comment.contains("b.st:1:1"), "{comment}");
}

#[test]
fn a_name_in_two_files_is_a_name_twice() {
    let text = told(&[("a.st", BLOCK), ("b.st", BLOCK), ("main.st", MAIN), ("globals.st", GLOBALS)]);
    assert!(text.starts_with("b.st:1:16: ") && text.contains("Ramp"), "{text}");
    assert!(text.contains("(the first is at a.st:1:16; "), "{text}");
    let globals = "VAR_GLOBAL\n  step : INT;\nEND_VAR\n";
    let text = told(&[("a.st", GLOBALS), ("b.st", BLOCK), ("main.st", MAIN), ("globals.st", globals)]);
    assert_eq!(text, "globals.st:2:3: the name `step` is declared twice (the first is at a.st:1:21)");
}

#[test]
fn statements_alone_can_be_in_one_file_only() {
    let text = told(&[("a.st", "VAR x : INT; END_VAR x := 1;"), ("b.st", "VAR y : INT; END_VAR y := 1;")]);
    assert!(text.starts_with("b.st:1:1: another file has statements without a PROGRAM too"), "{text}");
    assert_eq!(told(&[("a.st", "VAR x : INT; END_VAR x := 1;"), ("ramp.st", BLOCK)]), "");
}

#[test]
fn a_fault_lies_in_the_file_of_its_statement() {
    let block = "FUNCTION_BLOCK Share\nVAR_INPUT part : INT; END_VAR\nVAR x : INT; END_VAR\n\nx := 1 / part;\nEND_FUNCTION_BLOCK";
    let main = "PROGRAM Main VAR s : Share; END_VAR s(part := 0); END_PROGRAM";
    let program =
        compile(Sources::files([("main.st", main), ("share.st", block)]), &[]).expect("it is right");
    let stopped = program.start().scan(0, 1_000, &mut NoHost).expect_err("a division by zero");
    let place = program.sources().place(stopped.span);
    assert_eq!((place.file, place.line), (Some("share.st"), 5));
}

#[test]
fn reading_and_checking_stop_at_twenty_problems_and_say_so() {
    let unread = |count: usize| "x := ;\n".repeat(count);
    let unknown = |count: usize| (0..count).map(|at| format!("x{at} := 1;\n")).collect::<String>();
    for (source, is_cut) in [
        (unread(PROBLEMS_MAX), false),
        (unread(PROBLEMS_MAX + 1), true),
        (unknown(PROBLEMS_MAX), false),
        (unknown(5_000), true),
    ] {
        let problems = compile(&source, &[]).expect_err("it is wrong");
        assert_eq!((problems.list().len(), problems.are_cut()), (PROBLEMS_MAX, is_cut));
        let last = problems.to_string().lines().last().map(str::to_owned);
        let says = last.as_deref() == Some("stopped at 20 problems; there are more");
        assert_eq!(says, is_cut, "{last:?}");
    }
}
