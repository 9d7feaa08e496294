//! The marks of the pool's sentences: words in whose place a value is drawn.

use device::TRANSITIONS;
use wire::AlStatusCode;

use super::known::{KnownUnit, registers};
use crate::model::{Bytes, Entry, StateName};
use crate::run::Dice;

/// A mark.
pub struct Mark {
    /// The word.
    pub word: &'static str,
    /// What is drawn.
    pub meaning: &'static str,
    /// The value for a unit; none if the unit has nothing of the kind.
    draw: fn(&mut Drawing<'_>) -> Option<String>,
}

const fn mark(
    word: &'static str,
    meaning: &'static str,
    draw: fn(&mut Drawing<'_>) -> Option<String>,
) -> Mark {
    Mark { word, meaning, draw }
}

/// All of them, in the order of the reference.
#[rustfmt::skip]
pub const MARKS: &[Mark] = &[
    mark("#", "the number of a unit", |drawing| Some((drawing.position + 1).to_string())),
    mark("@", "the number of a cable", |drawing| drawing.cable()),
    mark("~", "1 to 5", |drawing| Some((drawing.dice.below(5) + 1).to_string())),
    mark("<percent>", "1 to 30", |drawing| Some((drawing.dice.below(30) + 1).to_string())),
    mark("<time>", "1 ms to 300 ms", |drawing| drawing.one_of(&["1ms", "2ms", "5ms", "20ms", "100ms", "300ms"]).map(|time| (*time).to_owned())),
    mark("<byte>", "a byte", |drawing| Some(format!("{:02X}", drawing.dice.below(256)))),
    mark("<control>", "the control byte of a SyncManager, such as 0x24", |drawing| Some(format!("0x{:02X}", drawing.dice.below(256)))),
    mark("<length>", "a number of bytes, 0 to 1,499, or a small one", |drawing| Some(drawing.length().to_string())),
    mark("<state>", "a state, or a number that is none", |drawing| Some(drawing.state())),
    mark("<fault>", "a fault of the unit's model", |drawing| { let known = drawing.unit; drawing.one_of(&known.faults).map(|fault| (*fault).to_owned()) }),
    mark("<readable>", "an entry of an object that a master may read", |drawing| { let known = drawing.unit; drawing.one_of(&known.readable).map(Entry::to_string) }),
    mark("<writable>", "an entry that a master may write, of at most 8 bytes", |drawing| { let known = drawing.unit; drawing.sized(&known.writable).map(|entry| entry.to_string()) }),
    mark("<parameter>", "the same, of the objects 2000 to 5FFF", |drawing| { let known = drawing.unit; drawing.sized(&known.parameters).map(|entry| entry.to_string()) }),
    mark("<register>", "a register that a master may write", |drawing| drawing.sized(&registers()).map(|offset| format!("0x{offset:04X}"))),
    mark("<value>", "bytes for the entry or the register before it: often all 0, or 1", |drawing| Some(drawing.value())),
    mark("<message>", "0, or the subindex of a message of the diagnosis history", |drawing| Some(drawing.message())),
    mark("<pdo>", "a PDO of the unit", |drawing| { let known = drawing.unit; drawing.one_of(&known.pdos).map(|(index, _)| format!("0x{index:04X}")) }),
    mark("<entries>", "1 to 8 entries, in the order in which a PDO of the unit has them", |drawing| drawing.entries()),
    mark("<assignment>", "an assignment object", |drawing| { let known = drawing.unit; drawing.one_of(&known.assignments).map(|index| format!("0x{index:04X}")) }),
    mark("<pdos>", "1 to 4 PDOs of the unit", |drawing| drawing.pdos()),
    mark("<channel>", "the number of a SyncManager", |drawing| (drawing.unit.sync_managers > 0).then(|| drawing.dice.below(drawing.unit.sync_managers as u64).to_string())),
    mark("<word>", "a word of the EEPROM, 0 to 127", |drawing| Some(drawing.dice.below(128).to_string())),
    mark("<transition>", "a transition, by its letters", |drawing| drawing.transition()),
    mark("<al-status-code>", "an AL status code of the standard", |drawing| drawing.one_of(AlStatusCode::TABLE).map(|row| format!("0x{:04X}", row.code.0))),
];

/// Draws the values of one sentence.
pub(crate) struct Drawing<'a> {
    dice: &'a mut Dice,
    /// The unit that the sentence is about.
    unit: &'a KnownUnit,
    /// Its position in the line, from 0.
    position: usize,
    /// Number of units, and of cables.
    count: usize,
    /// Length in bytes of the entry or the register that was drawn last.
    length_bytes: usize,
}

impl<'a> Drawing<'a> {
    pub(crate) const fn new(dice: &'a mut Dice, units: &'a [KnownUnit], position: usize) -> Option<Self> {
        if position >= units.len() {
            return None;
        }
        Some(Self { dice, unit: &units[position], position, count: units.len(), length_bytes: 1 })
    }

    /// The sentence with a value in place of each mark; none if the unit has nothing for one of them, or does not have an
    /// entry that the sentence names.
    pub(crate) fn sentence(&mut self, pattern: &str) -> Option<String> {
        let words = self.words(pattern)?;
        let entry = words.iter().zip(words.iter().skip(1)).find(|(word, _)| *word == "SDO");
        let entry = entry.and_then(|(_, entry)| entry.parse().ok());
        entry.is_none_or(|entry| self.unit.has_entry(entry)).then(|| words.join(" "))
    }

    /// The same, whatever entries the unit has.
    pub(crate) fn any_sentence(&mut self, pattern: &str) -> Option<String> {
        self.words(pattern).map(|words| words.join(" "))
    }

    fn words(&mut self, pattern: &str) -> Option<Vec<String>> {
        let mut words = Vec::new();
        for word in pattern.split_whitespace() {
            let mark = MARKS.iter().find(|mark| mark.word == word);
            words.push(match mark {
                Some(mark) => (mark.draw)(self)?,
                None => word.to_owned(),
            });
        }
        Some(words)
    }

    fn one_of<'t, T>(&mut self, list: &'t [T]) -> Option<&'t T> {
        (!list.is_empty()).then(|| &list[self.dice.below(list.len() as u64) as usize])
    }

    /// One of those that have a length.
    fn sized<T: Copy>(&mut self, list: &[(T, usize)]) -> Option<T> {
        let (one, length_bytes) = *self.one_of(list)?;
        self.length_bytes = length_bytes.max(1);
        Some(one)
    }

    fn cable(&mut self) -> Option<String> {
        (self.count > 0).then(|| (self.dice.below(self.count as u64) + 1).to_string())
    }

    fn length(&mut self) -> u64 {
        if self.dice.hits(50) { self.dice.below(64) } else { self.dice.below(1_500) }
    }

    fn state(&mut self) -> String {
        StateName(wire::AlState::from_bits([1, 2, 4, 8, 3, 5, 8, 4][self.dice.below(8) as usize])).to_string()
    }

    fn value(&mut self) -> String {
        let length = self.length_bytes;
        let bytes = match self.dice.below(4) {
            0 => vec![0; length],
            1 => (0..length).map(|at| u8::from(at == 0)).collect(),
            _ => (0..length).map(|_| self.dice.below(256) as u8).collect(),
        };
        Bytes(bytes).to_string()
    }

    fn message(&mut self) -> String {
        let sub = if self.dice.hits(30) { 0 } else { 6 + self.dice.below(32) };
        format!("{sub:02X}")
    }

    /// Those of BOOT are not in sentences.
    fn transition(&mut self) -> Option<String> {
        let letters: Vec<&str> =
            TRANSITIONS.iter().filter(|row| !row.needs_boot()).map(|row| row.letters).collect();
        self.one_of(&letters).map(|letters| (*letters).to_owned())
    }

    fn entries(&mut self) -> Option<String> {
        let known = self.unit;
        let (_, entries) = self.one_of(&known.pdos)?;
        let first = self.dice.below(entries.len() as u64) as usize;
        let count = self.dice.below(8) as usize + 1;
        let chosen: Vec<String> = entries.iter().skip(first).take(count).map(Entry::to_string).collect();
        (!chosen.is_empty()).then(|| chosen.join(" "))
    }

    fn pdos(&mut self) -> Option<String> {
        let known = self.unit;
        let count = self.dice.below(4) + 1;
        let chosen = (0..count).map(|_| self.one_of(&known.pdos).map(|(index, _)| format!("{index:04X}")));
        chosen.collect::<Option<Vec<_>>>().map(|pdos| pdos.join(" "))
    }
}
