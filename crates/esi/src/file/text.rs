//! From the bytes of a file to its text: UTF-8, UTF-16 with a byte order mark, ISO 8859-1.

use std::borrow::Cow;

use super::read_error::ReadError;

/// The text of a file.
pub(super) struct Text<'a> {
    /// The text, without a byte order mark.
    pub(super) text: Cow<'a, str>,
    /// Whether the bytes are not in the character set that the file declares: they are read as ISO 8859-1.
    pub(super) is_misdeclared: bool,
}

/// Longest declaration `<?xml … ?>` that is searched for its encoding.
const DECLARATION_BYTES_MAX: usize = 256;

pub(super) fn decode(bytes: &[u8]) -> Result<Text<'_>, ReadError> {
    let right = |text| Ok(Text { text, is_misdeclared: false });
    match bytes {
        [0xFF, 0xFE, rest @ ..] => return right(Cow::Owned(utf_16(rest, u16::from_le_bytes))),
        [0xFE, 0xFF, rest @ ..] => return right(Cow::Owned(utf_16(rest, u16::from_be_bytes))),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let declared = declared(bytes);
    match (declared.to_ascii_lowercase().as_str(), core::str::from_utf8(bytes)) {
        ("iso-8859-1" | "latin1" | "windows-1252", _) => right(Cow::Owned(latin(bytes))),
        (_, Ok(text)) => right(Cow::Borrowed(text)),
        ("" | "utf-8" | "utf8" | "us-ascii", Err(_)) => {
            Ok(Text { text: Cow::Owned(latin(bytes)), is_misdeclared: true })
        }
        (_, Err(_)) => Err(ReadError::Encoding { declared }),
    }
}

/// The name of the character set in the declaration; empty without one.
fn declared(bytes: &[u8]) -> String {
    let head = String::from_utf8_lossy(bytes.get(..DECLARATION_BYTES_MAX).unwrap_or(bytes));
    let declaration =
        head.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")).map(|(inside, _)| inside);
    let value = declaration.and_then(|inside| inside.split_once("encoding")).map(|(_, value)| value);
    let quoted = value.map(|value| value.trim_start_matches([' ', '=']));
    let name = quoted.and_then(|value| value.split(['"', '\'']).nth(1));
    name.unwrap_or_default().trim().to_owned()
}

fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let units = bytes.as_chunks().0.iter().map(|pair| unit(*pair));
    char::decode_utf16(units).map(|decoded| decoded.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
}

/// ISO 8859-1: each byte is the character of its number. Bytes that are control characters in it are those of
/// Windows-1252, which files do not distinguish.
fn latin(bytes: &[u8]) -> String {
    bytes
        .iter()
        .map(|byte| WINDOWS.get(usize::from(byte.wrapping_sub(0x80))).map_or(char::from(*byte), |c| *c))
        .collect()
}

/// The characters 0x80 to 0x9F of Windows-1252; five of them do not exist.
const WINDOWS: [char; 32] = [
    '€', '\u{FFFD}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{FFFD}', 'Ž', '\u{FFFD}',
    '\u{FFFD}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{FFFD}', 'ž', 'Ÿ',
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_in_its_character_set() {
        let utf_16 =
            |bytes: fn(u16) -> [u8; 2]| "\u{FEFF}<ü/>".encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
        let latin = |declared: &str| {
            [format!("<?xml version=\"1.0\" encoding={declared}?><").as_bytes(), b"\xFC\x80/>"].concat()
        };
        for (bytes, ending, is_misdeclared) in [
            ("<ü/>".as_bytes().to_vec(), "<ü/>", false),
            ("\u{FEFF}<ü/>".as_bytes().to_vec(), "<ü/>", false),
            (utf_16(u16::to_le_bytes), "<ü/>", false),
            (utf_16(u16::to_be_bytes), "<ü/>", false),
            (latin("\"ISO-8859-1\""), "<ü€/>", false),
            (latin("'iso-8859-1' "), "<ü€/>", false),
            (latin("\"UTF-8\""), "<ü€/>", true),
        ] {
            let text = decode(&bytes).unwrap();
            assert!(text.text.ends_with(ending), "{}", text.text);
            assert_eq!(text.is_misdeclared, is_misdeclared, "{}", text.text);
        }
        let other = decode(&latin("\"GB2312\"")).err();
        assert_eq!(other, Some(ReadError::Encoding { declared: "GB2312".into() }));
    }
}
