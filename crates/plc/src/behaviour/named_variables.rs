//! The variables that the keys of a unit file name.

use user_file::{Located, Problem, Reader, Section, did_you_mean, nearest, shown};
use variables::{Numeric, Target, TextProblem, VariableTable, VariableValue, variable_name};

use super::section::Loop;
use crate::device_variables::DeviceVariables;

/// The variable of a key; it is written by this key only.
pub(super) fn written_variable(
    reader: &mut Reader<'_>,
    section: &Section<'_, '_>,
    name: &Located<&str>,
    variables: &DeviceVariables,
    written: &mut Vec<Target>,
) -> Option<Target> {
    let found = variable(name.value, variables).and_then(|target| {
        if !is_writable(target, variables) {
            let message = format!("`{}` is set by the master", name.value);
            return Err(Problem::new(message, "a variable that goes to the master"));
        }
        if written.iter().any(|other| overlap(target, *other)) {
            let message = format!("`{}` has a behaviour already", section.place_of(name.value));
            return Err(Problem::new(message, "one for each variable"));
        }
        written.push(target);
        Ok(target)
    });
    found.map_err(|problem| reader.refuse_key(name, problem)).ok()
}

/// The variable with this name, with or without the name of the unit; blanks and dots of an entry's name are underscores.
pub(super) fn variable(name: &str, variables: &VariableTable) -> Result<Target, Problem> {
    let unit = variables.unit().device_name.as_str();
    let (entry, element) = name.split_at(name.find('[').unwrap_or(name.len()));
    let with_unit = || format!("{}{element}", variable_name(unit, entry));
    let found = variables.find_target(name).or_else(|_| variables.find_target(&with_unit()));
    found.map_err(|error| {
        if let TextProblem::NoSuchPlace(problem) = error.problem {
            return Problem::new(format!("`{}`: {problem}", shown(name)), "");
        }
        let of_unit =
            variables.iter().filter_map(|(_, variable)| variable.name.strip_prefix(unit)?.strip_prefix('_'));
        let names: Vec<&str> = of_unit.collect();
        let message = format!("the unit has no variable `{}`", shown(name));
        let problem = Problem::new(message, "one that `ectwin map` lists");
        match nearest(entry, &names) {
            Some(nearest) => problem.with_help(did_you_mean(nearest + element)),
            None => problem,
        }
    })
}

fn is_writable(target: Target, variables: &VariableTable) -> bool {
    let zeros: VariableValue = match variables.type_of(target) {
        Ok(variable_type) => core::iter::repeat_n(0, variable_type.size_bytes()).collect(),
        Err(_) => return false,
    };
    variables.writable(target, &zeros).is_ok()
}

/// Whether two targets share an element.
pub(super) fn overlap(one: Target, other: Target) -> bool {
    let is_shared = one.element.is_none() || other.element.is_none() || one.element == other.element;
    one.variable == other.variable && is_shared
}

/// How numbers become values of a variable with a behaviour.
pub(super) fn numeric(
    reader: &mut Reader<'_>,
    name: &Located<&str>,
    target: Target,
    variables: &VariableTable,
) -> Option<Numeric> {
    let variable_type = variables.type_of(target).ok()?;
    let refused = if variable_type.elements.is_some() {
        "one element, such as `NAME[0]`"
    } else if let Some(numeric) = Numeric::of(variable_type.elementary) {
        return Some(numeric);
    } else {
        "a variable whose values are numbers"
    };
    reader.refuse_key(name, Problem::new(format!("`{}` is {variable_type}", name.value), refused));
    None
}

pub(super) fn loop_of(variables: &VariableTable, to: Target, from: Target) -> Result<Loop, Problem> {
    match (variables.type_of(to), variables.type_of(from)) {
        (Ok(to_type), Ok(from_type)) if to_type == from_type => Ok(Loop { to, from }),
        (Ok(to_type), Ok(from_type)) => Err(Problem::new(
            format!("the variable is {from_type}, and the one that gets its value is {to_type}"),
            "two variables of one type",
        )),
        _ => Err(Problem::new("not a variable of the unit", "a variable")),
    }
}
