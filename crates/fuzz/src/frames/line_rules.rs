//! The conditions that a line meets whenever its units have reacted.

use device::{DataDirection, DeviceConfig, transition};
use esc::Esc;
use time::Instant;
use wire::{AlState, AlStatus, AlStatusCode};

use super::units::Units;

/// The states before the units react.
pub(super) struct Before {
    states: Vec<AlState>,
}

impl Before {
    pub(super) fn of(network: &Units) -> Self {
        let state = |position| network.device(position).map(|device| device.al_status().state);
        Self { states: (0..network.len()).filter_map(state).collect() }
    }
}

/// Checks the whole line at `now`.
pub(super) fn check(
    network: &mut Units,
    configs: &[DeviceConfig],
    before: &Before,
    now: Instant,
) -> Result<(), String> {
    if network.deadline() <= now {
        return Err("the line wants to be polled again at the same moment".to_owned());
    }
    for (position, (was, config)) in before.states.iter().zip(configs).enumerate() {
        let Some((device, esc)) = network.slave_mut(position) else { continue };
        if device.is_off() {
            continue;
        }
        let (status, code) = (device.al_status(), device.al_status_code());
        let checked = al_status(status, code, esc).and_then(|()| came_from(*was, status.state));
        let checked = checked.and_then(|()| sync_managers(status.state, config, esc, now));
        checked.map_err(|reason| format!("unit {position}: {reason}"))?;
    }
    Ok(())
}

/// A state of the standard, an error indication only with a code, and the same values in the registers.
fn al_status(status: AlStatus, code: AlStatusCode, esc: &mut Esc) -> Result<(), String> {
    if !matches!(status.state, AlState::Init | AlState::PreOp | AlState::SafeOp | AlState::Op) {
        return Err(format!("it is in {}", status.state));
    }
    if status.error && code == AlStatusCode::NO_ERROR {
        return Err("an error is indicated without a code".to_owned());
    }
    let pdi = esc.pdi();
    let wire = (pdi.al_status(), pdi.al_status_code());
    if wire == (status, code) {
        Ok(())
    } else {
        Err(format!("it shows {wire:?} and is in {status:?}, {code:?}"))
    }
}

/// Up only by the rows of the state machine; a slave may fall back.
fn came_from(was: AlState, is: AlState) -> Result<(), String> {
    let is_legal = was == is || is.bits() < was.bits() || transition(was, is).is_some();
    if is_legal { Ok(()) } else { Err(format!("it came from {was} to {is}")) }
}

/// Process data begin with SAFE-OP; OP ends with the watchdog.
fn sync_managers(state: AlState, config: &DeviceConfig, esc: &mut Esc, now: Instant) -> Result<(), String> {
    let must_be_closed = match state {
        AlState::Op => Some(false),
        // A slave that has fallen out of OP closes some of them until the error is acknowledged.
        AlState::SafeOp => None,
        _ => Some(true),
    };
    // A slave that reaches OP with an expired watchdog starts it again.
    let runs = esc.deadline() != Instant::NEVER;
    for described in &config.process_data {
        let number = described.sync_manager;
        let mut registers = [0; 8];
        esc.read(0x0800 + 8 * u16::from(number.0), &mut registers, now);
        let [_, _, _, _, control, status, activate, pdi_control] = registers;
        let is_closed = pdi_control & 1 != 0;
        if must_be_closed.is_some_and(|closed| closed != is_closed) {
            return Err(format!("in {state} SyncManager {} has PDI control {pdi_control:02X}", number.0));
        }
        // Bit 3 is a full mailbox, which a buffered SyncManager does not have.
        if control & 3 == 0 && activate & 1 != 0 && status & 0x08 != 0 {
            return Err(format!("buffered SyncManager {} has status {status:02X}", number.0));
        }
        let pdi = esc.pdi();
        let is_watched = described.direction == DataDirection::Outputs
            && pdi.is_watched(number)
            && pdi.outputs_received(number);
        if state == AlState::Op && is_watched && pdi.watchdog_expired() && !runs {
            return Err("it is in OP, and its watchdog has expired".to_owned());
        }
    }
    Ok(())
}
