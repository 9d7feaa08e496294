//! Values: little endian as in the CPU Unit, and as variants of OPC UA (OPC 10000-6, 5.1).
//!
//! Device variables are BOOL, bit strings and unsigned integers, and arrays of these; so their length
//! determines the type.

use opcua::types::{NumericRange, StatusCode, Variant, VariantScalarTypeId};
use plc::outside::{Change, Operation};
use plc::{VariableId, VariableType, VariableValue};

/// The built-in type of a variable, or of its elements.
pub(crate) fn scalar_type(variable_type: VariableType) -> VariantScalarTypeId {
    match variable_type.elementary.size_bytes() {
        _ if variable_type.is_bool() => VariantScalarTypeId::Boolean,
        1 => VariantScalarTypeId::Byte,
        2 => VariantScalarTypeId::UInt16,
        4 => VariantScalarTypeId::UInt32,
        _ => VariantScalarTypeId::UInt64,
    }
}

/// A whole variable.
pub(crate) fn to_variant(variable_type: VariableType, octets: &[u8]) -> Variant {
    let scalar_type = scalar_type(variable_type);
    let scalar = |octets: &[u8]| {
        let number = octets.iter().rev().fold(0, |number: u64, octet| number << 8 | u64::from(*octet));
        match scalar_type {
            VariantScalarTypeId::Boolean => Variant::Boolean(number != 0),
            VariantScalarTypeId::Byte => Variant::Byte(number as u8),
            VariantScalarTypeId::UInt16 => Variant::UInt16(number as u16),
            VariantScalarTypeId::UInt32 => Variant::UInt32(number as u32),
            _ => Variant::UInt64(number),
        }
    };
    match variable_type.elements {
        None => scalar(octets),
        Some(_) => {
            let elements = octets.chunks(variable_type.elementary.size_bytes()).map(scalar);
            Variant::from((scalar_type, elements.collect::<Vec<_>>()))
        }
    }
}

/// The changes that write a variable, or the elements of it in `range`.
///
/// # Errors
/// `BadTypeMismatch`, `BadOutOfRange` for an array of another length, or the error of the range.
pub(crate) fn changes(
    id: VariableId,
    variable_type: VariableType,
    range: &NumericRange,
    value: &Variant,
) -> Result<Vec<Change>, StatusCode> {
    let Some(elements) = variable_type.elements else {
        return match range {
            NumericRange::None => Ok(vec![write(id.into(), octets(variable_type, value)?)]),
            _ => Err(StatusCode::BadIndexRangeNoData),
        };
    };
    let values = array(variable_type, value)?;
    let (first, last) = match *range {
        NumericRange::None if values.len() != usize::from(elements) => return Err(StatusCode::BadOutOfRange),
        NumericRange::None => return Ok(vec![write(id.into(), values.into_iter().flatten().collect())]),
        NumericRange::Index(element) => (element, element),
        NumericRange::Range(first, last) => (first, last),
        NumericRange::MultipleRanges(_) => return Err(StatusCode::BadWriteNotSupported),
    };
    if first > last || last >= u32::from(elements) {
        return Err(StatusCode::BadIndexRangeNoData);
    }
    let places = (0..elements).filter(|element| (first..=last).contains(&u32::from(*element)));
    if places.clone().count() != values.len() {
        return Err(StatusCode::BadIndexRangeDataMismatch);
    }
    Ok(places.zip(values).map(|(element, value)| write(id.element(element), value)).collect())
}

fn write(target: plc::Target, value: VariableValue) -> Change {
    Change { target, operation: Operation::Write(value) }
}

/// The elements of an array. A ByteString is accepted as an array of Byte (OPC 10000-4, Write).
fn array(variable_type: VariableType, value: &Variant) -> Result<Vec<VariableValue>, StatusCode> {
    match value {
        Variant::Array(array) if array.dimensions.as_ref().is_none_or(|dimensions| dimensions.len() == 1) => {
            array.values.iter().map(|value| octets(variable_type, value)).collect()
        }
        Variant::ByteString(bytes) if scalar_type(variable_type) == VariantScalarTypeId::Byte => {
            let bytes = bytes.value.iter().flatten();
            bytes.map(|byte| octets(variable_type, &Variant::Byte(*byte))).collect()
        }
        _ => Err(StatusCode::BadTypeMismatch),
    }
}

/// One scalar of exactly this type: a client that sends another type means another value.
fn octets(variable_type: VariableType, value: &Variant) -> Result<VariableValue, StatusCode> {
    let octets: VariableValue = match (scalar_type(variable_type), value) {
        (VariantScalarTypeId::Boolean, Variant::Boolean(value)) => [u8::from(*value)].into_iter().collect(),
        (VariantScalarTypeId::Byte, Variant::Byte(value)) => [*value].into_iter().collect(),
        (VariantScalarTypeId::UInt16, Variant::UInt16(value)) => value.to_le_bytes().into_iter().collect(),
        (VariantScalarTypeId::UInt32, Variant::UInt32(value)) => value.to_le_bytes().into_iter().collect(),
        (VariantScalarTypeId::UInt64, Variant::UInt64(value)) => value.to_le_bytes().into_iter().collect(),
        _ => return Err(StatusCode::BadTypeMismatch),
    };
    Ok(octets)
}
