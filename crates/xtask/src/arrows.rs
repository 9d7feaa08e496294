//! The layers of the workspace: which crate may use which, what the core must never use, circles of files, and
//! which files name a unit model.

mod circles;
mod list;
mod models;
mod modules;
mod tokens;

use crate::metadata::{self, Metadata, Package};
use crate::outcome::{Outcome, report};
use crate::sources::{self, Source};

/// One crate, its layer, and the crates that it may use.
struct Row {
    name: &'static str,
    floor: u8,
    may_use: MayUse,
}

enum MayUse {
    Only(&'static [&'static str]),
    AnyFloorBelow,
}

use MayUse::{AnyFloorBelow, Only};

const fn row(name: &'static str, floor: u8, may_use: MayUse) -> Row {
    Row { name, floor, may_use }
}

/// What a unit model may use.
const UNIT_MODEL: MayUse = Only(&[
    "time",
    "wire",
    "iec-types",
    "objects",
    "nx-bus",
    "variables",
    "user-file",
    "esi",
    "coe-kit",
    "device",
    "unit-model",
]);

/// docs/architecture.md gives the reasons. A new crate is a new row; an arrow must never go up.
const FLOORS: &[Row] = &[
    row("time", 1, Only(&[])),
    row("wire", 1, Only(&[])),
    row("capture", 1, Only(&[])),
    row("iec-types", 1, Only(&[])),
    row("esc", 2, Only(&["time", "wire"])),
    row("objects", 2, Only(&["wire"])),
    row("nx-bus", 2, Only(&["time", "wire"])),
    row("variables", 2, Only(&["time", "wire", "iec-types"])),
    row("user-file", 2, Only(&["time", "wire"])),
    row("segment", 3, Only(&["time", "wire", "esc"])),
    row("mailbox", 3, Only(&["wire", "objects"])),
    row("esi", 3, Only(&["wire", "objects", "user-file"])),
    row("device", 4, AnyFloorBelow),
    row("coe-kit", 4, Only(&["time", "wire", "objects", "esi"])),
    row(
        "unit-model",
        5,
        Only(&["time", "wire", "objects", "nx-bus", "variables", "user-file", "esi", "coe-kit", "device"]),
    ),
    row(MASTER, 5, Only(&["time", "wire", "objects", "esi"])),
    row("st", 5, Only(&["iec-types"])),
    row("nx-ect101", 6, UNIT_MODEL),
    row("digital", 6, UNIT_MODEL),
    row("esi-device", 6, UNIT_MODEL),
    row("plc", 7, Only(&["time", "wire", "st", "nx-bus", "variables", "user-file"])),
    row("plant", 8, AnyFloorBelow),
    row("scenario", 9, AnyFloorBelow),
    row("wasm", 9, Only(&["time", "plc"])),
    row("modbus", 10, Only(&["plc"])),
    row("opcua", 10, Only(&["plc"])),
    row("control", 10, Only(&["time", "user-file"])),
    row("link", 10, Only(&["time", "wire", "capture", "segment"])),
    row("storage", 10, Only(&[])),
    row("ectwin", 11, AnyFloorBelow),
    row("ectwin-cli", 12, AnyFloorBelow),
    row("fuzz", CHECKS_FLOOR, AnyFloorBelow),
    row("xtask", CHECKS_FLOOR, AnyFloorBelow),
    row(TESTBED, 0, Only(&[])),
];

const TESTBED: &str = "testbed";
const MASTER: &str = "master";

/// Dev-dependencies may include these from any layer: namespaces and child processes, and the master with which
/// slaves are tested.
const FOR_TESTS: &[&str] = &[TESTBED, MASTER];

/// The layer of this project's checks.
const CHECKS_FLOOR: u8 = 13;
/// The first layer that may do input and output.
const SHELL_FLOOR: u8 = 10;

/// External crates that do input and output, read the clock or start threads.
const SHELL_CRATES: &[&str] =
    &["axum", "crossbeam-channel", "mio", "parking_lot", "pnet_datalink", "socket2", "tokio", "tun-rs"];

/// Names that must not occur in the core's code: time is an argument, a frame goes in and a frame comes out.
const SHELL_WORDS: &[&str] = &[
    "std::fs",
    "std::net",
    "std::process",
    "std::sync::Mutex",
    "std::sync::RwLock",
    "std::thread",
    "std::time",
    "Instant::now",
    "Mutex<",
    "RwLock<",
    "SystemTime::now",
];

/// Runs all checks: crates, words, circles of files, names of models.
pub(crate) fn check() -> Outcome {
    let metadata = metadata::read()?;
    let sources = sources::read()?;
    let mut findings = wrong_arrows(&metadata);
    findings.extend(sources.iter().flat_map(shell_words));
    findings.extend(circles::findings(&crates(), &sources));
    findings.extend(models::findings(&of_the_product(), &sources));
    report("arrows", &findings)?;
    println!("{} circles of files", circles::count());
    Ok(())
}

/// Writes the list of present circles, if it only shrinks.
pub(crate) fn bless() -> Outcome {
    circles::bless(&crates(), &sources::read()?)
}

fn crates() -> Vec<&'static str> {
    FLOORS.iter().map(|row| row.name).collect()
}

/// The crates for users: without this project's checks and the crates for tests.
fn of_the_product() -> Vec<&'static str> {
    FLOORS.iter().filter(|row| (1..CHECKS_FLOOR).contains(&row.floor)).map(|row| row.name).collect()
}

fn find(name: &str) -> Option<&'static Row> {
    FLOORS.iter().find(|row| row.name == name)
}

fn wrong_arrows(metadata: &Metadata) -> Vec<String> {
    let mut findings = Vec::new();
    for package in &metadata.packages {
        match find(package.short_name()) {
            Some(row) => findings.extend(wrong_arrows_of(row, package)),
            None => findings.push(format!("{}: has no row in crates/xtask/src/arrows.rs", package.name)),
        }
    }
    let exists = |row: &&Row| metadata.packages.iter().any(|package| package.short_name() == row.name);
    findings.extend(
        FLOORS.iter().filter(|row| !exists(row)).map(|row| format!("{}: has a row and no crate", row.name)),
    );
    findings
}

fn wrong_arrows_of(row: &Row, package: &Package) -> Vec<String> {
    let wrong = |dependency: &&metadata::Dependency| {
        if !dependency.is_ours() {
            return row.floor < SHELL_FLOOR
                && !dependency.is_for_tests()
                && SHELL_CRATES.contains(&dependency.name.as_str());
        }
        !may_use(row, dependency.short_name(), dependency.is_for_tests())
    };
    let line =
        |dependency: &metadata::Dependency| format!("{} may not use {}", package.name, dependency.name);
    package.dependencies.iter().filter(wrong).map(line).collect()
}

/// Tests may use any layer below their own, the code only the crates in its row. The tests of the master may
/// use slaves of all kinds, which are in a higher layer.
fn may_use(row: &Row, used: &str, for_tests: bool) -> bool {
    if for_tests && FOR_TESTS.contains(&used) {
        return true;
    }
    let limit = if for_tests && row.name == MASTER { SHELL_FLOOR } else { row.floor };
    let below = find(used).is_some_and(|used| used.floor < limit);
    match row.may_use {
        Only(names) if !for_tests => names.contains(&used),
        Only(_) | AnyFloorBelow => below,
    }
}

fn shell_words(source: &Source) -> Vec<String> {
    let Some(name) = source.path.strip_prefix("crates/").and_then(|path| path.split('/').next()) else {
        return Vec::new();
    };
    let in_core = find(name).is_some_and(|row| (1..SHELL_FLOOR).contains(&row.floor));
    if !in_core || source.extension() != "rs" || source.is_test() {
        return Vec::new();
    }
    let code = source.code_lines().filter(|(_, line)| !line.trim_start().starts_with("//"));
    code.flat_map(|(number, line)| {
        SHELL_WORDS
            .iter()
            .filter(move |word| line.contains(*word))
            .map(move |word| format!("{}:{number}: `{word}` is for links and the binary", source.path))
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_row_lets_an_arrow_run_up_or_sideways() {
        for row in FLOORS {
            let Only(names) = row.may_use else { continue };
            for used in names {
                let used = find(used).expect("a row names crates that have a row");
                assert!(used.floor < row.floor, "{} uses {}", row.name, used.name);
            }
        }
    }

    #[test]
    fn code_uses_what_its_row_names_and_tests_what_lies_below() {
        let link = find("link").expect("has a row");
        assert!(may_use(link, "segment", false));
        assert!(!may_use(link, "device", false));
        assert!(may_use(link, "device", true));
        assert!(!may_use(link, "ectwin", true));
        for name in FOR_TESTS {
            assert!(may_use(link, name, true));
            assert!(!may_use(link, name, false));
        }
        let master = find(MASTER).expect("has a row");
        assert!(may_use(master, "nx-ect101", true) && !may_use(master, "nx-ect101", false));
        assert!(!may_use(master, "link", true));
        assert!(may_use(find("esc").expect("has a row"), MASTER, true));
    }

    #[test]
    fn a_clock_in_the_core_is_found_and_one_in_its_tests_is_not() {
        let clock = "fn now() { std::time::Instant::now(); }\n";
        let source = |path: &str, text: String| Source { path: path.to_string(), text };
        assert!(!shell_words(&source("crates/esc/src/lib.rs", clock.to_string())).is_empty());
        assert!(
            shell_words(&source("crates/esc/src/lib.rs", format!("#[cfg(test)]\nmod tests {{ {clock} }}")))
                .is_empty()
        );
        assert!(shell_words(&source("crates/esc/tests/frames.rs", clock.to_string())).is_empty());
        assert!(shell_words(&source("crates/link/src/lib.rs", clock.to_string())).is_empty());
    }
}
