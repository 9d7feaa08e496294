//! Numbers in the notation of the schema, `HexDecValue`: `1234`, `-5`, `#x04D2`.

/// A number as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Written {
    /// Its value; [`i64::MAX`] if it is greater.
    pub(super) value: i64,
    /// Whether it is written as in C, `0x04D2`, which the schema does not permit.
    pub(super) is_as_in_c: bool,
}

/// The number in a text; none if the text is not a number.
pub(super) fn parse(text: &str) -> Option<Written> {
    let text = text.trim();
    let is_as_in_c = text.starts_with("0x") || text.starts_with("0X");
    let hexadecimal = ["#x", "#X", "0x", "0X"].iter().find_map(|prefix| text.strip_prefix(prefix));
    let value = match hexadecimal {
        Some(digits) => digits_of(digits.trim(), 16)?,
        None => match text.strip_prefix('-') {
            Some(digits) => -digits_of(digits, 10)?,
            None => digits_of(text.strip_prefix('+').unwrap_or(text), 10)?,
        },
    };
    Some(Written { value, is_as_in_c })
}

fn digits_of(digits: &str, radix: u32) -> Option<i64> {
    if digits.is_empty() {
        return None;
    }
    digits.chars().try_fold(0_i64, |value, digit| {
        let digit = i64::from(digit.to_digit(radix)?);
        Some(value.saturating_mul(i64::from(radix)).saturating_add(digit))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_real_files() {
        let value = |text| parse(text).map(|written| (written.value, written.is_as_in_c));
        for (text, expected) in [
            ("8067733", Some((8_067_733, false))),
            ("#x07D43052", Some((0x07D4_3052, false))),
            ("#X07d43052", Some((0x07D4_3052, false))),
            ("#x 12", Some((0x12, false))),
            (" #x0000000000000000000000012 ", Some((0x12, false))),
            ("0xF3F", Some((0xF3F, true))),
            ("-2000", Some((-2_000, false))),
            ("+7", Some((7, false))),
            ("#xFFFFFFFFFFFFFFFFFFFFFFFF", Some((i64::MAX, false))),
            ("", None),
            ("#x", None),
            ("-", None),
            ("12a", None),
            ("1.5", None),
            ("--5", None),
        ] {
            assert_eq!(value(text), expected, "{text}");
        }
    }
}
