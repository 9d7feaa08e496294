//! After power-on the CPU Unit allocates nothing: not for variables, forced values, programs, events.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use allocation_counter::measure;
use nx_bus::UnitHeader;
use nx_ect101::{IoAllocation, SlaveStatus};
use plc::{CpuSettings, CpuUnit, DeviceVariables, FailSoftOperation, Io, OperatingMode, ProgramEvent};
use time::Instant;

const CYCLES: u64 = 1_000;

/// Copies an array, element by element too, forces and releases, and reports trouble in every scan.
fn busy_program() -> impl FnMut(&mut Io) + Send {
    let mut ids = None;
    move |io: &mut Io| {
        let (from, to, flag) = *ids.get_or_insert_with(|| {
            ["N1_UINTs_01_M_to_C", "N1_UINTs_01_C_to_M", "N1_IN_Port_Link_ON"]
                .map(|name| io.find(name).expect(name))
                .into()
        });
        let value = io.read(from).expect("an input");
        io.write(to, &value).expect("an output");
        io.write(to.element(3), &value[..2]).expect("an element");
        io.force(flag, &[1]).and_then(|()| io.force(to.element(4), &[1, 2])).expect("what fits");
        io.release(to.element(4)).expect("an element");
        let _ = (io.validity(from), io.is_forced(flag), io.forced().count());
        io.report(ProgramEvent::TaskOverrun { budget_statements: 1 });
        io.report(ProgramEvent::UserDefinedError { code: 1, info1: io.now().as_nanos(), info2: 0 });
    }
}

#[test]
fn cycles_variables_forces_and_events_allocate_nothing() {
    let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &IoAllocation::factory()));
    let (mut unit, bus) = nx_bus::connect(variables.unit().m_to_c_bytes, variables.unit().c_to_m_bytes);
    let settings = CpuSettings { fail_soft: FailSoftOperation::Stop, ..CpuSettings::default() };
    let mut cpu = CpuUnit::power_on(Instant::ZERO, settings, variables, bus, Box::new(busy_program()));
    cpu.attach(Box::new(|io: &mut Io| io.c_to_m_mut()[100] ^= 1));
    let mut data = [0; 180];
    let allocated = measure(|| {
        for cycle in 0..CYCLES {
            data.fill(cycle as u8);
            let error_resets = unit.c_to_m.newest().header.error_resets;
            let fail_soft_error = cycle % 100 < 10;
            let status = SlaveStatus { m_to_c_valid: true, ..SlaveStatus::default() }.bits();
            unit.m_to_c.publish(
                UnitHeader { status, fail_soft_error, error_resets, ..UnitHeader::default() },
                &data,
            );
            // Every 50th time late, so that task periods are left out.
            let late = cpu.deadline() + time::Duration::from_millis(u64::from(cycle % 50 == 0) * 5);
            cpu.cycle(late);
            if cycle % 100 == 50 {
                cpu.reset_errors();
                cpu.set_mode(OperatingMode::Program);
            }
            if cycle % 100 == 60 {
                cpu.set_mode(OperatingMode::Run);
                cpu.take_events().for_each(drop);
            }
        }
    });
    assert_eq!(allocated.count_total, 0);
    assert_ne!(cpu.events_lost(), 0, "each error was another one, and the log is bounded");
}
