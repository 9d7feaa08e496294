//! The groups of the pool.

use super::rows::{EVERYDAY, PoolRow, ROWS};

/// A group of the pool.
pub struct Group {
    /// Its name, in the `from` of `random`.
    pub name: &'static str,
    /// What its sentences are about.
    pub meaning: &'static str,
}

/// The group that is used if `random` has no `from`.
const EVERYDAY_GROUP: &str = "everyday";

const fn group(name: &'static str, meaning: &'static str) -> Group {
    Group { name, meaning }
}

/// All of them, in the order of the reference.
#[rustfmt::skip]
pub const GROUPS: &[Group] = &[
    group(EVERYDAY_GROUP, "a bit of everything, for any line: what `random = 30` draws from"),
    group("line", "cables and frames"),
    group("unit", "power, restarts, resets and logs, by hand"),
    group("fault", "causes of the faults that the model of a unit has"),
    group("cpu", "CPU Units: mode, task, I/O refreshing, time"),
    group("state", "requests of states, valid or not, and whole start-ups"),
    group("process-data", "outputs, cycle, and their end"),
    group("sdo", "reads and writes of the objects that a unit has"),
    group("parameter", "writes of the objects of a maker that a master may write, restarts, and start-ups that take them over"),
    group("diagnosis", "history, errors, emergencies and logs, with the causes that fill them"),
    group("mapping", "PDO mapping and assignment, right or wrong, and start-ups that use them"),
    group("sync-manager", "wrong lengths and control bytes of SyncManagers, split accesses, and start-ups that use them"),
    group("sii", "the EEPROM: damage, and a slow or busy interface"),
    group("slave", "a slow slave, one that refuses states, one that behaves again"),
    group("register", "writes to registers of the ESC that a master may write"),
    group("mailbox", "lost, late and doubled mailbox frames, a master that counts or reads wrongly"),
];

impl Group {
    /// The group with this name.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        GROUPS.iter().find(|group| group.name == name)
    }

    /// Its sentences.
    pub fn rows(&self) -> impl Iterator<Item = &'static PoolRow> + use<> {
        let name = self.name;
        let is_everyday = name == EVERYDAY_GROUP;
        let everyday = EVERYDAY.iter().filter(move |_| is_everyday);
        everyday.chain(ROWS.iter().filter(move |row| row.group == name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_group_has_sentences_and_every_sentence_has_a_group() {
        for group in GROUPS {
            assert!(group.rows().count() > 0, "{}", group.name);
            assert_eq!(Group::named(group.name).map(|found| found.meaning), Some(group.meaning));
        }
        for row in ROWS {
            assert!(
                Group::named(row.group).is_some_and(|group| group.name != EVERYDAY_GROUP),
                "{}",
                row.sentence
            );
        }
        assert!(EVERYDAY.iter().all(|row| row.group == EVERYDAY_GROUP));
    }
}
