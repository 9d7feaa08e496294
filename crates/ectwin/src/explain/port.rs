//! I/O ports of the unit at its CPU Unit, and system-defined variables: the names by which programs use them.

use std::sync::LazyLock;

use plc::{DeviceVariables, Variable, VariableAccess};

use super::{Explanation, Fact, Subject};

static PORTS: LazyLock<Vec<Port>> = LazyLock::new(ports);

#[derive(Debug)]
struct Port {
    /// Name of the I/O port; for a system-defined variable its own name.
    name: String,
    /// Names for a unit with the device name N1: the variable, and the AT specification.
    variable: String,
    at: Option<String>,
    meaning: String,
    facts: Vec<(&'static str, String)>,
}

/// Each name with its port.
pub(super) fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
    PORTS.iter().flat_map(|port| {
        let names = [Some(&port.name), Some(&port.variable), port.at.as_ref()];
        names.into_iter().flatten().map(|name| (name.as_str(), port.name.as_str()))
    })
}

pub(super) fn explanation(name: &'static str) -> Option<Explanation> {
    let port = PORTS.iter().find(|port| port.name == name)?;
    let facts = port.facts.iter().map(|(label, text)| Fact::new(*label, text.as_str())).collect();
    let (subject, name) = (Subject::Port(&port.name), port.meaning.clone());
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections: Vec::new() })
}

fn ports() -> Vec<Port> {
    let mut ports: Vec<Port> = Vec::new();
    for table in plant::default_model().every_variable() {
        let variables = DeviceVariables::of(table);
        let location = variables.node_location();
        let location = Port {
            name: location.port.to_owned(),
            variable: location.name.clone(),
            at: Some(location.at.clone()),
            meaning: format!(
                "{}, the address of the unit for NX_ReadObj and NX_WriteObj",
                location.type_name
            ),
            facts: vec![("variable", location.name), ("AT", location.at)],
        };
        for port in variables.iter().map(|(_, variable)| port(&variables, variable)).chain([location]) {
            if !ports.iter().any(|known| known.name == port.name) {
                ports.push(port);
            }
        }
    }
    ports
}

fn port(variables: &DeviceVariables, variable: &Variable) -> Port {
    let Variable { name, at, variable_type, .. } = variable;
    let access = match variable.access {
        VariableAccess::ReadOnly => "programs read it",
        VariableAccess::ReadWrite => "programs read and write it",
    };
    let mut facts = vec![("variable", name.clone())];
    facts.extend(at.iter().map(|at| ("AT", at.clone())));
    if let Some((word, bit)) = variables.word_of(variable).zip(variable.place.bit_number()) {
        let (name, first) = (word.port.as_ref().unwrap_or(&word.name), 8 * word.place.start);
        facts.push(("bit", format!("{} of {name}", bit - first)));
    }
    Port {
        name: variable.port.clone().unwrap_or_else(|| name.clone()),
        variable: name.clone(),
        at: at.clone(),
        meaning: format!("{variable_type}, {access}"),
        facts,
    }
}
