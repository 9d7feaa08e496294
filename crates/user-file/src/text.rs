//! From the bytes of a file to its text.

use crate::encoding;
use crate::kind::{Refusal, Wanted, of_another_kind};
use crate::line_and_column;

/// The mark before a text that some editors write.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The text of the file of this name.
///
/// # Errors
/// The file is of another kind than required, or its text is not UTF-8: reports the kind, and the remedy.
pub fn text(bytes: Vec<u8>, name: &str, wanted: Wanted) -> Result<String, Refusal> {
    if let Some(refusal) = of_another_kind(&bytes, name, wanted) {
        return Err(refusal);
    }
    let text = exact_text(bytes, wanted)?;
    Ok(text.strip_prefix(BYTE_ORDER_MARK).map(str::to_owned).unwrap_or(text))
}

/// The text of a file that is compared with another text: of any kind, and with its byte order mark.
///
/// # Errors
/// The text is not UTF-8.
pub fn exact_text(bytes: Vec<u8>, wanted: Wanted) -> Result<String, Refusal> {
    match String::from_utf8(bytes) {
        Ok(text) if text.contains('\0') => Err(with_zeros(text.as_bytes(), wanted)),
        Ok(text) => Ok(text),
        Err(error) => Err(not_utf8(error.as_bytes(), error.utf8_error().valid_up_to(), wanted)),
    }
}

fn not_utf8(bytes: &[u8], wrong: usize, wanted: Wanted) -> Refusal {
    if matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]) {
        return not_utf8_but(&["UTF-16"], "");
    }
    if bytes.contains(&0) {
        return with_zeros(bytes, wanted);
    }
    let before = String::from_utf8_lossy(bytes.get(..wrong).unwrap_or_default());
    let (line, _) = line_and_column(&before, before.len());
    let byte = bytes.get(wrong).copied().unwrap_or_default();
    not_utf8_but(&encoding::guessed(bytes), &format!(": byte 0x{byte:02X} in line {line}"))
}

/// Refuses a text in another character set: perhaps one of these, the most likely first.
fn not_utf8_but(encodings: &[&str], place: &str) -> Refusal {
    let Some(likeliest) = encodings.first() else {
        return Refusal::new(format!("this text is not UTF-8{place}"), "save it as UTF-8");
    };
    let convert = |encoding| format!("iconv -f {encoding} -t UTF-8 FILE > NEW");
    let others: String = encodings.iter().skip(1).map(|other| format!(", or: {}", convert(other))).collect();
    Refusal::new(
        format!("this text is not UTF-8; it looks like {}{place}", encodings.join(" or ")),
        format!("save it as UTF-8, or convert it: {}{others}", convert(likeliest)),
    )
}

/// A text in UTF-8 has no byte 0.
fn with_zeros(bytes: &[u8], wanted: Wanted) -> Refusal {
    match utf_16_without_mark(bytes) {
        Some(encoding) => not_utf8_but(&[encoding], ""),
        None => Refusal::new("this is a binary file", wanted.help()),
    }
}

/// The byte order of a text in UTF-16 without byte order mark: all its code units are characters of a text, and
/// at least a third of them are ASCII.
fn utf_16_without_mark(bytes: &[u8]) -> Option<&'static str> {
    let is_text = |unit_of: fn([u8; 2]) -> u16| {
        let (units, rest) = bytes.as_chunks::<2>();
        let (mut ascii, mut all) = (0, 0);
        for character in char::decode_utf16(units.iter().map(|unit| unit_of(*unit))) {
            match character {
                Ok(character) if !character.is_control() || "\t\n\r".contains(character) => {
                    all += 1;
                    ascii += usize::from(character.is_ascii());
                }
                _ => return false,
            }
        }
        rest.is_empty() && 3 * ascii >= all
    };
    match () {
        () if is_text(u16::from_le_bytes) => Some("UTF-16LE"),
        () if is_text(u16::from_be_bytes) => Some("UTF-16BE"),
        () => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(bytes: &[u8]) -> String {
        let Refusal { message, help } = text(bytes.to_vec(), "a.st", Wanted::Program).expect_err("not UTF-8");
        format!("{message} ({help})")
    }

    #[cfg(feature = "encodings")]
    #[test]
    fn a_text_in_another_character_set_is_told_which() {
        // "(* プログラム *)" and "(* Zähler für Öl *)".
        let shift_jis = b"x := 1;\n(* \x83\x76\x83\x8D\x83\x4F\x83\x89\x83\x80 *)\n";
        assert!(
            refused(shift_jis).contains("looks like Shift_JIS: byte 0x83 in line 2"),
            "{}",
            refused(shift_jis)
        );
        assert!(refused(shift_jis).contains("iconv -f Shift_JIS -t UTF-8"));
        for latin in [&b"(* Z\xE4hler f\xFCr \xD6l *)\nx := 1;\n"[..], b"(* 20 \xB0C *)\n", b"// caf\xE9\n"] {
            assert!(refused(latin).contains("looks like Latin-1: byte 0x"), "{}", refused(latin));
        }
        for utf_16 in [&b"\xFF\xFEx\0:\0=\0"[..], b"\xFE\xFF\0x\0:"] {
            assert!(refused(utf_16).contains("looks like UTF-16"), "{}", refused(utf_16));
        }
    }

    #[cfg(feature = "encodings")]
    #[test]
    fn two_character_sets_are_named_where_either_can_be_meant() {
        let words = refused(b"(* don\x92t *)\n");
        assert!(words.contains("it looks like Latin-1 or Shift_JIS: byte 0x92 in line 1"), "{words}");
        assert!(words.contains("NEW, or: iconv -f Shift_JIS -t UTF-8"), "{words}");
    }

    #[test]
    fn utf_16_without_a_mark_is_told_with_the_order_of_its_bytes() {
        let japanese = "(* プログラム、日本語のコメント *)\r\nx := 1;\r\n";
        for text in ["x := 1;\n", "\tmodel = \"nx-ect101\"\r\n", "(* Zähler *)", japanese] {
            let units: Vec<u16> = text.encode_utf16().collect();
            let little: Vec<u8> = units.iter().flat_map(|unit| unit.to_le_bytes()).collect();
            let big: Vec<u8> = units.iter().flat_map(|unit| unit.to_be_bytes()).collect();
            for (bytes, name) in [(little, "UTF-16LE"), (big, "UTF-16BE")] {
                let told = refused(&bytes);
                assert!(told.contains(&format!("looks like {name} (")), "{text}: {told}");
                assert!(told.contains(&format!("iconv -f {name} -t UTF-8")), "{text}: {told}");
            }
        }
    }

    #[test]
    fn bytes_that_are_no_text_are_told_so() {
        for bytes in [
            &[0; 64][..],
            &[0x80, 0, 1, 2],
            b"x := 1;\0",
            b"x\0:\0\0\0",
            b"x\0:\0=",
            b"\x7FELF\x02\x01\x01\0",
        ] {
            assert!(refused(bytes).contains("this is a binary file"), "{}", refused(bytes));
        }
    }

    #[test]
    fn a_byte_order_mark_is_not_part_of_the_text() {
        let read = text("\u{feff}x := 1;".into(), "a.st", Wanted::Program);
        assert_eq!(read, Ok("x := 1;".to_owned()));
    }
}
