//! Names of data types in an ESI file (ETG.2000, ETG.1020), written and read.

use wire::DataType;

/// Base types of a fixed length: code, name, bits.
const BASE_TYPES: [(u16, &str, u16); 44] = [
    (0x0001, "BOOL", 1),
    (0x0002, "SINT", 8),
    (0x0003, "INT", 16),
    (0x0004, "DINT", 32),
    (0x0005, "USINT", 8),
    (0x0006, "UINT", 16),
    (0x0007, "UDINT", 32),
    (0x0008, "REAL", 32),
    (0x000C, "TIME_OF_DAY", 48),
    (0x000D, "TIME_DIFFERENCE", 48),
    (0x0010, "INT24", 24),
    (0x0011, "LREAL", 64),
    (0x0012, "INT40", 40),
    (0x0013, "INT48", 48),
    (0x0014, "INT56", 56),
    (0x0015, "LINT", 64),
    (0x0016, "UINT24", 24),
    (0x0018, "UINT40", 40),
    (0x0019, "UINT48", 48),
    (0x001A, "UINT56", 56),
    (0x001B, "ULINT", 64),
    (0x001D, "GUID", 128),
    (0x001E, "BYTE", 8),
    (0x001F, "WORD", 16),
    (0x0020, "DWORD", 32),
    (0x002D, "BITARR8", 8),
    (0x002E, "BITARR16", 16),
    (0x002F, "BITARR32", 32),
    (0x0030, "BIT1", 1),
    (0x0031, "BIT2", 2),
    (0x0032, "BIT3", 3),
    (0x0033, "BIT4", 4),
    (0x0034, "BIT5", 5),
    (0x0035, "BIT6", 6),
    (0x0036, "BIT7", 7),
    (0x0037, "BIT8", 8),
    (0x0038, "BIT9", 9),
    (0x0039, "BIT10", 10),
    (0x003A, "BIT11", 11),
    (0x003B, "BIT12", 12),
    (0x003C, "BIT13", 13),
    (0x003D, "BIT14", 14),
    (0x003E, "BIT15", 15),
    (0x003F, "BIT16", 16),
];

/// Types that are an array of a base type: code, name of the base type, bits of an element.
const ARRAY_TYPES: [(u16, &str, u16); 6] = [
    (0x000A, "BYTE", 8),
    (0x000B, "UINT", 16),
    (0x0260, "INT", 16),
    (0x0261, "SINT", 8),
    (0x0262, "DINT", 32),
    (0x0263, "UDINT", 32),
];

/// The contents of a data type.
#[cfg(feature = "write")]
pub(crate) enum Shape {
    /// Only bits.
    Base,
    /// Elements of a base type.
    Array {
        /// Name of the base type.
        base: &'static str,
        /// Bits of an element.
        element_bits: u16,
    },
}

/// Name of a data type for an entry of `bit_length` bits: `UINT`, `STRING(20)`, `ARRAY [0..9] OF BYTE`.
#[cfg(feature = "write")]
pub(crate) fn name(data_type: DataType, bit_length: u16) -> String {
    if let Some((_, name, _)) = BASE_TYPES.iter().find(|(code, ..)| *code == data_type.0) {
        return (*name).into();
    }
    match shape(data_type, bit_length) {
        Shape::Array { base, element_bits } => {
            let last = (bit_length / element_bits).saturating_sub(1);
            format!("ARRAY [0..{last}] OF {base}")
        }
        Shape::Base if data_type == DataType::VISIBLE_STRING => format!("STRING({})", bit_length / 8),
        Shape::Base => format!("BITARR{bit_length}"),
    }
}

/// The name of the type and, of an array, the number of elements; none for what has no such name.
#[must_use]
pub fn element_type(data_type: DataType, bit_length: u16) -> Option<(&'static str, Option<u16>)> {
    let base = BASE_TYPES.iter().find(|(code, _, bits)| (*code, *bits) == (data_type.0, bit_length));
    let is_array = |bits: u16| bit_length > 0 && bit_length.is_multiple_of(bits);
    let array = ARRAY_TYPES.iter().find(|(code, _, bits)| *code == data_type.0 && is_array(*bits));
    base.map(|(_, name, _)| (*name, None)).or(array.map(|(_, name, bits)| (*name, Some(bit_length / bits))))
}

/// The contents of `data_type`. Whole bytes of an unknown type are bytes.
#[cfg(feature = "write")]
pub(crate) fn shape(data_type: DataType, bit_length: u16) -> Shape {
    let known = |code: u16| BASE_TYPES.iter().any(|(base, ..)| *base == code);
    if known(data_type.0) || data_type == DataType::VISIBLE_STRING {
        return Shape::Base;
    }
    match ARRAY_TYPES.iter().find(|(code, _, bits)| *code == data_type.0 && bit_length.is_multiple_of(*bits))
    {
        Some((_, base, element_bits)) => Shape::Array { base, element_bits: *element_bits },
        None if bit_length.is_multiple_of(8) => Shape::Array { base: "BYTE", element_bits: 8 },
        None => Shape::Base,
    }
}

/// The type of a name and its bits: `UINT`, `STRING(20)`, `ARRAY [0..9] OF BYTE`; none if the standard has no such name.
pub(crate) fn parse(name: &str) -> Option<(DataType, u32)> {
    if let Some((code, _, bits)) = BASE_TYPES.iter().find(|(_, base, _)| *base == name) {
        return Some((DataType(*code), u32::from(*bits)));
    }
    let text = |prefix: &str| -> Option<u32> {
        name.strip_prefix(prefix)?.strip_prefix('(')?.strip_suffix(')')?.trim().parse().ok()
    };
    let texts = [
        ("STRING", DataType::VISIBLE_STRING, 8),
        ("OCTET_STRING", DataType::OCTET_STRING, 8),
        ("UNICODE_STRING", DataType::UNICODE_STRING, 16),
    ];
    let string = |(prefix, code, bits): (&str, DataType, u32)| Some((code, text(prefix)?.checked_mul(bits)?));
    texts.into_iter().find_map(string).or_else(|| array(name))
}

/// `ARRAY [0..9] OF BYTE`.
fn array(name: &str) -> Option<(DataType, u32)> {
    let (bounds, base) = name.strip_prefix("ARRAY")?.trim_start().strip_prefix('[')?.split_once(']')?;
    let (first, last) = bounds.split_once("..")?;
    let (first, last): (u32, u32) = (first.trim().parse().ok()?, last.trim().parse().ok()?);
    let elements = last.checked_sub(first)?.checked_add(1)?;
    array_of(base.trim_start().strip_prefix("OF")?.trim(), elements)
}

/// The type of an array of a base type, and its bits. Arrays without a type of their own are bytes.
pub(crate) fn array_of(base: &str, elements: u32) -> Option<(DataType, u32)> {
    let (_, _, bits) = BASE_TYPES.iter().find(|(_, name, _)| *name == base)?;
    let own = ARRAY_TYPES.iter().find(|(_, name, _)| *name == base).map(|(code, ..)| DataType(*code));
    Some((own.unwrap_or(DataType::OCTET_STRING), elements.checked_mul(u32::from(*bits))?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_type_is_found_by_the_name_that_is_written() {
        for (code, _, bits) in BASE_TYPES {
            assert_eq!(
                parse(&name(DataType(code), bits)),
                Some((DataType(code), bits.into())),
                "{code:#06X}"
            );
        }
        for (code, base, bits) in ARRAY_TYPES {
            assert_eq!(
                parse(&name(DataType(code), 3 * bits)),
                Some((DataType(code), (3 * bits).into())),
                "{base}"
            );
        }
        assert_eq!(parse(&name(DataType::VISIBLE_STRING, 160)), Some((DataType::VISIBLE_STRING, 160)));
    }

    #[test]
    fn what_is_no_name_of_a_type_is_none() {
        for name in [
            "",
            "UINT8",
            "uint",
            "STRING",
            "STRING(x)",
            "ARRAY [3..1] OF BYTE",
            "ARRAY [0..1] OF DT1018",
            "DT1018",
        ] {
            assert_eq!(parse(name), None, "{name}");
        }
        assert_eq!(parse("ARRAY [0..4294967295] OF ULINT"), None);
    }
}
