//! Which character set a text that is not UTF-8 is most likely in.

/// The name of the character set, as `iconv` takes it.
#[cfg(feature = "encodings")]
pub(crate) fn guessed(bytes: &[u8]) -> Option<&'static str> {
    use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};

    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    Some(match detector.guess(None, Utf8Detection::Deny).name() {
        // Latin-1 with letters in place of control characters: no file says which of the two it is.
        "windows-1252" => "Latin-1",
        other => other,
    })
}

/// Not known: this build does not look for it.
#[cfg(not(feature = "encodings"))]
pub(crate) const fn guessed(_bytes: &[u8]) -> Option<&'static str> {
    None
}
