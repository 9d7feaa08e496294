//! The most likely character set of a text that is not UTF-8.

/// The name of the character set, as `iconv` accepts it.
#[cfg(feature = "encodings")]
pub(crate) fn guessed(bytes: &[u8]) -> Option<&'static str> {
    use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};

    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    Some(match detector.guess(None, Utf8Detection::Deny).name() {
        // Latin-1 with letters in place of control characters: files do not distinguish the two.
        "windows-1252" => "Latin-1",
        other => other,
    })
}

/// Not known: this build does not detect it.
#[cfg(not(feature = "encodings"))]
pub(crate) const fn guessed(_bytes: &[u8]) -> Option<&'static str> {
    None
}
