//! The character set of a text with few non-ASCII letters: comments with a unit, a name, a word or two.
//!
//! Letter statistics fail there, so each word is examined: kana and kanji of Shift-JIS, or single letters and signs
//! of Latin-1 between ASCII.

use core::ops::RangeInclusive;

use encoding_rs::SHIFT_JIS as DECODER;

pub(super) const LATIN: &str = "Latin-1";
const SHIFT_JIS: &str = "Shift_JIS";

/// Maximum number of non-ASCII bytes of a text that is recognized as Latin-1 by its letters.
const FEW_BYTES: usize = 24;

/// The likely character sets, the most likely first; none if the letters are not conclusive.
pub(super) fn guessed(bytes: &[u8]) -> Option<&'static [&'static str]> {
    match (japanese(bytes), is_latin(bytes)) {
        (Japanese::Surely, _) | (Japanese::Kanji, false) => Some(&[SHIFT_JIS]),
        (Japanese::Kanji | Japanese::HalfWidth, true) => Some(&[LATIN, SHIFT_JIS]),
        (Japanese::Hardly, true) => Some(&[LATIN]),
        (Japanese::Hardly | Japanese::HalfWidth, false) => None,
    }
}

/// The result of the statistics, and Shift-JIS if the text can be words of half-width kana, the more likely first.
pub(super) fn with_half_width_kana(bytes: &[u8], by_statistics: &'static str) -> Vec<&'static str> {
    if japanese(bytes) != Japanese::HalfWidth {
        return vec![by_statistics];
    }
    // No language of Latin script has words of such letters alone; kana of the first rows are no letters elsewhere.
    let are_kana =
        LATIN_SCRIPTS.contains(&by_statistics) || bytes.iter().any(|byte| FIRST_ROWS.contains(byte));
    match are_kana && !TWO_BYTES.contains(&by_statistics) {
        true => vec![SHIFT_JIS, by_statistics],
        false => vec![by_statistics, SHIFT_JIS],
    }
}

/// Character sets whose non-ASCII letters stand between ASCII letters.
const LATIN_SCRIPTS: [&str; 7] =
    [LATIN, "windows-1250", "windows-1254", "windows-1257", "windows-1258", "ISO-8859-2", "ISO-8859-4"];
/// Character sets with two bytes for a character.
const TWO_BYTES: [&str; 6] = ["GBK", "gb18030", "Big5", "EUC-JP", "EUC-KR", SHIFT_JIS];
/// The half-width kana from ｱ to ｿ.
const FIRST_ROWS: RangeInclusive<u8> = 0xB1..=0xBF;

/// How much of a text in Shift-JIS resembles Japanese.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Japanese {
    /// It is none, or all of it can be letters of other character sets.
    Hardly,
    /// Half-width kana, which are letters and signs in many other character sets.
    HalfWidth,
    /// A single kanji, which can be a quotation mark and a letter.
    Kanji,
    /// Kana, or words of kanji.
    Surely,
}

fn japanese(bytes: &[u8]) -> Japanese {
    let Some(text) = DECODER.decode_without_bom_handling_and_without_replacement(bytes) else {
        return Japanese::Hardly;
    };
    if !text.chars().all(|character| character.is_ascii() || is_japanese(character)) {
        return Japanese::Hardly;
    }
    if text.chars().any(|character| matches!(character, '\u{3041}'..='\u{30FE}')) {
        return Japanese::Surely;
    }
    words(bytes).map(|word| word.japanese()).max().unwrap_or(Japanese::Hardly)
}

/// Kana, kanji, punctuation, and letters of full or half width.
const fn is_japanese(character: char) -> bool {
    matches!(character, '\u{3000}'..='\u{30FF}' | '\u{4E00}'..='\u{9FFF}' | '\u{FF01}'..='\u{FF9F}')
        || matches!(character, '\u{2010}'..='\u{2312}' | '\u{2460}'..='\u{266F}' | '\u{D7}' | '\u{B0}' | '\u{B1}')
}

/// Non-ASCII characters of Shift-JIS, one after the other.
struct Word {
    characters: usize,
    /// The first byte and, for a character of two bytes, the second one.
    first: (u8, Option<u8>),
    /// One of them begins with a byte that is a control character in Latin-1.
    has_low_lead: bool,
    follows_letter: bool,
}

/// Bytes that begin a character of two bytes, and are control characters in Latin-1.
const LOW_LEADS: RangeInclusive<u8> = 0x81..=0x9F;
/// Quotation marks and dashes in windows-1252.
const QUOTES: RangeInclusive<u8> = 0x91..=0x97;

impl Word {
    fn japanese(&self) -> Japanese {
        let (lead, trail) = self.first;
        match (self.has_low_lead, self.characters) {
            (true, 2..) => Japanese::Surely,
            (true, _) if !self.follows_letter && !QUOTES.contains(&lead) => Japanese::Surely,
            (true, _) => Japanese::Kanji,
            // Letters such as `é` begin a kanji whose second byte is the next letter.
            (false, _) if trail.is_some_and(|trail| trail.is_ascii()) => Japanese::Hardly,
            (false, 2..) => Japanese::HalfWidth,
            (false, _) => Japanese::Hardly,
        }
    }
}

/// The words of a valid text in Shift-JIS.
fn words(bytes: &[u8]) -> impl Iterator<Item = Word> {
    let mut at = 0;
    core::iter::from_fn(move || {
        at += bytes.get(at..)?.iter().position(|byte| !byte.is_ascii())?;
        let follows_letter = at.checked_sub(1).and_then(|before| bytes.get(before));
        let follows_letter = follows_letter.is_some_and(u8::is_ascii_alphabetic);
        let first = (*bytes.get(at)?, None);
        let mut word = Word { characters: 0, first, has_low_lead: false, follows_letter };
        while let Some(lead) = bytes.get(at).copied().filter(|byte| !byte.is_ascii()) {
            let is_single = matches!(lead, 0xA1..=0xDF);
            if word.characters == 0 && !is_single {
                word.first.1 = bytes.get(at + 1).copied();
            }
            word.characters += 1;
            word.has_low_lead |= LOW_LEADS.contains(&lead);
            at += if is_single { 1 } else { 2 };
        }
        Some(word)
    })
}

/// Whether all non-ASCII bytes can be a few letters of Western languages and signs of units.
fn is_latin(bytes: &[u8]) -> bool {
    let letter_at = |at: Option<usize>| at.and_then(|at| bytes.get(at)).is_some_and(u8::is_ascii_alphabetic);
    let mut beyond_ascii = 0;
    let mut at = 0_usize;
    for run in bytes.chunk_by(|one, next| one.is_ascii() == next.is_ascii()) {
        let letters = (letter_at(at.checked_sub(1)), letter_at(Some(at + run.len())));
        at += run.len();
        if run.iter().all(u8::is_ascii) {
            continue;
        }
        beyond_ascii += run.len();
        let fits = match run {
            [one] => is_letter(*one) || is_sign(*one, letters),
            // Two letters are in a word with others.
            [one, two] if is_letter(*one) && is_letter(*two) => letters.0 || letters.1,
            [one, two] => [one, two].iter().all(|byte| is_letter(**byte) || is_sign(**byte, (false, false))),
            _ => false,
        };
        if !fits {
            return false;
        }
    }
    beyond_ascii <= FEW_BYTES
}

const fn is_letter(byte: u8) -> bool {
    byte >= 0xC0 && byte != 0xD7 && byte != 0xF7
}

/// A sign is not inside a word, except for the apostrophe; `letters`: before and after it.
const fn is_sign(byte: u8, letters: (bool, bool)) -> bool {
    const APOSTROPHE: u8 = 0x92;
    match byte {
        APOSTROPHE => true,
        // € … ‘ “ ” – — ™ and £ § © « ® ° ± ² ³ µ · ¹ » ¼ ½ ¾ × ÷
        0x80 | 0x85 | 0x91 | 0x93 | 0x94 | 0x96 | 0x97 | 0x99 => !(letters.0 && letters.1),
        0xA3 | 0xA7 | 0xA9 | 0xAB | 0xAE | 0xB0..=0xB3 | 0xB5 | 0xB7 | 0xB9 | 0xBB..=0xBE | 0xD7 | 0xF7 => {
            !(letters.0 && letters.1)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use encoding_rs::{EUC_JP, Encoding, GBK, WINDOWS_1251, WINDOWS_1252};

    use super::super::guessed;
    use super::*;

    const BOTH: &[&str] = &[LATIN, SHIFT_JIS];

    #[test]
    fn short_lines_of_real_programs() {
        let latin: [(&str, &[&str]); 20] = [
            ("x := 1; // 20 µs", &[LATIN]),
            ("(* µ *)", &[LATIN]),
            ("(* Pause: 250µs *)", &[LATIN]),
            ("(* 20 °C *)", &[LATIN]),
            ("(* ±5 ° *)", &[LATIN]),
            ("(* 3 m², 4 m³/h *)", &[LATIN]),
            ("// §5, ©2024 µ-Tech", &[LATIN]),
            ("(* Zähler *)", &[LATIN]),
            ("(* während *)", &[LATIN]),
            ("(* Größe *)", &[LATIN]),
            ("// Öl", &[LATIN]),
            ("(* éléments répétés *)", &[LATIN]),
            ("// été", &[LATIN]),
            ("// café\n", &[LATIN]),
            ("(* ação *)", &[LATIN]),
            ("(* señal *)", &[LATIN]),
            ("name = \"Förderband\"", &[LATIN]),
            ("(* don’t *)", BOTH),
            ("(* “stop” *)", &[LATIN]),
            ("(* Länge in ½ µm *)", &[LATIN]),
        ];
        let japanese: [(&str, &[&str]); 13] = [
            ("(* 秒 *)", &[SHIFT_JIS]),
            ("T := 10; // 10秒", &[SHIFT_JIS]),
            ("(* 温度 *)", &[SHIFT_JIS]),
            ("// 停止", &[SHIFT_JIS]),
            ("(* カウンタ *)", &[SHIFT_JIS]),
            ("(* ポンプ1 *)", &[SHIFT_JIS]),
            ("x := 1; (* の *)", &[SHIFT_JIS]),
            ("(* 20℃ *)", &[SHIFT_JIS]),
            ("(* 速度:10m/s *)", &[SHIFT_JIS]),
            ("(* プログラム、日本語のコメント *)", &[SHIFT_JIS]),
            ("name = \"装置A\"", &[SHIFT_JIS]),
            ("// エラー", &[SHIFT_JIS]),
            ("(* ｵﾝ *)", BOTH),
        ];
        let lines = latin.map(|(line, names)| (WINDOWS_1252, line, names)).into_iter();
        let lines = lines.chain(japanese.map(|(line, names)| (DECODER, line, names)));
        for (encoding, line, names) in lines {
            assert_eq!(guessed(&written(encoding, line)), names, "{line} in {}", encoding.name());
        }
    }

    #[test]
    fn other_character_sets_are_left_to_statistics() {
        for (encoding, line) in [
            (WINDOWS_1251, "(* Счётчик импульсов *)"),
            (EUC_JP, "(* プログラム *)"),
            (GBK, "(* 计数器 *)"),
            (GBK, "(* 温度 *)"),
        ] {
            assert_eq!(super::guessed(&written(encoding, line)), None, "{line} in {}", encoding.name());
        }
    }

    #[test]
    fn shift_jis_is_named_for_short_texts_of_half_width_kana() {
        for line in ["(* ｶｳﾝﾀ *)", "// ﾎﾟﾝﾌﾟ", "(* ｲﾝﾀｰﾛｯｸ *)", "(* ﾓｰﾀ *)", "x := 1; // ﾘｾｯﾄ", "// ﾃｽﾄ ﾃｽﾄ"]
        {
            let names = guessed(&written(DECODER, line));
            assert!(names.contains(&SHIFT_JIS), "{line}: {names:?}");
        }
        // Two kana can be a character of two bytes; of an odd number of them one is left.
        assert_eq!(guessed(&written(DECODER, "// ﾃｽﾄ")).first(), Some(&SHIFT_JIS));
        let statistics = ["windows-1250", "windows-1251", "GBK"];
        for (line, expected) in
            [("// ﾎﾟﾝﾌﾟ", [SHIFT_JIS, "windows-1251", "GBK"]), ("// ｱﾝﾌﾟ", [SHIFT_JIS, SHIFT_JIS, "GBK"])]
        {
            let first = statistics.map(|name| with_half_width_kana(&written(DECODER, line), name)[0]);
            assert_eq!(first, expected, "{line}");
        }
        assert_eq!(guessed(&written(WINDOWS_1251, "// СЧЁТЧИК")).first(), Some(&"windows-1251"));
    }

    fn written(encoding: &'static Encoding, text: &str) -> Vec<u8> {
        let (bytes, _, has_unmappable) = encoding.encode(text);
        assert!(!has_unmappable, "{text}");
        bytes.into_owned()
    }
}
