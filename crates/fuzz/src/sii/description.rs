//! Descriptions of any device.

use esi::{
    CoeDetails, DeviceDescription, FmmuUsage, GeneralFlags, Mailbox, MailboxArea, MailboxProtocols, Pdo,
    PdoEntry, PortPhysics, SyncManager, SyncManagerType,
};
use wire::{DataType, ObjectIndex, SubIndex};

use crate::random::Random;

/// Text lengths up to the longest that an EEPROM accepts, and one that it does not.
const TEXT_CHARACTERS: [usize; 6] = [0, 1, 12, 60, 255, 256];

/// A description that usually fits into its EEPROM.
pub(super) fn any(random: &mut Random) -> DeviceDescription {
    let mut description = nx_ect101::description(&nx_ect101::UnitSettings::default());
    description.vendor.id = random.number() as u32;
    description.product_code = random.number() as u32;
    description.revision = random.number() as u32;
    description.serial = random.number() as u32;
    description.name = text(random);
    description.order_code = text(random);
    description.group.group_type = text(random);
    description.ports = [(); 4].map(|()| PortPhysics::from_bits(random.byte() & 0x0F));
    description.esc_configuration = [(); 4].map(|()| random.word());
    description.station_alias = random.word();
    description.eeprom_bytes = 128 * random.between(1, 128) as u32;
    description.mailbox = if random.once_in(3) { None } else { Some(mailbox(random)) };
    description.general_flags = GeneralFlags::from_bits_truncate(random.byte());
    description.ebus_current_ma = random.word() as i16;
    description.fmmus = (0..random.below(9)).map(|_| FmmuUsage::from_code(random.byte())).collect();
    description.sync_managers = (0..random.below(9)).map(|_| sync_manager(random)).collect();
    description.rx_pdos = pdos(0x1600, random);
    description.tx_pdos = pdos(0x1A00, random);
    description
}

fn text(random: &mut Random) -> String {
    let length = *random.one_of(&TEXT_CHARACTERS);
    let length = if random.once_in(20) { length } else { length.min(60) };
    (0..length)
        .map(|_| if random.once_in(20) { 'ü' } else { char::from(b' ' + random.byte() % 95) })
        .collect()
}

fn area(random: &mut Random) -> MailboxArea {
    MailboxArea { start: random.word(), length_bytes: random.word() }
}

fn mailbox(random: &mut Random) -> Mailbox {
    Mailbox {
        receive: area(random),
        send: area(random),
        bootstrap: if random.once_in(2) { Some((area(random), area(random))) } else { None },
        protocols: MailboxProtocols::from_bits_retain(random.word()),
        coe_details: CoeDetails::from_bits_retain(random.byte()),
    }
}

fn sync_manager(random: &mut Random) -> SyncManager {
    SyncManager {
        usage: SyncManagerType::from_code(random.byte()),
        start: random.word(),
        default_bytes: random.word(),
        min_bytes: None,
        max_bytes: None,
        control: random.byte(),
        enable: random.byte(),
    }
}

fn pdos(first: u16, random: &mut Random) -> Vec<Pdo> {
    let count = *random.one_of(&[0, 1, 2, 3, 10]);
    let pdo = |number: u16| Pdo {
        index: ObjectIndex(first + number),
        name: text(random),
        entries: {
            let count = *random.one_of(&[0, 1, 2, 8, 40, 255]);
            (0..count).map(|_| entry(random)).collect()
        },
        sync_manager: if random.once_in(3) { None } else { Some(random.byte()) },
        fixed: random.once_in(2),
        mandatory: random.once_in(2),
    };
    (0..count).map(pdo).collect()
}

fn entry(random: &mut Random) -> PdoEntry {
    if random.once_in(5) {
        return PdoEntry::padding(random.byte());
    }
    PdoEntry {
        index: ObjectIndex(random.word()),
        sub: SubIndex(random.byte()),
        // Texts are numbered up to 255: most names occur again.
        name: if random.once_in(10) { text(random) } else { format!("Entry {}", random.below(20)) },
        data_type: DataType(random.word()),
        bit_length: random.byte(),
    }
}
