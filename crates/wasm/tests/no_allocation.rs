//! After its start a program allocates nothing, like the whole CPU Unit.

use nx_bus::connect;
use nx_ect101::IoAllocation;
use plc::{CpuSettings, CpuUnit, DeviceVariables};
use time::Instant;
use wasm::WasmProgram;

const PROGRAM: &str = r#"(module
    (import "ectwin" "variable" (func $variable (param i32 i32) (result i32)))
    (import "ectwin" "read" (func $read (param i32 i32) (result i64)))
    (import "ectwin" "write" (func $write (param i32 i32 i64) (result i32)))
    (import "ectwin" "write_bytes" (func $write_bytes (param i32 i32 i32) (result i32)))
    (memory (export "memory") 1)
    (data (i32.const 0) "N1_UINTs_01_M_to_CN1_UINTs_01_C_to_MN1_UINTs_02_C_to_M")
    (func (export "start")
        (drop (call $variable (i32.const 0) (i32.const 18)))
        (drop (call $variable (i32.const 18) (i32.const 18)))
        (drop (call $variable (i32.const 36) (i32.const 18))))
    (func $copy (param $element i32)
        (drop (call $write (i32.const 1) (local.get $element)
            (i64.add (i64.const 1) (call $read (i32.const 0) (local.get $element)))))
        (if (local.get $element)
            (then (call $copy (i32.sub (local.get $element) (i32.const 1))))))
    (func (export "scan")
        (call $copy (i32.const 14))
        (drop (call $write_bytes (i32.const 2) (i32.const 0) (i32.const 30)))))"#;

#[test]
fn scans_do_not_allocate() {
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()));
    let (_unit, bus) = connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
    let mut cpu =
        CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables, bus, Box::new(plc::Echo));
    let octets = wat::parse_str(PROGRAM).expect("the text of a module");
    let program = WasmProgram::load(&octets, cpu.io().variables()).expect("a right module");
    cpu.set_mode(plc::OperatingMode::Program);
    cpu.load(Box::new(program)).expect("PROGRAM mode");
    cpu.set_mode(plc::OperatingMode::Run);
    cpu.cycle(cpu.deadline());
    let measured = allocation_counter::measure(|| {
        for _ in 0..1_000 {
            cpu.cycle(cpu.deadline());
        }
    });
    assert_eq!(cpu.io().c_to_m()[..2], [1, 0]);
    assert_eq!(
        cpu.take_events().filter(|record| matches!(record.event, plc::CpuEvent::Program(_))).count(),
        0
    );
    assert_eq!(measured.count_total, 0);
}
