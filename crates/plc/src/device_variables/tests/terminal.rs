//! A terminal: its variables are single bits, and no unit model is needed for its CPU Unit.

use nx_bus::UnitHeader;
use st::Elementary;
use time::Instant;
use variables::at_specification;

use crate::device_variables::*;
use crate::{CpuSettings, CpuUnit, Echo, Program, StructuredText};

/// 12 outputs M to C, 12 inputs C to M, no status word.
fn variables() -> DeviceVariables {
    let channel = |name: &str, area, access, number: u8| {
        let port = format!("{name} {number}");
        Variable {
            name: variable_name("K1", &port),
            at: Some(at_specification(2, &port)),
            port: Some(port),
            variable_type: VariableType::single(Elementary::Bool),
            access,
            place: Place::bit(area, usize::from(number - 1)),
            series: Some(Series { name: "Channel", number }),
            modbus: None,
            nx_object: None,
            pdo_entry: None,
        }
    };
    let outputs = (1..=12).map(|number| channel("Output", Area::MToC, VariableAccess::ReadOnly, number));
    let inputs = (1..=12).map(|number| channel("Input", Area::CToM, VariableAccess::ReadWrite, number));
    let unit = BusUnit {
        device_name: "K1".into(),
        unit_number: 2,
        m_to_c_bytes: 2,
        c_to_m_bytes: 2,
        status: StatusWord::default(),
    };
    DeviceVariables::of(VariableTable::new(unit, outputs.chain(inputs).collect()))
}

/// The bytes C to M in the third period of a CPU Unit whose terminal receives these outputs.
fn inputs(program: impl Program + Send + 'static, outputs: [u8; 2]) -> (Vec<u8>, CpuUnit) {
    let (mut unit, bus) = nx_bus::connect(2, 2);
    let mut cpu =
        CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables(), bus, Box::new(program));
    unit.m_to_c.publish(UnitHeader { io_data_active: true, ..UnitHeader::default() }, &outputs);
    for _ in 0..3 {
        cpu.cycle(cpu.deadline());
    }
    (unit.c_to_m.newest().bytes().to_vec(), cpu)
}

#[test]
fn an_echo_returns_each_bit() {
    let (bytes, cpu) = inputs(Echo, [0xA5, 0xFA]);
    assert_eq!(bytes, [0xA5, 0x0A], "bits without a channel are not copied");
    assert_eq!(cpu.io().find("K1_Output_10").map(|id| cpu.io().validity(id)), Some(Ok(Validity::Valid)));
    assert_eq!((cpu.io().entry("Channel", 1), cpu.io().uints(1)), (None, None), "a bit has no bytes");
}

#[test]
fn a_program_reads_and_writes_bits_by_name() {
    let source = "PROGRAM P VAR_EXTERNAL K1_Output_3 : BOOL; K1_Input_11 : BOOL; END_VAR \
                  K1_Input_11 := NOT K1_Output_3; END_PROGRAM";
    let program = || StructuredText::compile(source, &variables()).expect("a program");
    assert_eq!(inputs(program(), [0, 0]).0, [0, 0b100]);
    assert_eq!(inputs(program(), [0b100, 0]).0, [0, 0]);
}

#[test]
fn one_bit_is_forced_and_its_neighbours_are_not() {
    let (_, mut cpu) = inputs(Echo, [0xFF, 0xFF]);
    let io = cpu.io_mut();
    let [bit, next] = ["K1_Output_2", "K1_Output_3"].map(|name| io.find(name).expect(name));
    io.force(bit, &[0]).expect("a bit");
    assert_eq!((io.read(bit).expect("there")[0], io.read(next).expect("there")[0]), (0, 1));
    assert_eq!((io.is_forced(bit), io.is_forced(next)), (Ok(true), Ok(false)));
    cpu.cycle(cpu.deadline());
    assert_eq!(cpu.io().c_to_m(), [0xFD, 0x0F], "the program reads the forced value");
}

#[test]
fn the_statuses_of_the_bus_are_those_of_any_unit() {
    let (_, cpu) = inputs(Echo, [0, 0]);
    let value = |name: &str| cpu.io().read(cpu.io().find(name).expect(name)).expect("there").to_vec();
    assert_eq!(value("NXBus_K1_NX_Unit_I_O_Data_Active_Status"), [1]);
    assert_eq!(value("IOBus://unit#2/NX Unit Error Status"), [0]);
    assert_eq!(value("_NXB_UnitErrFlagTbl").len(), 33);
}
