//! The device in the tests of this crate.

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use wire::{DataType, ObjectIndex, SubIndex};

use crate::*;

/// A description in which every field has a value.
pub(crate) fn small_device() -> DeviceDescription {
    let sync_manager = |usage, start, default_bytes, control| SyncManager {
        usage,
        start,
        default_bytes,
        min_bytes: None,
        max_bytes: None,
        control,
        enable: 1,
    };
    DeviceDescription {
        vendor: Vendor { id: 0x83, name: "Example & Sons".into() },
        group: Group { group_type: "Mini".into(), name: "Mini devices".into() },
        order_code: "MINI-1".into(),
        name: "Small device".into(),
        product_code: 0x1234,
        revision: 0x10000,
        serial: 0,
        ports: [PortPhysics::Mii, PortPhysics::Ebus, PortPhysics::Unused, PortPhysics::Unused],
        esc_configuration: [0x0E80, 0xCC00, 0x1388, 0x00FF],
        station_alias: 0x0102,
        eeprom_bytes: 2048,
        mailbox: Some(Mailbox {
            receive: MailboxArea { start: 0x1000, length_bytes: 128 },
            send: MailboxArea { start: 0x1080, length_bytes: 128 },
            bootstrap: None,
            protocols: MailboxProtocols::COE,
            coe_details: CoeDetails::SDO | CoeDetails::SDO_INFO | CoeDetails::COMPLETE_ACCESS,
        }),
        general_flags: GeneralFlags::IDENT_AL_STATUS | GeneralFlags::IDENT_PHY_M,
        identification_offset: 0x0012,
        ebus_current_ma: -100,
        fmmus: vec![FmmuUsage::Outputs, FmmuUsage::Inputs, FmmuUsage::MailboxState],
        sync_managers: vec![
            sync_manager(SyncManagerType::MailboxOut, 0x1000, 128, 0x26),
            sync_manager(SyncManagerType::MailboxIn, 0x1080, 128, 0x22),
            SyncManager {
                min_bytes: Some(0),
                max_bytes: Some(8),
                ..sync_manager(SyncManagerType::Outputs, 0x1100, 2, 0x64)
            },
            sync_manager(SyncManagerType::Inputs, 0x1400, 2, 0x20),
        ],
        rx_pdos: vec![pdo(
            0x1600,
            "Outputs",
            Some(2),
            vec![entry(0x7000, 1, "Speed", DataType::UNSIGNED16, 16)],
        )],
        tx_pdos: vec![
            Pdo {
                fixed: true,
                mandatory: true,
                ..pdo(
                    0x1A00,
                    "Status",
                    Some(3),
                    vec![entry(0x6000, 1, "Ready", DataType::BOOLEAN, 1), PdoEntry::padding(15)],
                )
            },
            pdo(0x1A01, "More", None, vec![entry(0x6000, 2, "Level", DataType::UNSIGNED8, 8)]),
        ],
        init_commands: vec![InitCommand {
            transition: Transition::Ps,
            index: ObjectIndex(0x2000),
            sub: SubIndex(2),
            data: vec![1, 0xAB],
            comment: "clear".into(),
        }],
        timeouts: Timeouts::default(),
        esc_presets: EscPresets { watchdog_divider: Some(2498), ..EscPresets::default() },
        diag_messages: vec![DiagMessage { text_id: 0x0100, text: "speed %d".into() }],
    }
}

fn pdo(index: u16, name: &str, sync_manager: Option<u8>, entries: Vec<PdoEntry>) -> Pdo {
    Pdo {
        index: ObjectIndex(index),
        name: name.into(),
        entries,
        sync_manager,
        fixed: false,
        mandatory: false,
    }
}

fn entry(index: u16, sub: u8, name: &str, data_type: DataType, bit_length: u8) -> PdoEntry {
    PdoEntry { index: ObjectIndex(index), sub: SubIndex(sub), name: name.into(), data_type, bit_length }
}

/// A table with a variable, records, arrays, a gap, single bits and restricted rights.
pub(crate) fn small_table() -> ObjectTable {
    let state = AccessRights::READ | AccessRights::WRITE_PRE_OP | AccessRights::SETTING;
    let text = item(0, "Name", DataType::VISIBLE_STRING, 48, AccessRights::READ, b"MINI-1");
    let identity = vec![
        zero(4),
        item(1, "Vendor ID", DataType::UNSIGNED32, 32, AccessRights::READ, &[0x83, 0, 0, 0]),
        item(4, "Serial", DataType::UNSIGNED32, 32, AccessRights::READ, &[]),
    ];
    let status = vec![
        zero(3),
        item(1, "Ready", DataType::BOOLEAN, 1, AccessRights::READ | AccessRights::TX_PDO, &[0]),
        item(2, "Busy", DataType::BOOLEAN, 1, AccessRights::READ | AccessRights::TX_PDO, &[0]),
        item(3, "Level", DataType::UNSIGNED8, 8, AccessRights::WRITE_OP | AccessRights::RX_PDO, &[7]),
    ];
    let words = |sub, name| item(sub, name, DataType::UNICODE_STRING, 240, state, &[0; 30]);
    let words = vec![zero(2), words(1, "Words 01"), words(2, "Words 02")];
    let mixed = vec![
        zero(2),
        item(1, "Open", DataType::OCTET_STRING, 96, AccessRights::READ, &[]),
        item(2, "Closed", DataType::OCTET_STRING, 96, AccessRights::READ_OP | AccessRights::BACKUP, &[]),
    ];
    ObjectTable::new(vec![
        object(0x1008, "Device name", ObjectCode::Variable, DataType::VISIBLE_STRING, vec![text]),
        object(0x1018, "Identity", ObjectCode::Record, DataType::IDENTITY, identity),
        object(0x2000, "Status", ObjectCode::Record, DataType(0x0800), status),
        object(0x6000, "Words", ObjectCode::Array, DataType::UNICODE_STRING, words),
        object(0x6001, "Mixed", ObjectCode::Array, DataType::OCTET_STRING, mixed),
    ])
}

fn object(index: u16, name: &str, code: ObjectCode, data_type: DataType, entries: Vec<Entry>) -> Object {
    let complete_access = code == ObjectCode::Record;
    Object { index: ObjectIndex(index), name: name.into(), code, data_type, complete_access, entries }
}

fn zero(count: u8) -> Entry {
    item(0, "Number of entries", DataType::UNSIGNED8, 8, AccessRights::READ, &[count])
}

fn item(
    sub: u8,
    name: &str,
    data_type: DataType,
    bit_length: u16,
    access: AccessRights,
    default: &[u8],
) -> Entry {
    Entry {
        sub: SubIndex(sub),
        name: name.into(),
        data_type,
        bit_length,
        access,
        default: default.into(),
        limits: vec![],
    }
}
