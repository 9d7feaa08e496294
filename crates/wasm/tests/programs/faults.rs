//! Programs that fail while they run: the CPU Unit continues, and reports it.

use plc::ProgramEvent;
use wasm::MEMORY_BYTES_MAX;

use crate::bench::{Bench, FIND, IMPORTS, load, scanning};

/// Counts in element 0, then does this.
fn counts_and(then: &str) -> String {
    scanning(&format!(
        "(drop (call $write (i32.const 1) (i32.const 0)
            (i64.add (i64.const 1) (call $read (i32.const 1) (i32.const 0))))) {then}"
    ))
}

/// The reports of three scans; each of them has counted.
fn told_of(then: &str) -> Vec<(ProgramEvent, u64)> {
    let mut bench = Bench::with(&counts_and(then));
    bench.cycles(3);
    assert_eq!(bench.outputs()[0], 3, "what was written stays, and the next scan goes on");
    bench.told()
}

fn error_of(then: &str) -> String {
    let told = told_of(then);
    assert_eq!(told.len(), 1, "{told:?}");
    assert_eq!(told[0].1, 3);
    told[0].0.to_string()
}

#[test]
fn an_endless_loop_is_a_task_overrun() {
    let overrun = ProgramEvent::TaskOverrun { budget_statements: plc::STATEMENT_BUDGET_DEFAULT };
    for endless in [
        "(loop $for_ever (br $for_ever))",
        "(loop $for_ever (drop (call $now_ns)) (br $for_ever))",
        "(loop $for_ever (drop (call $read (i32.const 0) (i32.const 0))) (br $for_ever))",
        "(loop $for_ever (call $report (i32.const 0) (i32.const 0)) (br $for_ever))",
        "(loop $for_ever (memory.fill (i32.const 0) (i32.const 78) (i32.const 65536)) (br $for_ever))",
    ] {
        let told = told_of(endless);
        assert_eq!(told.last(), Some(&(overrun.clone(), 3)), "{endless}");
    }
}

/// More fuel than is assigned at once, used up by instructions and by calls of the host.
#[test]
fn a_large_budget_is_used_up_whole() {
    let call = "(drop (call $read (i32.const 0) (i32.const 0)))";
    let store = "(i32.store (i32.const 0) (local.get $turns))".repeat(30);
    for turn in [call.to_owned(), call.repeat(7), store] {
        let module = scanning(&format!(
            "(local $turns i32)
            (local.set $turns (i32.const 40000))
            (loop $next {turn}
                (br_if $next (local.tee $turns (i32.sub (local.get $turns) (i32.const 1)))))
            (drop (call $write (i32.const 1) (i32.const 0) (i64.const 7)))"
        ));
        let scan = |budget_statements| {
            let program = load(&module).expect("a program").with_budget(budget_statements);
            let mut bench = Bench::running(program);
            bench.cycles(1);
            (bench.outputs()[0], bench.told())
        };
        assert_eq!(scan(4_000_000), (7, Vec::new()), "{turn}");
        let overrun = ProgramEvent::TaskOverrun { budget_statements: 30_000 };
        assert_eq!(scan(30_000), (0, vec![(overrun, 1)]), "{turn}");
    }
}

#[test]
fn a_trap_is_an_error_that_says_what() {
    assert!(error_of("unreachable").contains("unreachable"));
    assert!(error_of("(drop (i32.load (i32.const 65536)))").contains("out of bounds"));
    assert!(error_of("(drop (i32.div_s (i32.const 1) (i32.const 0)))").contains("divi"));
    assert_eq!(
        error_of("(drop (call $read (i32.const 7) (i32.const 0)))"),
        "error in the program: read(7, 0): no variable has this number"
    );
    assert_eq!(
        error_of("(drop (call $write_bytes (i32.const 1) (i32.const -1) (i32.const 30)))"),
        "error in the program: write_bytes: outside of the memory"
    );
    assert_eq!(
        error_of("(drop (call $variable (i32.const 0) (i32.const 18)))"),
        "error in the program: variable: a program asks for its variables in `start`"
    );
}

#[test]
fn deep_recursion_ends() {
    let text = format!(
        "(module {IMPORTS} {FIND}
            (func $deeper (param i64 i64 i64 i64) (result i64)
                (i64.add (i64.const 1) (call $deeper (local.get 0) (local.get 1) (local.get 2) (local.get 3))))
            (func (export \"scan\")
                (drop (call $deeper (i64.const 1) (i64.const 2) (i64.const 3) (i64.const 4)))))"
    );
    let mut bench = Bench::with(&text);
    bench.cycles(2);
    let errors = bench.errors();
    assert!(errors.len() == 1 && errors[0].contains("stack"), "{errors:?}");
}

#[test]
fn memory_grows_to_its_limit_and_no_further() {
    let pages = MEMORY_BYTES_MAX / 65_536;
    let text = format!(
        "(module {IMPORTS} {FIND} (global $grown (export \"grown\") (mut i32) (i32.const 0))
            (func (export \"scan\")
                (global.set $grown (memory.grow (i32.const 1)))
                (drop (memory.grow (i32.const 65000)))))"
    );
    let mut bench = Bench::with(&text);
    bench.cycles(pages - 1);
    assert_eq!(bench.cpu.program_variable("grown"), Some((pages - 1).to_string()));
    bench.cycles(1);
    assert_eq!(bench.cpu.program_variable("grown").as_deref(), Some("-1"));
    assert_eq!(bench.errors(), Vec::<String>::new());
}

#[test]
fn a_start_that_fails_stops_the_program() {
    let start = |body: &str| {
        let text = format!(
            "(module {IMPORTS} (func (export \"start\") {body}) (func (export \"scan\") unreachable))"
        );
        let mut bench = Bench::with(&text);
        bench.cycles(3);
        bench.told()
    };
    for body in ["unreachable", "(loop $for_ever (br $for_ever))"] {
        let told = start(body);
        assert!(matches!(told.as_slice(), [(ProgramEvent::Stopped(_), 1)]), "{told:?}");
    }
}

#[test]
fn a_broken_off_scan_gives_its_stack_back_where_the_pointer_is_exported() {
    let text = format!(
        "(module {IMPORTS} {FIND} (global $stack (export \"__stack_pointer\") (mut i32) (i32.const 65536))
            (func (export \"scan\")
                (global.set $stack (i32.sub (global.get $stack) (i32.const 1024)))
                unreachable))"
    );
    let mut bench = Bench::with(&text);
    bench.cycles(100);
    assert_eq!(bench.cpu.program_variable("__stack_pointer").as_deref(), Some("65536"));
}

#[test]
fn no_number_is_like_another_machines_nan() {
    // 0/0 with an explicit sign, and its bits as an output.
    let text = scanning(
        "(drop (call $write (i32.const 1) (i32.const 0) (i64.extend_i32_u (i32.shr_u
            (i32.reinterpret_f32 (f32.div (f32.const -0) (f32.const 0))) (i32.const 16)))))",
    );
    let mut bench = Bench::with(&text);
    bench.cycles(1);
    assert_eq!(bench.outputs()[0], 0x7FC0);
}
