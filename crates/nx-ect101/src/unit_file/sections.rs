//! The sections `io_allocation` and `pdo` of a unit file, key by key.

use user_file::{DeValue, Located, Problem, Reader, Section, Value, values, wrong_type};
use wire::ObjectIndex;

use super::entries::{DataSetEntries, Entries, IoAllocationSection, MappingEntries, PdoSection};
use super::keys;
use crate::data_sets::DataSet;

/// Maximum entries of a list: subindexes are one byte.
const ENTRIES_MAX: usize = 255;

pub(super) fn io_allocation(
    reader: &mut Reader<'_>,
    file: &Section<'_, '_>,
) -> Option<Located<IoAllocationSection>> {
    let section = reader.section(file, "io_allocation")?;
    reader.only(&section, &keys::IO_ALLOCATION);
    let m_to_c = data_sets(reader, &section, "m_to_c");
    let c_to_m = data_sets(reader, &section, "c_to_m");
    Some(section.locate(IoAllocationSection { m_to_c, c_to_m }))
}

fn data_sets(reader: &mut Reader<'_>, parent: &Section<'_, '_>, key: &str) -> Vec<DataSetEntries> {
    let Some(section) = reader.section(parent, key) else { return Vec::new() };
    reader.only(&section, &keys::DATA_SETS.map(|(key, _)| key));
    let mut sets = Vec::new();
    for (key, kind) in keys::DATA_SETS {
        let value = section.get(key);
        if let Some(entries) = value.and_then(|value| entries(reader, &section.place_of(key), value)) {
            sets.push(DataSetEntries { kind, entries });
        }
    }
    sets
}

/// Short form or long form.
fn entries(reader: &mut Reader<'_>, place: &str, value: &Value<'_>) -> Option<Located<Entries>> {
    if value.get_ref().is_array() {
        let list = list(reader, place, value, values::entry_address)?;
        return Some(Located::at(value.span(), Entries::List(list)));
    }
    reader.read(place, value, |place, value| {
        if !value.is_integer() {
            let expected = "a number of entries, 0 to 255, or a list of entries: [\"6000:01\"]";
            return Err(wrong_type(place, value, expected));
        }
        values::integer(place, value, 0..=255, "0 to 255").map(Entries::Count)
    })
}

/// Every element of a list, which is not longer than an object can be.
fn list<T>(
    reader: &mut Reader<'_>,
    place: &str,
    value: &Value<'_>,
    read: impl FnMut(&str, &DeValue<'_>) -> Result<T, Problem>,
) -> Option<Vec<Located<T>>> {
    let count = value.get_ref().as_array().map_or(0, |array| array.len());
    if count <= ENTRIES_MAX {
        return Some(reader.array(place, value, read));
    }
    let problem = Problem::new(format!("`{place}` has {count} entries"), format!("{ENTRIES_MAX} at most"));
    reader.refuse(value.span(), problem);
    None
}

pub(super) fn pdo(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Located<PdoSection>> {
    let section = reader.section(file, "pdo")?;
    reader.only(&section, &keys::PDO);
    let mut pdo = PdoSection::default();
    if let Some(assign) = reader.section(&section, "assign") {
        reader.only(&assign, &keys::ASSIGN);
        pdo.assign_rx = assignment(reader, &assign, "rx");
        pdo.assign_tx = assignment(reader, &assign, "tx");
    }
    if let Some(mapping) = reader.section(&section, "mapping") {
        pdo.mappings = mappings(reader, &mapping);
    }
    Some(section.locate(pdo))
}

fn assignment(
    reader: &mut Reader<'_>,
    section: &Section<'_, '_>,
    key: &str,
) -> Option<Located<Vec<Located<ObjectIndex>>>> {
    let (place, value) = (section.place_of(key), section.get(key)?);
    if !value.get_ref().is_array() {
        let expected = "a list of PDO mapping objects: [0x1601]";
        reader.refuse(value.span(), wrong_type(&place, value.get_ref(), expected));
        return None;
    }
    Some(Located::at(value.span(), list(reader, &place, value, values::object_index)?))
}

fn mappings(reader: &mut Reader<'_>, section: &Section<'_, '_>) -> Vec<MappingEntries> {
    let mut mappings: Vec<MappingEntries> = Vec::new();
    for (key, value) in section.entries() {
        let place = section.place_of(key.value);
        let Some(pdo) = mapping_object(key.value) else {
            refuse_mapping_key(reader, &place, key);
            continue;
        };
        // `1a01` and `1A01` are two keys for TOML and one object here.
        if mappings.iter().any(|known| known.pdo.value == pdo) {
            let problem = Problem::new(format!("`{place}` occurs twice"), "one mapping for each object");
            reader.refuse(key.span.unwrap_or_default(), problem);
            continue;
        }
        if let Some(entries) = entries(reader, &place, value) {
            mappings.push(MappingEntries { pdo: Located { value: pdo, span: key.span }, entries });
        }
    }
    mappings.sort_by_key(|mapping| mapping.pdo.value);
    mappings
}

/// The mapping object for `key`, if a master may set its entries.
fn mapping_object(key: &str) -> Option<ObjectIndex> {
    let index = ObjectIndex(u16::try_from(values::hexadecimal(key, 4)?).ok()?);
    DataSet::of_pdo(index).map(|_| index)
}

fn refuse_mapping_key(reader: &mut Reader<'_>, place: &str, key: Located<&str>) {
    let names = keys::mappings();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let problem = Problem::unknown(format!("unknown key `{place}`"), key.value, &names);
    reader.refuse(key.span.unwrap_or_default(), problem);
}
