//! The EEPROM: words 0 to 6, the BOOT mailbox, categories of the vendor, a whole image.

use super::element::Element;
use super::place::Place;
use crate::lint::rules;

/// An element `Eeprom`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EepromElement {
    /// Its place.
    pub place: Place,
    /// Its size, if indicated.
    pub size_bytes: Option<u32>,
    /// Words 0 to 6, as many as the file has; longer data have a checksum of their own.
    pub configuration: Option<Vec<u8>>,
    /// Words 0x14 to 0x17.
    pub bootstrap: Option<Vec<u8>>,
    /// Whether the EEPROM belongs to the PDI after its contents are loaded.
    pub assign_to_pdi: bool,
    /// A whole image instead of everything else.
    pub image: Option<Vec<u8>>,
    /// The categories of the vendor: number and contents.
    pub categories: Vec<(u16, Vec<u8>)>,
}

impl EepromElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let bytes = |name| element.value_of(name).and_then(|value| value.bytes());
        Self {
            place: element.place(),
            size_bytes: element.number_of("ByteSize"),
            configuration: bytes("ConfigData"),
            bootstrap: bytes("BootStrap"),
            assign_to_pdi: element.flag("AssignToPdi"),
            image: bytes("Data"),
            categories: element.all("Category").filter_map(category).collect(),
        }
    }
}

/// A category of the vendor, its contents filled up to whole words.
fn category(element: Element<'_>) -> Option<(u16, Vec<u8>)> {
    let number = element.number_of("CatNo")?;
    let data = element.value_of("Data").and_then(|data| data.bytes());
    let text = || element.child("DataString").map(|text| text.text().chars().map(latin).collect());
    let word = || element.number_of::<u16>("DataUINT").map(|word| word.to_le_bytes().to_vec());
    let words = || element.number_of::<u32>("DataUDINT").map(|words| words.to_le_bytes().to_vec());
    let Some(mut bytes) = data.or_else(text).or_else(word).or_else(words) else {
        element.report(rules::CATEGORY_EMPTY, format!("category {number} has no contents; dropped"));
        return None;
    };
    bytes.resize(bytes.len().next_multiple_of(2), 0);
    Some((number, bytes))
}

fn latin(character: char) -> u8 {
    u8::try_from(character).unwrap_or(b'?')
}
