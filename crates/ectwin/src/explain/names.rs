//! Names of the tables and words of the glossary: what a text names, and which name is near.

use esc::REGISTERS;
use nx_ect101::{Event, NxObject, Pattern, object_table};

use super::{Subject, glossary, indicator};

/// All that has the name `text`; case, spaces and punctuation do not count.
pub(super) fn subjects(text: &str) -> Vec<Subject> {
    let wanted = letters(text);
    if wanted.is_empty() {
        return Vec::new();
    }
    let mut found: Vec<Subject> = Vec::new();
    for (name, subject) in all() {
        if letters(&name) == wanted && !found.contains(&subject) {
            found.push(subject);
        }
    }
    found
}

/// A name that differs from `text` in a letter or two; none if all are further away.
pub(super) fn near(text: &str) -> Option<String> {
    let wanted = letters(text);
    let differing_max = match wanted.len() {
        0..=3 => return None,
        4..=7 => 1,
        _ => 2,
    };
    let by_distance = all().map(|(name, _)| (strsim::osa_distance(&letters(&name), &wanted), name));
    let nearest = by_distance.min_by_key(|(distance, _)| *distance);
    nearest.filter(|(distance, _)| *distance <= differing_max).map(|(_, name)| name)
}

fn letters(text: &str) -> String {
    text.chars().filter(|letter| letter.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

fn all() -> impl Iterator<Item = (String, Subject)> {
    let words = glossary::words().map(|(word, row)| (word.to_owned(), Subject::Word(row)));
    let patterns = Pattern::ALL.map(|pattern| (pattern.id().to_owned(), Subject::Pattern(pattern)));
    let events = Event::all().iter().map(|event| (event.name.clone(), Subject::Event(event.code)));
    let objects: Vec<_> =
        object_table().iter().map(|object| (object.name.clone(), Subject::Object(object.index))).collect();
    let nx_objects =
        NxObject::all().iter().map(|object| (object.name.clone(), Subject::NxObject(object.index)));
    let registers =
        REGISTERS.iter().map(|register| (register.name.to_owned(), Subject::Register(register.offset)));
    let indicators = indicator::names().flat_map(indicator_names);
    indicators.chain(patterns).chain(words).chain(events).chain(objects).chain(nx_objects).chain(registers)
}

/// `L/A IN` is one of the two that `L/A` names.
fn indicator_names(name: &'static str) -> impl Iterator<Item = (String, Subject)> {
    let kind = name.split_once(' ').map(|(kind, _)| kind);
    [Some(name), kind].into_iter().flatten().map(move |known| (known.to_owned(), Subject::Indicator(name)))
}
