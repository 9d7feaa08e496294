//! Category 10: every text once, referenced by its number from 1.

use super::image_error::ImageError;

/// Texts of the image in order of first use.
#[derive(Default)]
pub(super) struct StringTable {
    texts: Vec<Vec<u8>>,
}

impl StringTable {
    /// The number of `text`; a new text is added to the table. An empty text is number 0.
    pub(super) fn number(&mut self, text: &str) -> Result<u8, ImageError> {
        let visible: Vec<u8> = text.chars().map(visible).collect();
        if visible.is_empty() {
            return Ok(0);
        }
        if visible.len() > 255 {
            return Err(ImageError::StringTooLong { text: text.into(), length_bytes: visible.len() });
        }
        let at = self.texts.iter().position(|known| *known == visible).unwrap_or_else(|| {
            self.texts.push(visible);
            self.texts.len() - 1
        });
        u8::try_from(at + 1).map_err(|_| ImageError::TooManyStrings { text: text.into() })
    }

    /// The category's payload, of even length.
    pub(super) fn payload(&self) -> Vec<u8> {
        // `number` refuses the 256th text and the 256th character.
        let mut payload = vec![self.texts.len().min(255) as u8];
        for text in self.texts.iter().take(255) {
            payload.push(text.len() as u8);
            payload.extend_from_slice(text);
        }
        payload.resize(payload.len().next_multiple_of(2), 0);
        payload
    }
}

/// Texts of the SII are visible ASCII; anything else becomes a question mark.
fn visible(character: char) -> u8 {
    u8::try_from(character).ok().filter(|byte| (0x20..0x7F).contains(byte)).unwrap_or(b'?')
}
