use objects::{AccessRights, Entry, ObjectTable};
use roxmltree::{Document, Node};

use super::xml;
use crate::tests::{small_device, small_table};
use crate::type_names;
use crate::{DeviceDescription, Pdo, PortPhysics};

#[test]
fn the_file_of_a_small_device() {
    insta::assert_snapshot!(xml(&small_device(), &small_table()));
}

#[test]
fn the_same_description_gives_the_same_text() {
    assert_eq!(xml(&small_device(), &small_table()), xml(&small_device(), &small_table()));
}

#[test]
fn elements_stand_in_the_order_of_the_schema() {
    let text = xml(&small_device(), &small_table());
    let document = Document::parse(&text).unwrap();
    let mut names: Vec<&str> =
        device(&document).children().filter(Node::is_element).map(|node| node.tag_name().name()).collect();
    names.dedup();
    let order = [
        "Type",
        "Name",
        "Info",
        "GroupType",
        "Profile",
        "Fmmu",
        "Sm",
        "RxPdo",
        "TxPdo",
        "Mailbox",
        "ESC",
        "Eeprom",
    ];
    assert_eq!(names, order);
}

#[test]
fn identity_and_eeprom_read_back() {
    let description = small_device();
    let text = xml(&description, &small_table());
    let document = Document::parse(&text).unwrap();
    let (device, vendor) = (device(&document), find(document.root(), "Vendor"));
    assert_eq!(number(text_of(vendor, "Id")), description.vendor.id);
    assert_eq!(text_of(vendor, "Name"), description.vendor.name);
    let device_type = find(device, "Type");
    assert_eq!(number(device_type.attribute("ProductCode").unwrap()), description.product_code);
    assert_eq!(number(device_type.attribute("RevisionNo").unwrap()), description.revision);
    assert_eq!(device_type.text(), Some(description.order_code.as_str()));
    assert_eq!(text_of(device, "GroupType"), text_of(find(document.root(), "Group"), "Type"));
    assert_eq!(device.attribute("Physics"), Some("YK"));
    let eeprom = find(device, "Eeprom");
    assert_eq!(text_of(eeprom, "ByteSize"), "2048");
    let image = crate::sii::image(&description);
    assert_eq!(bytes(text_of(eeprom, "ConfigData")), image[..14]);
}

#[test]
fn sync_managers_pdos_and_init_commands_read_back() {
    let description = small_device();
    let text = xml(&description, &small_table());
    let document = Document::parse(&text).unwrap();
    let device = device(&document);
    let sync_managers: Vec<_> = all(device, "Sm").map(|node| attribute(node, "StartAddress")).collect();
    let expected: Vec<_> = description.sync_managers.iter().map(|each| u32::from(each.start)).collect();
    assert_eq!(sync_managers, expected);
    let controls: Vec<_> = all(device, "Sm").map(|node| attribute(node, "ControlByte")).collect();
    assert_eq!(controls, [0x26, 0x22, 0x64, 0x20]);
    for (name, pdos) in [("RxPdo", &description.rx_pdos), ("TxPdo", &description.tx_pdos)] {
        let found: Vec<PdoRow> = all(device, name).map(pdo_row).collect();
        assert_eq!(found, pdos.iter().map(PdoRow::from).collect::<Vec<_>>());
    }
    let command = find(device, "InitCmd");
    assert_eq!(text_of(command, "Transition"), "PS");
    assert_eq!((number(text_of(command, "Index")), number(text_of(command, "SubIndex"))), (0x2000, 2));
    assert_eq!(bytes(text_of(command, "Data")), [1, 0xAB]);
}

/// C103: the dictionary in the file agrees with the table.
#[test]
fn the_dictionary_equals_the_table() {
    let table = small_table();
    let text = xml(&small_device(), &table);
    let document = Document::parse(&text).unwrap();
    assert_eq!(rows_of_file(find(document.root(), "Dictionary")), rows_of_table(&table));
}

#[test]
fn every_type_of_the_dictionary_is_defined_once() {
    let text = xml(&small_device(), &small_table());
    let document = Document::parse(&text).unwrap();
    let dictionary = find(document.root(), "Dictionary");
    let defined: Vec<&str> = all(dictionary, "DataType").map(|node| text_of(node, "Name")).collect();
    let used = all(dictionary, "Type").chain(all(dictionary, "BaseType")).filter_map(|node| node.text());
    for name in used {
        assert_eq!(defined.iter().filter(|known| **known == name).count(), 1, "{name}");
    }
}

#[test]
fn a_device_without_mailbox_and_dictionary_has_no_such_element() {
    let description = DeviceDescription {
        ports: [PortPhysics::Mii; 4],
        eeprom_bytes: 256,
        name: "a\u{1}<b>".into(),
        ..DeviceDescription::default()
    };
    let text = xml(&description, &ObjectTable::default());
    let document = Document::parse(&text).unwrap();
    for name in ["Mailbox", "Profile", "ESC", "Sm", "InitCmd"] {
        assert_eq!(all(document.root(), name).count(), 0, "{name}");
    }
    assert_eq!(device(&document).attribute("Physics"), Some("YYYY"));
    assert_eq!(text_of(device(&document), "Name"), "a\u{FFFD}<b>");
}

/// PDO: index, SyncManager, and for each entry index, subindex, bits, type.
#[derive(Debug, PartialEq)]
struct PdoRow(u32, Option<u32>, Vec<(u32, u32, u32, String)>);

impl From<&Pdo> for PdoRow {
    fn from(pdo: &Pdo) -> Self {
        let entries = pdo.entries.iter().map(|entry| {
            let name = match entry.is_padding() {
                true => String::new(),
                false => type_names::name(entry.data_type, entry.bit_length.into()),
            };
            (entry.index.0.into(), entry.sub.0.into(), entry.bit_length.into(), name)
        });
        Self(pdo.index.0.into(), pdo.sync_manager.map(u32::from), entries.collect())
    }
}

fn pdo_row(node: Node<'_, '_>) -> PdoRow {
    let text = |node: Node<'_, '_>, name| optional(node, name).unwrap_or_default().to_owned();
    let entries = all(node, "Entry").map(|entry| {
        let sub = optional(entry, "SubIndex").map_or(0, number);
        (number(text_of(entry, "Index")), sub, number(text_of(entry, "BitLen")), text(entry, "DataType"))
    });
    PdoRow(number(text_of(node, "Index")), node.attribute("Sm").map(number), entries.collect())
}

/// Index, subindex, name, type, bits, access rights, default.
type Row = (u32, u8, String, String, u32, AccessRights, Vec<u8>);

fn rows_of_table(table: &ObjectTable) -> Vec<Row> {
    let row = |index: u16, entry: &Entry| {
        let name = type_names::name(entry.data_type, entry.bit_length);
        let bits = entry.bit_length.into();
        (index.into(), entry.sub.0, entry.name.clone(), name, bits, entry.access, entry.default.clone())
    };
    table
        .iter()
        .flat_map(|object| object.entries.iter().map(move |entry| row(object.index.0, entry)))
        .collect()
}

fn rows_of_file(dictionary: Node<'_, '_>) -> Vec<Row> {
    all(dictionary, "Object").flat_map(|object| rows_of_object(dictionary, object)).collect()
}

fn rows_of_object(dictionary: Node<'_, '_>, object: Node<'_, '_>) -> Vec<Row> {
    let (index, name) = (number(text_of(object, "Index")), text_of(object, "Type"));
    let bits = number(text_of(object, "BitSize"));
    if !name.starts_with("DT") {
        let row = (
            index,
            0,
            text_of(object, "Name"),
            name,
            bits,
            rights(object),
            default_data(find(object, "Info")),
        );
        // The only entry of a variable has its own name in the table; the file contains the name of the object.
        return vec![(row.0, row.1, "Name".into(), row.3.into(), row.4, row.5, row.6)];
    }
    let definition = definition(dictionary, name);
    let mut described = Vec::new();
    for item in children(definition, "SubItem") {
        let (data_type, bits) = (text_of(item, "Type"), number(text_of(item, "BitSize")));
        match optional(item, "SubIdx") {
            Some(sub) => described.push((number(sub) as u8, data_type, bits, rights(item))),
            None => described.extend(elements(dictionary, data_type, bits, rights(item))),
        }
    }
    let infos: Vec<_> = children(find(object, "Info"), "SubItem").collect();
    assert_eq!(infos.len(), described.len());
    let row = |(info, (sub, data_type, bits, rights)): (Node<'_, '_>, (u8, &str, u32, AccessRights))| {
        (
            index,
            sub,
            text_of(info, "Name").into(),
            data_type.into(),
            bits,
            rights,
            default_data(find(info, "Info")),
        )
    };
    infos.into_iter().zip(described).map(row).collect()
}

fn elements<'a>(
    dictionary: Node<'a, 'a>,
    name: &str,
    bits: u32,
    rights: AccessRights,
) -> Vec<(u8, &'a str, u32, AccessRights)> {
    let array = definition(dictionary, name);
    let (first, count) = (number(text_of(array, "LBound")), number(text_of(array, "Elements")));
    let base = text_of(array, "BaseType");
    (first..first + count).map(|sub| (sub as u8, base, bits / count, rights)).collect()
}

fn rights(node: Node<'_, '_>) -> AccessRights {
    let Some(flags) = children(node, "Flags").next() else { return AccessRights::empty() };
    let mut rights = AccessRights::empty();
    if let Some(access) = children(flags, "Access").next() {
        let states = |name| access.attribute(name).unwrap_or("PreOP_SafeOP_OP").split('_');
        let text = access.text().unwrap();
        let read = states("ReadRestrictions").filter(|_| text.contains('r'));
        let write = states("WriteRestrictions").filter(|_| text.contains('w'));
        rights |= read.map(|state| right(0, state)).collect::<AccessRights>();
        rights |= write.map(|state| right(3, state)).collect::<AccessRights>();
    }
    let flag = |name, right| if optional(flags, name).is_some() { right } else { AccessRights::empty() };
    let mapping = optional(flags, "PdoMapping").unwrap_or_default();
    rights.set(AccessRights::RX_PDO, mapping.contains('R'));
    rights.set(AccessRights::TX_PDO, mapping.contains('T'));
    rights | flag("Backup", AccessRights::BACKUP) | flag("Setting", AccessRights::SETTING)
}

fn right(first_bit: u16, state: &str) -> AccessRights {
    let at = ["PreOP", "SafeOP", "OP"].iter().position(|name| *name == state).unwrap();
    AccessRights::from_bits(1 << (usize::from(first_bit) + at)).unwrap()
}

fn default_data(info: Node<'_, '_>) -> Vec<u8> {
    optional(info, "DefaultData").map(bytes).unwrap_or_default()
}

fn definition<'a>(dictionary: Node<'a, 'a>, name: &str) -> Node<'a, 'a> {
    all(dictionary, "DataType").find(|node| text_of(*node, "Name") == name).unwrap()
}

fn device<'a>(document: &'a Document<'a>) -> Node<'a, 'a> {
    find(document.root(), "Device")
}

fn all<'a>(node: Node<'a, 'a>, name: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.descendants().filter(move |node| node.has_tag_name(name))
}

fn children<'a>(node: Node<'a, 'a>, name: &str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |node| node.has_tag_name(name))
}

fn find<'a>(node: Node<'a, 'a>, name: &str) -> Node<'a, 'a> {
    all(node, name).next().unwrap_or_else(|| panic!("no {name}"))
}

fn optional<'a>(node: Node<'a, 'a>, name: &str) -> Option<&'a str> {
    all(node, name).next()?.text()
}

fn text_of<'a>(node: Node<'a, 'a>, name: &str) -> &'a str {
    optional(node, name).unwrap_or_else(|| panic!("no text in {name}"))
}

fn attribute(node: Node<'_, '_>, name: &str) -> u32 {
    number(node.attribute(name).unwrap())
}

/// `#x1F` or decimal.
fn number(text: &str) -> u32 {
    match text.strip_prefix("#x") {
        Some(digits) => u32::from_str_radix(digits, 16).unwrap(),
        None => text.parse().unwrap(),
    }
}

fn bytes(text: &str) -> Vec<u8> {
    let digit = |at| u8::from_str_radix(&text[at..at + 2], 16).unwrap();
    (0..text.len()).step_by(2).map(digit).collect()
}
