//! Random descriptions of devices, as an ESI file can have them.

use std::collections::BTreeMap;

use esi::{
    CoeDetails, DeviceDescription, DiagMessage, EscPresets, FmmuUsage, GeneralFlags, Group, InitCommand,
    Mailbox, MailboxArea, MailboxProtocols, Pdo, PdoEntry, PortPhysics, SyncManager, SyncManagerType,
    Timeouts, Transition, Vendor,
};
use proptest::collection::{btree_map, vec};
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;
use wire::{ObjectIndex, SubIndex};

use crate::dictionaries::data_type;

/// A text without blanks around it, with characters that XML treats specially.
pub(crate) fn text() -> impl Strategy<Value = String> {
    "[A-Za-z0-9&<>\"'ü€]([ -~ü€]{0,12}[A-Za-z0-9&<>\"'ü€])?"
}

pub(crate) fn description() -> impl Strategy<Value = DeviceDescription> {
    (identity(), controller(), process_data(), option::of(mailbox()), master()).prop_map(
        |(identity, controller, process_data, mailbox, master)| {
            let mut device = DeviceDescription {
                esc_configuration: controller.esc_configuration,
                station_alias: controller.station_alias,
                eeprom_bytes: controller.eeprom_bytes,
                ports: controller.ports,
                ebus_current_ma: controller.ebus_current_ma,
                general_flags: controller.general_flags,
                identification_offset: controller.identification_offset,
                timeouts: master.timeouts,
                esc_presets: master.esc_presets,
                diag_messages: master.diag_messages,
                ..identity
            };
            add_mailbox(&mut device, mailbox, master.init_commands);
            add_process_data(&mut device, process_data);
            device
        },
    )
}

fn identity() -> impl Strategy<Value = DeviceDescription> {
    ([text(), text(), text(), text(), text()], any::<[u32; 4]>()).prop_map(
        |([vendor, group_type, group, order_code, name], [id, product_code, revision, serial])| {
            DeviceDescription {
                vendor: Vendor { id, name: vendor },
                group: Group { group_type, name: group },
                order_code,
                name,
                product_code,
                revision,
                serial,
                ..DeviceDescription::default()
            }
        },
    )
}

fn controller() -> impl Strategy<Value = DeviceDescription> {
    let kinds =
        select(vec![PortPhysics::Mii, PortPhysics::Ebus, PortPhysics::FastHotConnect, PortPhysics::Unused]);
    let ports = [kinds.clone(), kinds.clone(), kinds.clone(), kinds]
        .prop_filter("a device has a port", |ports| ports.iter().any(|port| *port != PortPhysics::Unused));
    (ports, any::<[u16; 4]>(), any::<u16>(), 1_u32..65_536, any::<i16>(), 0_u8..32, any::<u16>()).prop_map(
        |(ports, esc_configuration, station_alias, size, ebus_current_ma, flags, offset)| {
            let general_flags = GeneralFlags::from_bits_truncate(flags);
            let has_offset = general_flags.contains(GeneralFlags::IDENT_PHY_M);
            DeviceDescription {
                ports,
                esc_configuration,
                station_alias,
                eeprom_bytes: 128 * size,
                ebus_current_ma,
                general_flags,
                identification_offset: if has_offset { offset } else { 0 },
                ..DeviceDescription::default()
            }
        },
    )
}

fn master() -> impl Strategy<Value = DeviceDescription> {
    let command = (select(Transition::ALL.to_vec()), any::<(u16, u8)>(), vec(any::<u8>(), 0..9), text())
        .prop_map(|(transition, (index, sub), data, comment)| InitCommand {
            transition,
            index: ObjectIndex(index),
            sub: SubIndex(sub),
            data,
            comment,
        });
    let message = (any::<u16>(), text()).prop_map(|(text_id, text)| DiagMessage { text_id, text });
    (any::<[u32; 6]>(), any::<[Option<u16>; 4]>(), vec(command, 0..4), vec(message, 0..3)).prop_map(
        |([a, b, c, d, e, f], [g, h, i, j], init_commands, diag_messages)| DeviceDescription {
            timeouts: Timeouts {
                pre_op_ms: a,
                safe_op_op_ms: b,
                back_to_init_ms: c,
                back_to_safe_op_ms: d,
                mailbox_request_ms: e,
                mailbox_response_ms: f,
            },
            esc_presets: EscPresets {
                read_write_offset: g,
                watchdog_divider: h,
                pdi_watchdog: i,
                process_data_watchdog: j,
            },
            init_commands,
            diag_messages,
            ..DeviceDescription::default()
        },
    )
}

fn mailbox() -> impl Strategy<Value = Mailbox> {
    let area = || any::<(u16, u16)>().prop_map(|(start, length_bytes)| MailboxArea { start, length_bytes });
    (area(), area(), option::of((area(), area())), 0_u16..64, 0_u8..64).prop_map(
        |(receive, send, bootstrap, protocols, details)| Mailbox {
            receive,
            send,
            bootstrap,
            protocols: MailboxProtocols::from_bits_truncate(protocols) | MailboxProtocols::COE,
            coe_details: CoeDetails::from_bits_truncate(details) | CoeDetails::SDO,
        },
    )
}

/// What a device without a mailbox cannot have is removed.
fn add_mailbox(device: &mut DeviceDescription, mailbox: Option<Mailbox>, init_commands: Vec<InitCommand>) {
    match &mailbox {
        Some(mailbox) => {
            let areas = [
                (SyncManagerType::MailboxOut, mailbox.receive, 0x26),
                (SyncManagerType::MailboxIn, mailbox.send, 0x22),
            ];
            let sync_manager = |(usage, area, control)| sync_manager(usage, area, control, [None; 2], 1);
            device.sync_managers = areas.map(sync_manager).to_vec();
            device.init_commands = init_commands;
        }
        None => {
            device.general_flags.remove(GeneralFlags::MAILBOX_DATA_LINK_LAYER);
            device.timeouts.mailbox_request_ms = Timeouts::USUAL.mailbox_request_ms;
            device.timeouts.mailbox_response_ms = Timeouts::USUAL.mailbox_response_ms;
        }
    }
    device.mailbox = mailbox;
}

fn sync_manager(
    usage: SyncManagerType,
    area: MailboxArea,
    control: u8,
    [min_bytes, max_bytes]: [Option<u16>; 2],
    enable: u8,
) -> SyncManager {
    let MailboxArea { start, length_bytes: default_bytes } = area;
    SyncManager { usage, start, default_bytes, min_bytes, max_bytes, control, enable }
}

/// SyncManagers with their PDOs, and PDOs that are assigned to none of them.
#[derive(Debug)]
struct ProcessData {
    areas: Vec<(bool, SyncManager)>,
    rx_pdos: BTreeMap<u16, (Pdo, bool)>,
    tx_pdos: BTreeMap<u16, (Pdo, bool)>,
    fmmus: Vec<FmmuUsage>,
}

fn process_data() -> impl Strategy<Value = ProcessData> {
    let area =
        (any::<bool>(), any::<(u16, u16)>(), any::<[Option<u16>; 2]>(), select(vec![0_u8, 1, 4, 5, 8, 9]))
            .prop_map(|(is_output, (start, length_bytes), limits, enable)| {
                let (usage, control) = if is_output {
                    (SyncManagerType::Outputs, 0x64)
                } else {
                    (SyncManagerType::Inputs, 0x20)
                };
                (is_output, sync_manager(usage, MailboxArea { start, length_bytes }, control, limits, enable))
            });
    let usage =
        select(vec![FmmuUsage::Outputs, FmmuUsage::Inputs, FmmuUsage::MailboxState, FmmuUsage::Unused]);
    let pdos = |first: u16| btree_map(first..first + 0x200, (pdo(), any::<bool>()), 0..4);
    (vec(area, 0..4), pdos(0x1600), pdos(0x1A00), vec(usage, 1..5))
        .prop_map(|(areas, rx_pdos, tx_pdos, fmmus)| ProcessData { areas, rx_pdos, tx_pdos, fmmus })
}

fn add_process_data(device: &mut DeviceDescription, process_data: ProcessData) {
    let first = device.sync_managers.len() as u8;
    let ProcessData { areas, rx_pdos, tx_pdos, fmmus } = process_data;
    let of_direction = |is_output: bool| {
        let found = areas.iter().zip(first..).find(|((output, _), _)| *output == is_output);
        found.map(|(_, number)| number)
    };
    let pdos = |pdos: BTreeMap<u16, (Pdo, bool)>, sync_manager: Option<u8>| -> Vec<Pdo> {
        let pdo = |(index, (pdo, is_assigned)): (u16, (Pdo, bool))| Pdo {
            index: ObjectIndex(index),
            sync_manager: sync_manager.filter(|_| is_assigned),
            ..pdo
        };
        pdos.into_iter().map(pdo).collect()
    };
    device.rx_pdos = pdos(rx_pdos, of_direction(true));
    device.tx_pdos = pdos(tx_pdos, of_direction(false));
    device.sync_managers.extend(areas.into_iter().map(|(_, area)| area));
    device.fmmus = fmmus;
}

fn pdo() -> impl Strategy<Value = Pdo> {
    (text(), vec(entry(), 0..5), any::<[bool; 2]>()).prop_map(|(name, entries, [fixed, mandatory])| Pdo {
        index: ObjectIndex(0),
        name,
        entries,
        sync_manager: None,
        fixed,
        mandatory,
    })
}

fn entry() -> impl Strategy<Value = PdoEntry> {
    let contents = (1_u16.., any::<u8>(), text(), data_type()).prop_filter_map(
        "longer than the SII can say",
        |(index, sub, name, (data_type, bits))| {
            let (index, sub, bit_length) = (ObjectIndex(index), SubIndex(sub), u8::try_from(bits).ok()?);
            Some(PdoEntry { index, sub, name, data_type, bit_length })
        },
    );
    prop_oneof![contents, (1_u8..).prop_map(PdoEntry::padding)]
}
