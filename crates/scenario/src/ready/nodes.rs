//! Node addresses of the units: a master with its own program identifies each unit by its ID (manual, 3-3).

use super::maker::Maker;
use super::problem::Part;
use crate::run::NODE_ADDRESS_MAX;

impl Maker<'_> {
    /// The node address of each unit, in the order of the line. Refuses IDs that are missing, equal, or not a
    /// node address, each with its unit.
    pub(super) fn node_addresses(&mut self) -> Option<Vec<u16>> {
        let ids = self.units.iter().map(|unit| unit.file.section().explicit_device_id());
        let ids: Vec<u16> = ids.collect();
        let problems = (0..ids.len()).filter_map(|at| Some((at, problem(&ids, at)?)));
        let problems: Vec<_> = problems.collect();
        let are_right = problems.is_empty();
        for (at, message) in problems {
            self.refuse(Part::Unit(at), message, way_out(&ids));
        }
        are_right.then_some(ids)
    }
}

/// Why the ID of the unit at this position cannot be its node address.
fn problem(ids: &[u16], at: usize) -> Option<String> {
    let (id, unit) = (*ids.get(at)?, at + 1);
    if id == 0 {
        return Some(format!("unit {unit} has no ID: the master's program needs it as the node address"));
    }
    if id > NODE_ADDRESS_MAX {
        return Some(format!("unit {unit} has the ID {id}: a node address is 1 to {NODE_ADDRESS_MAX}"));
    }
    let first = ids.iter().position(|other| *other == id).filter(|first| *first < at)?;
    Some(format!("units {} and {unit} both have the ID {id}: it is the node address", first + 1))
}

/// Suggests a free ID; there is none for a line with more units than node addresses.
fn way_out(ids: &[u16]) -> String {
    let free = (1..=NODE_ADDRESS_MAX).find(|id| !ids.contains(id));
    let keys = free.map_or_else(String::new, |id| {
        format!("`id_switch = {id}`, or `id_switch = 0` and `alias = {id}`: ")
    });
    format!("{keys}each unit needs a different ID if the master has a program")
}
