//! Facts about entries of objects: the same data on the other side, and bits with names.

use nx_bus::SlaveStatus;
use unit_model::tables::{EntryFact, Fact};
use wire::{EntryAddress, ObjectIndex, SubIndex};

use crate::data_sets::DataSet;
use crate::status::SLAVE_STATUS_BITS;

/// The NX object of each entry of the dictionary that has one.
pub(super) fn of_dictionary() -> Vec<EntryFact> {
    let counterpart = |set: &DataSet, sub| fact("NX object", set.pdo_entry, set.nx_entry, sub, &set.name);
    DataSet::all().iter().flat_map(|set| subs(set).map(move |sub| counterpart(set, sub))).collect()
}

/// The entry of the dictionary for each NX object that has one, and the bits of EtherCAT Slave Status.
pub(super) fn of_nx_objects() -> Vec<EntryFact> {
    let counterpart = |set: &DataSet, sub| fact("CoE object", set.nx_entry, set.pdo_entry, sub, &set.name);
    let of_sets = DataSet::all().iter().flat_map(|set| subs(set).map(move |sub| counterpart(set, sub)));
    let (index, sub) = SlaveStatus::NX_OBJECT;
    let bit = |bit: &crate::status::StatusBit| EntryFact {
        entry: EntryAddress { index, sub },
        fact: Fact::new(format!("bit {}", bit.bit), bit.port),
    };
    of_sets.chain(SLAVE_STATUS_BITS.iter().map(bit)).collect()
}

/// The subindexes of its entries.
fn subs(set: &DataSet) -> impl Iterator<Item = SubIndex> {
    (1..=set.max_count).map(SubIndex)
}

fn fact(label: &'static str, index: ObjectIndex, other: ObjectIndex, sub: SubIndex, name: &str) -> EntryFact {
    EntryFact { entry: EntryAddress { index, sub }, fact: Fact::new(label, format!("{other}:{sub}, {name}")) }
}
