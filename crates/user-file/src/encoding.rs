//! The possible character sets of a text that is not UTF-8.

#[cfg(feature = "encodings")]
mod by_letters;

/// The names of the likely character sets, as `iconv` accepts them, the most likely first; none if it is unknown.
#[cfg(feature = "encodings")]
pub(crate) fn guessed(bytes: &[u8]) -> Vec<&'static str> {
    match by_letters::guessed(bytes) {
        Some(names) => names.to_vec(),
        None => by_letters::with_half_width_kana(bytes, by_statistics(bytes)),
    }
}

/// Not known: this build does not detect it.
#[cfg(not(feature = "encodings"))]
pub(crate) const fn guessed(_bytes: &[u8]) -> Vec<&'static str> {
    Vec::new()
}

/// The result of letter frequencies, which needs a text of some length.
#[cfg(feature = "encodings")]
fn by_statistics(bytes: &[u8]) -> &'static str {
    use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};

    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    match detector.guess(None, Utf8Detection::Deny).name() {
        // Latin-1 with letters in place of control characters: files do not distinguish the two.
        "windows-1252" => by_letters::LATIN,
        other => other,
    }
}
