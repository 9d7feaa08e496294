//! What a word that is not known may have been meant for.

use super::super::keyword::Keyword;
use super::super::literal;
use crate::elementary::Elementary;

/// Words of other languages and dialects for which no letter-by-letter likeness is needed.
const OTHER_WORDS: [(&str, Keyword); 8] = [
    ("ELIF", Keyword::Elsif),
    ("ELSEIF", Keyword::Elsif),
    ("BREAK", Keyword::Exit),
    ("STEP", Keyword::By),
    ("NEXT", Keyword::EndFor),
    ("WEND", Keyword::EndWhile),
    ("ENDSWITCH", Keyword::EndCase),
    ("SWITCH", Keyword::Case),
];

/// The one of `candidates` that `text` looks like.
pub(super) fn nearest(text: &str, candidates: &[Keyword]) -> Option<Keyword> {
    let text = text.to_ascii_uppercase();
    let other = OTHER_WORDS.iter().find(|(word, keyword)| *word == text && candidates.contains(keyword));
    if let Some((_, keyword)) = other {
        return Some(*keyword);
    }
    let distance = |keyword: &Keyword| strsim::damerau_levenshtein(&text, keyword.word());
    // Two wrong letters in a word of four would make half of all names a keyword.
    let allowed = if text.len() > 5 { 2 } else { 1 };
    // The table of distances is as large as the text is long, and no keyword is nearly as long as this. A single letter
    // looks like nothing.
    let is_comparable = (2..24).contains(&text.len());
    let best = candidates.iter().filter(|_| is_comparable).min_by_key(|keyword| distance(keyword))?;
    (distance(best) <= allowed).then_some(*best)
}

/// Whether `text` is a word that names a type, which nothing else may be called.
pub(super) fn is_type_word(text: &str) -> bool {
    Elementary::named(text).is_some() || text.eq_ignore_ascii_case("STRING") || is_unsupported_type(text)
}

/// Whether `text` names a type of the standard that is not supported.
pub(super) fn is_unsupported_type(text: &str) -> bool {
    const OTHERS: [&str; 5] = ["CHAR", "WCHAR", "POINTER", "REF_TO", "REFERENCE"];
    // D, T, DT and their like are prefixes of literals, and free as names.
    let is_date = text.len() > 3 || text.eq_ignore_ascii_case("TOD") || text.eq_ignore_ascii_case("LDT");
    (is_date && literal::is_unsupported(text)) || OTHERS.iter().any(|word| word.eq_ignore_ascii_case(text))
}
