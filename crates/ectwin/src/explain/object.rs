//! Objects: of the CoE object dictionary for the master, and NX objects for the CPU Unit.

use nx_ect101::unit_file::{DataSetEntries, Entries, IoAllocationSection, Located, UnitFile};
use nx_ect101::{
    DataSet, Direction, MINOR_FAULT_BIT, NxAccess, NxEntry, NxObject, OBSERVATION_BIT, SLAVE_STATUS_BITS,
    SlaveStatus, StatusBit, object_table,
};
use objects::{AccessRights, Entry, Object};
use wire::{ObjectIndex, SdoAbort, SubIndex};

use super::{Explanation, Fact, Section, Subject, Unexplained};
use crate::object_words::{access, code, default, pdo, type_name, writable_in};

/// The object whose bits 4 and 5 are I/O ports of a master.
pub(super) const SYSMAC_ERROR_STATUS: (ObjectIndex, SubIndex) = (ObjectIndex(0x2002), SubIndex(1));

/// Maximum length of a default that is shown in a list.
const SHOWN_DEFAULT: usize = 20;

/// Index and subindex, as in `10F3:05`.
#[derive(Clone, Copy, Debug)]
pub(super) struct EntryNumber {
    index: ObjectIndex,
    sub: SubIndex,
}

impl EntryNumber {
    /// None if `text` has another form.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let (index, sub) = text.trim().split_once(':')?;
        let index = index.strip_prefix("0x").or(index.strip_prefix("0X")).unwrap_or(index);
        let sub = sub.strip_prefix("0x").or(sub.strip_prefix("0X")).unwrap_or(sub);
        let are_digits =
            [index, sub].iter().all(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()));
        let index = u16::from_str_radix(index, 16).ok().filter(|_| are_digits)?;
        Some(Self { index: ObjectIndex(index), sub: SubIndex(u8::from_str_radix(sub, 16).ok()?) })
    }

    /// On both sides, if they exist there.
    pub(super) fn explanations(self) -> Result<Vec<Explanation>, Unexplained> {
        let Self { index, sub } = self;
        let found: Vec<_> =
            entry(index, sub).into_iter().chain(gap(index, sub)).chain(nx_entry(index, sub)).collect();
        if found.is_empty() { Err(self.missing()) } else { Ok(found) }
    }

    fn missing(self) -> Unexplained {
        let Self { index, sub } = self;
        let table = object_table();
        let subs = match (table.object(index), NxObject::find(index)) {
            (Some(object), _) => object.entries.iter().map(|entry| entry.sub.to_string()).collect::<Vec<_>>(),
            (None, Some(object)) => object.entries.iter().map(|entry| entry.sub.to_string()).collect(),
            (None, None) => {
                let help = "`ectwin list objects` and `ectwin list nx-objects` show which there are";
                return Unexplained::new(format!("there is no object {index}"), help);
            }
        };
        let message = format!("object {index} has no subindex {sub}");
        Unexplained::new(message, format!("its subindexes are {}", subs.join(", ")))
    }
}

/// The name of the object to which an entry belongs; none if it is not an entry.
pub(super) fn name_around(subject: Subject) -> Option<String> {
    match subject {
        Subject::Entry(index, _) => object_table().object(index).map(|object| object.name.clone()),
        Subject::NxEntry(index, _) => NxObject::find(index).map(|object| object.name.clone()),
        _ => None,
    }
}

/// Unit files that together have every I/O entry: one data set each, because all of them exceed one unit.
pub(super) fn files_with_every_io_entry() -> Vec<UnitFile> {
    let Ok(file) = UnitFile::parse("model = \"nx-ect101\"") else { return Vec::new() };
    let with = |set: &DataSet| {
        let all = Located::left_out(Entries::Count(set.max_count));
        let entries = vec![DataSetEntries { kind: set.kind, entries: all }];
        let section = match set.direction {
            Direction::MToC => IoAllocationSection { m_to_c: entries, c_to_m: Vec::new() },
            Direction::CToM => IoAllocationSection { m_to_c: Vec::new(), c_to_m: entries },
        };
        UnitFile { io_allocation: Some(Located::left_out(section)), ..file.clone() }
    };
    DataSet::all().iter().map(with).collect()
}

pub(super) fn object(index: ObjectIndex) -> Option<Explanation> {
    let table = object_table();
    let object = table.object(index)?;
    let facts = vec![Fact::new("kind", kind(object))];
    let entries = object.entries.iter().map(|entry| Fact::new(format!(":{}", entry.sub), entry_line(entry)));
    let sections = vec![Section { heading: "Entries", facts: entries.collect() }];
    let (subject, name) = (Subject::Object(index), object.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections })
}

fn kind(object: &Object) -> String {
    let complete = if object.complete_access { "with" } else { "without" };
    format!("{}, {complete} complete access", code(object.code))
}

fn entry_line(entry: &Entry) -> String {
    let (data_type, access) = (type_name(entry.data_type), access(entry.access));
    format!(
        "{}, {data_type}, {} bit, {access}{}",
        entry.name,
        entry.bit_length,
        shown_default(&default(entry))
    )
}

/// A default that is short enough to display.
fn shown_default(default: &str) -> String {
    if default.is_empty() || default.len() > SHOWN_DEFAULT {
        String::new()
    } else {
        format!(", default {default}")
    }
}

pub(super) fn entry(index: ObjectIndex, sub: SubIndex) -> Option<Explanation> {
    let table = object_table();
    let (object, entry) = (table.object(index)?, table.entry(index, sub)?);
    let mut facts = vec![
        Fact::new("object", format!("{}, {}", object.name, kind(object))),
        Fact::new("type", format!("{}, {} bit", type_name(entry.data_type), entry.bit_length)),
        Fact::new("access", access_words(entry)),
    ];
    let default = default(entry);
    facts.extend(Some(default).filter(|text| !text.is_empty()).map(|text| Fact::new("default", text)));
    let limits: Vec<String> =
        entry.limits.iter().map(|range| format!("{:X} to {:X}", range.start(), range.end())).collect();
    facts.extend((!limits.is_empty()).then(|| Fact::new("range", format!("{} hex", limits.join(", ")))));
    facts.extend(pdo(entry.access).map(|kind| Fact::new("PDO", format!("{kind} can map it"))));
    if entry.access.contains(AccessRights::SETTING) {
        facts.push(Fact::new("setting", "a master writes it when communications start"));
    }
    let set = DataSet::all().iter().find(|set| set.pdo_entry == index && set.has(sub));
    facts.extend(set.map(|set| Fact::new("NX object", format!("{}:{sub}, {}", set.nx_entry, set.name))));
    if (index, sub) == SYSMAC_ERROR_STATUS {
        facts.extend(bits(&[OBSERVATION_BIT, MINOR_FAULT_BIT]));
    }
    let (subject, name) = (Subject::Entry(index, sub), entry.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

/// A subindex below the highest one that has no entry.
fn gap(index: ObjectIndex, sub: SubIndex) -> Option<Explanation> {
    let table = object_table();
    let object = table.object(index)?;
    if !object.is_gap(sub) {
        return None;
    }
    let facts = vec![
        Fact::new("object", format!("{}, {}", object.name, kind(object))),
        Fact::new("type", "none, 0 bit"),
        Fact::new("access", "none"),
        Fact::new(
            "SDO",
            format!("{} for reading and writing", Subject::Abort(SdoAbort::SUBINDEX_DOES_NOT_EXIST)),
        ),
        Fact::new("described", "by SDO information, as every subindex up to the highest is"),
    ];
    let (subject, name) = (Subject::Entry(index, sub), "a gap without data".to_owned());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

fn access_words(entry: &Entry) -> String {
    let states = writable_in(entry.access);
    let written =
        if states.is_empty() { String::new() } else { format!(", written in {}", states.join(", ")) };
    format!("{}{written}", access(entry.access))
}

fn bits(bits: &[StatusBit]) -> Vec<Fact> {
    bits.iter().map(|StatusBit { bit, port }| Fact::new(format!("bit {bit}"), *port)).collect()
}

pub(super) fn nx_object(index: ObjectIndex) -> Option<Explanation> {
    let object = NxObject::find(index)?;
    let facts = vec![Fact::new("reached", reached(object))];
    let entries =
        object.entries.iter().map(|entry| Fact::new(format!(":{}", entry.sub), nx_entry_line(entry)));
    let sections = vec![Section { heading: "Entries", facts: entries.collect() }];
    let (subject, name) = (Subject::NxObject(index), object.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections })
}

const fn reached(object: &NxObject) -> &'static str {
    if object.message_access { "by NX_ReadObj and NX_WriteObj" } else { "by I/O allocation" }
}

fn nx_entry_line(entry: &NxEntry) -> String {
    format!("{}, {}, {}", entry.name, entry.data_type, nx_access(entry))
}

const fn nx_access(entry: &NxEntry) -> &'static str {
    match entry.access {
        NxAccess::Ro => "RO",
        NxAccess::Rw => "RW",
    }
}

pub(super) fn nx_entry(index: ObjectIndex, sub: SubIndex) -> Option<Explanation> {
    let object = NxObject::find(index)?;
    let entry = object.entry(sub)?;
    let mut facts = vec![
        Fact::new("object", object.name.clone()),
        Fact::new("reached", reached(object)),
        Fact::new("type", entry.data_type.clone()),
        Fact::new("access", nx_access(entry)),
    ];
    let set = DataSet::all().iter().find(|set| set.nx_entry == index && set.has(sub));
    facts.extend(set.map(|set| Fact::new("CoE object", format!("{}:{sub}, {}", set.pdo_entry, set.name))));
    if (index, sub) == SlaveStatus::NX_OBJECT {
        facts.extend(bits(&SLAVE_STATUS_BITS));
    }
    let (subject, name) = (Subject::NxEntry(index, sub), entry.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}
