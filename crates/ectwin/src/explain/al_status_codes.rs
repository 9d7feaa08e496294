//! Names of AL status codes, and the likely cause and correction of each, for the user of a master. The names of the
//! standard are in [`AlStatusCode::TABLE`].

use std::borrow::Cow;

use unit_model::tables::VendorAlStatusCode;
use wire::AlStatusCode;

use super::Advice;
use super::tables::tables;

/// The name of a code; none if there is no published name.
pub(super) fn name(code: AlStatusCode) -> Option<&'static str> {
    let of_vendor = of_vendor(code).map(|row| row.name);
    of_vendor.or_else(|| code.row().map(|row| row.meaning))
}

/// The row of a code that is in no standard.
pub(super) fn of_vendor(code: AlStatusCode) -> Option<&'static VendorAlStatusCode> {
    tables().al_status_codes.iter().find(|row| row.code == code)
}

/// Likely cause and correction of a code of the standard, with what the model adds.
pub(super) fn advice(code: AlStatusCode) -> Option<Advice> {
    let (_, advice) = ADVICE.iter().find(|(known, _)| *known == code)?;
    let mut advice = advice.clone();
    for note in tables().al_status_notes.iter().filter(|note| note.code == code) {
        add(&mut advice.cause, note.cause);
        add(&mut advice.correction, note.correction);
    }
    Some(advice)
}

/// Adds the end of a sentence.
fn add(sentence: &mut Cow<'static, str>, end: &str) {
    if !end.is_empty() {
        *sentence = format!("{}{end}.", sentence.trim_end_matches('.')).into();
    }
}

/// All known codes.
pub(super) fn known() -> impl Iterator<Item = AlStatusCode> {
    AlStatusCode::TABLE.iter().map(|row| row.code).chain(tables().al_status_codes.iter().map(|row| row.code))
}

type Row = (AlStatusCode, Advice);

const fn row(code: AlStatusCode, cause: &'static str, correction: &'static str) -> Row {
    (code, Advice::new(cause, correction))
}

/// Ascending by code, one row for each row of [`AlStatusCode::TABLE`].
#[rustfmt::skip]
pub(super) const ADVICE: &[Row] = &[
    row(AlStatusCode::NO_ERROR, "Nothing is wrong.", "None needed."),
    row(AlStatusCode::UNSPECIFIED, "An error for which the standard has no code.", "Read the diagnosis history (0x10F3); restart the unit."),
    row(AlStatusCode::NO_MEMORY, "The unit could not get memory.", "Restart the unit; if it occurs again, check the file of `storage` in the unit file."),
    row(AlStatusCode::INVALID_DEVICE_SETUP, "The device is not set up in a way that can run.", "Check the unit's own settings, then request the state again."),
    row(AlStatusCode::INVALID_REVISION, "The mapping is made for another hardware or software revision.", "Use the ESI file of this revision in the master's configuration."),
    row(AlStatusCode::SII_MISMATCH, "The SII was written for another firmware.", "Write the SII image that fits: `ectwin sii FILE`."),
    row(AlStatusCode::FIRMWARE_UPDATE_FAILED, "The file of a firmware update did not arrive whole or does not fit.", "Repeat the update in BOOT."),
    row(AlStatusCode::LICENSE_ERROR, "A licence that the device needs is missing or has run out.", "Renew the licence."),
    row(AlStatusCode::INVALID_REQUESTED_STATE_CHANGE, "The master asked for a state that cannot be reached from the present one, such as OP from PRE-OP.", "Go through the states in order: INIT, PRE-OP, SAFE-OP, OP; acknowledge the error first (AL control bit 4)."),
    row(AlStatusCode::UNKNOWN_REQUESTED_STATE, "AL control bits 3:0 held a value that names no state.", "Write 1 (INIT), 2 (PRE-OP), 4 (SAFE-OP) or 8 (OP)."),
    row(AlStatusCode::BOOTSTRAP_NOT_SUPPORTED, "The master asked for BOOT, which this unit does not have.", "Do not request BOOT; firmware updates are not possible this way."),
    row(AlStatusCode::NO_VALID_FIRMWARE, "The device has no firmware that it may start.", "Write the SII image again: `ectwin sii FILE`; restart the unit."),
    row(AlStatusCode::INVALID_MAILBOX_CONFIGURATION_BOOT, "SyncManager 0 or 1 does not have the address, length or mode that the SII gives for BOOT.", "Set both from the SII words 0x14 to 0x17."),
    row(AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP, "SyncManager 0 or 1 does not have the address, length or mode that the SII gives for the mailbox.", "Set both from the SII words 0x18 to 0x1B before asking for PRE-OP."),
    row(AlStatusCode::INVALID_SYNC_MANAGER_CONFIGURATION, "A SyncManager is set in a way that the device cannot use.", "Compare registers 0x0800 and following with the SII or ESI."),
    row(AlStatusCode::NO_VALID_INPUTS, "The application has no valid inputs to give.", "Wait for the application, or start it, then request the state again."),
    row(AlStatusCode::NO_VALID_OUTPUTS, "The master asked for OP without having sent outputs.", "Send process data cyclically in SAFE-OP, before and while asking for OP."),
    row(AlStatusCode::SYNCHRONIZATION_ERROR, "The device lost its synchronization with the master's cycle.", "Check cycle time and jitter of the master."),
    row(AlStatusCode::SYNC_MANAGER_WATCHDOG, "In OP: no outputs for longer than the process data watchdog (registers 0x0400 and 0x0420) allows. SAFE-OP to OP: no outputs within the SafeopOpTimeout of the ESI.", "Start process data before or while OP is requested, and send outputs in each cycle; make the cycle shorter or the watchdog longer; then acknowledge and request OP again."),
    row(AlStatusCode::INVALID_SYNC_MANAGER_TYPES, "A SyncManager has another use than the device gives it (0x1C00).", "Take the uses from the SII or ESI: 0 and 1 mailbox, 2 outputs, 3 inputs."),
    row(AlStatusCode::INVALID_OUTPUT_CONFIGURATION, "SyncManager 2 does not have the address, length or mode that the RxPDO mapping requires.", "Set its length to the sum of the entries assigned in 0x1C12, its address and mode from the SII."),
    row(AlStatusCode::INVALID_INPUT_CONFIGURATION, "SyncManager 3 does not have the address, length or mode that the TxPDO mapping requires.", "Set its length to the sum of the entries assigned in 0x1C13, its address and mode from the SII."),
    row(AlStatusCode::INVALID_WATCHDOG_CONFIGURATION, "The process data watchdog is set in a way that the device refuses.", "Set registers 0x0400 and 0x0420 and the watchdog bit of SyncManager 2 to the values in the ESI."),
    row(AlStatusCode::NEEDS_COLD_START, "A setting takes effect only after the power was off.", "Switch the unit off and on."),
    row(AlStatusCode::NEEDS_INIT, "A setting takes effect only from INIT.", "Take the unit to INIT and up again."),
    row(AlStatusCode::NEEDS_PREOP, "A setting takes effect only from PRE-OP.", "Take the unit to PRE-OP and up again."),
    row(AlStatusCode::NEEDS_SAFEOP, "A setting takes effect only from SAFE-OP.", "Take the unit to SAFE-OP and up again."),
    row(AlStatusCode::INVALID_INPUT_MAPPING, "The TxPDO mapping breaks a rule: 0x1A00 is missing, an entry is illegal or out of order, or it is too large.", "Compare 0x1C13 and 0x1A00 to 0x1BFF with the unit's I/O allocation; the diagnosis history (0x10F3) names the rule."),
    row(AlStatusCode::INVALID_OUTPUT_MAPPING, "The RxPDO mapping breaks a rule: an entry is illegal or out of order, or it is too large.", "Compare 0x1C12 and 0x1600 to 0x17FF with the unit's I/O allocation; the diagnosis history (0x10F3) names the rule."),
    row(AlStatusCode::INCONSISTENT_SETTINGS, "Settings that are valid by themselves contradict each other.", "Compare the master's configuration with the ESI."),
    row(AlStatusCode::FREE_RUN_NOT_SUPPORTED, "The device has no Free-Run.", "Choose a synchronization that its ESI offers."),
    row(AlStatusCode::SYNCHRONIZATION_NOT_SUPPORTED, "The synchronization that the master chose is not there.", "Set the synchronization type in 0x1C32:01 and 0x1C33:01 to 0 (Free-Run), and no SM event."),
    row(AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS, "Free-Run with a SyncManager that is not in 3-buffer mode.", "Set bits 1:0 of the control byte of SyncManagers 2 and 3 to 0."),
    row(AlStatusCode::BACKGROUND_WATCHDOG, "A watchdog inside the device ran out.", "Restart the unit."),
    row(AlStatusCode::NO_VALID_INPUTS_AND_OUTPUTS, "Neither inputs nor outputs are valid.", "Start the application and send outputs, then request the state again."),
    row(AlStatusCode::FATAL_SYNC_ERROR, "The SYNC signals of the distributed clocks have failed for good.", "Set the distributed clocks up again from INIT."),
    row(AlStatusCode::NO_SYNC_ERROR, "No SYNC signal came.", "Activate SYNC0 (register 0x0981) before asking for OP."),
    row(AlStatusCode::CYCLE_TIME_TOO_SMALL, "The cycle is shorter than the device can follow.", "Make the cycle longer than the minimum in 0x1C32:05."),
    row(AlStatusCode::INVALID_DC_SYNC_CONFIGURATION, "The SYNC unit is active in a way that the device does not support.", "Leave registers 0x0980 and 0x0981 at 0: configure Free-Run in the master."),
    row(AlStatusCode::INVALID_DC_LATCH_CONFIGURATION, "The latch unit is set in a way that the device does not support.", "Keep the latch registers at the values in the ESI."),
    row(AlStatusCode::PLL_ERROR, "The device cannot follow the master's clock.", "Check the jitter of the master, and wait until the clocks have settled."),
    row(AlStatusCode::DC_SYNC_IO_ERROR, "Inputs or outputs did not keep time with SYNC.", "Check that process data arrives before SYNC0."),
    row(AlStatusCode::DC_SYNC_TIMEOUT, "SYNC and the frames drifted apart for too long.", "Check the shift between cycle start and SYNC0."),
    row(AlStatusCode::DC_INVALID_SYNC_CYCLE_TIME, "The SYNC cycle is not one that the device supports.", "Take a cycle from its ESI (registers 0x09A0 and 0x09A4)."),
    row(AlStatusCode::DC_SYNC0_CYCLE_TIME, "The SYNC0 cycle does not fit the application.", "Correct register 0x09A0."),
    row(AlStatusCode::DC_SYNC1_CYCLE_TIME, "The SYNC1 cycle does not fit the application.", "Correct register 0x09A4."),
    row(AlStatusCode::MAILBOX_AOE, "An error in ADS over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::MAILBOX_EOE, "An error in Ethernet over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::MAILBOX_COE, "An error in CANopen over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::MAILBOX_FOE, "An error in file access over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::MAILBOX_SOE, "An error in the servo profile over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::MAILBOX_VOE, "An error in a vendor protocol over EtherCAT.", "Check the mailbox traffic in a capture."),
    row(AlStatusCode::EEPROM_NO_ACCESS, "The device needs its SII, but the master holds it.", "Give the SII to the PDI: write 1 to register 0x0500."),
    row(AlStatusCode::EEPROM_ERROR, "The SII could not be read, or its checksum is wrong.", "Write a valid image: `ectwin sii FILE`."),
    row(AlStatusCode::EXTERNAL_HARDWARE_NOT_READY, "A resource that the device needs is not ready.", "Check what is connected to the device."),
    row(AlStatusCode::SLAVE_RESTARTED_LOCALLY, "The unit was restarted at its own side.", "Acknowledge, and take it up from INIT again."),
    row(AlStatusCode::DEVICE_ID_UPDATED, "The device identification value was changed.", "Read it again, or set it back."),
    row(AlStatusCode::MODULE_LIST_MISMATCH, "The modules that the master configured are not those that are there.", "Compare 0xF030 with 0xF050."),
    row(AlStatusCode::SUPPLY_VOLTAGE_TOO_LOW, "The supply is below its limit.", "Check the power supply and its cables."),
    row(AlStatusCode::SUPPLY_VOLTAGE_TOO_HIGH, "The supply is above its limit.", "Check the power supply."),
    row(AlStatusCode::TEMPERATURE_TOO_LOW, "The device is too cold.", "Warm it up."),
    row(AlStatusCode::TEMPERATURE_TOO_HIGH, "The device is too hot.", "Cool it, check its fan and its surroundings."),
    row(AlStatusCode::APPLICATION_CONTROLLER_AVAILABLE, "The controller behind the device has become available.", "None needed."),
];
