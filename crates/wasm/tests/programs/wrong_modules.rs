//! Modules that are refused with a message when they are loaded.

use proptest::prelude::*;
use wasm::{MODULE_BYTES_MAX, WasmError, WasmProgram};

use crate::bench::{load, variables};

const STEP: &str = "a function without parameters and results";
const MEMORY: &str = "a memory";
const SCAN: &str = "(func (export \"scan\"))";

fn refused(body: &str) -> WasmError {
    match load(&format!("(module {body})")) {
        Ok(_) => panic!("taken: {body}"),
        Err(error) => error,
    }
}

#[test]
fn missing_and_wrong_exports() {
    let memory = "(memory (export \"memory\") 1)";
    assert_eq!(refused(memory), WasmError::MissingExport { name: "scan", expected: STEP });
    assert_eq!(refused(SCAN), WasmError::MissingExport { name: "memory", expected: MEMORY });
    let wrong = |name, expected| WasmError::WrongExport { name, expected };
    for scan in ["(func (export \"scan\") (param i32))", "(global (export \"scan\") i32 (i32.const 0))"] {
        assert_eq!(refused(&format!("{memory} {scan}")), wrong("scan", STEP));
    }
    let start = "(func (export \"start\") (result i32) (i32.const 0))";
    assert_eq!(refused(&format!("{memory} {SCAN} {start}")), wrong("start", STEP));
    let function = "(func (export \"memory\"))";
    assert_eq!(refused(&format!("{SCAN} {function}")), wrong("memory", MEMORY));
}

#[test]
fn imports_that_are_not_there() {
    let import = |module: &str, name: &str, what: &str| {
        let memory = "(memory (export \"memory\") 1)";
        refused(&format!("(import \"{module}\" \"{name}\" {what}) {memory} {SCAN}"))
    };
    for (module, name) in [("ectwin", "clock"), ("env", "read"), ("wasi_snapshot_preview1", "random_get")] {
        let expected = WasmError::UnknownImport { module: module.to_owned(), name: name.to_owned() };
        assert_eq!(import(module, name, "(func)"), expected);
    }
    for what in ["(func)", "(func (param i32 i64) (result i64))", "(global i32)"] {
        let expected = WasmError::WrongImport { name: "read", expected: "(id: i32, element: i32) -> i64" };
        assert_eq!(import("ectwin", "read", what), expected);
    }
}

#[test]
fn too_much_memory_and_too_large_tables() {
    let error = refused(&format!("(memory (export \"memory\") 257) {SCAN}"));
    assert_eq!(error, WasmError::MemoryTooLarge { size_bytes: 257 << 16, limit_bytes: 16 << 20 });
    let error = refused(&format!("(memory (export \"memory\") 65536) {SCAN}"));
    assert_eq!(error, WasmError::MemoryTooLarge { size_bytes: 1 << 32, limit_bytes: 16 << 20 });
    let memory = "(memory (export \"memory\") 1)";
    let error = refused(&format!("{memory} {SCAN} (table 4000000 funcref)"));
    assert!(matches!(error, WasmError::CannotBegin { .. }), "{error:?}");
}

#[test]
fn what_cannot_begin() {
    let memory = "(memory (export \"memory\") 1)";
    for body in [
        "(data (i32.const 65536) \"outside\")",
        "(func $begin unreachable) (start $begin)",
        "(func $begin (loop $for_ever (br $for_ever))) (start $begin)",
    ] {
        let error = refused(&format!("{memory} {SCAN} {body}"));
        assert!(matches!(error, WasmError::CannotBegin { .. }), "{error:?}");
    }
}

#[test]
fn what_this_build_cannot_run() {
    let memory = "(memory (export \"memory\") 1)";
    for body in ["(func (drop (v128.const i64x2 1 2)))", "(memory 1)", "(func $body unreachable) (tag)"] {
        let error = refused(&format!("{memory} {SCAN} {body}"));
        assert!(matches!(error, WasmError::NotAModule { .. }), "{body}: {error:?}");
    }
}

#[test]
fn what_is_no_module() {
    let load = |octets: &[u8]| WasmProgram::load(octets, &variables()).expect_err("no module");
    for octets in [&b""[..], b"(module)", b"\0asm", b"\0asm\x02\0\0\0", b"PROGRAM Main\nEND_PROGRAM"] {
        assert!(matches!(load(octets), WasmError::NotAModule { .. }), "{octets:?}");
    }
    let (size_bytes, limit_bytes) = (MODULE_BYTES_MAX + 1, MODULE_BYTES_MAX);
    assert_eq!(load(&vec![0; size_bytes]), WasmError::TooLarge { size_bytes, limit_bytes });
}

proptest! {
    #[test]
    fn damaged_modules_are_refused_or_run(at in any::<prop::sample::Index>(), octet: u8) {
        let text = crate::page::block("copy.wat");
        let mut octets = wat::parse_str(text).expect("the page's module");
        let at = at.index(octets.len());
        octets[at] = octet;
        if let Ok(program) = WasmProgram::load(&octets, &variables()) {
            let mut bench = crate::bench::Bench::running(program.with_budget(1_000));
            bench.cycles(3);
        }
    }
}
