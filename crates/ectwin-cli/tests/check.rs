//! `ectwin check` and `ectwin list rules`: what they print and how they end.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn ectwin(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ectwin")).args(arguments).env("NO_COLOR", "1").output().unwrap()
}

/// A unit file with these sections.
fn unit_file(name: &str, sections: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, format!("model = \"nx-ect101\"\n{sections}")).unwrap();
    path
}

fn check(name: &str, sections: &str, options: &[&str]) -> (Option<i32>, String) {
    let path = unit_file(name, sections);
    let output = ectwin(&[&["check", path.to_str().unwrap()], options].concat());
    (output.status.code(), String::from_utf8(output.stdout).unwrap())
}

const BROKEN: &str =
    "[io_allocation]\nm_to_c.uints = [\"6001:01\"]\nc_to_m.uints = 4\n[pdo]\nassign.rx = [0x1602, 0x1601]\n";

#[test]
fn every_unit_file_of_ours_satisfies_the_rules() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    for path in files.filter(|path| path.is_file()) {
        let output = ectwin(&["check", path.to_str().unwrap()]);
        let told = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(0), "{told}");
        assert!(told.contains("the setting rules are satisfied") || told.contains("no problems"), "{told}");
    }
}

#[test]
fn a_program_reads_all_findings() {
    let (code, told) = check("check-json.toml", BROKEN, &["--json"]);
    assert_eq!(code, Some(1));
    let document: Value = serde_json::from_str(&told).unwrap();
    let findings = document["findings"].as_array().unwrap();
    let told = |finding: &Value| {
        ["event_code", "rule", "side", "direction", "data_set"].map(|key| finding[key].to_string()).join(" ")
    };
    let expected = [
        r#""392E0000" "sm_order" "assignment" "m_to_c" null"#,
        r#""391B0000" "type" "io_entry" "m_to_c" "1A01""#,
        r#""39160000" "matched" "pdo_entry" "c_to_m" "1A01""#,
    ];
    assert_eq!(findings.iter().map(told).collect::<Vec<_>>(), expected);
    assert_eq!(findings[0]["event_name"], "Incorrect RxPDO Mapping Order");
    for finding in findings {
        assert_eq!(finding["level"], "minor_fault");
        assert!(finding["message"].is_string() && finding["correction"].is_string());
    }
}

#[test]
fn satisfied_rules_are_an_empty_list() {
    let (code, told) = check("check-satisfied.toml", "", &["--json"]);
    let document: Value = serde_json::from_str(&told).unwrap();
    assert_eq!((code, &document["findings"]), (Some(0), &serde_json::json!([])));
    let factory =
        |pdo_bytes| serde_json::json!({ "pdo_bytes": pdo_bytes, "io_bytes": 180, "exchanged_bytes": 180 });
    assert_eq!(document["sizes"], serde_json::json!({ "m_to_c": factory(180), "c_to_m": factory(183) }));
}

const MISMATCH: &str = "[io_allocation]\nm_to_c.uints = 6\nc_to_m.uints = 4\n";
const OBSERVATION: &str = "[event_levels]\n39160000 = \"observation\"\n";

#[test]
fn a_mismatch_that_is_an_observation_is_a_warning() {
    let (code, told) = check("check-observation.toml", &format!("{MISMATCH}{OBSERVATION}"), &[]);
    assert_eq!(code, Some(0), "{told}");
    assert!(told.contains("  ! UINTs Data C to M"), "{told}");
    assert!(told.contains(": 1 warning; only what both sides have is exchanged"), "{told}");
    let both = "[io_allocation]\nm_to_c.uints = 4\nc_to_m.uints = 4\n";
    let (code, told) = check("check-one-observation.toml", &format!("{both}{OBSERVATION}"), &[]);
    assert_eq!(code, Some(1), "the other direction is a minor fault: {told}");
    assert!(told.contains("  x UINTs Data M to C") && told.contains(": 2 findings; "), "{told}");
}

#[test]
fn a_program_reads_level_and_sizes() {
    for (levels, level, exit) in [("", "minor_fault", 1), (OBSERVATION, "observation", 0)] {
        let (code, told) = check("check-sizes.toml", &format!("{MISMATCH}{levels}"), &["--json"]);
        assert_eq!(code, Some(exit));
        let document: Value = serde_json::from_str(&told).unwrap();
        let finding = &document["findings"][0];
        assert_eq!(finding["level"], level);
        assert_eq!((&finding["pdo_bytes"], &finding["io_bytes"]), (&180.into(), &120.into()));
        assert_eq!(document["sizes"]["c_to_m"]["exchanged_bytes"], 120);
        let sets = document["data_sets"].as_array().unwrap();
        let uints = sets.iter().find(|set| set["pdo"] == "1A01").unwrap();
        let entries = ["pdo_entries", "io_entries", "exchanged_entries"].map(|key| uints[key].clone());
        assert_eq!((sets.len(), entries), (6, [6.into(), 4.into(), 4.into()]));
    }
}

#[test]
fn too_much_data_has_its_size_on_its_side() {
    let sizes = |sections: &str| {
        let (_, told) = check("check-too-much.toml", sections, &["--json"]);
        let document: Value = serde_json::from_str(&told).unwrap();
        let findings = document["findings"].as_array().unwrap().clone();
        let found = findings.iter().find(|finding| finding["rule"] == "total").unwrap();
        (found["pdo_bytes"].clone(), found["io_bytes"].clone())
    };
    let io = "[io_allocation]\nm_to_c = { uints = 40, udint = 1 }\nc_to_m.uints = 6\n";
    assert_eq!(sizes(io), (Value::Null, 1204.into()));
    let pdo = "[pdo]\nassign.rx = [0x1601, 0x1603]\nmapping.1601 = 40\nmapping.1603 = 1\n";
    assert_eq!(sizes(pdo), (1204.into(), Value::Null));
}

#[test]
fn people_see_the_place_the_event_the_correction_and_the_exchange() {
    let (code, told) = check("check-people.toml", BROKEN, &[]);
    assert_eq!(code, Some(1));
    let fragments = [
        "392E0000 Incorrect RxPDO Mapping Order (rule sm_order)",
        "check-people.toml:6:22]",
        "must be before 0x1602",
        "Assign the PDOs in ascending order",
        "not an entry of 0x6000 that exists",
        "4 I/O entries",
        "I/O refreshing does not start, the unit stays in PRE-OP with AL status code 0x0025 (invalid output mapping); nothing",
    ];
    for fragment in fragments {
        assert!(told.contains(fragment), "`{fragment}` is not in:\n{told}");
    }
}

#[test]
fn a_mismatch_says_what_is_exchanged() {
    let (code, told) = check("check-mismatch.toml", MISMATCH, &[]);
    assert_eq!(code, Some(1));
    assert!(told.contains("  x UINTs Data C to M"), "{told}");
    assert!(told.contains("only what both sides have is exchanged"), "{told}");
    assert!(told.contains("4 entries, 120 bytes"), "{told}");
}

#[test]
fn a_bad_file_and_no_file_end_with_2() {
    let (code, told) = check("check-bad.toml", "serail = 1\n", &["--json"]);
    let document: Value = serde_json::from_str(&told).unwrap();
    assert_eq!((code, &document["problems"][0]["line"]), (Some(2), &Value::from(2)), "{told}");
    assert_eq!(ectwin(&["check", "/no-such-folder/unit.toml"]).status.code(), Some(2));
}

#[test]
fn the_program_and_the_memory_that_a_unit_file_names_are_checked_and_nothing_is_made() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("check-files");
    let _files_of_an_earlier_run = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let put = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    put("wrong.st", "VAR x : INT; END_VAR\nx := y;\n");
    put("notes.nvm", "my notes");
    let check = |storage: &str, program: &str| {
        let text = format!("model = \"nx-ect101\"\nstorage = \"{storage}\"\n[cpu]\nprogram = {program}\n");
        put("unit.toml", &text);
        let before = std::fs::read_dir(&folder).unwrap().count();
        let output = ectwin(&["check", folder.join("unit.toml").to_str().unwrap(), "--json"]);
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), before, "nothing is made");
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        let problems = told["problems"].as_array().cloned().unwrap_or_default();
        let problem = |row: &Value| {
            let place = [&row["line"], &row["column"]].map(|place| place.as_u64().unwrap());
            let file = Path::new(row["file"].as_str().unwrap()).file_name().unwrap().display().to_string();
            (file, place, format!("{} {}", row["message"], row["help"]))
        };
        (output.status.code(), problems.iter().map(problem).collect::<Vec<_>>())
    };
    assert_eq!(check("N1.nvm", "\"builtin:copy\""), (Some(0), Vec::new()));
    let (code, problems) = check("no/such/N1.nvm", "\"gone.st\"");
    assert_eq!((code, problems.len()), (Some(2), 2), "{problems:?}");
    for ((file, place, told), (expected, words)) in
        problems.iter().zip([([4, 11], "gone.st cannot be read"), ([2, 11], "no/such/N1.nvm cannot be used")])
    {
        assert_eq!((file.as_str(), *place), ("unit.toml", expected), "{told}");
        assert!(told.contains(words), "{told}");
    }
    for (storage, program, file, place, words) in [
        ("notes.nvm", "\"builtin:copy\"", "unit.toml", [2, 11], "is not the memory of a unit"),
        ("N1.nvm", "\"wrong.st\"", "wrong.st", [2, 6], "there is no variable `y`"),
        ("N1.nvm", "\"builtin:cpy\"", "unit.toml", [4, 11], "there is no program builtin:cpy"),
        ("N1.nvm", "[\"builtin:copy\", \"wrong.st\"]", "unit.toml", [4, 11], "give it alone"),
    ] {
        let (code, problems) = check(storage, program);
        let [(named, found, told)] = problems.as_slice() else { panic!("{problems:?}") };
        assert_eq!((code, named.as_str(), *found), (Some(2), file, place), "{told}");
        assert!(told.contains(words), "{told}");
    }
}

#[test]
fn list_rules_has_the_seven_rules_and_their_events() {
    let output = ectwin(&["list", "rules", "--json"]);
    assert!(output.status.success());
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rules = document["rules"].as_array().unwrap();
    let ids: Vec<&str> = rules.iter().filter_map(|rule| rule["id"].as_str()).collect();
    assert_eq!(ids, ["mandatory", "sm_order", "type", "order", "total", "combination", "matched"]);
    let text = String::from_utf8(ectwin(&["list", "rules"]).stdout).unwrap();
    for event in rules.iter().flat_map(|rule| rule["events"].as_array().unwrap()) {
        assert!(text.contains(event["code"].as_str().unwrap()), "{event}");
    }
}

/// Violates the rules of type and order in every data set on both sides, and the order of the PDOs.
const EVERYTHING_BROKEN: &str = r#"
[io_allocation]
m_to_c = { uints = ["6001:01", "6000:05"], bytes = ["6000:01", "6001:05"], udint = ["6000:01", "6002:05"] }
c_to_m = { uints = ["7001:01", "7000:05"], bytes = ["7000:01", "7001:05"], udint = ["7000:01", "7002:05"] }
[pdo]
assign.rx = [0x1603, 0x1602, 0x1601]
assign.tx = [0x1A03, 0x1A02, 0x1A01, 0x1A00]
mapping.1601 = ["7001:01", "7000:05"]
mapping.1602 = ["7000:01", "7001:05"]
mapping.1603 = ["7000:01", "7002:05"]
mapping.1A01 = ["6001:01", "6000:05"]
mapping.1A02 = ["6000:01", "6001:05"]
mapping.1A03 = ["6000:01", "6002:05"]
"#;

#[test]
fn the_first_findings_have_pictures_and_the_others_are_counted() {
    let (_, json) = check("check-many.toml", EVERYTHING_BROKEN, &["--json"]);
    let document: Value = serde_json::from_str(&json).unwrap();
    let count = document["findings"].as_array().unwrap().len();
    assert!(count > 20, "JSON has all of them: {count}");
    let (code, told) = check("check-many.toml", EVERYTHING_BROKEN, &[]);
    assert_eq!((code, told.matches(" (rule ").count()), (Some(1), 20), "{told}");
    let more = format!("and {} more", count - 20);
    assert_eq!(told.lines().find(|line| line.starts_with("and ")), Some(more.as_str()));
    assert!(told.contains(&format!(": {count} findings: ")), "the whole number at the end: {told}");
    let (_, told) = check("check-few.toml", BROKEN, &[]);
    assert!(!told.contains("more"), "{told}");
}

/// A line is cut around the place, and its column is that of the file.
#[test]
fn a_long_line_is_shown_around_its_place() {
    let list = format!("{}, \"6001:01\"", vec!["\"6000:01\""; 254].join(", "));
    let sections = format!("[io_allocation]\nm_to_c.uints = [{list}]\nc_to_m.uints = 6\n");
    let (code, told) = check("check-long-line.toml", &sections, &[]);
    assert_eq!(code, Some(1));
    let column = "m_to_c.uints = [".len() + 254 * "\"6000:01\", ".len() + 1;
    assert!(told.contains(&format!("check-long-line.toml:3:{column}]")), "{told}");
    assert!(
        told.contains("not an entry of 0x6000 that exists") && told.len() < 4_000,
        "{} bytes",
        told.len()
    );
}
