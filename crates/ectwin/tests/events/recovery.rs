//! The recovery: the cause is removed, the recovery in the event's row is executed, and no error remains.

use nx_ect101::{Event, Recovery};

use crate::cases::{CASES, Case};
use crate::stage::{INIT, OP, Stage};
use crate::{caused, event};

/// Executes the recovery in the row; the unit may be in any state.
fn recover(event: &Event, case: &Case, mut stage: Stage) -> Stage {
    match event.recovery {
        // Error reset by the CPU Unit; the master's is another test.
        Recovery::ResetErrorInSlaveUnit | Recovery::ResetErrorByFailsoft => {
            stage.unit().reset_errors();
        }
        Recovery::CycleUnitPowerOrRestartNxBus | Recovery::CycleSlaveUnitPower | Recovery::CycleUnitPower => {
            stage.unit().cycle_power()
        }
        Recovery::CycleNxUnitPowerThenResetErrorInNxBusFm => {
            stage.unit().cycle_power();
            stage.run_for_ms(2);
            stage.unit().reset_errors();
        }
        Recovery::RestartNxUnitThenResetErrorByFailsoft => {
            stage.unit().restart();
            stage.run_for_ms(2);
            stage.unit().reset_errors();
        }
        Recovery::RedoIoAllocationSettings => stage = Stage::power_on(""),
        Recovery::None => {
            // An observation or an information: nothing is broken, and a reset removes it from the list.
            assert!(!case.code.starts_with('3'));
            stage.unit().reset_errors();
        }
    }
    stage.run_for_ms(2);
    stage
}

#[test]
fn without_its_cause_and_after_its_recovery_nothing_of_an_event_is_left() {
    for case in CASES {
        let (event, mut stage) = (event(case), caused(case));
        (case.remove)(&mut stage);
        if case.code == "39160000" || case.code == "39170000" {
            // The cause is in the I/O allocation.
            stage = Stage::power_on("");
        }
        let mut stage = recover(event, case, stage);
        // The factory setting again, for cases that have changed the mapping.
        assert_eq!(stage.request(INIT | 0x10), (INIT, 0), "{}", case.code);
        restore_mapping(&mut stage);
        stage.enter_pre_op();
        stage.enter_op();
        assert_eq!(stage.al(), (OP, 0), "{}", case.code);
        let inputs = stage.exchange(&[0xC3; 180]);
        assert_eq!((inputs[0] & 0x06, inputs[183]), (0x06, 0), "{}: flags", case.code);
        assert_eq!(stage.upload(0x2002, 1), [0], "{}", case.code);
        assert_eq!((stage.upload(0x2003, 0), stage.upload(0x2004, 0)), (vec![0], vec![0]), "{}", case.code);
        assert_eq!(stage.take_emergencies(), [], "{}", case.code);
        let side = stage.unit();
        assert!(side.io().io_data_active() && !side.io().unit_error(), "{}", case.code);
        assert_eq!(side.outputs(), [0xC3; 180], "{}", case.code);
    }
}

/// The settings that a case has made in PRE-OP.
fn restore_mapping(stage: &mut Stage) {
    stage.set_mailboxes();
    stage.request(crate::PRE_OP);
    let entries = |base: u32| (1..=6).map(|sub| base | sub << 8 | 240).collect::<Vec<u32>>();
    stage.map(0x1601, &entries(0x7000_0000));
    stage.map(0x1A01, &entries(0x6000_0000));
    stage.assign(0x1C12, &[0x1601]);
}

#[test]
fn an_error_that_is_reset_with_its_cause_in_place_is_recorded_anew() {
    for case in CASES {
        let (event, mut stage) = (event(case), caused(case));
        let stands = event.reported_as_current_error
            && !matches!(event.recovery, Recovery::ResetErrorInSlaveUnit | Recovery::None);
        if !stands {
            continue;
        }
        let before = stage.history().len();
        stage.unit().reset_errors();
        assert_eq!(stage.history().len(), before + 1, "{}", case.code);
        assert_eq!(stage.unit().error_status(), 0x20, "{}", case.code);
        assert!(stage.unit().io().unit_error(), "{}", case.code);
    }
}
