//! User programs in WebAssembly, in a build with the feature: from a file, in a unit file, changed while they run.

#[expect(dead_code, reason = "each test uses a part of the command")]
mod running;

use std::path::{Path, PathBuf};
use std::process::Command;

use ectwin::{Duration, Setup, SetupError, Twin};
use running::{Running, UNIT, must};

const PAGE: &str = include_str!("../../../docs/user/wasm-programs.md");

/// A folder of the test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    must(std::fs::create_dir_all(&folder));
    folder
}

fn write(path: &Path, text: &str) {
    must(std::fs::write(path, must(wat::parse_str(text))));
}

/// A program that writes this value, and reports these words.
fn writes_and_reports(value: u32, words: &str) -> String {
    format!(
        r#"(module
            (import "ectwin" "variable" (func $variable (param i32 i32) (result i32)))
            (import "ectwin" "write" (func $write (param i32 i32 i64) (result i32)))
            (import "ectwin" "report" (func $report (param i32 i32)))
            (memory (export "memory") 1)
            (data (i32.const 0) "N1_UINTs_01_C_to_M") (data (i32.const 32) "{words}")
            (func (export "start") (drop (call $variable (i32.const 0) (i32.const 18))))
            (func (export "scan")
                (drop (call $write (i32.const 0) (i32.const 0) (i64.const {value})))
                (call $report (i32.const 32) (i32.const {}))))"#,
        words.len()
    )
}

#[test]
fn a_unit_file_names_a_module_beside_it() {
    let folder = folder("names_a_module");
    write(&folder.join("seven.wasm"), &writes_and_reports(7, "written"));
    let text = "model = \"nx-ect101\"\n[cpu]\nprogram = \"seven.wasm\"";
    let mut twin = Twin::power_on([Setup::from_toml_in(text, &folder).unwrap()]);
    twin.run_for(Duration::from_millis(3));
    assert_eq!(twin.unit(0).cpu().io().c_to_m()[..2], [7, 0]);
}

#[test]
fn the_program_of_the_page_is_taken() {
    let (_, rest) = PAGE.split_once("```text copy.wat\n").unwrap();
    let path = folder("of_the_page").join("copy.wasm");
    write(&path, rest.split_once("```").unwrap().0);
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap().program_file(&path);
    assert!(setup.is_ok());
}

#[test]
fn a_wrong_module_is_refused_with_its_file_and_the_reason() {
    let path = folder("wrong_module").join("wrong.wasm");
    write(&path, "(module (memory (export \"memory\") 1))");
    let error = Setup::from_toml("model = \"nx-ect101\"").unwrap().program_file(&path).map(drop).unwrap_err();
    assert!(matches!(error, SetupError::WebAssemblyWrong { .. }), "{error}");
    let words = "wrong.wasm: it does not export `scan`, a function without parameters and results";
    assert!(error.to_string().ends_with(words), "{error}");
    let output = Command::new(env!("CARGO_BIN_EXE_ectwin"))
        .args(["run", UNIT, "--link", "udp:127.0.0.1:0", "--program"])
        .arg(&path)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("it does not export `scan`"), "{told}");
}

#[test]
fn a_changed_module_is_loaded_and_a_wrong_one_is_not() {
    let path = folder("changed_module").join("changed.wasm");
    write(&path, &writes_and_reports(1, "the first one"));
    let mut running = Running::start(&path);
    running.wait_for("error in the program: the first one");
    write(&path, "(module)");
    running.wait_for("changed.wasm: it does not export `scan`");
    running.wait_for("the old program continues");
    write(&path, &writes_and_reports(1, "the second one"));
    running.wait_for("a user program was loaded");
    running.wait_for("error in the program: the second one");
}

#[test]
fn a_program_that_never_ends_is_told() {
    let path = folder("never_ends").join("never_ends.wasm");
    let text = "(module (memory (export \"memory\") 1) (func (export \"scan\") (loop $on (br $on))))";
    write(&path, text);
    Running::start(&path).wait_for("task overrun: a scan had used up its 100000 statements");
}
