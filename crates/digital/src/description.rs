//! The description of a terminal in ESI and SII.

use device::{DataDirection, DataLength, ProcessDataConfig};
use esi::{
    DeviceDescription, FmmuUsage, Group, Pdo, PdoEntry, PortPhysics, SyncManager, SyncManagerType, Timeouts,
    Vendor,
};
use wire::{DataType, ObjectIndex, SubIndex};

use crate::channels::Channels;
use crate::layout;
use crate::settings::{Ports, TerminalSettings};

/// SII word 0: the PDI is digital I/O, and no device emulation: requests are checked.
const PDI_DIGITAL_IO: u16 = 0x0004;

/// The description of a terminal.
#[must_use]
pub fn description(settings: &TerminalSettings) -> DeviceDescription {
    DeviceDescription {
        vendor: Vendor { id: layout::VENDOR_ID, name: layout::VENDOR_NAME.into() },
        group: Group { group_type: "Digital".into(), name: "Digital terminals".into() },
        order_code: order_code(settings),
        name: name(settings),
        product_code: layout::product_code(settings),
        revision: layout::REVISION,
        serial: settings.serial,
        ports: physics(settings.ports),
        esc_configuration: [PDI_DIGITAL_IO, 0, 0, 0],
        station_alias: settings.alias,
        eeprom_bytes: layout::eeprom_bytes(settings),
        fmmus: layout::process_data(settings).map(|described| fmmu(described.direction)).collect(),
        sync_managers: layout::process_data(settings).map(sync_manager).collect(),
        rx_pdos: pdos(settings, DataDirection::Outputs),
        tx_pdos: pdos(settings, DataDirection::Inputs),
        timeouts: timeouts(),
        ..DeviceDescription::default()
    }
}

/// Time-outs of the master.
pub(crate) fn timeouts() -> Timeouts {
    Timeouts::default()
}

/// Such as DO8, DI16, DO8-DI8.
fn order_code(settings: &TerminalSettings) -> String {
    match [settings.outputs, settings.inputs].map(Channels::count) {
        [0, 0] => "COUPLER".into(),
        [outputs, 0] => format!("DO{outputs}"),
        [0, inputs] => format!("DI{inputs}"),
        [outputs, inputs] => format!("DO{outputs}-DI{inputs}"),
    }
}

fn name(settings: &TerminalSettings) -> String {
    let of = |channels: Channels, kind: &str| match channels.count() {
        1 => format!("1 digital {kind}"),
        count => format!("{count} digital {kind}s"),
    };
    let (outputs, inputs) = (of(settings.outputs, "output"), of(settings.inputs, "input"));
    match [settings.outputs, settings.inputs].map(Channels::is_none) {
        [true, true] => "Coupler".into(),
        [false, true] => outputs,
        [true, false] => inputs,
        [false, false] => format!("{outputs}, {inputs}"),
    }
}

/// Ports for cables, according to the settings.
fn physics(ports: Ports) -> [PortPhysics; 4] {
    let physics = |number| if number < ports.count() { PortPhysics::Mii } else { PortPhysics::Unused };
    [0, 1, 2, 3].map(physics)
}

const fn fmmu(direction: DataDirection) -> FmmuUsage {
    match direction {
        DataDirection::Outputs => FmmuUsage::Outputs,
        DataDirection::Inputs => FmmuUsage::Inputs,
    }
}

fn sync_manager(described: ProcessDataConfig) -> SyncManager {
    let (usage, control) = match described.direction {
        DataDirection::Outputs => (SyncManagerType::Outputs, layout::OUTPUTS_CONTROL),
        DataDirection::Inputs => (SyncManagerType::Inputs, layout::INPUTS_CONTROL),
    };
    let default_bytes = match described.length {
        DataLength::Fixed(bytes) | DataLength::Mapped { max_bytes: bytes } => bytes,
    };
    let (min_bytes, max_bytes) = (None, None);
    SyncManager { usage, start: described.start, default_bytes, min_bytes, max_bytes, control, enable: 1 }
}

/// A PDO of one bit for each channel, like simple terminals: 0x7000:01 in 0x1600, 0x7010:01 in 0x1601 and so
/// on; inputs are 0x6000:01 in 0x1A00.
fn pdos(settings: &TerminalSettings, direction: DataDirection) -> Vec<Pdo> {
    let sync_manager = layout::process_data(settings).find(|described| described.direction == direction);
    let sync_manager = sync_manager.map(|described| described.sync_manager.0);
    let (channels, pdo, object, entry) = match direction {
        DataDirection::Outputs => (settings.outputs, 0x1600, 0x7000, "Output"),
        DataDirection::Inputs => (settings.inputs, 0x1A00, 0x6000, "Input"),
    };
    let channel = |number: u8| {
        let at = u16::from(number) - 1;
        Pdo {
            index: ObjectIndex(pdo + at),
            name: format!("Channel {number}"),
            entries: vec![PdoEntry {
                index: ObjectIndex(object + 0x10 * at),
                sub: SubIndex(1),
                name: entry.into(),
                data_type: DataType::BOOLEAN,
                bit_length: 1,
            }],
            sync_manager,
            fixed: true,
            mandatory: true,
        }
    };
    channels.numbers().map(channel).collect()
}
