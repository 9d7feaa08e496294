//! From the bytes of a file to its text.

use crate::encoding;
use crate::kind::{Refusal, Wanted, of_another_kind};
use crate::line_and_column;

/// The mark in front of a text that some editors write.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The text of the file of this name.
///
/// # Errors
/// The file is of another kind than is wanted, or its text is not in UTF-8: what it is, and what helps.
pub fn text(bytes: Vec<u8>, name: &str, wanted: Wanted) -> Result<String, Refusal> {
    if let Some(refusal) = of_another_kind(&bytes, name, wanted) {
        return Err(refusal);
    }
    match String::from_utf8(bytes) {
        Ok(text) if text.contains('\0') => Err(Refusal::new("this is a binary file", wanted.help())),
        Ok(text) => Ok(text.strip_prefix(BYTE_ORDER_MARK).map(str::to_owned).unwrap_or(text)),
        Err(error) => Err(not_utf8(error.as_bytes(), error.utf8_error().valid_up_to(), wanted)),
    }
}

fn not_utf8(bytes: &[u8], wrong: usize, wanted: Wanted) -> Refusal {
    if matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]) {
        return not_utf8_but(Some("UTF-16"), "");
    }
    if bytes.contains(&0) {
        return Refusal::new("this is a binary file", wanted.help());
    }
    let before = String::from_utf8_lossy(bytes.get(..wrong).unwrap_or_default());
    let (line, _) = line_and_column(&before, before.len());
    let byte = bytes.get(wrong).copied().unwrap_or_default();
    not_utf8_but(encoding::guessed(bytes), &format!(": byte 0x{byte:02X} in line {line}"))
}

/// Refuses a text in another character set, which is perhaps known.
fn not_utf8_but(encoding: Option<&str>, place: &str) -> Refusal {
    match encoding {
        Some(encoding) => Refusal::new(
            format!("this text is not UTF-8; it looks like {encoding}{place}"),
            format!("save it as UTF-8, or convert it: iconv -f {encoding} -t UTF-8 FILE > NEW"),
        ),
        None => Refusal::new(format!("this text is not UTF-8{place}"), "save it as UTF-8"),
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

    #[test]
    fn bytes_that_are_no_text_are_told_so() {
        for bytes in [&[0; 64][..], &[0x80, 0, 1, 2], b"x := 1;\0"] {
            assert!(refused(bytes).contains("this is a binary file"), "{}", refused(bytes));
        }
    }

    #[test]
    fn a_byte_order_mark_is_not_part_of_the_text() {
        let read = text("\u{feff}x := 1;".into(), "a.st", Wanted::Program);
        assert_eq!(read, Ok("x := 1;".to_owned()));
    }
}
