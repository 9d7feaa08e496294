//! From a device of a file to the description from which SII and ESI are made.

use objects::ObjectTable;
use wire::{DataType, SubIndex};

use super::objects::table;
use crate::file::{
    DeviceElement, EepromElement, EntryElement, InitCommandElement, MailboxElement, PdoElement,
    SyncManagerElement,
};
use crate::{
    CoeDetails, DeviceDescription, FmmuUsage, GeneralFlags, Group, InitCommand, Mailbox, MailboxArea, Pdo,
    PdoEntry, PortPhysics, SyncManager, SyncManagerType, type_names,
};

/// Size of the EEPROM of a device that does not indicate it.
const EEPROM_BYTES: u32 = 2_048;
/// Longest entry of a PDO in the SII; whole bytes.
const ENTRY_BITS_MAX: u8 = 248;
/// SII word 0 of a device that does not indicate it: an on-chip bus to a processor.
const ON_CHIP_BUS: u16 = 0x0080;
/// The same without a processor: digital I/O, and the controller follows every request.
const DIGITAL_IO: u16 = 0x0104;

impl DeviceElement {
    /// The description: everything that SII and ESI have in common. What the file leaves out has the usual value.
    #[must_use]
    pub fn description(&self) -> DeviceDescription {
        let device_type = &self.device_type;
        let eeprom = self.eeprom.as_ref();
        let (esc_configuration, station_alias) = self.configuration();
        DeviceDescription {
            vendor: (*self.vendor).clone(),
            group: self.group.as_deref().cloned().unwrap_or_else(|| Group {
                group_type: self.group_type.clone(),
                name: self.group_type.clone(),
            }),
            order_code: device_type.order_code.clone(),
            name: self.name.clone(),
            product_code: device_type.product_code.unwrap_or(0),
            revision: device_type.revision.unwrap_or(0),
            serial: device_type.serial,
            ports: self.ports(),
            esc_configuration,
            station_alias,
            eeprom_bytes: eeprom.and_then(|eeprom| eeprom.size_bytes).unwrap_or(EEPROM_BYTES),
            mailbox: self.mailbox.as_ref().map(|mailbox| self.mailbox_of(mailbox)),
            general_flags: self.general_flags(),
            identification_offset: self.info.identification_offset.unwrap_or(0),
            ebus_current_ma: self.info.ebus_current_ma.unwrap_or(0),
            fmmus: self.fmmu_usages(),
            sync_managers: self
                .sync_managers
                .iter()
                .zip(0..)
                .map(|(element, at)| self.sync_manager(element, at))
                .collect(),
            rx_pdos: self.rx_pdos.iter().map(pdo).collect(),
            tx_pdos: self.tx_pdos.iter().map(pdo).collect(),
            init_commands: self.init_commands(),
            timeouts: self.info.timeouts,
            esc_presets: self.esc_presets,
            diag_messages: self.profiles.iter().flat_map(|profile| profile.diag_messages.clone()).collect(),
        }
    }

    /// The objects of its dictionaries. Without a dictionary the table is empty.
    #[must_use]
    pub fn objects(&self) -> ObjectTable {
        table(
            self.profiles.iter().filter_map(|profile| profile.dictionary.as_deref()),
            self.has_complete_access(),
        )
    }

    /// Whether complete access is permitted to objects that say nothing else.
    pub(crate) fn has_complete_access(&self) -> bool {
        let coe = self.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref());
        coe.is_some_and(|coe| coe.details.contains(CoeDetails::COMPLETE_ACCESS))
    }

    /// Its ports; without `Physics`, two for cables, or two for a backplane if it draws its current from there.
    #[must_use]
    pub fn ports(&self) -> [PortPhysics; 4] {
        let usual = match self.info.ebus_current_ma {
            Some(_) => PortPhysics::Ebus,
            None => PortPhysics::Mii,
        };
        self.physics.unwrap_or([usual, usual, PortPhysics::Unused, PortPhysics::Unused])
    }

    /// The purpose of a SyncManager. The PDOs that are assigned to it go first, then its text, then its control byte.
    #[must_use]
    pub fn usage(&self, number: u8) -> SyncManagerType {
        let Some(element) = self.sync_managers.get(usize::from(number)) else {
            return SyncManagerType::Unused;
        };
        let has = |pdos: &[PdoElement]| pdos.iter().any(|pdo| pdo.sync_manager == Some(number));
        match (has(&self.rx_pdos), has(&self.tx_pdos)) {
            (true, false) => SyncManagerType::Outputs,
            (false, true) => SyncManagerType::Inputs,
            _ => element.named_usage.unwrap_or_else(|| self.usage_by_control(element, number)),
        }
    }

    fn usage_by_control(&self, element: &SyncManagerElement, number: u8) -> SyncManagerType {
        let is_mailbox = self.mailbox.is_some() && number < 2 && element.has_one_buffer();
        match (element.master_writes(), is_mailbox) {
            (Some(true), true) => SyncManagerType::MailboxOut,
            (Some(false), true) => SyncManagerType::MailboxIn,
            (Some(true), false) => SyncManagerType::Outputs,
            (Some(false), false) => SyncManagerType::Inputs,
            (None, _) => SyncManagerType::Unused,
        }
    }

    /// The purposes of the FMMUs; without elements, one for each SyncManager of process data.
    fn fmmu_usages(&self) -> Vec<FmmuUsage> {
        if !self.fmmus.is_empty() {
            return self.fmmus.iter().map(|fmmu| fmmu.usage).collect();
        }
        let usages = self.sync_managers.iter().zip(0..).map(|(_, number)| self.usage(number));
        let fmmu = |usage| match usage {
            SyncManagerType::Outputs => Some(FmmuUsage::Outputs),
            SyncManagerType::Inputs => Some(FmmuUsage::Inputs),
            _ => None,
        };
        usages.filter_map(fmmu).collect()
    }

    fn sync_manager(&self, element: &SyncManagerElement, number: u8) -> SyncManager {
        SyncManager {
            usage: self.usage(number),
            start: element.start.unwrap_or(0),
            default_bytes: element.default_bytes.unwrap_or(0),
            min_bytes: element.min_bytes,
            max_bytes: element.max_bytes,
            control: element.control.unwrap_or(0),
            enable: element.enable_byte(),
        }
    }

    /// The length of a SyncManager unless a master sets another one: that of the mailbox, or of the PDOs that are
    /// assigned by default.
    #[must_use]
    pub fn default_pdo_bytes(&self, number: u8) -> u32 {
        let assigned = self.pdos().filter(|pdo| pdo.sync_manager == Some(number));
        assigned.map(PdoElement::bit_length).sum::<u32>().div_ceil(8)
    }

    /// Words 0 to 3 and word 4 of the SII.
    fn configuration(&self) -> ([u16; 4], u16) {
        let given = self.eeprom.as_ref().and_then(|eeprom| eeprom.configuration.as_deref());
        let Some(given) = given else {
            let word_0 = if self.mailbox.is_some() { ON_CHIP_BUS } else { DIGITAL_IO };
            return ([word_0, 0, 0, 0], 0);
        };
        let mut bytes = [0; 10];
        for (byte, given) in bytes.iter_mut().zip(given) {
            *byte = *given;
        }
        let [a, b, c, d, e] = [0, 2, 4, 6, 8].map(|at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]));
        ([a, b, c, d], e)
    }

    fn general_flags(&self) -> GeneralFlags {
        let layer = self.mailbox.as_ref().is_some_and(|mailbox| mailbox.data_link_layer);
        let rows = [
            (self.device_type.safe_op_in_configuration_mode, GeneralFlags::ENABLE_SAFE_OP),
            (self.info.safe_op_without_sync, GeneralFlags::ENABLE_SAFE_OP),
            (self.device_type.use_lrd_lwr, GeneralFlags::ENABLE_NOT_LRW),
            (layer, GeneralFlags::MAILBOX_DATA_LINK_LAYER),
            (self.info.identification_in_al_status, GeneralFlags::IDENT_AL_STATUS),
            (self.info.identification_offset.is_some(), GeneralFlags::IDENT_PHY_M),
        ];
        rows.into_iter().filter(|(set, _)| *set).map(|(_, flag)| flag).collect()
    }

    fn mailbox_of(&self, mailbox: &MailboxElement) -> Mailbox {
        let area = |usage| {
            let numbered = self.sync_managers.iter().zip(0..);
            let found = numbered
                .filter(|(_, number)| self.usage(*number) == usage)
                .map(|(element, _)| element)
                .next();
            let start = found.and_then(|element| element.start).unwrap_or(0);
            MailboxArea { start, length_bytes: found.and_then(|element| element.default_bytes).unwrap_or(0) }
        };
        Mailbox {
            receive: area(SyncManagerType::MailboxOut),
            send: area(SyncManagerType::MailboxIn),
            bootstrap: self.eeprom.as_ref().and_then(EepromElement::bootstrap_areas),
            protocols: mailbox.protocols,
            coe_details: mailbox.coe.as_ref().map(|coe| coe.details).unwrap_or_default(),
        }
    }

    fn init_commands(&self) -> Vec<InitCommand> {
        let coe = self.mailbox.as_ref().and_then(|mailbox| mailbox.coe.as_ref());
        coe.iter().flat_map(|coe| &coe.init_commands).flat_map(init_commands).collect()
    }
}

impl EepromElement {
    /// The mailbox areas in BOOT: receive, then send.
    #[must_use]
    pub fn bootstrap_areas(&self) -> Option<(MailboxArea, MailboxArea)> {
        let [a, b, c, d, e, f, g, h] = *self.bootstrap.as_deref()? else { return None };
        let area = |start, length| MailboxArea {
            start: u16::from_le_bytes(start),
            length_bytes: u16::from_le_bytes(length),
        };
        Some((area([a, b], [c, d]), area([e, f], [g, h])))
    }
}

fn init_commands(element: &InitCommandElement) -> impl Iterator<Item = InitCommand> {
    element.transitions.iter().map(|transition| InitCommand {
        transition: *transition,
        index: element.index,
        sub: element.sub,
        data: element.data.clone(),
        comment: element.comment.clone(),
    })
}

fn pdo(element: &PdoElement) -> Pdo {
    Pdo {
        index: element.index.index,
        name: element.name.clone(),
        entries: element.entries.iter().flat_map(pdo_entries).collect(),
        sync_manager: element.sync_manager,
        fixed: element.fixed,
        mandatory: element.mandatory,
    }
}

/// The entry, in parts if it is longer than the SII can say.
fn pdo_entries(element: &EntryElement) -> impl Iterator<Item = PdoEntry> {
    let mut rest = element.bit_length;
    core::iter::from_fn(move || {
        let bit_length = u8::try_from(rest).unwrap_or(ENTRY_BITS_MAX);
        rest -= u16::from(bit_length);
        (bit_length > 0).then(|| pdo_entry(element, bit_length))
    })
}

fn pdo_entry(element: &EntryElement, bit_length: u8) -> PdoEntry {
    if element.is_padding() {
        return PdoEntry::padding(bit_length);
    }
    PdoEntry {
        index: element.index.index,
        sub: SubIndex(element.sub.unwrap_or(0)),
        name: element.name.clone(),
        data_type: pdo_entry_type(element).map_or(DataType::NONE, |(data_type, _)| data_type),
        bit_length,
    }
}

/// The type of an entry by its name, and its bits; none if the standard has no such name.
pub(crate) fn pdo_entry_type(element: &EntryElement) -> Option<(DataType, u32)> {
    type_names::parse(&element.type_name)
}
