//! The contents of ESI and SII, from the same tables that answer online.

use coe_kit::pdo::PdoObjects;
use esi::{
    CoeDetails, DeviceDescription, EscPresets, FmmuUsage, GeneralFlags, Group, InitCommand, Mailbox,
    MailboxArea, MailboxProtocols, Pdo, PdoEntry, PortPhysics, SyncManager, SyncManagerType, Timeouts,
    Transition, Vendor,
};
use objects::ObjectTable;
use wire::{ObjectIndex, SubIndex};

use crate::data_sets::{Assignment, DataSet, Direction, Limits, StatusPdo};
use crate::layout;
use crate::settings::UnitSettings;
use crate::tables::object_table;

/// SII word 0: PDI control 0x08 (a microcontroller runs the unit), no device emulation.
const ESC_CONFIGURATION: [u16; 4] = [0x0008, 0, 0, 0];

/// The description of a unit with these settings. The SII gets its serial number and its ID, which the unit
/// loads into the station alias register at power-on (manual, 3-3).
#[must_use]
pub fn description(settings: &UnitSettings) -> DeviceDescription {
    let table = object_table();
    let mapping = PdoObjects::of_table(&table);
    DeviceDescription {
        vendor: Vendor { id: layout::VENDOR_ID, name: layout::VENDOR_NAME.into() },
        group: Group { group_type: "NX-ECT".into(), name: "NX-series EtherCAT Slave Units".into() },
        order_code: layout::ORDER_CODE.into(),
        name: "NX-ECT101 EtherCAT Slave Unit".into(),
        product_code: layout::PRODUCT_CODE,
        revision: layout::REVISION,
        serial: settings.serial,
        ports: [PortPhysics::Mii, PortPhysics::Mii, PortPhysics::Unused, PortPhysics::Unused],
        esc_configuration: ESC_CONFIGURATION,
        station_alias: settings.explicit_device_id(),
        eeprom_bytes: layout::EEPROM_BYTES,
        mailbox: Some(mailbox()),
        general_flags: GeneralFlags::IDENT_AL_STATUS | GeneralFlags::MAILBOX_DATA_LINK_LAYER,
        identification_offset: 0,
        ebus_current_ma: 0,
        fmmus: vec![FmmuUsage::Outputs, FmmuUsage::Inputs, FmmuUsage::MailboxState],
        sync_managers: sync_managers(&mapping),
        rx_pdos: pdos(&table, &mapping, Direction::MToC),
        tx_pdos: pdos(&table, &mapping, Direction::CToM),
        init_commands: vec![set_notification_flags(), clear_sysmac_error()],
        timeouts: timeouts(),
        esc_presets: EscPresets::default(),
        diag_messages: Vec::new(),
    }
}

/// Time-outs of the master.
pub(crate) fn timeouts() -> Timeouts {
    Timeouts::default()
}

fn mailbox() -> Mailbox {
    let area = |start| MailboxArea { start, length_bytes: layout::MAILBOX_BYTES };
    Mailbox {
        receive: area(layout::MAILBOX_RECEIVE_START),
        send: area(layout::MAILBOX_SEND_START),
        bootstrap: None,
        protocols: MailboxProtocols::COE,
        coe_details: CoeDetails::SDO
            | CoeDetails::SDO_INFO
            | CoeDetails::PDO_ASSIGN
            | CoeDetails::PDO_CONFIG
            | CoeDetails::COMPLETE_ACCESS,
    }
}

fn sync_managers(mapping: &PdoObjects) -> Vec<SyncManager> {
    let limits = Limits::of_model();
    // 1A00 is always assigned, so inputs are never shorter than its 2 bytes.
    let (outputs_bytes, inputs_bytes) = ((0, limits.rxpdo_bytes), (2, limits.txpdo_bytes));
    let default =
        |direction: Direction| u16::try_from(mapping.size_bytes(direction.assignment())).unwrap_or(u16::MAX);
    vec![
        SyncManager {
            control: layout::MAILBOX_RECEIVE_CONTROL,
            ..mailbox_sync_manager(SyncManagerType::MailboxOut, layout::MAILBOX_RECEIVE_START)
        },
        SyncManager {
            control: layout::MAILBOX_SEND_CONTROL,
            ..mailbox_sync_manager(SyncManagerType::MailboxIn, layout::MAILBOX_SEND_START)
        },
        SyncManager {
            start: layout::OUTPUTS_START,
            control: layout::OUTPUTS_CONTROL,
            ..buffered_sync_manager(SyncManagerType::Outputs, default(Direction::MToC), outputs_bytes)
        },
        SyncManager {
            start: layout::INPUTS_START,
            control: layout::INPUTS_CONTROL,
            ..buffered_sync_manager(SyncManagerType::Inputs, default(Direction::CToM), inputs_bytes)
        },
    ]
}

fn mailbox_sync_manager(usage: SyncManagerType, start: u16) -> SyncManager {
    let (default_bytes, max_bytes) = (layout::MAILBOX_BYTES, Some(layout::MAILBOX_BYTES));
    SyncManager { usage, start, default_bytes, min_bytes: None, max_bytes, control: 0, enable: 1 }
}

fn buffered_sync_manager(usage: SyncManagerType, default_bytes: u16, (min, max): (u16, u16)) -> SyncManager {
    let (min_bytes, max_bytes) = (Some(min), Some(max));
    SyncManager { usage, start: 0, default_bytes, min_bytes, max_bytes, control: 0, enable: 1 }
}

/// All PDOs of one direction, ascending by index, those that are not assigned by default included.
fn pdos(table: &ObjectTable, mapping: &PdoObjects, direction: Direction) -> Vec<Pdo> {
    let sync_manager = match direction {
        Direction::MToC => 2,
        Direction::CToM => 3,
    };
    let assigned: Vec<ObjectIndex> = mapping.assigned(direction.assignment()).collect();
    let pdo = |index: ObjectIndex| Pdo {
        index,
        name: table.object(index).map(|object| object.name.clone()).unwrap_or_default(),
        entries: mapping.entries(index).map(|entry| pdo_entry(table, entry)).collect(),
        sync_manager: assigned.contains(&index).then_some(sync_manager),
        fixed: DataSet::of_pdo(index).is_none(),
        mandatory: StatusPdo::all().iter().any(|status| status.index == index && status.mandatory),
    };
    Assignment::of(direction).allowed.iter().copied().map(pdo).collect()
}

fn pdo_entry(table: &ObjectTable, mapped: coe_kit::pdo::PdoEntry) -> PdoEntry {
    let bit_length = u8::try_from(mapped.bit_length).unwrap_or(u8::MAX);
    match table.entry(mapped.index, mapped.sub) {
        Some(entry) => PdoEntry {
            index: mapped.index,
            sub: mapped.sub,
            name: entry.name.clone(),
            data_type: entry.data_type,
            bit_length,
        },
        None => PdoEntry::padding(bit_length),
    }
}

/// The setting parameter of the unit at its default: no emergency messages (manual, 7-8). The manual does not
/// define the transition; this one needs no other rule than the command after it.
fn set_notification_flags() -> InitCommand {
    InitCommand {
        transition: Transition::Ps,
        index: ObjectIndex(0x10F3),
        sub: SubIndex(5),
        data: vec![0, 0],
        comment: "Flags".into(),
    }
}

/// The master clears the Sysmac error status on the way to SAFE-OP (manual, 8-6).
fn clear_sysmac_error() -> InitCommand {
    InitCommand {
        transition: Transition::Ps,
        index: ObjectIndex(0x2002),
        sub: SubIndex(2),
        data: vec![1],
        comment: "Sysmac Error Status Clear".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factory() -> DeviceDescription {
        description(&UnitSettings::default())
    }

    #[test]
    fn the_sync_managers_are_those_of_the_unit() {
        let of_unit = [(0x1000, 400, 0x26), (0x1200, 400, 0x22), (0x13A0, 180, 0x64), (0x21B0, 183, 0x20)];
        let described = factory()
            .sync_managers
            .iter()
            .map(|sm| (sm.start, sm.default_bytes, sm.control))
            .collect::<Vec<_>>();
        assert_eq!(described, of_unit);
    }

    #[test]
    fn every_selectable_pdo_is_described_and_the_default_ones_are_assigned() {
        let description = factory();
        let assigned = |pdos: &[Pdo]| {
            pdos.iter().map(|pdo| (pdo.index.0, pdo.entries.len(), pdo.sync_manager)).collect::<Vec<_>>()
        };
        assert_eq!(
            assigned(&description.rx_pdos),
            [(0x1601, 6, Some(2)), (0x1602, 2, None), (0x1603, 4, None)]
        );
        assert_eq!(
            assigned(&description.tx_pdos),
            [
                (0x1A00, 6, Some(3)),
                (0x1A01, 6, Some(3)),
                (0x1A02, 2, None),
                (0x1A03, 4, None),
                (0x1BFE, 2, Some(3)),
                (0x1BFF, 1, None)
            ]
        );
    }

    #[test]
    fn default_lengths_are_those_of_the_assigned_pdos() {
        let description = factory();
        for (pdos, sync_manager) in [(&description.rx_pdos, 2), (&description.tx_pdos, 3)] {
            let assigned = pdos.iter().filter(|pdo| pdo.sync_manager == Some(sync_manager));
            let bits = assigned.map(Pdo::bit_length).sum::<u32>();
            let described = description.sync_managers[usize::from(sync_manager)].default_bytes;
            assert_eq!(u32::from(described) * 8, bits);
        }
    }

    #[test]
    fn the_written_esi_has_the_commands_of_the_start() {
        let written = esi::xml(&factory(), &crate::object_table());
        let commands: Vec<String> = written
            .split("<InitCmd>")
            .skip(1)
            .filter_map(|rest| rest.split_once("</InitCmd>"))
            .map(|(command, _)| command.split_whitespace().collect())
            .collect();
        let command = |index: &str, sub: &str, data: &str| {
            format!(
                "<Transition>PS</Transition><Index>#x{index}</Index><SubIndex>#x{sub}</SubIndex><Data>{data}</Data>"
            )
        };
        assert_eq!(commands.len(), 2, "{commands:?}");
        assert!(commands[0].starts_with(&command("10F3", "05", "0000")), "{}", commands[0]);
        assert!(commands[1].starts_with(&command("2002", "02", "01")), "{}", commands[1]);
    }

    #[test]
    fn the_eeprom_holds_it_all_and_the_rules_of_the_sii() {
        let image = esi::sii::try_image(&factory()).expect("fits");
        assert_eq!(image.len(), layout::EEPROM_BYTES as usize);
        let findings = esi::sii::lint(&image);
        assert!(findings.is_empty(), "{findings:?}");
    }

    #[test]
    fn the_identity_is_that_of_the_dictionary() {
        let table = object_table();
        let identity = |sub| table.entry(ObjectIndex(0x1018), SubIndex(sub)).expect("exists").default.clone();
        let described = [layout::VENDOR_ID, layout::PRODUCT_CODE, layout::REVISION];
        for (sub, number) in (1..).zip(described) {
            assert_eq!(identity(sub), number.to_le_bytes());
        }
    }

    #[test]
    fn the_description_has_the_pdo_settings_of_the_factory() {
        let described = coe_kit::pdo::PdoSettings::of_description(&factory());
        assert_eq!(described, crate::pdo_settings::factory());
    }
}
