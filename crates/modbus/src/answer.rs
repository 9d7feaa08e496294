//! From the bytes of a request to those of its response.

use crate::exception::Exception;
use crate::request::Request;
use crate::unit::Unit;

/// The response to a request: function code and the bytes after it.
pub(crate) async fn answer(units: &[Unit], unit_identifier: u8, function: u8, octets: &[u8]) -> Vec<u8> {
    match respond(units, unit_identifier, function, octets).await {
        Ok(response) => response,
        Err(exception) => exception.response(function),
    }
}

async fn respond(
    units: &[Unit],
    unit_identifier: u8,
    function: u8,
    octets: &[u8],
) -> Result<Vec<u8>, Exception> {
    let unit = unit_at(units, unit_identifier)?;
    let head = |length_bytes: usize| [&[function], octets.get(..length_bytes).unwrap_or_default()].concat();
    match Request::parse(function, octets)? {
        Request::ReadBits(table, addresses) => Ok(packed_bits(function, &unit.bits(table, addresses)?)),
        Request::ReadRegisters(table, addresses) => {
            Ok(packed_registers(function, &unit.registers(table, addresses)?))
        }
        // The response to a write contains the first bytes of the request: address and value, or address and quantity.
        Request::WriteCoils(addresses, values) => {
            unit.write_coils(addresses, &values).await.map(|()| head(4))
        }
        Request::WriteRegisters(addresses, values) => {
            unit.write_registers(addresses, &values).await.map(|()| head(4))
        }
        Request::MaskWriteRegister { address, and_mask, or_mask } => {
            unit.mask_register(address, and_mask, or_mask).await.map(|()| head(6))
        }
        Request::ReadWriteRegisters { read, write, values } => {
            let table = crate::map::Table::HoldingRegisters;
            // A refused request writes nothing.
            unit.registers(table, read)?;
            unit.write_registers(write, &values).await?;
            Ok(packed_registers(function, &unit.registers(table, read)?))
        }
    }
}

/// The unit identifier is the position in the line, from 1. 0 and 255 mean the server (implementation guide,
/// 4.4.1.2): the first unit.
fn unit_at(units: &[Unit], unit_identifier: u8) -> Result<&Unit, Exception> {
    let position = match unit_identifier {
        0 | 255 => 0,
        position => usize::from(position) - 1,
    };
    units.get(position).ok_or(Exception::GatewayTargetDeviceFailedToRespond)
}

/// Eight bits a byte, the first in the least significant bit.
fn packed_bits(function: u8, bits: &[bool]) -> Vec<u8> {
    let octets =
        bits.chunks(8).map(|chunk| chunk.iter().rev().fold(0_u8, |octet, &bit| octet << 1 | u8::from(bit)));
    counted(function, octets.collect())
}

/// The high byte first.
fn packed_registers(function: u8, registers: &[u16]) -> Vec<u8> {
    counted(function, registers.iter().flat_map(|register| register.to_be_bytes()).collect())
}

fn counted(function: u8, octets: Vec<u8>) -> Vec<u8> {
    // At most 250 bytes: no valid request asks for more.
    let length_bytes = octets.len() as u8;
    [vec![function, length_bytes], octets].concat()
}
