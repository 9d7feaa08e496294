//! The likely meaning of an unknown word.

use super::super::keyword::Keyword;
use crate::elementary::Elementary;

/// Words of other languages and dialects, which are recognized without a similar spelling.
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

/// The one of `candidates` that `text` resembles.
pub(super) fn nearest(text: &str, candidates: &[Keyword]) -> Option<Keyword> {
    let text = text.to_ascii_uppercase();
    let other = OTHER_WORDS.iter().find(|(word, keyword)| *word == text && candidates.contains(keyword));
    if let Some((_, keyword)) = other {
        return Some(*keyword);
    }
    let distance = |keyword: &Keyword| strsim::damerau_levenshtein(&text, keyword.word());
    // With two wrong letters in a word of four, half of all names would match a keyword.
    let allowed = if text.len() > 5 { 2 } else { 1 };
    // The table of distances is as large as the length of the text, and all keywords are much shorter than this
    // limit. A single letter resembles nothing.
    // looks like nothing.
    let is_comparable = (2..24).contains(&text.len());
    let best = candidates.iter().filter(|_| is_comparable).min_by_key(|keyword| distance(keyword))?;
    (distance(best) <= allowed).then_some(*best)
}

/// Whether `text` is the name of a type, which nothing else may have. DT is free: many programs use it as the
/// name of a time step.
pub(super) fn is_type_word(text: &str) -> bool {
    let is_type = Elementary::named(text).is_some() || text.eq_ignore_ascii_case("STRING");
    is_type && !text.eq_ignore_ascii_case("DT")
}

/// The remedy for a pointer.
pub(super) const INSTEAD_OF_A_POINTER: &str = "pass the variable to the function or block as VAR_IN_OUT";

/// Whether `text` begins the type of a pointer.
pub(super) fn is_pointer(text: &str) -> bool {
    ["POINTER", "REF_TO", "REFERENCE"].iter().any(|word| word.eq_ignore_ascii_case(text))
}
