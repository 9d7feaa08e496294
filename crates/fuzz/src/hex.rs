//! Bytes in steps: hexadecimal digits, and `5Ax1200` for many equal ones.

use std::fmt;

/// Bytes in hexadecimal digits.
pub(crate) struct Hex<'a>(pub(crate) &'a [u8]);

impl fmt::Display for Hex<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            [first, rest @ ..] if rest.len() > 7 && rest.iter().all(|byte| byte == first) => {
                write!(formatter, "{first:02X}x{}", self.0.len())
            }
            bytes => bytes.iter().try_for_each(|byte| write!(formatter, "{byte:02X}")),
        }
    }
}

/// The bytes for hexadecimal digits; none if there are too many for a frame.
pub(crate) fn hex(text: &str) -> Option<Vec<u8>> {
    const MOST: usize = 4_096;
    if let Some((byte, count)) = text.split_once('x') {
        let count = count.parse().ok().filter(|count| *count <= MOST)?;
        return Some(vec![u8::from_str_radix(byte, 16).ok()?; count]);
    }
    let digits = text.as_bytes();
    let pairs = digits.chunks(2).map(|pair| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok());
    let is_whole = digits.len().is_multiple_of(2) && digits.len() <= 2 * MOST;
    if is_whole { pairs.collect() } else { None }
}
