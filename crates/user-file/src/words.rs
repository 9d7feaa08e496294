//! Text from a file in a message: on one line, without control characters, and not too long.

/// Maximum number of characters of a text in a message.
const SHOWN_CHARACTERS: usize = 40;

/// A number of things: `1 weight`, `2 weights`, `2 entries`.
#[must_use]
pub fn counted(count: usize, noun: &str) -> String {
    match (count, noun.strip_suffix('y')) {
        (1, _) => format!("1 {noun}"),
        (_, Some(stem)) => format!("{count} {stem}ies"),
        (_, None) => format!("{count} {noun}s"),
    }
}

/// How often something is: `once`, `2 times`.
#[must_use]
pub fn times(count: u64) -> String {
    if count == 1 { "once".to_owned() } else { format!("{count} times") }
}

/// The start of a text, on one line.
#[must_use]
pub fn shown(text: &str) -> String {
    let mut characters = text.chars();
    let head: String = characters.by_ref().take(SHOWN_CHARACTERS).flat_map(char::escape_debug).collect();
    if characters.next().is_some() { format!("{head}...") } else { head }
}

/// Longest text that [`shortened`] leaves unchanged.
const WHOLE_CHARACTERS_MAX: usize = 600;

/// A message without its middle part if it is long: the text quoted from a file may have any length.
#[must_use]
pub fn shortened(message: String) -> String {
    if message.chars().nth(WHOLE_CHARACTERS_MAX).is_none() {
        return message;
    }
    let kept = WHOLE_CHARACTERS_MAX / 3;
    let start: String = message.chars().take(kept).collect();
    let end: Vec<char> = message.chars().rev().take(kept).collect();
    start + "…" + &end.into_iter().rev().collect::<String>()
}

/// The text with its control characters escaped, so that a terminal does not interpret them, and with those that hide
/// text or change its order. Line ends are kept.
#[must_use]
pub fn escaped(text: &str) -> String {
    let obeyed = |character: char| (character.is_control() && character != '\n') || hides_text(character);
    if !text.contains(obeyed) {
        return text.to_owned();
    }
    let write = |character: char| -> String {
        if hides_text(character) {
            character.escape_unicode().collect()
        } else if obeyed(character) {
            character.escape_debug().collect()
        } else {
            character.into()
        }
    };
    text.chars().map(write).collect()
}

/// Whether a character is invisible and changes how others are shown: it reverses their order, such as U+202E, separates
/// lines, or has no width. Joiners inside words of some languages are none of them.
#[must_use]
pub const fn hides_text(character: char) -> bool {
    matches!(character, '\u{AD}' | '\u{61C}' | '\u{180E}' | '\u{200B}' | '\u{200E}' | '\u{200F}')
        || matches!(character, '\u{2028}'..='\u{202E}' | '\u{2060}'..='\u{206F}' | '\u{FEFF}')
        || matches!(character, '\u{FFF9}'..='\u{FFFB}' | '\u{E0000}'..='\u{E007F}')
}

/// The text with all its control characters escaped, line ends too: it cannot begin a line of an output.
#[must_use]
pub fn on_one_line(text: &str) -> String {
    let text = escaped(text);
    if text.contains('\n') { text.replace('\n', r"\n") } else { text }
}

/// Line and column of a byte, both from 1, columns in characters.
#[must_use]
pub fn line_and_column(text: &str, byte: usize) -> (usize, usize) {
    let before = text.get(..byte).unwrap_or(text);
    let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (line, column)
}

/// The line numbers of a text, found in one pass for many places.
#[derive(Clone, Debug)]
pub struct LineNumbers {
    /// The byte of each line end.
    ends: Vec<usize>,
}

impl LineNumbers {
    /// Of this text.
    #[must_use]
    pub fn of(text: &str) -> Self {
        Self { ends: text.match_indices('\n').map(|(at, _)| at).collect() }
    }

    /// The number of the line that has this byte, from 1.
    #[must_use]
    pub fn line(&self, byte: usize) -> usize {
        self.ends.partition_point(|end| *end < byte) + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_obeys_nothing_of_what_is_shown() {
        assert_eq!(shown("a\u{1b}[31mb"), "a\\u{1b}[31mb");
        assert_eq!(shown(&"x".repeat(41)), format!("{}...", "x".repeat(40)));
        assert_eq!(escaped("a\u{1b}[2J\r\nb\u{9b}"), "a\\u{1b}[2J\\r\nb\\u{9b}");
        assert_eq!(escaped("plain ü"), "plain ü");
        assert_eq!(escaped("a\u{202E}b\u{200B}c\u{2066}"), "a\\u{202e}b\\u{200b}c\\u{2066}");
        assert_eq!(escaped("\u{645}\u{6CC}\u{200C}\u{62E}"), "\u{645}\u{6CC}\u{200C}\u{62E}");
        assert_eq!(on_one_line("a\nok  b\r\n\u{7}"), r"a\nok  b\r\n\u{7}");
        assert_eq!(on_one_line("plain ü"), "plain ü");
    }

    #[test]
    fn a_long_message_keeps_its_beginning_and_its_end() {
        for whole in ["short".to_owned(), "漢".repeat(250), "ü".repeat(WHOLE_CHARACTERS_MAX)] {
            assert_eq!(shortened(whole.clone()), whole);
        }
        let long = format!("unknown field `{}`, expected `title`", "ü".repeat(1_000));
        let short = shortened(long);
        assert!(short.chars().count() <= WHOLE_CHARACTERS_MAX, "{short}");
        assert!(short.starts_with("unknown field `ü") && short.ends_with("ü`, expected `title`"), "{short}");
    }

    #[test]
    fn many_places_have_the_lines_that_one_has() {
        for text in ["", "\n", "one\ntwo\n\n\u{fc}four", "\r\n\r\n"] {
            let lines = LineNumbers::of(text);
            for byte in (0..=text.len()).filter(|byte| text.is_char_boundary(*byte)) {
                assert_eq!(lines.line(byte), line_and_column(text, byte).0, "{byte} of {text:?}");
            }
        }
    }

    #[test]
    fn one_thing_is_singular() {
        let all = [(0, "weight"), (1, "weight"), (2, "weight"), (1, "entry"), (2, "entry")];
        let words = all.map(|(count, noun)| counted(count, noun));
        assert_eq!(words, ["0 weights", "1 weight", "2 weights", "1 entry", "2 entries"]);
    }

    #[test]
    fn columns_are_characters() {
        assert_eq!(line_and_column("a\nüb", 4), (2, 2));
        assert_eq!(line_and_column("ab", 100), (1, 3));
    }
}
