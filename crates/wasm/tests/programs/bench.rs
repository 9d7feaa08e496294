//! A CPU Unit with a program, and the unit's end of its bus.

use nx_bus::{UnitEnd, UnitHeader, connect};
use nx_ect101::{IoAllocation, SlaveStatus};
use plc::{CpuEvent, CpuSettings, CpuUnit, DeviceVariables, OperatingMode, ProgramEvent};
use time::Instant;
use wasm::{WasmError, WasmProgram};

/// The functions of `ectwin`, for modules that tests write.
pub(crate) const IMPORTS: &str = r#"
    (import "ectwin" "variable" (func $variable (param i32 i32) (result i32)))
    (import "ectwin" "read" (func $read (param i32 i32) (result i64)))
    (import "ectwin" "write" (func $write (param i32 i32 i64) (result i32)))
    (import "ectwin" "read_bytes" (func $read_bytes (param i32 i32 i32) (result i32)))
    (import "ectwin" "write_bytes" (func $write_bytes (param i32 i32 i32) (result i32)))
    (import "ectwin" "now_ns" (func $now_ns (result i64)))
    (import "ectwin" "report" (func $report (param i32 i32)))
    (memory (export "memory") 1)"#;

/// Looks up `N1_UINTs_01_M_to_C` as 0 and `N1_UINTs_01_C_to_M` as 1.
pub(crate) const FIND: &str = r#"
    (data (i32.const 0) "N1_UINTs_01_M_to_CN1_UINTs_01_C_to_M")
    (func (export "start")
        (drop (call $variable (i32.const 0) (i32.const 18)))
        (drop (call $variable (i32.const 18) (i32.const 18))))"#;

pub(crate) struct Bench {
    pub(crate) cpu: CpuUnit,
    pub(crate) unit: UnitEnd,
}

/// The variables of the factory setting.
pub(crate) fn variables() -> DeviceVariables {
    DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()))
}

/// Loads the text of a module.
pub(crate) fn load(text: &str) -> Result<WasmProgram, WasmError> {
    let octets = wat::parse_str(text).unwrap_or_else(|error| panic!("{error}"));
    WasmProgram::load(&octets, &variables())
}

/// A module with all imports, the two variables, and this `scan`.
pub(crate) fn scanning(scan: &str) -> String {
    format!("(module {IMPORTS} {FIND} (func (export \"scan\") {scan}))")
}

impl Bench {
    fn new(program: Box<dyn plc::Program + Send>) -> Self {
        let variables = variables();
        let (unit, bus) = connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
        let settings = CpuSettings { mode: OperatingMode::Run, ..CpuSettings::default() };
        Self { cpu: CpuUnit::power_on(Instant::ZERO, settings, variables, bus, program), unit }
    }

    pub(crate) fn with(text: &str) -> Self {
        Self::running(load(text).unwrap_or_else(|error| panic!("{error}")))
    }

    pub(crate) fn running(program: WasmProgram) -> Self {
        Self::new(Box::new(program))
    }

    /// The unit sends these UINTs of entry 1, and whether they are valid.
    pub(crate) fn give(&mut self, elements: [u16; 15], valid: bool) {
        let mut image = vec![0; self.cpu.io().m_to_c().len()];
        for (octets, element) in image.chunks_exact_mut(2).zip(elements) {
            octets.copy_from_slice(&element.to_le_bytes());
        }
        let status = SlaveStatus::from_bits(if valid { 0b110 } else { 0 }).bits();
        let header = UnitHeader { status, io_data_active: true, ..UnitHeader::default() };
        self.unit.m_to_c.publish(header, &image);
    }

    pub(crate) fn cycles(&mut self, cycles: usize) {
        for _ in 0..cycles {
            self.cpu.cycle(self.cpu.deadline());
        }
    }

    /// The contents of entry 1 C to M after the last scan.
    pub(crate) fn outputs(&self) -> Vec<u16> {
        let octets = self.cpu.io().c_to_m()[..30].chunks_exact(2);
        octets.map(|octets| u16::from_le_bytes([octets[0], octets[1]])).collect()
    }

    /// The reports of the program, each with its count.
    pub(crate) fn told(&mut self) -> Vec<(ProgramEvent, u64)> {
        let told = self.cpu.take_events().filter_map(|record| match record.event {
            CpuEvent::Program(event) => Some((event, record.count)),
            _ => None,
        });
        told.collect()
    }

    /// The texts of the errors.
    pub(crate) fn errors(&mut self) -> Vec<String> {
        self.told().iter().map(|(event, _)| event.to_string()).collect()
    }
}
