//! The blocks of a pcapng file (draft-ietf-opsawg-pcapng).

use crate::packet::{NotACapture, Packet};
use crate::{
    BYTE_ORDER_MAGIC, Direction, ENHANCED_PACKET, INTERFACE_DESCRIPTION, LINKTYPE_ETHERNET,
    OPTION_PACKET_FLAGS, OPTION_TIME_RESOLUTION, SECTION_HEADER,
};

/// The packets of a pcapng file.
#[derive(Debug)]
pub(super) struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
    /// Duration of a tick in nanoseconds for each interface, as a fraction.
    interfaces: Vec<(u64, u64)>,
}

impl Iterator for Blocks<'_> {
    type Item = Result<Packet, NotACapture>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.bytes.len() {
            match self.block() {
                Ok(None) => {}
                Ok(Some(packet)) => return Some(Ok(packet)),
                Err(reason) => {
                    self.at = self.bytes.len();
                    return Some(Err(reason));
                }
            }
        }
        None
    }
}

impl<'a> Blocks<'a> {
    /// None: it does not begin with a section.
    pub(super) fn of(bytes: &'a [u8]) -> Option<Self> {
        let is_section = bytes.get(..4) == Some(&SECTION_HEADER.to_le_bytes());
        is_section.then_some(Self { bytes, at: 0, big_endian: false, interfaces: Vec::new() })
    }

    /// Processes a block; returns the packet, if it is one.
    fn block(&mut self) -> Result<Option<Packet>, NotACapture> {
        let at = self.at;
        let broken = NotACapture::Block { at };
        let block_type = self.word(at).ok_or(broken)?;
        if self.bytes.get(at..at + 4) == Some(&SECTION_HEADER.to_le_bytes()) {
            let magic =
                self.bytes.get(at + 8..at + 12).and_then(|magic| magic.try_into().ok()).ok_or(broken)?;
            self.big_endian = u32::from_be_bytes(magic) == BYTE_ORDER_MAGIC;
            self.interfaces.clear();
        }
        let length = self.word(at + 4).ok_or(broken)? as usize;
        if length < 12
            || !length.is_multiple_of(4)
            || self.word((at + length).wrapping_sub(4)) != Some(length as u32)
        {
            return Err(broken);
        }
        let body = self.bytes.get(at + 8..at + length - 4).ok_or(broken)?;
        let packet = match block_type {
            INTERFACE_DESCRIPTION => self.interface(body).map(|()| None)?,
            ENHANCED_PACKET => Some(self.packet(body, at)?),
            _ => None,
        };
        self.at += length;
        Ok(packet)
    }

    fn interface(&mut self, body: &'a [u8]) -> Result<(), NotACapture> {
        let broken = NotACapture::Block { at: self.at };
        let link_type = self.half(body, 0).ok_or(broken)?;
        if link_type != LINKTYPE_ETHERNET {
            return Err(NotACapture::LinkType { link_type: link_type.into() });
        }
        let resolution =
            self.option(body, 8, OPTION_TIME_RESOLUTION).and_then(|value| value.first().copied());
        self.interfaces.push(tick(resolution.unwrap_or(6)));
        Ok(())
    }

    fn packet(&self, body: &'a [u8], at: usize) -> Result<Packet, NotACapture> {
        let broken = NotACapture::Block { at };
        let word =
            |place: usize| body.get(place..place + 4).and_then(|bytes| self.number(bytes)).ok_or(broken);
        let interface = word(0)? as usize;
        let &(nanos, ticks) = self.interfaces.get(interface).ok_or(NotACapture::Interface { at })?;
        let time = u64::from(word(4)?) << 32 | u64::from(word(8)?);
        let length = word(12)? as usize;
        let frame = body.get(20..20 + length).ok_or(broken)?.to_vec();
        let flags = self.option(body, 20 + length.next_multiple_of(4), OPTION_PACKET_FLAGS);
        let direction = match flags.and_then(|flags| self.number(flags)).map(|flags| flags & 3) {
            Some(1) => Some(Direction::Inbound),
            Some(2) => Some(Direction::Outbound),
            _ => None,
        };
        let at_nanos =
            u64::try_from(u128::from(time) * u128::from(nanos) / u128::from(ticks)).unwrap_or(u64::MAX);
        Ok(Packet { at_nanos, direction, frame })
    }

    /// The value of an option among those that begin at `at`.
    fn option(&self, body: &'a [u8], mut at: usize, wanted: u16) -> Option<&'a [u8]> {
        loop {
            let (code, length) = (self.half(body, at)?, usize::from(self.half(body, at + 2)?));
            if code == 0 {
                return None;
            }
            let value = body.get(at + 4..at + 4 + length)?;
            if code == wanted {
                return Some(value);
            }
            at += 4 + length.next_multiple_of(4);
        }
    }

    fn word(&self, at: usize) -> Option<u32> {
        self.number(self.bytes.get(at..at.checked_add(4)?)?)
    }

    fn number(&self, bytes: &[u8]) -> Option<u32> {
        let bytes = bytes.try_into().ok()?;
        Some(if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    fn half(&self, body: &[u8], at: usize) -> Option<u16> {
        let bytes = body.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if self.big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) })
    }
}

/// Duration of a tick in nanoseconds, as a fraction: a power of ten, or a power of two if bit 7 is set.
pub(super) fn tick(resolution: u8) -> (u64, u64) {
    let exponent = u32::from(resolution & 0x7F);
    let ticks =
        if resolution & 0x80 == 0 { 10_u64.checked_pow(exponent) } else { 2_u64.checked_pow(exponent) };
    (1_000_000_000, ticks.unwrap_or(u64::MAX))
}
