//! From the contents of an EEPROM to the description of its device, as far as an EEPROM has it.

use super::contents::{General, PdoContents, PdoEntryContents, SiiContents, SyncManagerContents};
use super::layout;
use crate::{
    DeviceDescription, FmmuUsage, Group, Mailbox, MailboxArea, MailboxProtocols, Pdo, PdoEntry, PortPhysics,
    SyncManager, Vendor,
};

impl SiiContents {
    /// The description of the device. An EEPROM has no name of the vendor, no time-outs, no init commands and no
    /// dictionary; texts that do not exist are empty.
    #[must_use]
    pub fn description(&self) -> DeviceDescription {
        let header = &self.header;
        let general = self.general.as_ref();
        let text = |number: fn(&General) -> u8| self.text(general.map_or(0, number));
        let group = text(|general| general.group);
        let [a, b, c, d, e, f, g, h, alias_low, alias_high, ..] = header.configuration;
        DeviceDescription {
            vendor: Vendor { id: header.vendor_id, name: String::new() },
            group: Group { group_type: group.clone(), name: group },
            order_code: text(|general| general.order_code),
            name: text(|general| general.name),
            product_code: header.product_code,
            revision: header.revision,
            serial: header.serial,
            ports: general.map_or([PortPhysics::Unused; 4], |general| general.ports),
            esc_configuration: [[a, b], [c, d], [e, f], [g, h]].map(u16::from_le_bytes),
            station_alias: u16::from_le_bytes([alias_low, alias_high]),
            eeprom_bytes: header.size_bytes(),
            mailbox: self.mailbox(),
            general_flags: general.map(|general| general.flags).unwrap_or_default(),
            identification_offset: general.map_or(0, |general| general.identification_offset),
            ebus_current_ma: general.map_or(0, |general| general.ebus_current_ma),
            fmmus: self.fmmu_usages(),
            sync_managers: self.sync_managers.iter().map(sync_manager).collect(),
            rx_pdos: self.rx_pdos.iter().map(|pdo| self.pdo(pdo)).collect(),
            tx_pdos: self.tx_pdos.iter().map(|pdo| self.pdo(pdo)).collect(),
            ..DeviceDescription::default()
        }
    }

    fn text(&self, number: u8) -> String {
        self.string(number).unwrap_or_default().to_owned()
    }

    fn mailbox(&self) -> Option<Mailbox> {
        let header = &self.header;
        let bootstrap = (header.bootstrap_receive, header.bootstrap_send);
        let has_bootstrap = bootstrap != (MailboxArea::default(), MailboxArea::default());
        let is_there = header.receive.length_bytes > 0 || header.protocols != MailboxProtocols::empty();
        is_there.then(|| Mailbox {
            receive: header.receive,
            send: header.send,
            bootstrap: has_bootstrap.then_some(bootstrap),
            protocols: header.protocols,
            coe_details: self.general.as_ref().map(|general| general.coe_details).unwrap_or_default(),
        })
    }

    /// The FMMUs without the padding to a whole word at the end.
    fn fmmu_usages(&self) -> Vec<FmmuUsage> {
        let used =
            self.fmmus.iter().rposition(|usage| *usage != FmmuUsage::Unused).map_or(0, |last| last + 1);
        self.fmmus.iter().take(used).copied().collect()
    }

    fn pdo(&self, contents: &PdoContents) -> Pdo {
        Pdo {
            index: contents.index,
            name: self.text(contents.name),
            entries: contents.entries.iter().map(|entry| self.pdo_entry(entry)).collect(),
            sync_manager: contents.sync_manager,
            fixed: contents.flags & layout::PDO_FIXED != 0,
            mandatory: contents.flags & layout::PDO_MANDATORY != 0,
        }
    }

    fn pdo_entry(&self, contents: &PdoEntryContents) -> PdoEntry {
        let PdoEntryContents { index, sub, name, data_type, bit_length } = *contents;
        PdoEntry { index, sub, name: self.text(name), data_type, bit_length }
    }
}

fn sync_manager(contents: &SyncManagerContents) -> SyncManager {
    let SyncManagerContents { start, length_bytes, control, enable, usage } = *contents;
    SyncManager {
        usage,
        start,
        default_bytes: length_bytes,
        min_bytes: None,
        max_bytes: None,
        control,
        enable,
    }
}
