//! The dictionary: data types and objects, as the file has them.

use objects::AccessRights;
use wire::ObjectIndex;

use super::element::Element;
use super::pdo::SlotIndex;
use super::place::Place;
use crate::lint::rules;

/// An element `Dictionary`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DictionaryElement {
    /// Its place.
    pub place: Place,
    /// Its data types.
    pub data_types: Vec<DataTypeElement>,
    /// Its objects.
    pub objects: Vec<ObjectElement>,
}

/// An element `DataType`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataTypeElement {
    /// Its place.
    pub place: Place,
    /// Its name.
    pub name: String,
    /// The name of the type that it restricts, or of the elements of an array.
    pub base_type: String,
    /// Its size.
    pub bit_size: u32,
    /// The bounds of an array: the first index and the number of elements.
    pub array: Option<(u8, u16)>,
    /// The parts of a record or array object.
    pub sub_items: Vec<SubItemElement>,
}

/// An element `SubItem` of a data type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SubItemElement {
    /// Its place.
    pub place: Place,
    /// Its subindex; none if it is left out.
    pub sub: Option<u8>,
    /// Its name.
    pub name: String,
    /// The name of its type.
    pub type_name: String,
    /// Its size.
    pub bit_size: u32,
    /// Its offset in complete access, if indicated.
    pub bit_offset: Option<u32>,
    /// Access rights, and purposes.
    pub flags: Flags,
}

/// An element `Flags`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Flags {
    /// The rights that `Access` gives; none without that element.
    pub access: Option<AccessRights>,
    /// Mapping, backup and setting, as SDO information shows them.
    pub purposes: AccessRights,
    /// Whether complete access is permitted, if indicated.
    pub complete_access: Option<bool>,
}

impl Default for Flags {
    fn default() -> Self {
        Self { access: None, purposes: AccessRights::empty(), complete_access: None }
    }
}

/// An element `Object`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ObjectElement {
    /// Its place.
    pub place: Place,
    /// Its index.
    pub index: SlotIndex,
    /// Its name.
    pub name: String,
    /// The name of its type.
    pub type_name: String,
    /// Its size.
    pub bit_size: u32,
    /// Its value, if it is a variable.
    pub values: Values,
    /// The names and values of its subindexes.
    pub sub_items: Vec<(String, Values)>,
    /// Access rights, and purposes.
    pub flags: Flags,
}

/// The values in an element `Info`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Values {
    /// Value at power-on.
    pub default: Option<Given>,
    /// The least value that a write may set.
    pub min: Option<Given>,
    /// The greatest value that a write may set.
    pub max: Option<Given>,
}

/// A value as the file gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Given {
    /// Bytes in the order of an SDO: `DefaultData`.
    Data(Vec<u8>),
    /// A number: `DefaultValue`.
    Number(i64),
    /// A text: `DefaultString`.
    Text(String),
}

impl DictionaryElement {
    pub(super) fn read(element: Element<'_>) -> Self {
        let all =
            |list, name| element.child(list).into_iter().flat_map(move |list: Element<'_>| list.all(name));
        Self {
            place: element.place(),
            data_types: all("DataTypes", "DataType").map(DataTypeElement::read).collect(),
            objects: all("Objects", "Object").filter_map(ObjectElement::read).collect(),
        }
    }
}

impl DataTypeElement {
    fn read(element: Element<'_>) -> Self {
        let array = element.child("ArrayInfo");
        Self {
            place: element.place(),
            name: element.text_of("Name").to_owned(),
            base_type: element.text_of("BaseType").to_owned(),
            bit_size: element.number_of("BitSize").unwrap_or(0),
            array: array.and_then(|array| Some((array.number_of("LBound")?, array.number_of("Elements")?))),
            sub_items: element.all("SubItem").filter_map(SubItemElement::read).collect(),
        }
    }
}

impl SubItemElement {
    fn read(element: Element<'_>) -> Option<Self> {
        let number = element.value_of("SubIdx");
        let sub = number.and_then(|number| number.number());
        if number.is_some() && sub.is_none() {
            return None;
        }
        Some(Self {
            place: element.place(),
            sub,
            name: element.localized("Name"),
            type_name: element.text_of("Type").to_owned(),
            bit_size: element.number_of("BitSize").unwrap_or(0),
            bit_offset: element.number_of("BitOffs"),
            flags: element.child("Flags").map(Flags::read).unwrap_or_default(),
        })
    }
}

impl ObjectElement {
    /// The lowest index of an object: below are data types.
    const INDEX_MIN: u16 = 0x1000;

    fn read(element: Element<'_>) -> Option<Self> {
        let index = element.child("Index").and_then(SlotIndex::read);
        let Some(index) = index.filter(|index| index.index >= ObjectIndex(Self::INDEX_MIN)) else {
            let name = user_file::shown(&element.localized("Name"));
            let message = format!("the object `{name}` has no index from 0x1000 to 0xFFFF; dropped");
            element.report(rules::OBJECT_INDEX, message);
            return None;
        };
        let info = element.child("Info");
        let sub_item = |item: Element<'_>| {
            (item.localized("Name"), item.child("Info").map(Values::read).unwrap_or_default())
        };
        Some(Self {
            place: element.place(),
            index,
            name: element.localized("Name"),
            type_name: element.text_of("Type").to_owned(),
            bit_size: element.number_of("BitSize").unwrap_or(0),
            values: info.map(Values::read).unwrap_or_default(),
            sub_items: info.map(|info| info.all("SubItem").map(sub_item).collect()).unwrap_or_default(),
            flags: element.child("Flags").map(Flags::read).unwrap_or_default(),
        })
    }
}

impl Values {
    fn read(info: Element<'_>) -> Self {
        Self {
            default: Given::read(info, ["DefaultData", "DefaultValue", "DefaultString"]),
            min: Given::read(info, ["MinData", "MinValue", ""]),
            max: Given::read(info, ["MaxData", "MaxValue", ""]),
        }
    }
}

impl Given {
    fn read(info: Element<'_>, [data, value, text]: [&'static str; 3]) -> Option<Self> {
        if let Some(data) = info.value_of(data) {
            return data.bytes().map(Self::Data);
        }
        if let Some(number) = info.number_of(value) {
            return Some(Self::Number(number));
        }
        info.child(text).map(|text| Self::Text(text.text().to_owned()))
    }
}

/// States by their names in restrictions, with the rights to read and to write.
const STATES: [(&str, AccessRights, AccessRights); 3] = [
    ("preop", AccessRights::READ_PRE_OP, AccessRights::WRITE_PRE_OP),
    ("safeop", AccessRights::READ_SAFE_OP, AccessRights::WRITE_SAFE_OP),
    ("op", AccessRights::READ_OP, AccessRights::WRITE_OP),
];

impl Flags {
    fn read(element: Element<'_>) -> Self {
        let set = |name, right| if is_set(element, name) { right } else { AccessRights::empty() };
        let purposes =
            mapping(element) | set("Backup", AccessRights::BACKUP) | set("Setting", AccessRights::SETTING);
        Self {
            access: element.child("Access").and_then(access),
            purposes,
            complete_access: element.child("SdoAccess").map(|access| access.text() != "SubIndexAccess"),
        }
    }
}

fn is_set(flags: Element<'_>, name: &'static str) -> bool {
    flags.value_of(name).is_some_and(|value| value.flag())
}

fn access(element: Element<'_>) -> Option<AccessRights> {
    let text = element.text().to_ascii_lowercase();
    let (reads, writes) = match text.as_str() {
        "ro" => (true, false),
        "wo" => (false, true),
        "rw" => (true, true),
        _ => {
            element.value().report(rules::ACCESS_TEXT, "is neither ro, rw nor wo; read as missing");
            return None;
        }
    };
    let restricted = |name, all: AccessRights, is_given: bool| {
        let states = element.attribute(name).map(|states| states.text.to_ascii_lowercase());
        let named: AccessRights = states
            .iter()
            .flat_map(|states| states.split('_'))
            .flat_map(|state| STATES.iter().filter(move |(name, ..)| *name == state))
            .map(|(_, read, write)| *read | *write)
            .collect();
        let permitted = if named.is_empty() { all } else { named & all };
        if is_given { permitted } else { AccessRights::empty() }
    };
    Some(
        restricted("ReadRestrictions", AccessRights::READ, reads)
            | restricted("WriteRestrictions", AccessRights::WRITE, writes),
    )
}

fn mapping(flags: Element<'_>) -> AccessRights {
    let Some(value) = flags.value_of("PdoMapping") else { return AccessRights::empty() };
    match value.text.to_ascii_uppercase().as_str() {
        "" => AccessRights::empty(),
        "T" => AccessRights::TX_PDO,
        "R" => AccessRights::RX_PDO,
        "TR" | "RT" => AccessRights::TX_PDO | AccessRights::RX_PDO,
        other => {
            let letters = |letter, right| if other.contains(letter) { right } else { AccessRights::empty() };
            value.report(rules::MAPPING_TEXT, "is neither T, R nor TR; read by its letters");
            // `Rx` and `Tx` have one of the two letters, `TRx` both.
            letters('T', AccessRights::TX_PDO) | letters('R', AccessRights::RX_PDO)
        }
    }
}
