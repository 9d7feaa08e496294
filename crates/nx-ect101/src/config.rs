//! The description of the unit for the slave stack.

use device::{
    AbortProfile, Area, Buffers, Condition, DataDirection, DataLength, DeviceConfig, EscConfig, MailboxAreas,
    MailboxConfig, OutputsBeforeOp, ProcessDataConfig, RefusedInOp, Requirement, SmIndex, SyncManagerWrites,
    SyncMode, condition,
};
use time::Duration;
use unit_model::keys::{OutputsRule, SlaveKeys, Timing};
use wire::AlStatusCode;

use crate::description::{description, timeouts};
use crate::layout;
use crate::settings::UnitSettings;
use crate::timing::sdo_response;

/// A byte of an EEPROM that has never been written.
const ERASED: u8 = 0xFF;

/// The checks of the stack from PRE-OP to SAFE-OP (manual, 8-3-4); the unit adds mapping and synchronization
/// between them.
const CHECKS: &[Condition] = &[
    condition(Requirement::Areas(DataDirection::Outputs), AlStatusCode::INVALID_OUTPUT_CONFIGURATION),
    condition(Requirement::Areas(DataDirection::Inputs), AlStatusCode::INVALID_INPUT_CONFIGURATION),
    condition(Requirement::Offered(SyncMode::Dc), AlStatusCode::INVALID_DC_SYNC_CONFIGURATION),
    condition(Requirement::Buffers(DataDirection::Outputs), AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS),
    condition(Requirement::Buffers(DataDirection::Inputs), AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS),
    condition(Requirement::WatchdogTrigger, AlStatusCode::INVALID_WATCHDOG_CONFIGURATION),
];

/// The stack of a unit with these settings: an ESC with 8 FMMUs, 8 SyncManagers, 8 KiB and 64-bit distributed
/// clocks, its EEPROM, its mailboxes, and the abort codes of the manual (7-6-2).
#[must_use]
pub fn device_config(settings: &UnitSettings) -> DeviceConfig {
    device_config_with(settings, esi::sii::image(&description(settings)))
}

/// The same, with the EEPROM of a unit that has been in use: [`crate::NonVolatileMemory::sii_image`].
#[must_use]
pub fn device_config_with(settings: &UnitSettings, sii_image: Vec<u8>) -> DeviceConfig {
    let (slave, timing) = (&settings.slave, settings.timing);
    let sii_image = if slave.is_sii_blank { vec![ERASED; sii_image.len()] } else { sii_image };
    let area = |start| Area { start, length_bytes: layout::MAILBOX_BYTES };
    DeviceConfig {
        esc: EscConfig {
            fmmu_count: 8,
            sync_manager_count: 8,
            ram_kib: 8,
            distributed_clocks: true,
            sii: slave.sii_timing(timing),
            sync_manager_writes: SyncManagerWrites::OnlyWhileDisabled,
            ..EscConfig::default()
        },
        sii_image,
        mailbox: Some(MailboxConfig {
            standard: MailboxAreas {
                receive: area(layout::MAILBOX_RECEIVE_START),
                send: area(layout::MAILBOX_SEND_START),
            },
            bootstrap: None,
            response_time: mailbox_time(slave, timing),
            aborts: AbortProfile::COARSE,
        }),
        process_data: process_data().into_iter().collect(),
        checks: CHECKS,
        start_up: settings.start_up,
        refresh_phase: settings.refresh_phase,
        outputs_before_op: outputs_before_op(slave.outputs_before_op),
        // Manual, 8-3-4: the state is kept when the error occurs.
        refused_in_op: RefusedInOp::StayInOp,
        conduct: slave.conduct(timing),
        ..DeviceConfig::default()
    }
}

/// SyncManagers 2 and 3, with the length of the mapping.
fn process_data() -> [ProcessDataConfig; 2] {
    let described = |sync_manager, direction, start, max_bytes| {
        let length = DataLength::Mapped { max_bytes };
        ProcessDataConfig { sync_manager, direction, start, length, buffers: Buffers::Three }
    };
    [
        described(SmIndex::OUTPUTS, DataDirection::Outputs, layout::OUTPUTS_START, layout::OUTPUTS_MAX_BYTES),
        described(SmIndex::INPUTS, DataDirection::Inputs, layout::INPUTS_START, layout::INPUTS_MAX_BYTES),
    ]
}

fn outputs_before_op(rule: Option<OutputsRule>) -> OutputsBeforeOp {
    match rule {
        Some(OutputsRule::Required) | None => {
            OutputsBeforeOp::Within(Duration::from_millis(timeouts().safe_op_op_ms.into()))
        }
        Some(OutputsRule::NotRequired) => OutputsBeforeOp::NotRequired,
    }
}

fn mailbox_time(slave: &SlaveKeys, timing: Timing) -> Duration {
    match timing {
        Timing::Exact => slave.mailbox_time.unwrap_or(sdo_response()),
        Timing::Fast => Duration::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use device::{Device, SiiTiming, Unit};
    use time::Instant;
    use wire::AlState;

    use super::*;
    use crate::NxEct101;

    #[test]
    fn a_unit_starts_on_its_stack() {
        let settings = UnitSettings::default();
        let (unit, _cpu) = NxEct101::power_on(&settings);
        let (mut device, mut esc) = Device::power_on(device_config(&settings), unit, Instant::ZERO);
        device.poll(&mut esc, Instant::ZERO);
        assert_eq!(device.al_status().state, AlState::Init);
        let period = device.unit().refresh_period().expect("a period");
        assert_eq!(device.deadline(), Instant::ZERO + period);
    }

    /// C056: the time is the one in the ESI.
    #[test]
    fn outputs_are_waited_for_as_long_as_a_master_waits() {
        let of = |text: &str| {
            let file = crate::unit_file::UnitFile::parse(text).expect("a unit file");
            device_config(&UnitSettings::from_unit_file(&file)).outputs_before_op
        };
        let told = description(&UnitSettings::default()).timeouts.safe_op_op_ms;
        let within = OutputsBeforeOp::Within(Duration::from_millis(told.into()));
        assert_eq!(of("model = \"nx-ect101\""), within);
        assert_eq!(of("model = \"nx-ect101\"\noutputs_before_op = \"required\""), within);
        let lenient = "model = \"nx-ect101\"\noutputs_before_op = \"not-required\"";
        assert_eq!(of(lenient), OutputsBeforeOp::NotRequired);
    }

    #[test]
    fn times_of_the_file_hold_unless_the_unit_is_fast() {
        let text =
            "model = \"nx-ect101\"\ntimes = { transitions = \"5ms\", sii = \"1ms\", mailbox = \"7ms\" }";
        let file = crate::unit_file::UnitFile::parse(text).expect("a unit file");
        let times = |timing| {
            let config = device_config(&UnitSettings { timing, ..UnitSettings::from_unit_file(&file) });
            let transition = config.conduct.transition_times.of(AlState::Init, AlState::PreOp);
            (transition, config.esc.sii, config.mailbox.expect("a mailbox").response_time)
        };
        let ms = Duration::from_millis;
        assert_eq!(times(Timing::Exact), (ms(5), SiiTiming::Busy(ms(1)), ms(7)));
        assert_eq!(times(Timing::Fast), (ms(0), SiiTiming::Immediate, ms(0)));
    }

    #[test]
    fn a_blank_eeprom_is_erased_whatever_it_held() {
        let slave = SlaveKeys { is_sii_blank: true, ..SlaveKeys::default() };
        let config = device_config_with(&UnitSettings { slave, ..UnitSettings::default() }, vec![1, 2, 3]);
        assert_eq!(config.sii_image, [0xFF; 3]);
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
