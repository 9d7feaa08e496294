//! What the slave stack is told about the unit.

use device::{
    AbortProfile, Area, DeviceConfig, EscConfig, MailboxConfig, OutputsBeforeOp, RefusedInOp, SiiTiming,
    SyncManagerWrites, WatchdogCheck,
};

use crate::description::description;
use crate::layout;
use crate::settings::UnitSettings;

/// The stack of a unit with these settings: an ESC with 8 FMMUs, 8 SyncManagers, 8 KiB and 64-bit distributed
/// clocks, its EEPROM, its mailboxes, and the abort codes of the manual (7-6-2).
#[must_use]
pub fn device_config(settings: &UnitSettings) -> DeviceConfig {
    device_config_with(settings, esi::sii::image(&description(settings)))
}

/// The same, with the EEPROM of a unit that has been in use: [`crate::NonVolatileMemory::sii_image`].
#[must_use]
pub fn device_config_with(settings: &UnitSettings, sii_image: Vec<u8>) -> DeviceConfig {
    let area = |start| Area { start, length_bytes: layout::MAILBOX_BYTES };
    DeviceConfig {
        esc: EscConfig {
            fmmu_count: 8,
            sync_manager_count: 8,
            ram_kib: 8,
            distributed_clocks: true,
            sii: SiiTiming::Immediate,
            sync_manager_writes: SyncManagerWrites::OnlyWhileDisabled,
        },
        sii_image,
        mailbox: Some(MailboxConfig {
            receive: area(layout::MAILBOX_RECEIVE_START),
            send: area(layout::MAILBOX_SEND_START),
            response_time: settings.timing.sdo_response(),
            aborts: AbortProfile::COARSE,
        }),
        outputs_start: layout::OUTPUTS_START,
        inputs_start: layout::INPUTS_START,
        // Masters differ in what comes first, outputs or OP. Outputs are not valid until they come.
        outputs_before_op: OutputsBeforeOp::NotRequired,
        watchdog_check: WatchdogCheck::TriggerRequired,
        // Manual, 8-3-4: the state is kept when the error occurs.
        refused_in_op: RefusedInOp::StayInOp,
    }
}

#[cfg(test)]
mod tests {
    use device::{Device, Unit};
    use time::{Duration, Instant};
    use wire::AlState;

    use super::*;
    use crate::{NxEct101, Timing};

    #[test]
    fn a_unit_starts_on_its_stack() {
        let settings = UnitSettings::default();
        let (unit, _cpu) = NxEct101::power_on(&settings);
        let (mut device, mut esc) = Device::power_on(device_config(&settings), unit, Instant::ZERO);
        device.poll(&mut esc, Instant::ZERO);
        assert_eq!(device.al_status().state, AlState::Init);
        assert_eq!(device.deadline(), Instant::ZERO + device.unit().refresh_period());
    }

    #[test]
    fn sdo_responses_take_the_time_of_the_manual() {
        let response_time = |timing| {
            let settings = UnitSettings { timing, ..UnitSettings::default() };
            device_config(&settings).mailbox.expect("a mailbox").response_time
        };
        assert_eq!(response_time(Timing::Exact), Duration::from_millis(2));
        assert_eq!(response_time(Timing::Fast), Duration::ZERO);
    }
}
