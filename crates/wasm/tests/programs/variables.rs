//! What a program reads, writes and reports.

use proptest::prelude::*;

use crate::bench::{Bench, FIND, IMPORTS, scanning};

/// The first element that the master sends, after one scan with this value.
fn first_output(value: &str) -> u16 {
    let mut bench =
        Bench::with(&scanning(&format!("(drop (call $write (i32.const 1) (i32.const 0) {value}))")));
    bench.give([0xFFFF, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15], true);
    bench.cycles(1);
    assert_eq!(bench.errors(), Vec::<String>::new());
    bench.outputs()[0]
}

/// The same for a function's result.
fn result_of(call: &str) -> u16 {
    first_output(&format!("(i64.extend_i32_u (i32.and (i32.const 0xFFFF) {call}))"))
}

#[test]
fn elements_are_read_and_written_by_number() {
    assert_eq!(first_output("(call $read (i32.const 0) (i32.const 14))"), 15);
    assert_eq!(first_output("(call $read (i32.const 0) (i32.const 0))"), 0xFFFF, "unsigned");
}

#[test]
fn what_cannot_be_written_has_a_number() {
    let write = |id: i32, element: i32, value: i64| {
        result_of(&format!("(call $write (i32.const {id}) (i32.const {element}) (i64.const {value}))"))
    };
    assert_eq!(write(1, 3, 0xFFFF), 0);
    assert_eq!([write(2, 0, 0), write(-1, 0, 0)], [1, 1], "no such variable");
    assert_eq!([write(1, 15, 0), write(1, -1, 0)], [2, 2], "no such element");
    assert_eq!(write(0, 0, 0), 3, "read-only");
    assert_eq!([write(1, 0, 0x1_0000), write(1, 0, -1)], [4, 4], "does not fit");
    let bytes = |function: &str, id: i32, length_bytes: i32| {
        result_of(&format!("(call ${function} (i32.const {id}) (i32.const 64) (i32.const {length_bytes}))"))
    };
    assert_eq!([bytes("read_bytes", 0, 30), bytes("write_bytes", 1, 30)], [0, 0]);
    assert_eq!([bytes("read_bytes", 9, 30), bytes("write_bytes", 9, 30)], [1, 1]);
    assert_eq!([bytes("read_bytes", 0, 28), bytes("write_bytes", 1, 0)], [5, 5]);
    assert_eq!(bytes("write_bytes", 0, 30), 3);
}

#[test]
fn a_name_in_whatever_case_has_one_number_and_an_unknown_one_none() {
    let text = format!(
        r#"(module {IMPORTS}
            (data (i32.const 0) "n1_uints_01_m_to_c N1_UINTs_01_M_to_C N1_Misspelt \ff\fe")
            (global $sum (export "sum") (mut i32) (i32.const 100))
            (func $add (param i32 i32)
                (global.set $sum (i32.add (global.get $sum) (call $variable (local.get 0) (local.get 1)))))
            (func (export "start")
                (call $add (i32.const 0) (i32.const 18)) (call $add (i32.const 19) (i32.const 18))
                (call $add (i32.const 38) (i32.const 11)) (call $add (i32.const 50) (i32.const 2))
                (call $add (i32.const 0) (i32.const 0)) (call $add (i32.const 0) (i32.const 60000)))
            (func (export "scan")))"#
    );
    let mut bench = Bench::with(&text);
    bench.cycles(1);
    assert_eq!(bench.errors(), Vec::<String>::new());
    assert_eq!(bench.cpu.program_variable("sum").as_deref(), Some("96"), "twice 0, four times -1");
}

#[test]
fn time_is_that_of_the_task_period() {
    let mut bench = Bench::with(&scanning(
        "(drop (call $write (i32.const 1) (i32.const 0) (i64.div_u (call $now_ns) (i64.const 1000000))))",
    ));
    bench.cycles(6);
    assert_eq!(bench.outputs()[0], 5);
}

#[test]
fn memory_and_globals_live_from_start_to_start() {
    let text = format!(
        r#"(module {IMPORTS} {FIND}
            (global $scans (export "scans") (mut i64) (i64.const 0))
            (func (export "scan") (global.set $scans (i64.add (global.get $scans) (i64.const 1)))))"#
    );
    let mut bench = Bench::with(&text);
    bench.cycles(3);
    assert_eq!(bench.cpu.program_variable("scans").as_deref(), Some("3"));
    assert_eq!(bench.cpu.program_variable("memory"), None, "no global");
    bench.cpu.set_mode(plc::OperatingMode::Program);
    bench.cycles(2);
    bench.cpu.set_mode(plc::OperatingMode::Run);
    bench.cycles(1);
    assert_eq!(bench.cpu.program_variable("scans").as_deref(), Some("1"));
}

#[test]
fn reports_are_told_without_control_characters_and_four_a_scan() {
    let text = format!(
        r#"(module {IMPORTS} (data (i32.const 0) "too \0a\1bhot")
            (func (export "scan") (local $n i32)
                (loop $again
                    (call $report (i32.const 0) (i32.sub (i32.const 9) (local.get $n)))
                    (local.set $n (i32.add (local.get $n) (i32.const 1)))
                    (br_if $again (i32.lt_u (local.get $n) (i32.const 6))))
                (call $report (i32.const 0) (i32.const 65536))))"#
    );
    let mut bench = Bench::with(&text);
    bench.cycles(1);
    let expected =
        ["too   hot", "too   ho", "too   h", "too   "].map(|text| format!("error in the program: {text}"));
    assert_eq!(bench.errors(), expected);
}

proptest! {
    #[test]
    fn whole_variables_go_through_memory(elements: [u16; 15]) {
        let mut bench = Bench::with(&scanning(
            "(drop (call $read_bytes (i32.const 0) (i32.const 1000) (i32.const 30)))
             (drop (call $write_bytes (i32.const 1) (i32.const 1000) (i32.const 30)))",
        ));
        bench.give(elements, true);
        bench.cycles(1);
        prop_assert_eq!(bench.outputs(), elements);
    }
}
