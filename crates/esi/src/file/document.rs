//! The bytes of a file as a document, from which its contents are read.

use super::element::Element;
use super::read_error::ReadError;
use super::reading::{self, Reading};
use super::text;
use crate::lint::finding::{Findings, Report};
use crate::lint::rules;

/// What `contents` makes of a document, and what is wrong with it.
pub(super) fn read<T>(
    bytes: &[u8],
    contents: impl for<'a> FnOnce(&'a Reading<'a>) -> Result<T, ReadError>,
) -> Result<(T, Findings), ReadError> {
    if bytes.len() > ReadError::LENGTH_BYTES_MAX {
        return Err(ReadError::TooLong { length_bytes: bytes.len() });
    }
    let text = text::decode(bytes)?;
    let document = reading::parse(&text.text)?;
    let reading = Reading::new(&document, None);
    if text.is_misdeclared {
        let message = "the file is not UTF-8; read as ISO 8859-1".into();
        reading.report(rules::CHARACTER_SET, Element::root(&reading).place(), message);
    }
    let contents = contents(&reading)?;
    Ok((contents, reading.into_findings()))
}
