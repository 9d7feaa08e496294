//! No command overwrites a file that it reads, by whatever path it is given.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;

use started::{Started, ended, folder_of, free_link};

/// Every command with an output that may already exist, and the input that is given as the output.
const CASES: &[(&[&str], &str)] = &[
    (&["esi", "unit.toml", "-o", "OUT"], "unit.toml"),
    (&["sii", "unit.toml", "-o", "OUT"], "unit.toml"),
    (&["esi", "unit.toml", "-o", "OUT"], "N1.nvm"),
    (&["sii", "unit.toml", "-o", "OUT"], "N1.nvm"),
    (&["esi", "unit.toml", "-o", "OUT"], "program.st"),
    (&["sii", "several.toml", "-o", "OUT"], "blocks/a.st"),
    (&["merge", "result.jsonl", "--junit", "OUT"], "result.jsonl"),
    (&["replay", "scenario.toml", "--junit", "OUT"], "scenario.toml"),
    (&["replay", "scenario.toml", "--json", "OUT"], "scenario.toml"),
    (&["replay", "scenario.toml", "--pcap", "OUT"], "scenario.toml"),
    (&["replay", "scenario.toml", "--json", "OUT"], "unit.toml"),
    (&["replay", "scenario.toml", "--json", "OUT"], "N1.nvm"),
    (&["replay", "scenario.toml", "--pcap", "OUT"], "live.pcapng"),
    (&["replay", "scenario.toml", "--junit", "OUT"], "scenario.trace"),
    // Its golden trace would have a different name.
    (&["replay", "named.trace", "--bless"], "named.trace"),
    (&["run", "unit.toml", "--link", "LINK", "--pcap", "OUT"], "unit.toml"),
    (&["run", "unit.toml", "--link", "LINK", "--pcap", "OUT"], "N1.nvm"),
    (&["run", "unit.toml", "--link", "LINK", "--pcap", "OUT"], "program.st"),
    (&["run", "unit.toml", "--link", "LINK", "--program", "other.st", "--pcap", "OUT"], "other.st"),
    (&["run", "unit.toml", "--link", "LINK", "--program", "blocks", "--pcap", "OUT"], "blocks/a.st"),
    // These two overwrite nothing at all.
    (&["import", "live.pcapng", "--unit", "unit.toml", "-o", "OUT"], "unit.toml"),
    (&["search", "dice.toml", "-o", "OUT"], "dice.toml"),
];

const SCENARIO: &str = "title = \"again\"\ncapture = \"live.pcapng\"\nunits = [\"unit.toml\"]\nsteps = [\n\
    { expect = \"the capture is replayed\", within = \"1s\" } ]\n";
const LIVE: &str = "title = \"live\"\nunits = [\"unit.toml\"]\nsteps = [\n\
    { master = \"take unit 1 to PRE-OP\" }, { expect = \"unit 1 is in PRE-OP\", within = \"1s\" } ]\n";

/// A folder with every input.
fn inputs(name: &str) -> std::path::PathBuf {
    let folder = folder_of(name);
    let put = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    put("unit.toml", "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n[cpu]\nprogram = \"program.st\"\n");
    put("program.st", ";\n");
    put("other.st", ";\n");
    put("several.toml", "model = \"nx-ect101\"\n[cpu]\nprogram = [\"program.st\", \"blocks\"]\n");
    fs::create_dir_all(folder.join("blocks")).unwrap();
    put("blocks/a.st", ";\n");
    // The lock of an editor does not belong to the program.
    symlink("nobody@nowhere", folder.join("blocks/.#a.st")).unwrap();
    put("scenario.toml", LIVE);
    put("named.trace", LIVE);
    put("dice.toml", &LIVE.replace("{ expect", "{ random = 3, within = \"1s\" },\n{ expect"));
    let live = ["replay", "scenario.toml", "--pcap", "live.pcapng", "--json", "result.jsonl"];
    assert_eq!(ended(&folder, "", &live).code, Some(0));
    put("scenario.toml", SCENARIO);
    assert_eq!(ended(&folder, "", &["replay", "scenario.toml", "--bless"]).code, Some(0));
    Started::new(&folder, "", &["run", "unit.toml", "--link", &free_link()]).ready().interrupt();
    folder
}

fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
    files.map(|path| (path.display().to_string(), fs::read(&path).unwrap())).collect()
}

#[test]
fn an_output_that_is_an_input_is_refused_and_nothing_is_written() {
    let folder = inputs("inputs");
    let link = free_link();
    for (arguments, input) in CASES {
        for way in ["same", "dotted", "soft", "hard"] {
            let output = folder.join(way);
            let _gone = fs::remove_file(&output);
            let output = match way {
                "same" => (*input).to_owned(),
                "dotted" => format!("./{input}"),
                "soft" => symlink(input, &output).map(|()| "soft".to_owned()).unwrap(),
                _ => fs::hard_link(folder.join(input), &output).map(|()| "hard".to_owned()).unwrap(),
            };
            let before = contents(&folder);
            let arguments: Vec<&str> = arguments
                .iter()
                .map(|argument| match *argument {
                    "OUT" => output.as_str(),
                    "LINK" => link.as_str(),
                    other => other,
                })
                .collect();
            let refused = ended(&folder, "", &arguments);
            assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.stderr);
            assert_eq!(contents(&folder), before, "{arguments:?}");
        }
    }
}

#[test]
fn a_capture_that_one_case_of_a_folder_replays_is_not_replaced() {
    let folder = inputs("folder");
    fs::create_dir(folder.join("out")).unwrap();
    fs::rename(folder.join("live.pcapng"), folder.join("out/0001-scenario-seed-1.pcapng")).unwrap();
    let scenario = SCENARIO.replace("live.pcapng", "out/0001-scenario-seed-1.pcapng");
    fs::write(folder.join("scenario.toml"), scenario).unwrap();
    fs::remove_file(folder.join("scenario.trace")).unwrap();
    let before = contents(&folder.join("out"));
    let refused = ended(&folder, "", &["replay", "scenario.toml", "--pcap", "out/"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("would overwrite"), "{}", refused.stderr);
    assert_eq!(contents(&folder.join("out")), before);
}

#[test]
fn one_file_for_two_outputs_is_refused_and_a_device_is_not() {
    let folder = inputs("outputs");
    let refused = ended(&folder, "", &["replay", "scenario.toml", "--json", "out", "--junit", "./out"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("--junit ./out is the file of --json too"), "{}", refused.stderr);
    assert!(!folder.join("out").exists());
    let device = ["replay", "scenario.toml", "--json", "/dev/null", "--junit", "/dev/null"];
    assert_eq!(ended(&folder, "", &device).code, Some(0));
}

/// Every command with an output that is a file.
const WRITING: &[&[&str]] = &[
    &["esi", "unit.toml", "-o", "OUT"],
    &["sii", "unit.toml", "-o", "OUT"],
    &["merge", "result.jsonl", "--junit", "OUT"],
    &["replay", "scenario.toml", "--junit", "OUT"],
    &["replay", "scenario.toml", "--json", "OUT"],
    &["replay", "scenario.toml", "--pcap", "OUT"],
    &["replay", "scenario.toml", "--pcap", "captures/", "--json", "OUT"],
    &["import", "live.pcapng", "-o", "NEW"],
    &["search", "never.toml", "-o", "NEW"],
];

/// As on a full disk: no file may grow.
#[test]
fn a_command_that_can_write_nothing_leaves_no_new_file_and_changes_none() {
    let folder = inputs("nothing");
    let never = LIVE
        .replace("is in PRE-OP", "is in OP")
        .replace("{ expect", "{ random = 1, within = \"1s\" },\n{ expect");
    fs::write(folder.join("never.toml"), never).unwrap();
    fs::write(folder.join("old"), "the report of yesterday").unwrap();
    let before = contents(&folder);
    for arguments in WRITING {
        for output in ["old", "new"] {
            let put = |argument: &&'static str| match *argument {
                "OUT" => output,
                "NEW" => "new",
                other => other,
            };
            let arguments: Vec<&str> = arguments.iter().map(put).collect();
            let refused = ended(&folder, "ulimit -f 0;", &arguments);
            // The failure that a search has found is its result.
            let code = if arguments[0] == "search" { 1 } else { 2 };
            assert_eq!(refused.code, Some(code), "{arguments:?}: {}", refused.stderr);
            assert!(refused.stderr.contains("cannot write "), "{arguments:?}: {}", refused.stderr);
            assert_eq!(contents(&folder), before, "{arguments:?}");
            let captures = fs::read_dir(folder.join("captures"));
            assert_eq!(captures.map_or(0, Iterator::count), 0, "{arguments:?}");
        }
    }
    // A run goes on without its capture until it ends.
    for output in ["old", "new"] {
        let link = free_link();
        let arguments = ["run", "unit.toml", "--link", &link, "--fast", "--pcap", output];
        let mut run = Started::new(&folder, "ulimit -f 0;", &arguments).ready();
        run.wait_for("cannot be written");
        assert_eq!(run.interrupt().code, Some(2));
        assert_eq!(contents(&folder), before, "{output}");
    }
}

#[test]
fn a_result_without_cases_is_an_empty_file() {
    let folder = inputs("no-cases");
    fs::write(folder.join("old"), "the results of yesterday").unwrap();
    for output in ["old", "new"] {
        let part = ["replay", "scenario.toml", "--partition", "2/2", "--json", output];
        let ended = ended(&folder, "", &part);
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        assert_eq!(fs::read(folder.join(output)).unwrap(), b"");
    }
}

#[test]
fn an_output_in_the_place_of_a_memory_that_is_not_there_yet_is_refused() {
    let folder = inputs("memory");
    fs::remove_file(folder.join("N1.nvm")).unwrap();
    let link = free_link();
    for arguments in [
        &["run", "unit.toml", "--link", &link, "--pcap", "./N1.nvm"][..],
        &["esi", "unit.toml", "-o", "./N1.nvm"],
        &["sii", "unit.toml", "-o", "./N1.nvm"],
    ] {
        let refused = ended(&folder, "", arguments);
        assert_eq!(refused.code, Some(2), "{}", refused.stderr);
        assert!(refused.stderr.contains("would overwrite"), "{}", refused.stderr);
        assert!(!folder.join("N1.nvm").exists());
    }
}

#[test]
fn an_output_beside_the_files_of_a_unit_is_written() {
    let folder = inputs("beside");
    for (command, output) in [("esi", "N1.xml"), ("sii", "builtin:copy")] {
        let unit = "model = \"nx-ect101\"\nstorage = \"N1.nvm\"\n[cpu]\nprogram = \"builtin:copy\"\n";
        fs::write(folder.join("builtin.toml"), unit).unwrap();
        let written = ended(&folder, "", &[command, "builtin.toml", "-o", output]);
        assert_eq!(written.code, Some(0), "{}", written.stderr);
        assert!(folder.join(output).exists());
    }
}

#[test]
fn a_capture_that_another_run_writes_is_refused_until_that_run_ends() {
    let folder = inputs("capture");
    fs::write(folder.join("plain.toml"), "model = \"nx-ect101\"\n").unwrap();
    symlink("frames.pcapng", folder.join("link.pcapng")).unwrap();
    let links = [free_link(), free_link()];
    let run = |link, capture| ["run", "plain.toml", "--link", link, "--pcap", capture];
    let first = Started::new(&folder, "", &run(&links[0], "frames.pcapng")).ready();
    for arguments in [
        &run(&links[1], "frames.pcapng")[..],
        &run(&links[1], "link.pcapng"),
        &["replay", "scenario.toml", "--json", "frames.pcapng"],
    ] {
        let refused = Started::new(&folder, "", arguments).try_ready().err();
        let refused = refused.unwrap_or_else(|| panic!("{arguments:?} is ready"));
        assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.stderr);
        assert!(refused.stderr.contains("another ectwin writes it"), "{}", refused.stderr);
    }
    assert_eq!(first.interrupt().code, Some(0));
    let second = Started::new(&folder, "", &run(&links[1], "link.pcapng")).ready();
    assert_eq!(second.interrupt().code, Some(0));
    let block_type = fs::read(folder.join("frames.pcapng")).unwrap()[..4].to_vec();
    assert_eq!(block_type, [0x0A, 0x0D, 0x0D, 0x0A]);
}
