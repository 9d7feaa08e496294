//! One unit: which datagrams are for it, and what they do.

use core::ops::Range;

use device::Network;
use esc::Esc;
use mailbox::{SdoDirection, SdoEnd, SdoNote};
use plant::{Happening, HappeningKind, Mapping, mappings};
use time::Instant;
use unit_model::ModelUnit;
use wire::{AlState, Command, DatagramView, SdoAccess};

use super::acts::{Acts, Moments};
use super::exchange::Exchange;
use super::mailbox::Counters;
use crate::model::{Bytes, Entry, MasterAct};

/// The address by which datagrams with a station address find the unit.
const STATION_ADDRESS: u16 = 0x0010;
const AL_CONTROL: u16 = 0x0120;
/// In AL control: the error indication is acknowledged.
const ACKNOWLEDGE: u8 = 0x10;
/// SII control, whose second byte has the command, and the address of the word.
const SII_CONTROL: u16 = 0x0502;
const SII_BYTES: usize = 6;
/// The command to read, in the second byte of SII control.
const SII_READ: u8 = 0x01;
const SII_COMMANDS: u8 = 0x07;

/// A unit with which acts of the master are counted.
#[derive(Debug)]
pub(super) struct WatchedUnit {
    pub(super) position: usize,
    pub(super) acts: Acts,
    pub(super) exchange: Exchange,
    /// The unit shows the error indication.
    has_error: bool,
    /// Logical addresses of its process data.
    outputs: Option<Range<u32>>,
    inputs: Option<Range<u32>>,
    counters: Counters,
    sii: SiiCommand,
}

/// What the master has written to the registers of the SII.
#[derive(Debug, Default)]
struct SiiCommand {
    registers: [u8; SII_BYTES],
    /// The frame has written a command.
    is_given: bool,
}

impl WatchedUnit {
    /// A unit as it is now; none if it is not there.
    pub(super) fn beginning_with(
        network: &Network<Box<dyn ModelUnit>>,
        position: usize,
        now: Instant,
    ) -> Option<Self> {
        let (device, esc) = (network.device(position)?, network.esc(position)?);
        let status = device.al_status();
        let mut unit = Self {
            position,
            acts: Acts::default(),
            exchange: Exchange::new(),
            has_error: status.error,
            outputs: None,
            inputs: None,
            counters: Counters::default(),
            sii: SiiCommand::default(),
        };
        if [AlState::SafeOp, AlState::Op].contains(&status.state) {
            mappings(esc, now).for_each(|mapping| unit.is_mapped(&mapping));
        }
        Some(unit)
    }

    /// Another unit is at its place.
    pub(super) fn begin_again(&mut self) {
        self.has_error = false;
        self.counters.begin_again();
        self.sii = SiiCommand::default();
        self.is_not_mapped();
    }

    /// A datagram of the master, before it reaches a unit.
    pub(super) fn datagram(
        &mut self,
        now: Instant,
        datagram: &DatagramView<'_>,
        network: &Network<Box<dyn ModelUnit>>,
        moments: &mut Moments,
    ) {
        let (reads, writes) = directions(datagram.header.command);
        if let Some(addresses) = logical(datagram) {
            if writes && overlap(&addresses, self.outputs.as_ref()) {
                self.acts.are_done(now, moments, |act| matches!(act, MasterAct::SendOutputs { .. }));
            }
            if overlap(&addresses, self.outputs.as_ref().or(self.inputs.as_ref())) {
                self.exchange.come(now);
            }
            return;
        }
        let esc = network.esc(self.position).filter(|esc| self.is_addressed(datagram, esc, now));
        let Some(esc) = esc else { return };
        let offset = datagram.header.offset;
        if reads {
            let has = |register: u16| byte_of(datagram.data, offset, register).is_some();
            self.acts.are_done(
                now,
                moments,
                |act| matches!(act, MasterAct::ReadRegister { register, .. } if has(register.0)),
            );
            self.counters.read(datagram, esc, now);
        }
        if writes {
            if self.counters.are_wrong(datagram.data, offset, esc, now) {
                self.acts.are_done(now, moments, |act| matches!(act, MasterAct::MiscountMailbox { .. }));
            }
            self.write(now, datagram.data, offset, moments);
        }
    }

    fn write(&mut self, now: Instant, data: &[u8], offset: u16, moments: &mut Moments) {
        let control = byte_of(data, offset, AL_CONTROL);
        let requested = control.map(|control| AlState::from_bits(u16::from(control & !ACKNOWLEDGE)));
        let acknowledges = self.has_error && control.is_some_and(|control| control & ACKNOWLEDGE != 0);
        self.acts.are_done(now, moments, |act| match act {
            MasterAct::WriteRegister { register, bytes, .. } => {
                has_written(data, offset, register.0, bytes.as_ref())
            }
            MasterAct::RequestState { state, .. } => requested == Some(*state),
            MasterAct::AcknowledgeError { .. } => acknowledges,
            MasterAct::ReadSdo { .. }
            | MasterAct::WriteSdo { .. }
            | MasterAct::ReadRegister { .. }
            | MasterAct::ReadSiiWord { .. }
            | MasterAct::SendOutputs { .. }
            | MasterAct::MiscountMailbox { .. } => false,
        });
        if requested == Some(AlState::Init) {
            // Also if the line loses the request.
            self.counters.begin_again();
        }
        self.sii.write(data, offset);
    }

    /// Commands of the SII begin at the end of a frame.
    pub(super) fn end_of_frame(&mut self, now: Instant, moments: &mut Moments) {
        let Some(word) = self.sii.take_read() else { return };
        // One command reads two words.
        let is_read = |wanted: u16| (word..=word.saturating_add(1)).contains(&u32::from(wanted));
        self.acts.are_done(
            now,
            moments,
            |act| matches!(act, MasterAct::ReadSiiWord { word: wanted, .. } if is_read(wanted.0)),
        );
    }

    /// A datagram as it returns.
    pub(super) fn answer(&mut self, datagram: &DatagramView<'_>) {
        let Some(addresses) = logical(datagram) else { return self.counters.answer(datagram) };
        if overlap(&addresses, self.outputs.as_ref()) || overlap(&addresses, self.inputs.as_ref()) {
            self.exchange.working_counter = Some(datagram.working_counter);
        }
    }

    pub(super) fn happening(&mut self, happening: &Happening, moments: &mut Moments) {
        match &happening.kind {
            HappeningKind::State { status, .. } => {
                self.has_error = status.error;
                if status.state == AlState::Init {
                    // The mailbox counts from its beginning with PRE-OP.
                    self.counters.begin_again();
                }
                if ![AlState::SafeOp, AlState::Op].contains(&status.state) {
                    self.is_not_mapped();
                }
            }
            HappeningKind::Power { on: false } => self.begin_again(),
            HappeningKind::Mapping(mapping) => self.is_mapped(mapping),
            HappeningKind::Sdo(note) => self.sdo(happening.at, note, moments),
            HappeningKind::MessageReceived(note) => self.counters.is_taken(note),
            HappeningKind::Power { on: true }
            | HappeningKind::Event(_)
            | HappeningKind::Emergency(_)
            | HappeningKind::EmergenciesLost { .. }
            | HappeningKind::MessageSent(_)
            | HappeningKind::Link { .. }
            | HappeningKind::Indicator { .. }
            | HappeningKind::Fault { .. }
            | HappeningKind::Carrier { .. }
            | HappeningKind::Master { .. }
            | HappeningKind::FrameFaultEnded { .. } => {}
        }
    }

    fn sdo(&mut self, at: Instant, note: &SdoNote, moments: &mut Moments) {
        if note.end != SdoEnd::Done {
            return;
        }
        self.acts.are_done(at, moments, |act| match (act, note.direction) {
            (MasterAct::ReadSdo { entry, .. }, Some(SdoDirection::Upload))
            | (MasterAct::WriteSdo { entry, value: None, .. }, Some(SdoDirection::Download)) => {
                is_target(note, *entry, true)
            }
            (MasterAct::WriteSdo { entry, value: Some(value), .. }, Some(SdoDirection::Download)) => {
                is_target(note, *entry, false) && is_value(note, value)
            }
            _ => false,
        });
    }

    fn is_mapped(&mut self, mapping: &Mapping) {
        let range =
            mapping.logical_start.map(|start| start..start.saturating_add(mapping.length_bytes.into()));
        if mapping.is_outputs {
            self.outputs = range;
        } else {
            self.inputs = range;
        }
    }

    fn is_not_mapped(&mut self) {
        (self.outputs, self.inputs) = (None, None);
        self.exchange.working_counter = None;
    }

    /// Whether a datagram with a physical address is for this unit.
    fn is_addressed(&self, datagram: &DatagramView<'_>, esc: &Esc, now: Instant) -> bool {
        let address = datagram.header.address;
        match datagram.header.command {
            Command::Brd | Command::Bwr | Command::Brw => true,
            Command::Aprd | Command::Apwr | Command::Aprw | Command::Armw => {
                usize::from(address.wrapping_neg()) == self.position
            }
            Command::Fprd | Command::Fpwr | Command::Fprw | Command::Frmw => {
                let mut own = [0; 2];
                esc.look(STATION_ADDRESS, &mut own, now);
                u16::from_le_bytes(own) == address
            }
            Command::Nop | Command::Lrd | Command::Lwr | Command::Lrw | Command::Other(_) => false,
        }
    }
}

impl SiiCommand {
    fn write(&mut self, data: &[u8], offset: u16) {
        for (place, byte) in (SII_CONTROL..).zip(&mut self.registers) {
            if let Some(written) = byte_of(data, offset, place) {
                *byte = written;
            }
        }
        self.is_given |= byte_of(data, offset, SII_CONTROL + 1).is_some();
    }

    /// The word that the frame orders to be read.
    fn take_read(&mut self) -> Option<u32> {
        let [_, command, address @ ..] = self.registers;
        let is_given = core::mem::take(&mut self.is_given);
        (is_given && command & SII_COMMANDS == SII_READ).then(|| u32::from_le_bytes(address))
    }
}

/// Whether a command reads and writes at the unit that it addresses.
const fn directions(command: Command) -> (bool, bool) {
    match command {
        Command::Aprd | Command::Fprd | Command::Brd | Command::Lrd | Command::Armw | Command::Frmw => {
            (true, false)
        }
        Command::Apwr | Command::Fpwr | Command::Bwr | Command::Lwr => (false, true),
        Command::Aprw | Command::Fprw | Command::Brw | Command::Lrw => (true, true),
        Command::Nop | Command::Other(_) => (false, false),
    }
}

/// The logical addresses of a datagram; none if it has physical ones.
fn logical(datagram: &DatagramView<'_>) -> Option<Range<u32>> {
    let header = &datagram.header;
    let start = header.logical_address();
    match header.command {
        Command::Lrd | Command::Lwr | Command::Lrw => {
            Some(start..start.saturating_add(header.length_bytes.into()))
        }
        _ => None,
    }
}

fn overlap(one: &Range<u32>, other: Option<&Range<u32>>) -> bool {
    other.is_some_and(|other| one.start < other.end && other.start < one.end)
}

/// The byte for a register in the data of a datagram from `offset` on.
fn byte_of(data: &[u8], offset: u16, register: u16) -> Option<u8> {
    data.get(usize::from(register.checked_sub(offset)?)).copied()
}

fn has_written(data: &[u8], offset: u16, register: u16, bytes: Option<&Bytes>) -> bool {
    let Some(place) = register.checked_sub(offset).map(usize::from) else { return false };
    match bytes {
        None => place < data.len(),
        Some(bytes) => data.get(place..place + bytes.0.len()) == Some(&*bytes.0),
    }
}

/// Whether an SDO is about this entry. One by complete access is about all entries of its object.
fn is_target(note: &SdoNote, entry: Entry, by_complete_access: bool) -> bool {
    let target = note.target;
    let is_entry = match target.access {
        SdoAccess::Entry => target.sub.0 == entry.sub,
        SdoAccess::Complete => by_complete_access,
    };
    target.index.0 == entry.index && is_entry
}

/// Whether it has transferred this value, of which no more bytes are known than [`mailbox::SdoValue::HEAD_BYTES`].
fn is_value(note: &SdoNote, value: &Bytes) -> bool {
    note.value.length_bytes as usize == value.0.len() && note.value.head() == &*value.0
}
