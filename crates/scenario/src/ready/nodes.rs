//! Node addresses of the units: a master with its own program identifies each unit by its ID (manual, 3-3), or by its
//! station alias if it has no ID switch.

use unit_model::Model;

use super::maker::Maker;
use super::problem::Part;
use crate::model::ID_SWITCH;
use crate::run::NODE_ADDRESS_MAX;

impl Maker<'_> {
    /// The node address of each unit, in the order of the line. Refuses those that are missing, equal, or out of range,
    /// each with its unit.
    pub(super) fn node_addresses(&mut self) -> Option<Vec<u16>> {
        let addresses = self.units.iter().map(|unit| unit.file.section().node_address());
        let addresses: Vec<u16> = addresses.collect();
        let models = self.units.iter().map(|unit| unit.file.section().model());
        let problems = models.enumerate().filter_map(|(at, model)| {
            let message = problem(&addresses, at, model)?;
            Some((at, message, way_out(&addresses, model)))
        });
        let problems: Vec<_> = problems.collect();
        let are_right = problems.is_empty();
        for (at, message, help) in problems {
            self.refuse(Part::Unit(at), message, help);
        }
        are_right.then_some(addresses)
    }
}

/// Why the unit at this position has no node address, or one that it cannot have.
fn problem(addresses: &[u16], at: usize, model: &dyn Model) -> Option<String> {
    let (address, unit) = (*addresses.get(at)?, at + 1);
    let name = if has_id_switch(model) { "ID" } else { "alias" };
    if address == 0 {
        return Some(format!("unit {unit} has no {name}: the master's program needs it as the node address"));
    }
    if address > NODE_ADDRESS_MAX {
        return Some(format!(
            "unit {unit} has the {name} {address}: a node address is 1 to {NODE_ADDRESS_MAX}"
        ));
    }
    let first = addresses.iter().position(|other| *other == address).filter(|first| *first < at)?;
    Some(format!("units {} and {unit} both have the node address {address}", first + 1))
}

/// Suggests a free node address, by the keys of the model; there is none for a line with more units than node addresses.
fn way_out(addresses: &[u16], model: &dyn Model) -> String {
    let free = (1..=NODE_ADDRESS_MAX).find(|address| !addresses.contains(address));
    let keys = free.map_or_else(String::new, |free| match has_id_switch(model) {
        true => format!("`id_switch = {free}`, or `id_switch = 0` and `alias = {free}`: "),
        false => format!("`alias = {free}`: "),
    });
    format!("{keys}each unit needs a different node address if the master has a program")
}

fn has_id_switch(model: &dyn Model) -> bool {
    model.switches().contains(&ID_SWITCH)
}
