//! What the stack itself checks of a master's settings, in the order in which the first finding counts.

use arrayvec::ArrayVec;
use esc::{Pdi, SmDirection, SmIndex, SmMode, SyncManagerSettings};
use wire::AlStatusCode;

use crate::config::{Area, DeviceConfig, MailboxConfig, WatchdogCheck};
use crate::unit::ProcessDataAreas;

type Verdict = Result<(), AlStatusCode>;

/// Everything that is wrong, in the order in which the first finding counts.
pub(crate) type Findings = ArrayVec<AlStatusCode, 8>;

fn all(verdicts: impl IntoIterator<Item = Verdict>) -> Findings {
    verdicts.into_iter().filter_map(Verdict::err).collect()
}

fn require(holds: bool, otherwise: AlStatusCode) -> Verdict {
    if holds { Ok(()) } else { Err(otherwise) }
}

/// INIT to PRE-OP: the SII was loaded, and SyncManagers 0 and 1 are as it tells (reference 5.4).
pub(crate) fn mailbox(config: &DeviceConfig, pdi: &Pdi<'_>) -> Findings {
    all([
        require(pdi.sii_loaded(), AlStatusCode::EEPROM_ERROR),
        config.mailbox.as_ref().map_or(Ok(()), |mailbox| mailbox_sync_managers(mailbox, pdi)),
    ])
}

/// SyncManagers 0 and 1, which have to stay valid in every state with a mailbox.
pub(crate) fn mailbox_sync_managers(config: &MailboxConfig, pdi: &Pdi<'_>) -> Verdict {
    let receive = pdi.sync_manager(SmIndex::MAILBOX_RECEIVE);
    let send = pdi.sync_manager(SmIndex::MAILBOX_SEND);
    let valid = is_mailbox(&receive, config.receive, SmDirection::EcatWrites)
        && is_mailbox(&send, config.send, SmDirection::EcatReads);
    require(valid, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP)
}

fn is_mailbox(sm: &SyncManagerSettings, area: Area, direction: SmDirection) -> bool {
    sm.enabled
        && sm.mode == SmMode::Mailbox
        && sm.direction == direction
        && sm.start == area.start
        && sm.length_bytes == area.length_bytes
}

/// PRE-OP to SAFE-OP: SyncManagers against the mapping, DC, 3-buffer mode, watchdog.
pub(crate) fn process_data(config: &DeviceConfig, areas: ProcessDataAreas, pdi: &Pdi<'_>) -> Findings {
    let [outputs_fit, inputs_fit] = process_data_sync_managers(config, areas, pdi);
    all([
        outputs_fit,
        inputs_fit,
        require(pdi.dc_activation() & 1 == 0, AlStatusCode::INVALID_DC_SYNC_CONFIGURATION),
        require(
            is_buffered(SmIndex::OUTPUTS, pdi) && is_buffered(SmIndex::INPUTS, pdi),
            AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS,
        ),
        require(watchdog_is_right(config, areas, pdi), AlStatusCode::INVALID_WATCHDOG_CONFIGURATION),
    ])
}

/// Outputs with a watchdog time have a SyncManager that triggers it, where the unit asks for that.
fn watchdog_is_right(config: &DeviceConfig, areas: ProcessDataAreas, pdi: &Pdi<'_>) -> bool {
    let watched = areas.outputs_bytes > 0 && pdi.watchdog_time() > 0;
    let triggered = pdi.sync_manager(SmIndex::OUTPUTS).watchdog_trigger;
    config.watchdog_check == WatchdogCheck::Off || !watched || triggered
}

fn is_buffered(index: SmIndex, pdi: &Pdi<'_>) -> bool {
    let sm = pdi.sync_manager(index);
    !sm.enabled || sm.mode == SmMode::Buffered
}

/// SyncManagers 2 and 3 in SAFE-OP and OP: they have to stay as they were checked.
pub(crate) fn watched_process_data(
    config: &DeviceConfig,
    areas: ProcessDataAreas,
    pdi: &Pdi<'_>,
) -> Findings {
    let [outputs_fit, inputs_fit] = process_data_sync_managers(config, areas, pdi);
    let buffered = |index, otherwise| require(is_buffered(index, pdi), otherwise);
    all([
        outputs_fit.and_then(|()| buffered(SmIndex::OUTPUTS, AlStatusCode::INVALID_OUTPUT_CONFIGURATION)),
        inputs_fit.and_then(|()| buffered(SmIndex::INPUTS, AlStatusCode::INVALID_INPUT_CONFIGURATION)),
    ])
}

/// SyncManagers 2 and 3 against the mapping.
fn process_data_sync_managers(config: &DeviceConfig, areas: ProcessDataAreas, pdi: &Pdi<'_>) -> [Verdict; 2] {
    let outputs = Area { start: config.outputs_start, length_bytes: areas.outputs_bytes };
    let inputs = Area { start: config.inputs_start, length_bytes: areas.inputs_bytes };
    let fits = |index, area, direction| holds_process_data(&pdi.sync_manager(index), area, direction);
    [
        require(
            fits(SmIndex::OUTPUTS, outputs, SmDirection::EcatWrites),
            AlStatusCode::INVALID_OUTPUT_CONFIGURATION,
        ),
        require(
            fits(SmIndex::INPUTS, inputs, SmDirection::EcatReads),
            AlStatusCode::INVALID_INPUT_CONFIGURATION,
        ),
    ]
}

/// A SyncManager without data is disabled or empty; one with data is enabled and fits exactly.
fn holds_process_data(sm: &SyncManagerSettings, area: Area, direction: SmDirection) -> bool {
    if area.length_bytes == 0 {
        return !sm.enabled || sm.length_bytes == 0;
    }
    sm.enabled && sm.direction == direction && sm.start == area.start && sm.length_bytes == area.length_bytes
}
