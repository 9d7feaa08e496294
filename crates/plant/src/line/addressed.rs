//! What the datagrams of a frame address: the unit, and the part of its memory.

use core::ops::Range;

use device::{Network, Unit};
use esc::{Esc, SmMode, SyncManagerSettings};
use time::Instant;
use wire::{Command, DatagramHeader, datagrams};

use super::frames::{FrameKind, Frames};

/// The registers of the SII.
const SII: Range<u32> = 0x0500..0x0510;
const SYNC_MANAGERS: u16 = 0x0800;
const SYNC_MANAGER_BYTES: u16 = 8;
const SYNC_MANAGERS_MAX: u16 = 16;
/// Status, activation and PDI control of a SyncManager, in its registers.
const HANDSHAKE: Range<u32> = 5..8;

impl Frames {
    /// Whether a frame is of the kind, with a datagram that addresses the unit.
    pub(super) fn include<U: Unit>(&self, frame: &[u8], units: &Network<U>) -> bool {
        match self.kind {
            FrameKind::Any if self.unit.is_none() => true,
            _ => datagrams(frame).any(|datagram| self.include_datagram(&datagram.header, units)),
        }
    }

    fn include_datagram<U: Unit>(&self, header: &DatagramHeader, units: &Network<U>) -> bool {
        let addresses_unit = self.unit.as_ref().is_none_or(|unit| addresses(header, units, unit.position()));
        addresses_unit && self.kind.includes(header, units)
    }

    /// Which datagrams of a frame address the unit, by bits; without a unit all of them.
    pub(super) fn addressing<U: Unit>(&self, frame: &[u8], units: &Network<U>) -> u128 {
        let Some(unit) = &self.unit else { return u128::MAX };
        let numbered = datagrams(frame).enumerate().take(128);
        let meant = numbered.filter(|(_, datagram)| addresses(&datagram.header, units, unit.position()));
        meant.fold(0, |bits, (number, _)| bits | 1 << number)
    }
}

impl FrameKind {
    fn includes<U: Unit>(self, header: &DatagramHeader, units: &Network<U>) -> bool {
        match self {
            Self::Any => true,
            Self::ProcessData => is_logical(header.command),
            Self::Mailbox => is_at_mailbox(header, units),
            Self::Sii => !is_logical(header.command) && overlap(&memory(header), &SII),
            Self::Nop
            | Self::Aprd
            | Self::Apwr
            | Self::Aprw
            | Self::Fprd
            | Self::Fpwr
            | Self::Fprw
            | Self::Brd
            | Self::Bwr
            | Self::Brw
            | Self::Lrd
            | Self::Lwr
            | Self::Lrw
            | Self::Armw
            | Self::Frmw => self.command().is_some_and(|(command, _)| command == header.command),
        }
    }
}

/// Whether a datagram addresses the unit at a position: by this position, by its station address or alias, by a logical
/// address that one of its FMMUs maps, or all units. The header is that of the frame as the master sends it.
fn addresses<U: Unit>(header: &DatagramHeader, units: &Network<U>, position: usize) -> bool {
    let Some(esc) = units.esc(position) else { return false };
    match header.command {
        Command::Aprd | Command::Apwr | Command::Aprw => {
            usize::from(header.address.wrapping_neg()) == position
        }
        Command::Fprd | Command::Fpwr | Command::Fprw => esc.answers_to(header.address),
        Command::Lrd | Command::Lwr | Command::Lrw => {
            let bytes = logical(header);
            esc.mapped_bytes().any(|mapped| overlap(&mapped, &bytes))
        }
        // Those that read one unit write all others.
        Command::Brd | Command::Bwr | Command::Brw | Command::Armw | Command::Frmw => true,
        Command::Nop | Command::Other(_) => false,
    }
}

const fn is_logical(command: Command) -> bool {
    matches!(command, Command::Lrd | Command::Lwr | Command::Lrw)
}

/// The bytes of the memory of a unit.
fn memory(header: &DatagramHeader) -> Range<u32> {
    let start = u32::from(header.offset);
    start..start + u32::from(header.length_bytes)
}

fn logical(header: &DatagramHeader) -> Range<u64> {
    let start = u64::from(header.logical_address());
    start..start + u64::from(header.length_bytes)
}

fn overlap<T: PartialOrd>(one: &Range<T>, other: &Range<T>) -> bool {
    one.start < other.end && other.start < one.end
}

fn is_at_mailbox<U: Unit>(header: &DatagramHeader, units: &Network<U>) -> bool {
    let bytes = memory(header);
    let is_meant = |position: &usize| addresses(header, units, *position);
    !is_logical(header.command)
        && (0..units.len())
            .filter(is_meant)
            .any(|position| units.esc(position).is_some_and(|esc| has_mailbox_at(esc, &bytes)))
}

/// Whether these bytes are in the area of a SyncManager in mailbox mode, or within its handshake.
fn has_mailbox_at(esc: &Esc, bytes: &Range<u32>) -> bool {
    (0..SYNC_MANAGERS_MAX).any(|number| {
        let at = SYNC_MANAGERS + number * SYNC_MANAGER_BYTES;
        let mut registers = [0; SYNC_MANAGER_BYTES as usize];
        esc.look(at, &mut registers, Instant::ZERO);
        let settings = SyncManagerSettings::from_bytes(&registers);
        let start = u32::from(settings.start);
        let area = start..start + u32::from(settings.length_bytes);
        let handshake = u32::from(at) + HANDSHAKE.start..u32::from(at) + HANDSHAKE.end;
        let is_handshake = handshake.start <= bytes.start && bytes.end <= handshake.end && !bytes.is_empty();
        settings.mode == SmMode::Mailbox && settings.enabled && (overlap(&area, bytes) || is_handshake)
    })
}
