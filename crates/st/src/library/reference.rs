//! The library in the form of the documents.

use super::blocks::BLOCKS;
use super::function::{Function, Pin, ResultType, Takes};
use super::table::GROUPS;
use crate::elementary::{Class, Elementary};

/// A function or a function block of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its heading, such as `bit strings` or `function blocks`.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Its inputs and in-outs in their order, each with its other name and its types: `In: BYTE … LWORD, Num
    /// (N): integer`.
    pub inputs: String,
    /// The type of its result, or its outputs.
    pub outputs: String,
    /// Its description, one line.
    pub does: &'static str,
}

/// All functions and function blocks that a program may call; conversions by name (`INT_TO_REAL`) are not included.
#[must_use]
pub fn reference() -> Vec<Entry> {
    let functions =
        GROUPS.into_iter().flat_map(|(group, functions)| functions.iter().map(move |row| (group, row)));
    let named = functions.filter(|(_, function)| !function.name.starts_with('_'));
    let blocks = BLOCKS.iter().map(|row| Entry {
        group: "function blocks",
        name: row.name,
        inputs: row.inputs.to_owned(),
        outputs: row.outputs.to_owned(),
        does: row.does,
    });
    named.map(|(group, function)| of_function(group, function)).chain(blocks).collect()
}

fn of_function(group: &'static str, function: &Function) -> Entry {
    let mut inputs = function.pins.iter().map(of_pin).collect::<Vec<_>>().join(", ");
    if function.variadic {
        inputs.push_str(", …");
    }
    Entry { group, name: function.name, inputs, outputs: of_result(function.result), does: function.does }
}

fn of_pin(pin: &Pin) -> String {
    let alias = if pin.alias.is_empty() { String::new() } else { format!(" ({})", pin.alias) };
    let optional = if pin.default.is_some() { ", optional" } else { "" };
    format!("{}{alias}: {}{optional}", pin.name, of_taken(pin.takes))
}

fn of_taken(takes: Takes) -> String {
    match takes {
        Takes::Generic(classes) | Takes::Any(classes) => of_classes(classes),
        Takes::GenericOrText(classes) => format!("{} or STRING", of_classes(classes)),
        Takes::Fixed(elementary) => elementary.name().to_owned(),
        Takes::Text => "STRING".to_owned(),
        Takes::Variable(classes) => format!("variable, {}", of_classes(classes)),
        Takes::Elements { .. } => "element of an array".to_owned(),
        Takes::Reference => "variable".to_owned(),
    }
}

/// Types by the first and last of each class: `SINT … LINT`.
fn of_classes(classes: &[Class]) -> String {
    const CLASSES: usize = 7;
    if classes.len() == CLASSES {
        return "elementary".to_owned();
    }
    let types = classes.iter().map(|class| {
        let all: Vec<_> =
            Elementary::ALL.into_iter().filter(|elementary| elementary.class() == *class).collect();
        match all.as_slice() {
            [first, .., last] => format!("{first} … {last}"),
            _ => all.iter().map(|elementary| elementary.name()).collect(),
        }
    });
    types.collect::<Vec<_>>().join(", ")
}

fn of_result(result: ResultType) -> String {
    match result {
        ResultType::Generic => "the type of the inputs".to_owned(),
        ResultType::Whole => "DINT or LINT".to_owned(),
        ResultType::Fixed(elementary) => elementary.name().to_owned(),
        ResultType::Text | ResultType::TextOfAll | ResultType::TextOf(_) => "STRING".to_owned(),
    }
}
