//! Damage to texts: lines, words and signs that are removed, doubled, exchanged or replaced.

use crate::random::Random;

/// Maximum length of a text after damage.
const LONGEST: usize = 1 << 16;

/// Characters that are inserted between others.
#[rustfmt::skip]
const SIGNS: &[&str] = &[
    " ", "\n", "\t", "\r\n", "\"", "'", "\"\"\"", "{", "}", "[", "]", "(", ")", "=", ":=", "..", ",", ";", ":", "#",
    "//", "(*", "*)", ".", "-", "\\", "\\u0000", "\0", "\u{7F}", "\u{FEFF}", "ä", "日本", "\u{202E}", "😀",
];

/// A text with damage in a few places. `words` belong to its language; `others` are texts of its kind.
pub(crate) fn damaged(text: &str, words: &[&str], others: &[String], random: &mut Random) -> String {
    let mut text = text.to_owned();
    for _ in 0..random.between(1, 4) {
        text = if random.once_in(3) {
            with_other_lines(&text, others, random)
        } else {
            with_other_words(&text, words, random)
        };
    }
    cut(&mut text);
    text
}

fn cut(text: &mut String) {
    let mut end = LONGEST.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    text.truncate(end);
}

fn with_other_lines(text: &str, others: &[String], random: &mut Random) -> String {
    let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
    let (at, other) = (random.below(lines.len()), random.below(lines.len()));
    let stranger = if others.is_empty() { "" } else { random.one_of(others) };
    let strange: Vec<&str> = stranger.split_inclusive('\n').collect();
    if lines.is_empty() {
        return stranger.to_owned();
    }
    match random.below(7) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(at, lines[other]),
        2 => lines.swap(at, other),
        3 => lines.truncate(at),
        4 if random.once_in(8) => {
            let times = random.between(2, 200);
            lines.splice(at..at, std::iter::repeat_n(lines[other], times).collect::<Vec<_>>());
        }
        _ if !strange.is_empty() => {
            let from = random.below(strange.len());
            let end = (from + random.between(1, 5)).min(strange.len());
            lines.splice(at..at, strange[from..end].iter().copied());
        }
        _ => {}
    }
    lines.concat()
}

fn with_other_words(text: &str, words: &[&str], random: &mut Random) -> String {
    let tokens = tokens(text);
    let mut tokens: Vec<&str> = tokens;
    let fresh = fresh(words, random);
    if tokens.is_empty() {
        return fresh;
    }
    let (at, other) = (random.below(tokens.len()), random.below(tokens.len()));
    match random.below(8) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(at, tokens[other]),
        2 => tokens.swap(at, other),
        3 => tokens[at] = tokens[other],
        4 => tokens.insert(at, &fresh),
        5 if random.once_in(10) => {
            let times = random.between(2, 2_000);
            tokens.splice(at..at, std::iter::repeat_n(tokens[other], times).collect::<Vec<_>>());
        }
        6 if random.once_in(4) => tokens.truncate(at),
        _ => tokens[at] = &fresh,
    }
    tokens.concat()
}

/// A word, a sign or a number.
fn fresh(words: &[&str], random: &mut Random) -> String {
    match random.below(4) {
        0 => (*random.one_of(SIGNS)).to_owned(),
        1 => number(random),
        _ if words.is_empty() => number(random),
        _ => (*random.one_of(words)).to_owned(),
    }
}

/// A number as in files.
pub(crate) fn number(random: &mut Random) -> String {
    let number = random.number();
    match random.below(8) {
        0 => format!("-{number}"),
        1 => format!("0x{number:X}"),
        2 => format!("{number}.5"),
        3 => format!("{}e{}", number % 10, random.below(400)),
        _ => number.to_string(),
    }
}

/// Words, numbers and signs; together they are the whole text.
pub(crate) fn tokens(text: &str) -> Vec<&str> {
    let is_word = |character: char| character.is_alphanumeric() || character == '_';
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = if is_word(first) {
            rest.find(|character| !is_word(character)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, behind) = rest.split_at(end);
        tokens.push(token);
        rest = behind;
    }
    tokens
}
