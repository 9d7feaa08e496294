//! The description of a terminal for the slave stack.

use device::{DeviceConfig, EscConfig, PortKind, SyncMode};

use crate::description::description;
use crate::layout;
use crate::settings::{Ports, TerminalSettings};

/// A byte of an EEPROM that has never been written.
const ERASED: u8 = 0xFF;

/// The stack of a terminal with these settings: no mailbox, and outputs that are applied at the end of a frame.
#[must_use]
pub fn device_config(settings: &TerminalSettings) -> DeviceConfig {
    let mut sii_image = esi::sii::image(&description(settings));
    if settings.is_sii_blank {
        sii_image.fill(ERASED);
    }
    DeviceConfig {
        esc: EscConfig { ports: ports(settings.ports), sii: settings.sii, ..EscConfig::default() },
        sii_image,
        process_data: layout::process_data(settings).collect(),
        sync_modes: &[SyncMode::EndOfFrame],
        start_up: settings.start_up,
        refresh_phase: settings.refresh_phase,
        outputs_before_op: settings.outputs_before_op,
        conduct: settings.conduct.clone(),
        ..DeviceConfig::default()
    }
}

fn ports(ports: Ports) -> [PortKind; 4] {
    let kind = |number| if number < ports.count() { PortKind::Mii } else { PortKind::Missing };
    [0, 1, 2, 3].map(kind)
}
