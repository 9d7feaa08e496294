//! PDOs with their entries.

use wire::ObjectIndex;

use super::element::{Element, Value};
use super::place::Place;
use crate::lint::rules;

/// An index that increases with the slot of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlotIndex {
    /// The index in slot 0.
    pub index: ObjectIndex,
    /// Whether the increment of the slots is added for each further slot.
    pub depends_on_slot: bool,
}

impl SlotIndex {
    /// The number in an element `Index` or `Exclude`.
    pub(super) fn read(element: Element<'_>) -> Option<Self> {
        let index = ObjectIndex(element.value().number()?);
        Some(Self { index, depends_on_slot: element.flag("DependOnSlot") })
    }
}

/// An element `RxPdo` or `TxPdo`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoElement {
    /// Its place.
    pub place: Place,
    /// Index of its mapping object.
    pub index: SlotIndex,
    /// Its name.
    pub name: String,
    /// The SyncManager to which it is assigned by default; none if it is optional.
    pub sync_manager: Option<u8>,
    /// The sync unit that it belongs to, if indicated.
    pub sync_unit: Option<u8>,
    /// Whether its mapping cannot be changed.
    pub fixed: bool,
    /// Whether it must be in the assignment.
    pub mandatory: bool,
    /// Whether it has no mapping object.
    pub is_virtual: bool,
    /// Whether a module replaces it.
    pub overwritten_by_module: bool,
    /// Its place in the order of assignment, if not that of the file.
    pub order: Option<i32>,
    /// Its entries several times in a cycle.
    pub oversampling: Option<Oversampling>,
    /// The PDOs that cannot be assigned together with it.
    pub excludes: Vec<SlotIndex>,
    /// Its entries.
    pub entries: Vec<EntryElement>,
}

/// The attributes `OSFac`, `OSMin`, `OSMax` and `OSIndexInc` of a PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Oversampling {
    /// How often the entries occur, unless an operation mode says otherwise.
    pub factor: u16,
    /// Minimum of the factor.
    pub min: Option<u16>,
    /// Maximum of the factor.
    pub max: Option<u16>,
    /// What is added to the index of the entry for each further copy.
    pub index_increment: u16,
}

/// An element `Entry`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryElement {
    /// Its place.
    pub place: Place,
    /// Index of the mapped object; 0 for padding.
    pub index: SlotIndex,
    /// Subindex of the mapped entry; none if it is left out.
    pub sub: Option<u8>,
    /// Its length.
    pub bit_length: u16,
    /// Its name; empty for padding.
    pub name: String,
    /// The name of its type; empty if it is left out.
    pub type_name: String,
    /// Whether it cannot be removed from the mapping.
    pub fixed: bool,
}

impl EntryElement {
    /// Whether its bits have no contents.
    #[must_use]
    pub const fn is_padding(&self) -> bool {
        self.index.index.0 == 0
    }

    /// An entry of 0 bits has no effect, and is dropped.
    fn read(element: Element<'_>) -> Option<Self> {
        let bit_length = element.number_of("BitLen").unwrap_or(0);
        if bit_length == 0 {
            element.report(rules::ENTRY_WITHOUT_BITS, "the entry has no bits; dropped".into());
            return None;
        }
        let entry = Self {
            place: element.place(),
            index: element.child("Index").and_then(SlotIndex::read).unwrap_or_default(),
            sub: element.number_of("SubIndex"),
            bit_length,
            name: element.localized("Name"),
            type_name: element.text_of("DataType").to_owned(),
            fixed: element.flag("Fixed"),
        };
        if entry.sub.is_none() && !entry.is_padding() {
            let message = format!("the entry of {} has no SubIndex; read as 0", entry.index.index);
            element.report(rules::ENTRY_WITHOUT_SUBINDEX, message);
        }
        Some(entry)
    }
}

impl PdoElement {
    /// Length of all entries in bits.
    #[must_use]
    pub fn bit_length(&self) -> u32 {
        self.entries.iter().map(|entry| u32::from(entry.bit_length)).sum()
    }

    /// A PDO without an index cannot be assigned, and is dropped.
    pub(super) fn read(element: Element<'_>) -> Option<Self> {
        let Some(index) = element.child("Index").and_then(SlotIndex::read) else {
            let name = user_file::shown(&element.localized("Name"));
            element.report(rules::PDO_WITHOUT_INDEX, format!("the PDO `{name}` has no index; dropped"));
            return None;
        };
        let indexes = |name| element.all(name).filter_map(SlotIndex::read).collect();
        Some(Self {
            place: element.place(),
            index,
            name: element.localized("Name"),
            sync_manager: element.number("Sm"),
            sync_unit: element.number("Su"),
            fixed: element.flag("Fixed"),
            mandatory: element.flag("Mandatory"),
            is_virtual: element.flag("Virtual"),
            overwritten_by_module: element.flag("OverwrittenByModule"),
            order: element.number("PdoOrder"),
            oversampling: element.attribute("OSFac").and_then(Value::number).map(|factor| Oversampling {
                factor,
                min: element.number("OSMin"),
                max: element.number("OSMax"),
                index_increment: element.number("OSIndexInc").unwrap_or(0),
            }),
            excludes: indexes("Exclude"),
            entries: element.all("Entry").filter_map(EntryElement::read).collect(),
        })
    }
}
