//! The device variables, as globals of Structured Text.

use st::Global;

use crate::device_variables::{DeviceVariables, NodeLocation, VariableAccess, VariableId};

/// Globals, and the device variable of each except the last.
pub(super) struct Globals {
    pub(super) list: Vec<Global>,
    pub(super) variables: Vec<VariableId>,
}

/// All variables of a CPU Unit, followed by the location of its unit, which NX_ReadObj and NX_WriteObj require:
/// a variable of the type `_sNXUNIT_ID` that is assigned to the port *Node location information*.
pub(super) fn of(variables: &DeviceVariables) -> Globals {
    let globals = variables.iter().map(|(_, variable)| Global {
        name: variable.name.clone(),
        at: variable.at.clone(),
        type_name: variable.variable_type.to_string(),
        writable: variable.access == VariableAccess::ReadWrite,
        constant: None,
    });
    let mut list: Vec<_> = globals.collect();
    let NodeLocation { name, at, type_name, unit_number, .. } = variables.node_location();
    list.push(Global {
        name,
        at: Some(at),
        type_name: type_name.to_owned(),
        writable: false,
        constant: Some(format!("(UnitNo := {unit_number})")),
    });
    Globals { list, variables: variables.iter().map(|(id, _)| id).collect() }
}
