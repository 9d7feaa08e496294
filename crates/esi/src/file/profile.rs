//! Profiles: their numbers, the dictionary, the texts of the diagnosis history.

use std::sync::Arc;

use super::dictionary::DictionaryElement;
use super::element::Element;
use super::place::Place;
use crate::DiagMessage;

/// An element `Profile`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProfileElement {
    /// Its place.
    pub place: Place,
    /// The number of the profile, such as 5001 or 402.
    pub number: Option<u16>,
    /// What the device type adds to it in its high word.
    pub add_info: Option<u16>,
    /// The dictionary: the one in the element, or that of its external file.
    pub dictionary: Option<Arc<DictionaryElement>>,
    /// The name of the external file with the dictionary.
    pub dictionary_file: Option<String>,
    /// The texts of the diagnosis history.
    pub diag_messages: Vec<DiagMessage>,
}

impl ProfileElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        // The number is in the element itself, or in its channels, all of which have the same one.
        let numbered = element.child("ChannelInfo").unwrap_or(element);
        let texts =
            element.all("DiagMessages").flat_map(|texts| texts.all("DiagMessage").collect::<Vec<_>>());
        let file = element.text_of("DictionaryFile");
        Self {
            place: element.place(),
            number: element.number_of("ProfileNo").or_else(|| numbered.number_of("ProfileNo")),
            add_info: element.number_of("AddInfo").or_else(|| numbered.number_of("AddInfo")),
            dictionary: element.child("Dictionary").map(DictionaryElement::read).map(Arc::new),
            dictionary_file: (!file.is_empty()).then(|| file.to_owned()),
            diag_messages: texts.filter_map(diag_message).collect(),
        }
    }

    /// Device type, object 0x1000.
    #[must_use]
    pub fn device_type(&self) -> u32 {
        u32::from(self.add_info.unwrap_or(0)) << 16 | u32::from(self.number.unwrap_or(0))
    }
}

fn diag_message(element: Element<'_>) -> Option<DiagMessage> {
    Some(DiagMessage { text_id: element.number_of("TextId")?, text: element.localized("MessageText") })
}
