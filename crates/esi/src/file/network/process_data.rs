//! The SyncManagers of a slave as the master sets them.

use wire::ObjectIndex;

use super::super::element::Element;
use super::super::place::Place;

/// The elements of the SyncManagers, by number.
const ELEMENTS: [&str; 16] = [
    "Sm0", "Sm1", "Sm2", "Sm3", "Sm4", "Sm5", "Sm6", "Sm7", "Sm8", "Sm9", "Sm10", "Sm11", "Sm12", "Sm13",
    "Sm14", "Sm15",
];

/// An element `Sm0` to `Sm15`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkSyncManager {
    /// Its place.
    pub place: Place,
    /// Its number.
    pub number: u8,
    /// Its type, as the file has it: `Outputs`, `Inputs`.
    pub type_name: String,
    /// Where its area begins.
    pub start: Option<u16>,
    /// The length of its area.
    pub bytes: Option<u16>,
    /// The control byte.
    pub control: Option<u8>,
    /// Whether it is on; it is if the file does not say.
    pub is_enabled: bool,
    /// The PDOs that are assigned to it, with the place of each.
    pub pdos: Vec<(Place, ObjectIndex)>,
}

impl NetworkSyncManager {
    /// Those in an element `ProcessData`, by their numbers.
    pub(super) fn read_all(process_data: Element<'_>) -> Vec<Self> {
        let numbered = (0_u8..).zip(ELEMENTS);
        let found = numbered.filter_map(|(number, name)| Some((number, process_data.child(name)?)));
        found.map(|(number, element)| Self::read(number, element)).collect()
    }

    fn read(number: u8, element: Element<'_>) -> Self {
        let pdos =
            element.all("Pdo").filter_map(|pdo| Some((pdo.place(), ObjectIndex(pdo.value().wrapping_16()?))));
        Self {
            place: element.place(),
            number,
            type_name: element.text_of("Type").to_owned(),
            start: element.wrapping_16("StartAddress"),
            bytes: element.wrapping_16("DefaultSize"),
            control: element.number_of("ControlByte"),
            is_enabled: element.value_of("Enable").is_none_or(|value| value.flag()),
            pdos: pdos.collect(),
        }
    }
}
