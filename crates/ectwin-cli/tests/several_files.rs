//! Programs in several files: on the command line, in unit files, in scenarios, and while they run.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[path = "replay/bench.rs"]
#[expect(dead_code, reason = "each test uses a part of the bench")]
mod bench;
#[expect(dead_code, reason = "each test uses a part of the command")]
mod running;

use std::fs;
use std::os::unix::fs::symlink;

use bench::Bench;
use ectwin::Setup;
use running::Running;
use serde_json::json;

const MAIN: &str = "PROGRAM Main\nVAR share : Share; END_VAR\nshare(part := Part);\nEND_PROGRAM\n";
const SHARE: &str = "FUNCTION_BLOCK Share\nVAR_INPUT part : INT; END_VAR\nVAR_OUTPUT whole : INT; END_VAR\n\
    whole := 100 / part;\nEND_FUNCTION_BLOCK\n";

fn bench(name: &str) -> Bench {
    let bench = Bench::new(&format!("several-files-{name}"));
    bench.put("main.st", MAIN);
    bench.put("blocks/share.st", SHARE);
    bench.put("blocks/deeper/PART.ST", "VAR_GLOBAL CONSTANT Part : INT := 4; END_VAR\n");
    bench.put("blocks/readme.md", "no program");
    bench
}

#[test]
fn files_and_folders_are_checked_as_one_program() {
    let bench = bench("check");
    for files in [&["main.st", "blocks"][..], &["blocks", "main.st"], &["."]] {
        let ended = bench.ectwin(&[&["st", "check"], files].concat());
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{files:?}");
        assert_eq!(ended.stdout, format!("{}: no problems\n", files.join(", ")));
    }
    for part in ["blocks/share.st", "blocks/deeper", "blocks"] {
        let ended = bench.ectwin(&["st", "check", part]);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{part}");
    }
    bench.put("empty/readme.md", "");
    let ended = bench.ectwin(&["st", "check", "empty"]);
    assert_eq!(ended.code, Some(2));
    assert!(ended.stderr.contains("no file below it ends with .st"), "{}", ended.stderr);
}

#[test]
fn a_file_that_is_given_twice_is_one_file() {
    let bench = bench("twice");
    symlink("main.st", bench.folder.join("soft.st")).unwrap();
    fs::hard_link(bench.folder.join("main.st"), bench.folder.join("hard.st")).unwrap();
    symlink("blocks", bench.folder.join("again")).unwrap();
    for files in [
        &["main.st", "main.st", "blocks"][..],
        &["./main.st", "main.st", "blocks"],
        &["main.st", "soft.st", "blocks"],
        &["main.st", "hard.st", "blocks"],
        &["main.st", "blocks", "blocks/share.st", "again"],
        // The folder contains all of it, main.st by three names.
        &["."],
    ] {
        let ended = bench.ectwin(&[&["st", "check"], files].concat());
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{files:?}");
        let program =
            format!("[{}]", files.iter().map(|file| format!("\"{file}\"")).collect::<Vec<_>>().join(", "));
        let unit = format!("model = \"nx-ect101\"\n[cpu]\nprogram = {program}\n");
        assert!(Setup::from_toml_in(&unit, &bench.folder).is_ok(), "{files:?}");
        bench.put("plain.toml", "model = \"nx-ect101\"\n");
        let expect = "expect = \"program variable share.whole of the master is 25\", within = \"1s\"";
        let scenario = format!(
            "title = \"t\"\nunits = [{{ file = \"plain.toml\", program = {program} }}]\n\
             master = {{ program = {program} }}\nsteps = [{{ {expect} }}, {{ {} }}]\n",
            expect.replace("the master", "unit 1")
        );
        bench.put("scenario.toml", &scenario);
        let ended = bench.ectwin(&["replay", "scenario.toml"]);
        assert_eq!(ended.code, Some(0), "{files:?}: {}{}", ended.stdout, ended.stderr);
    }
    // A copy is another file.
    bench.put("copy.st", MAIN);
    let ended = bench.ectwin(&["st", "check", "main.st", "copy.st", "blocks"]);
    assert!(ended.stderr.contains("copy.st"), "{}", ended.stderr);
    assert_eq!(ended.code, Some(1));
}

#[test]
fn a_problem_names_its_file() {
    let bench = bench("problem");
    bench.put("blocks/share.st", &SHARE.replace("/ part", "/ parts"));
    let ended = bench.ectwin(&["st", "check", "main.st", "blocks"]);
    assert_eq!(ended.code, Some(1));
    assert!(ended.stderr.contains("[blocks/share.st:4:16]"), "{}", ended.stderr);
    let ended = bench.ectwin(&["st", "check", "--json", "main.st", "blocks"]);
    let document: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
    let problem = &document["problems"][0];
    assert_eq!((ended.code, &document["more"]), (Some(1), &json!(false)));
    assert_eq!(
        [&problem["file"], &problem["line"], &problem["column"]],
        [&json!("blocks/share.st"), &json!(4), &json!(16)]
    );
}

#[test]
fn twenty_problems_are_told_and_that_there_are_more() {
    let bench = bench("many");
    for (count, more) in [(20, false), (21, true), (5_000, true)] {
        bench.put("many.st", &(0..count).map(|at| format!("x{at} := 1;\n")).collect::<String>());
        let ended = bench.ectwin(&["st", "check", "many.st"]);
        let says = ended.stderr.lines().last() == Some("stopped at 20 problems; there are more");
        assert_eq!((ended.stderr.matches("there is no variable").count(), says), (20, more), "{count}");
        let ended = bench.ectwin(&["st", "check", "--json", "many.st"]);
        let document: serde_json::Value = serde_json::from_str(&ended.stdout).unwrap();
        assert_eq!(document["problems"].as_array().map(Vec::len), Some(20));
        assert_eq!(document["more"], json!(more), "{count}");
    }
}

#[test]
fn unit_files_and_scenarios_name_lists_and_folders() {
    let bench = bench("named");
    for program in ["[\"main.st\", \"blocks\"]", "[\"main.st\", \"blocks/share.st\", \"blocks/deeper\"]"] {
        bench.put("unit.toml", &format!("model = \"nx-ect101\"\n[cpu]\nprogram = {program}\n"));
        bench.put("plain.toml", "model = \"nx-ect101\"\n");
        for (name, head) in [
            ("by-unit-file", "units = [\"../unit.toml\"]".to_owned()),
            (
                "by-scenario",
                format!("units = [{{ file = \"../plain.toml\", program = {} }}]", above(program)),
            ),
        ] {
            let step = "{ expect = \"program variable share.whole of unit 1 is 25\", within = \"1s\" }";
            let scenario = format!("title = \"{name}\"\n{head}\nsteps = [{step}]\n");
            bench.put(&format!("scenarios/{name}.toml"), &scenario);
            let ended = bench.ectwin(&["replay", &format!("scenarios/{name}.toml")]);
            assert_eq!(ended.code, Some(0), "{name}: {}{}", ended.stdout, ended.stderr);
        }
    }
    bench.put("blocks/main.st", MAIN);
    let master = "title = \"the master's\"\nmaster = { program = \"../blocks\" }\nsteps = [{ expect = \
                  \"program variable share.whole of the master is 25\", within = \"1s\" }]\n";
    bench.put("scenarios/master.toml", master);
    let ended = bench.ectwin(&["replay", "scenarios/master.toml"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
}

/// The same paths, relative to a folder beside them.
fn above(paths: &str) -> String {
    paths.replace("\"main", "\"../main").replace("\"blocks", "\"../blocks")
}

#[test]
fn an_error_in_a_scenario_names_the_file_and_a_wrong_file_has_its_place() {
    let bench = bench("scenario-error");
    bench.put("blocks/deeper/PART.ST", "VAR_GLOBAL CONSTANT Part : INT := 0; END_VAR\n");
    let scenario = "title = \"t\"\nunits = [{ model = \"nx-ect101\", cpu.program = [\"main.st\", \"blocks\"] }]\n\
                    steps = [{ after = \"100ms\", expect = \"no program error of unit 1\" }]\n";
    bench.put("scenario.toml", scenario);
    let told = |ended: bench::Ended| format!("{}{}", ended.stdout, ended.stderr);
    let failed = told(bench.ectwin(&["replay", "scenario.toml"]));
    assert!(failed.contains("blocks/share.st:4:"), "{failed}");
    bench.put("blocks/share.st", &SHARE.replace("/ part", "/ parts"));
    let wrong = told(bench.ectwin(&["replay", "scenario.toml"]));
    assert!(wrong.contains("blocks/share.st:4:16: there is no variable `parts`"), "{wrong}");
}

#[test]
fn run_takes_several_and_an_error_names_the_file() {
    let bench = bench("run");
    bench.put("blocks/deeper/PART.ST", "VAR_GLOBAL CONSTANT Part : INT := 0; END_VAR\n");
    let programs = [bench.folder.join("main.st"), bench.folder.join("blocks")];
    let mut running = Running::start_all(&programs);
    running.wait_for("share.st, line 4, column");
}

#[test]
fn a_changed_block_is_loaded_once_and_a_timer_runs_to_its_end() {
    let bench = bench("timer");
    let main = "PROGRAM Main VAR t : Wait; END_VAR t(); IF t.Q THEN SetAlarm(t.Number); END_IF; END_PROGRAM";
    let block = |number: u16| {
        format!(
            "FUNCTION_BLOCK Wait VAR_OUTPUT Q : BOOL; Number : UINT := {number}; END_VAR VAR t : TON; END_VAR\n\
             t(IN := TRUE, PT := T#2s, Q => Q);\nEND_FUNCTION_BLOCK"
        )
    };
    bench.put("main.st", main);
    bench.put("blocks/share.st", &block(1));
    let mut running = Running::start_all(&[bench.folder.join("main.st"), bench.folder.join("blocks")]);
    running.wait_for("user-defined error 16#1 ");
    bench.put("blocks/share.st", &block(2));
    running.wait_for("has changed, and is loaded");
    // If it were reloaded repeatedly, it would never reach the end of its two seconds.
    running.wait_for_before("user-defined error 16#2 ", "is loaded");
}
