//! Objects: of the CoE object dictionary for the master, and NX objects for the CPU Unit.

use objects::{AccessRights, Entry, Object};
use unit_model::tables::{EntryFact, NxEntry, NxObject};
use wire::{EntryAddress, ObjectIndex, SdoAbort, SubIndex};

use super::tables::{self, tables};
use super::{Explanation, Fact, Section, Subject, Unexplained};
use crate::object_words::{access, code, default, pdo, type_name, writable_in};

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
        let subs = match (tables().objects.object(index), tables::nx_object(index)) {
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
        Subject::Entry(index, _) => tables().objects.object(index).map(|object| object.name.clone()),
        Subject::NxEntry(index, _) => tables::nx_object(index).map(|object| object.name.clone()),
        _ => None,
    }
}

pub(super) fn object(index: ObjectIndex) -> Option<Explanation> {
    let table = &tables().objects;
    let object = table.object(index)?;
    let facts = vec![Fact::new("kind", kind(object))];
    let entries = object.entries.iter().map(|entry| Fact::new(format!(":{}", entry.sub), entry_line(entry)));
    let sections = vec![Section { heading: "Entries".into(), facts: entries.collect() }];
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
    let table = &tables().objects;
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
    facts.extend(facts_of(&tables().entry_facts, index, sub));
    let named = tables().named_bits.iter().filter(|bit| bit.entry == EntryAddress { index, sub });
    facts.extend(named.map(|bit| Fact::new(format!("bit {}", bit.bit), bit.name)));
    let (subject, name) = (Subject::Entry(index, sub), entry.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

/// A subindex below the highest one that has no entry.
fn gap(index: ObjectIndex, sub: SubIndex) -> Option<Explanation> {
    let table = &tables().objects;
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

/// What the model adds about an entry.
fn facts_of(facts: &'static [EntryFact], index: ObjectIndex, sub: SubIndex) -> impl Iterator<Item = Fact> {
    let facts = facts.iter().filter(move |fact| fact.entry == EntryAddress { index, sub });
    facts.map(|fact| fact.fact.clone())
}

pub(super) fn nx_object(index: ObjectIndex) -> Option<Explanation> {
    let object = tables::nx_object(index)?;
    let facts = vec![Fact::new("reached", reached(object))];
    let entries =
        object.entries.iter().map(|entry| Fact::new(format!(":{}", entry.sub), nx_entry_line(entry)));
    let sections = vec![Section { heading: "Entries".into(), facts: entries.collect() }];
    let (subject, name) = (Subject::NxObject(index), object.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections })
}

const fn reached(object: &NxObject) -> &'static str {
    if object.message_access { "by NX_ReadObj and NX_WriteObj" } else { "by I/O allocation" }
}

fn nx_entry_line(entry: &NxEntry) -> String {
    format!("{}, {}, {}", entry.name, entry.data_type, entry.access.id())
}

pub(super) fn nx_entry(index: ObjectIndex, sub: SubIndex) -> Option<Explanation> {
    let object = tables::nx_object(index)?;
    let entry = object.entry(sub)?;
    let mut facts = vec![
        Fact::new("object", object.name.clone()),
        Fact::new("reached", reached(object)),
        Fact::new("type", entry.data_type.clone()),
        Fact::new("access", entry.access.id()),
    ];
    facts.extend(facts_of(&tables().nx_entry_facts, index, sub));
    let (subject, name) = (Subject::NxEntry(index, sub), entry.name.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}
