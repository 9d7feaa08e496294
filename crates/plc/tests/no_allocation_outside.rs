//! The CPU Unit allocates nothing for outside programs, whatever they send.

use allocation_counter::measure;
use nx_ect101::IoAllocation;
use plc::outside::{self, Change, Operation};
use plc::{CpuSettings, CpuUnit, DeviceVariables, Echo, Target};
use time::Instant;

#[test]
fn changes_and_snapshots_allocate_nothing() {
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()));
    let (_unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
    let mut cpu = CpuUnit::power_on(Instant::ZERO, CpuSettings::default(), variables, bus, Box::new(Echo));
    let (program, mut end) = outside::connect(cpu.io().variables());
    cpu.attach(Box::new(program));
    let target: Target = cpu.io().find("N1_UINTs_01_C_to_M").expect("allocated").into();
    let value: plc::VariableValue = [1; 30].into_iter().collect();
    let operations = [
        Operation::Write(value.clone()),
        Operation::Force(value.clone()),
        Operation::ForceAsItIs,
        Operation::Release,
    ];
    let changes = operations.map(|operation| Change { target, operation });
    let allocated = measure(|| {
        for _ in 0..1_000 {
            // Sometimes more than there is room for.
            for _ in 0..200 {
                let _ = end.send(&changes);
            }
            cpu.cycle(cpu.deadline());
            assert_eq!(end.newest().read(target), Ok(value.clone()));
        }
    });
    assert_eq!(allocated.count_total, 0);
}
