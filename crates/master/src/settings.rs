//! The settings of a slave on its way up: from its SII, from its description, or from the caller.

use esi::sii::SiiContents;
use esi::{
    CoeDetails, DeviceDescription, FmmuUsage, GeneralFlags, Mailbox, MailboxArea, MailboxProtocols,
    SyncManagerType, Timeouts, Transition,
};
use wire::SdoTarget;

use crate::channels::SyncManagerSettings;
use crate::registers;

/// All settings that a master writes to one slave. All of them may be changed before they are written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SlaveSettings {
    /// The mailbox; none for a slave without one.
    pub mailbox: Option<MailboxSettings>,
    /// Process data, one area for each SyncManager with process data.
    pub process_data: Vec<ProcessDataArea>,
    /// Registers that are written on the way up, before the state of the transition is requested.
    pub registers: Vec<RegisterSetting>,
    /// SDOs that are written on the way up, in this order: those of IP when PRE-OP is reached, those of PS and
    /// SO before SAFE-OP and OP are requested.
    pub start_up: Vec<StartUpSdo>,
    /// Time-outs for the slave.
    pub timeouts: Timeouts,
    /// The slave requires LRD and LWR instead of LRW.
    pub separate_commands: bool,
    /// The FMMUs of the slave map whole bytes only.
    pub bytewise_fmmus: bool,
    /// Where the slave shows its Explicit Device ID.
    pub device_id: DeviceIdSource,
}

/// The mailbox of a slave.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MailboxSettings {
    /// From master to slave.
    pub out: SyncManagerSettings,
    /// From slave to master.
    pub inward: SyncManagerSettings,
    /// Both in BOOT; none for a slave without BOOT.
    pub bootstrap: Option<(MailboxArea, MailboxArea)>,
    /// The protocols.
    pub protocols: MailboxProtocols,
    /// The services of CoE.
    pub coe_details: CoeDetails,
}

impl MailboxSettings {
    /// Both SyncManagers in BOOT; none for a slave without BOOT.
    #[must_use]
    pub fn in_boot(&self) -> Option<(SyncManagerSettings, SyncManagerSettings)> {
        let (receive, send) = self.bootstrap?;
        let at = |settings: SyncManagerSettings, area| {
            SyncManagerSettings::mailbox(settings.number, area, settings.control)
        };
        Some((at(self.out, receive), at(self.inward, send)))
    }
}

/// The direction of process data, seen from the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From master to slave.
    Outputs,
    /// From slave to master.
    Inputs,
}

impl Direction {
    /// The type byte of an FMMU that maps process data of this direction: bit 0 reads, bit 1 writes.
    #[must_use]
    pub const fn fmmu_kind(self) -> u8 {
        match self {
            Self::Inputs => 1,
            Self::Outputs => 2,
        }
    }
}

/// Process data of one SyncManager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProcessDataArea {
    /// Their direction.
    pub direction: Direction,
    /// Their number of bits. The length of the SyncManager is a separate setting, which may be wrong.
    pub bits: u32,
    /// Its SyncManager.
    pub sync_manager: SyncManagerSettings,
    /// The FMMU that maps them.
    pub fmmu: u8,
}

/// A register that is written on the way up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegisterSetting {
    /// Before the state of this transition is requested.
    pub transition: Transition,
    /// Its offset.
    pub offset: u16,
    /// The bytes.
    pub data: Vec<u8>,
}

/// An SDO that is written on the way up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StartUpSdo {
    /// The transition: IP, PS or SO.
    pub transition: Transition,
    /// The target.
    pub target: SdoTarget,
    /// The value.
    pub data: Vec<u8>,
}

/// Where a slave shows its Explicit Device ID (reference 5.7).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceIdSource {
    /// Only in the configured station alias.
    #[default]
    StationAlias,
    /// In the AL status code, when AL control bit 5 requests it.
    AlStatusCode,
    /// In the word at this register.
    Register(u16),
}

/// A SyncManager, as in SII and description.
struct Channel {
    number: u8,
    usage: SyncManagerType,
    start: u16,
    default_bytes: u16,
    control: u8,
    enable: u8,
}

/// Maximum number of SyncManagers of a controller: further ones in an SII or a description have no registers
/// (reference 2.1).
const SYNC_MANAGERS_MAX: u8 = 16;

/// Enable bit 2 of SII and ESI: a SyncManager that does not exist in the controller.
const VIRTUAL: u8 = 0x04;

impl SlaveSettings {
    /// The settings in the SII: mailbox, SyncManagers, and the PDOs that are assigned by default.
    #[must_use]
    pub fn from_sii(sii: &SiiContents) -> Self {
        let general = sii.general.as_ref();
        let flags = general.map_or(GeneralFlags::empty(), |general| general.flags);
        let channels = (0..SYNC_MANAGERS_MAX).zip(&sii.sync_managers).map(|(number, sm)| Channel {
            number,
            usage: sm.usage,
            start: sm.start,
            default_bytes: sm.length_bytes,
            control: sm.control,
            enable: sm.enable,
        });
        let pdos = sii.rx_pdos.iter().chain(&sii.tx_pdos).map(|pdo| {
            let bits = pdo.entries.iter().map(|entry| u32::from(entry.bit_length)).sum::<u32>();
            (pdo.sync_manager, bits)
        });
        let header = &sii.header;
        let bootstrap = (header.bootstrap_receive, header.bootstrap_send);
        let mailbox = (header.receive.length_bytes > 0).then(|| Mailbox {
            receive: header.receive,
            send: header.send,
            bootstrap: Some(bootstrap).filter(|(receive, _)| receive.length_bytes > 0),
            protocols: header.protocols,
            coe_details: general.map_or(CoeDetails::empty(), |general| general.coe_details),
        });
        let identification = general.map_or(0, |general| general.identification_offset);
        Self {
            separate_commands: flags.contains(GeneralFlags::ENABLE_NOT_LRW),
            device_id: DeviceIdSource::of(flags, identification),
            ..Self::of(channels.collect(), mailbox.as_ref(), &pdos.collect::<Vec<_>>(), &sii.fmmus)
        }
    }

    /// The settings in a description: everything that an SII has, and in addition time-outs, registers and SDOs
    /// for the way up.
    #[must_use]
    pub fn from_description(description: &DeviceDescription) -> Self {
        let channels = (0..SYNC_MANAGERS_MAX).zip(&description.sync_managers).map(|(number, sm)| Channel {
            number,
            usage: sm.usage,
            start: sm.start,
            default_bytes: sm.default_bytes,
            control: sm.control,
            enable: sm.enable,
        });
        let pdos = description.rx_pdos.iter().chain(&description.tx_pdos);
        let pdos: Vec<_> = pdos.map(|pdo| (pdo.sync_manager, pdo.bit_length())).collect();
        let start_up = description.init_commands.iter().map(|command| StartUpSdo {
            transition: command.transition,
            target: SdoTarget::entry(command.index.0, command.sub.0),
            data: command.data.clone(),
        });
        let flags = description.general_flags;
        Self {
            registers: presets(description),
            start_up: start_up.collect(),
            timeouts: description.timeouts,
            separate_commands: flags.contains(GeneralFlags::ENABLE_NOT_LRW),
            device_id: DeviceIdSource::of(flags, description.identification_offset),
            ..Self::of(channels.collect(), description.mailbox.as_ref(), &pdos, &description.fmmus)
        }
    }

    fn of(
        channels: Vec<Channel>,
        mailbox: Option<&Mailbox>,
        pdos: &[(Option<u8>, u32)],
        fmmus: &[FmmuUsage],
    ) -> Self {
        let mut free = FreeFmmus { usages: fmmus, taken: Vec::new() };
        let process_data = channels.iter().filter_map(|channel| {
            let assigned = pdos.iter().filter(|(sm, _)| *sm == Some(channel.number)).map(|(_, bits)| bits);
            area(channel, assigned.sum(), &mut free)
        });
        Self {
            process_data: process_data.collect(),
            mailbox: mailbox.map(|mailbox| mailbox_settings(&channels, mailbox)),
            ..Self::default()
        }
    }

    /// The areas of one direction, in the order of their SyncManagers.
    pub fn areas(&self, direction: Direction) -> impl Iterator<Item = &ProcessDataArea> {
        self.process_data.iter().filter(move |area| area.direction == direction)
    }

    /// The length in bytes of the first area that is too long for an FMMU; none if all can be mapped.
    pub(crate) fn too_long_area(&self) -> Option<usize> {
        let lengths = self.process_data.iter().map(|area| area.bits.div_ceil(8) as usize);
        lengths.into_iter().find(|length_bytes| *length_bytes > usize::from(u16::MAX))
    }

    /// Sets the number of bits of a SyncManager's process data, and its length. Without bits it is disabled. A
    /// SyncManager without process data is unchanged.
    pub fn set_bits(&mut self, sync_manager: u8, bits: u32) {
        for area in self.process_data.iter_mut().filter(|area| area.sync_manager.number == sync_manager) {
            area.bits = bits;
            area.sync_manager.length_bytes = length_bytes(bits);
            area.sync_manager.activate = u8::from(bits > 0);
        }
    }
}

impl DeviceIdSource {
    const fn of(flags: GeneralFlags, identification_offset: u16) -> Self {
        if flags.contains(GeneralFlags::IDENT_AL_STATUS) {
            Self::AlStatusCode
        } else if flags.contains(GeneralFlags::IDENT_PHY_M) {
            Self::Register(identification_offset)
        } else {
            Self::StationAlias
        }
    }
}

fn length_bytes(bits: u32) -> u16 {
    u16::try_from(bits.div_ceil(8)).unwrap_or(u16::MAX)
}

/// The process data of a SyncManager; none for a mailbox and for one without data.
fn area(channel: &Channel, assigned_bits: u32, free: &mut FreeFmmus<'_>) -> Option<ProcessDataArea> {
    let direction = match usage(channel) {
        SyncManagerType::Outputs => Direction::Outputs,
        SyncManagerType::Inputs => Direction::Inputs,
        SyncManagerType::MailboxOut
        | SyncManagerType::MailboxIn
        | SyncManagerType::Unused
        | SyncManagerType::Other(_) => return None,
    };
    let bits = if assigned_bits > 0 { assigned_bits } else { 8 * u32::from(channel.default_bytes) };
    let sync_manager = SyncManagerSettings {
        number: channel.number,
        start: channel.start,
        length_bytes: length_bytes(bits),
        control: channel.control,
        activate: u8::from(bits > 0),
    };
    Some(ProcessDataArea { direction, bits, sync_manager, fmmu: free.take(direction) })
}

/// The purpose of a SyncManager. Old SIIs do not contain it; then the control byte is used.
fn usage(channel: &Channel) -> SyncManagerType {
    match (channel.usage, channel.control & 0x0F) {
        _ if channel.enable & VIRTUAL != 0 => SyncManagerType::Unused,
        (SyncManagerType::Unused, _) if channel.enable & 1 == 0 => SyncManagerType::Unused,
        (SyncManagerType::Unused, 0x06) => SyncManagerType::MailboxOut,
        (SyncManagerType::Unused, 0x02) => SyncManagerType::MailboxIn,
        (SyncManagerType::Unused, 0x04) => SyncManagerType::Outputs,
        (SyncManagerType::Unused, 0x00) => SyncManagerType::Inputs,
        (known, _) => known,
    }
}

/// The mailbox, on the SyncManagers with that purpose; otherwise on the first two.
fn mailbox_settings(channels: &[Channel], mailbox: &Mailbox) -> MailboxSettings {
    let channel = |wanted| channels.iter().find(|channel| usage(channel) == wanted);
    let settings = |wanted, area, number, control| {
        let (number, control) =
            channel(wanted).map_or((number, control), |channel| (channel.number, channel.control));
        SyncManagerSettings::mailbox(number, area, control)
    };
    MailboxSettings {
        out: settings(SyncManagerType::MailboxOut, mailbox.receive, 0, SyncManagerSettings::MAILBOX_OUT),
        inward: settings(SyncManagerType::MailboxIn, mailbox.send, 1, SyncManagerSettings::MAILBOX_IN),
        bootstrap: mailbox.bootstrap,
        protocols: mailbox.protocols,
        coe_details: mailbox.coe_details,
    }
}

/// The registers that a description presets.
fn presets(description: &DeviceDescription) -> Vec<RegisterSetting> {
    let presets = description.esc_presets;
    let rows = [
        (registers::READ_WRITE_OFFSET, presets.read_write_offset),
        (registers::WATCHDOG_DIVIDER, presets.watchdog_divider),
        (registers::PDI_WATCHDOG, presets.pdi_watchdog),
        (registers::PROCESS_DATA_WATCHDOG, presets.process_data_watchdog),
    ];
    let written = rows.into_iter().filter_map(|(offset, value)| {
        Some(RegisterSetting { transition: Transition::Ip, offset, data: value?.to_le_bytes().to_vec() })
    });
    written.collect()
}

/// FMMUs that are not used by an area yet.
struct FreeFmmus<'a> {
    usages: &'a [FmmuUsage],
    taken: Vec<u8>,
}

impl FreeFmmus<'_> {
    /// The first one for this direction; otherwise the first one without a purpose.
    fn take(&mut self, direction: Direction) -> u8 {
        let wanted = match direction {
            Direction::Outputs => FmmuUsage::Outputs,
            Direction::Inputs => FmmuUsage::Inputs,
        };
        let usage = |number: u8| self.usages.get(usize::from(number)).copied().unwrap_or(FmmuUsage::Unused);
        let mut free = (0..=u8::MAX).filter(|number| !self.taken.contains(number));
        let number = free.clone().find(|&number| usage(number) == wanted);
        let number =
            number.or_else(|| free.find(|&number| usage(number) == FmmuUsage::Unused)).unwrap_or(u8::MAX);
        self.taken.push(number);
        number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sync_managers_that_no_controller_has_are_not_used() {
        let outputs = esi::sii::SyncManagerContents {
            start: 0x1000,
            length_bytes: 1,
            control: 0x64,
            enable: 1,
            usage: SyncManagerType::Outputs,
        };
        let sii = SiiContents { sync_managers: vec![outputs; 300], ..SiiContents::default() };
        let areas = SlaveSettings::from_sii(&sii).process_data;
        assert_eq!(
            areas.iter().map(|area| area.sync_manager.number).collect::<Vec<_>>(),
            Vec::from_iter(0..16)
        );
    }
}
