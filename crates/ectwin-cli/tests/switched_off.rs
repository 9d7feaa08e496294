//! A running command that ends in the middle of a scan.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;

use started::{Started, folder_of, free_link};

/// One of its scans takes half a minute or longer.
const UNIT: &str = "model = \"nx-ect101\"\ncpu = { program = \"p.st\", statement_budget = 1_000_000_000 }\n";

/// `ready` is printed before the first scan ends, and the command ends in the middle of it: the scan never uses up
/// its statements, which would be reported.
#[test]
fn an_endless_scan_delays_neither_the_start_nor_the_end() {
    let folder = folder_of("endless");
    fs::write(folder.join("unit.toml"), UNIT).unwrap();
    fs::write(folder.join("p.st"), "WHILE TRUE DO ; END_WHILE;\n").unwrap();
    let mut started = Started::new(&folder, "", &["run", "unit.toml", "--link", &free_link()]).ready();
    started.wait_for("the program has not returned for ");
    let ended = started.interrupt();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(!ended.stderr.contains("overrun"), "{}", ended.stderr);
}
