//! Requests: function code and bytes in, a well-formed request out.

use crate::addresses::Addresses;
use crate::exception::Exception;
use crate::map::Table;

/// Maximum number of bits in a response (application protocol, 6.1 and 6.2).
const READ_BITS_MAX: u16 = 2000;
/// Maximum number of registers in a response (6.3, 6.4 and 6.17).
const READ_REGISTERS_MAX: u16 = 125;
/// Maximum number of coils in a request (6.11).
const WRITE_COILS_MAX: u16 = 1968;
/// Maximum number of registers in a request that writes (6.12).
const WRITE_REGISTERS_MAX: u16 = 123;
/// Maximum number of registers in a request that also reads (6.17).
const READ_WRITE_REGISTERS_MAX: u16 = 121;

/// A well-formed request. Its addresses are not checked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Request {
    /// Read Coils, 0x01, and Read Discrete Inputs, 0x02.
    ReadBits(Table, Addresses),
    /// Read Holding Registers, 0x03, and Read Input Registers, 0x04.
    ReadRegisters(Table, Addresses),
    /// Write Single Coil, 0x05, and Write Multiple Coils, 0x0F.
    WriteCoils(Addresses, Vec<bool>),
    /// Write Single Register, 0x06, and Write Multiple Registers, 0x10.
    WriteRegisters(Addresses, Vec<u16>),
    /// Mask Write Register, 0x16.
    MaskWriteRegister { address: u16, and_mask: u16, or_mask: u16 },
    /// Read/Write Multiple Registers, 0x17: it writes first.
    ReadWriteRegisters { read: Addresses, write: Addresses, values: Vec<u16> },
}

impl Request {
    /// A request from its function code and the bytes after it.
    pub(crate) fn parse(function: u8, octets: &[u8]) -> Result<Self, Exception> {
        match function {
            0x01 => Ok(Self::ReadBits(Table::Coils, addresses(octets, READ_BITS_MAX)?)),
            0x02 => Ok(Self::ReadBits(Table::DiscreteInputs, addresses(octets, READ_BITS_MAX)?)),
            0x03 => Ok(Self::ReadRegisters(Table::HoldingRegisters, addresses(octets, READ_REGISTERS_MAX)?)),
            0x04 => Ok(Self::ReadRegisters(Table::InputRegisters, addresses(octets, READ_REGISTERS_MAX)?)),
            0x05 => single_coil(octets),
            0x06 => match words(octets)? {
                [address, value] => Ok(Self::WriteRegisters(Addresses::one(address), vec![value])),
            },
            0x0F => coils(octets),
            0x10 => {
                let (write, values) = registers(octets, WRITE_REGISTERS_MAX)?;
                Ok(Self::WriteRegisters(write, values))
            }
            0x16 => match words(octets)? {
                [address, and_mask, or_mask] => Ok(Self::MaskWriteRegister { address, and_mask, or_mask }),
            },
            0x17 => read_write(octets),
            _ => Err(Exception::IllegalFunction),
        }
    }
}

/// Exactly this number of registers, with nothing after them.
fn words<const N: usize>(octets: &[u8]) -> Result<[u16; N], Exception> {
    registers_of(octets).try_into().map_err(|_| Exception::IllegalDataValue).and_then(|words| {
        let is_whole = octets.len() == 2 * N;
        is_whole.then_some(words).ok_or(Exception::IllegalDataValue)
    })
}

/// The high byte comes first.
fn registers_of(octets: &[u8]) -> Vec<u16> {
    octets.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
}

fn addresses(octets: &[u8], most: u16) -> Result<Addresses, Exception> {
    let [first, quantity] = words(octets)?;
    Addresses::checked(first, quantity, most)
}

fn single_coil(octets: &[u8]) -> Result<Request, Exception> {
    let [address, value] = words(octets)?;
    let value = match value {
        0xFF00 => true,
        0x0000 => false,
        _ => return Err(Exception::IllegalDataValue),
    };
    Ok(Request::WriteCoils(Addresses::one(address), vec![value]))
}

/// The bytes after `head` bytes of words and the byte count: as many as the byte count says.
fn counted(octets: &[u8], head: usize) -> Result<(&[u8], &[u8]), Exception> {
    let (head, rest) = octets.split_at_checked(head).ok_or(Exception::IllegalDataValue)?;
    match rest.split_first() {
        Some((length_bytes, values)) if usize::from(*length_bytes) == values.len() => Ok((head, values)),
        _ => Err(Exception::IllegalDataValue),
    }
}

fn coils(octets: &[u8]) -> Result<Request, Exception> {
    let (head, packed) = counted(octets, 4)?;
    let write = addresses(head, WRITE_COILS_MAX)?;
    let quantity = usize::from(write.quantity);
    if packed.len() != quantity.div_ceil(8) {
        return Err(Exception::IllegalDataValue);
    }
    let bits = packed.iter().flat_map(|octet| (0..8).map(move |bit| octet >> bit & 1 != 0));
    Ok(Request::WriteCoils(write, bits.take(quantity).collect()))
}

fn registers(octets: &[u8], most: u16) -> Result<(Addresses, Vec<u16>), Exception> {
    let (head, values) = counted(octets, 4)?;
    let write = addresses(head, most)?;
    let is_whole = values.len() == 2 * usize::from(write.quantity);
    is_whole.then(|| (write, registers_of(values))).ok_or(Exception::IllegalDataValue)
}

fn read_write(octets: &[u8]) -> Result<Request, Exception> {
    let (read, rest) = octets.split_at_checked(4).ok_or(Exception::IllegalDataValue)?;
    let read = addresses(read, READ_REGISTERS_MAX)?;
    let (write, values) = registers(rest, READ_WRITE_REGISTERS_MAX)?;
    Ok(Request::ReadWriteRegisters { read, write, values })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn what_is_no_request_is_refused_by_its_exception() {
        let value = Err(Exception::IllegalDataValue);
        for (function, octets) in [
            (0x01, vec![0, 0, 0, 0]),
            (0x01, vec![0, 0, 0x07, 0xD1]),
            (0x03, vec![0, 0, 0, 126]),
            (0x03, vec![0, 0, 0]),
            (0x03, vec![0, 0, 0, 1, 0]),
            (0x05, vec![0, 0, 0xFF, 0x01]),
            (0x06, vec![]),
            (0x0F, vec![0, 0, 0, 16, 1, 0xFF]),
            (0x0F, vec![0, 0, 0x27, 0x10, 2, 0, 0]),
            (0x10, vec![0, 0, 0x80, 0, 0]),
            (0x10, vec![0, 0, 0, 2, 4, 0, 0, 0]),
            (0x10, [vec![0, 0, 0, 124, 248], vec![0; 248]].concat()),
            (0x17, vec![0, 0, 0, 1, 0, 0, 0, 0, 0]),
        ] {
            assert_eq!(Request::parse(function, &octets), value, "{function:#04x} {octets:02x?}");
        }
        for function in [0x00, 0x07, 0x11, 0x2B, 0x80, 0xFF] {
            assert_eq!(Request::parse(function, &[]), Err(Exception::IllegalFunction));
        }
    }

    #[test]
    fn the_largest_requests_are_well_formed() {
        let coils = [vec![0, 0, 0x07, 0xB0, 246], vec![0xFF; 246]].concat();
        let registers = [vec![0, 0, 0, 123, 246], vec![1; 246]].concat();
        let both = [vec![0, 0, 0, 125, 0, 0, 0, 121, 242], vec![1; 242]].concat();
        for (function, octets) in [(0x0F, coils), (0x10, registers), (0x17, both)] {
            assert!(Request::parse(function, &octets).is_ok(), "{function:#04x}");
        }
    }

    proptest! {
        #[test]
        fn no_octets_are_too_much_for_it(
            function: u8,
            octets in proptest::collection::vec(any::<u8>(), 0..260),
        ) {
            let _ = Request::parse(function, &octets);
        }
    }
}
