//! What mapping and assignment objects hold, as lists: right or wrong, whether a unit has them or a master wants them.

use core::ops::Range;

use esi::{DeviceDescription, Pdo, SyncManagerType};
use wire::ObjectIndex;

use super::{PdoEntry, PdoObjects, assignment_object};

/// PDO mapping and PDO assignment of one unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoSettings {
    /// Every assignment object with its PDOs, ascending by index.
    assignments: Vec<(ObjectIndex, Vec<ObjectIndex>)>,
    /// Every PDO mapping object with its entries, ascending by index.
    mappings: Vec<(ObjectIndex, Vec<PdoEntry>)>,
}

/// An entry and where it is among the process data of its SyncManager.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlacedEntry {
    /// The PDO that maps it.
    pub pdo: ObjectIndex,
    /// The entry.
    pub entry: PdoEntry,
    /// Its bits, counted from the start of the SyncManager.
    pub bits: Range<usize>,
}

impl PdoSettings {
    /// What the objects hold, with room for everything that a master can write to them.
    #[must_use]
    pub fn of_objects(objects: &PdoObjects) -> Self {
        let assignments = objects.assignments().map(|(index, room)| (index, Vec::with_capacity(room)));
        let mappings = objects.mappings().map(|(index, room)| (index, Vec::with_capacity(room)));
        let mut settings = Self { assignments: assignments.collect(), mappings: mappings.collect() };
        settings.follow(objects);
        settings
    }

    /// The settings of a description: every PDO with its entries, and the PDOs of every SyncManager with process data.
    #[must_use]
    pub fn of_description(description: &DeviceDescription) -> Self {
        let pdos = || description.rx_pdos.iter().chain(&description.tx_pdos);
        let is_used = |usage| matches!(usage, SyncManagerType::Outputs | SyncManagerType::Inputs);
        let sync_managers = (0..).zip(&description.sync_managers).filter(|(_, sm)| is_used(sm.usage));
        let assignments = sync_managers.map(|(number, _)| {
            let assigned = pdos().filter(|pdo| pdo.sync_manager == Some(number)).map(|pdo| pdo.index);
            (assignment_object(number), assigned.collect())
        });
        let mappings = pdos().map(|pdo| (pdo.index, entries(pdo)));
        Self { assignments: assignments.collect(), mappings: mappings.collect() }
    }

    /// Takes over what the objects hold now. Nothing is allocated.
    pub fn follow(&mut self, objects: &PdoObjects) {
        for (assignment, pdos) in &mut self.assignments {
            pdos.clear();
            pdos.extend(objects.elements(*assignment));
        }
        for (pdo, entries) in &mut self.mappings {
            entries.clear();
            entries.extend(objects.entries(*pdo));
        }
    }

    /// Assigns exactly these PDOs, in this order; index 0 is an element without PDO. If `assignment` is no assignment
    /// object, nothing changes.
    pub fn assign(&mut self, assignment: ObjectIndex, pdos: impl IntoIterator<Item = ObjectIndex>) {
        if let Some((_, list)) = self.assignments.iter_mut().find(|(known, _)| *known == assignment) {
            list.clear();
            list.extend(pdos);
        }
    }

    /// Maps exactly these entries in `pdo`, in this order. If it is no PDO mapping object, nothing changes.
    pub fn map(&mut self, pdo: ObjectIndex, entries: impl IntoIterator<Item = PdoEntry>) {
        if let Some((_, list)) = self.mappings.iter_mut().find(|(known, _)| *known == pdo) {
            list.clear();
            list.extend(entries);
        }
    }

    /// The elements of an assignment object, those without PDO included; none if it is no assignment object.
    #[must_use]
    pub fn assignment(&self, assignment: ObjectIndex) -> &[ObjectIndex] {
        self.assignments.iter().find(|(known, _)| *known == assignment).map_or(&[], |(_, pdos)| pdos)
    }

    /// The PDOs that `assignment` lists, in the order of their assignment.
    pub fn assigned(&self, assignment: ObjectIndex) -> impl Iterator<Item = ObjectIndex> + '_ {
        self.assignment(assignment).iter().copied().filter(|pdo| pdo.0 != 0)
    }

    /// The entries that `pdo` maps, padding included; none if it is no PDO mapping object.
    #[must_use]
    pub fn entries(&self, pdo: ObjectIndex) -> &[PdoEntry] {
        self.mappings.iter().find(|(known, _)| *known == pdo).map_or(&[], |(_, entries)| entries)
    }

    /// The entries of all PDOs that `assignment` lists, each with its place.
    pub fn placed(&self, assignment: ObjectIndex) -> impl Iterator<Item = PlacedEntry> + '_ {
        let pdos = self.assigned(assignment);
        let entries = pdos.flat_map(|pdo| self.entries(pdo).iter().map(move |&entry| (pdo, entry)));
        entries.scan(0, |offset, (pdo, entry)| {
            let start = *offset;
            *offset += usize::from(entry.bit_length);
            Some(PlacedEntry { pdo, entry, bits: start..*offset })
        })
    }

    /// Length in bytes of those PDOs of `assignment` that count, rounded up at the end.
    pub fn size_bytes(&self, assignment: ObjectIndex, counts: impl Fn(ObjectIndex) -> bool) -> usize {
        let entries = self.assigned(assignment).filter(|&pdo| counts(pdo)).flat_map(|pdo| self.entries(pdo));
        entries.map(|entry| usize::from(entry.bit_length)).sum::<usize>().div_ceil(8)
    }
}

fn entries(pdo: &Pdo) -> Vec<PdoEntry> {
    let entry = |entry: &esi::PdoEntry| PdoEntry {
        index: entry.index,
        sub: entry.sub,
        bit_length: entry.bit_length.into(),
    };
    pdo.entries.iter().map(entry).collect()
}
