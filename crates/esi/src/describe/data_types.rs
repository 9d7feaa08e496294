//! The data types of a dictionary, by name.

use std::collections::BTreeMap;

use wire::DataType;

use crate::file::{DataTypeElement, DictionaryElement};
use crate::lint::finding::Report;
use crate::lint::rules;
use crate::type_names;

/// The data types of a dictionary by their names.
pub(super) struct DataTypes<'a> {
    by_name: BTreeMap<&'a str, &'a DataTypeElement>,
}

/// Longest chain of types of which each names the next one.
const CHAIN_MAX: usize = 8;

impl<'a> DataTypes<'a> {
    pub(super) fn of(dictionary: &'a DictionaryElement, report: &dyn Report) -> Self {
        let mut by_name = BTreeMap::new();
        for element in &dictionary.data_types {
            if by_name.contains_key(element.name.as_str()) {
                let message =
                    format!("the type `{}` is there before; dropped", user_file::shown(&element.name));
                report.report(rules::TWICE, element.place, message);
            } else {
                by_name.insert(element.name.as_str(), element);
            }
        }
        Self { by_name }
    }

    pub(super) fn element(&self, name: &str) -> Option<&'a DataTypeElement> {
        self.by_name.get(name).copied()
    }

    /// The type of a value and its bits; none if the name leads to none of the standard.
    pub(super) fn value(&self, name: &str) -> Option<(DataType, u32)> {
        let mut name = name;
        for _ in 0..CHAIN_MAX {
            if let Some(found) = type_names::parse(name) {
                return Some(found);
            }
            let element = self.element(name)?;
            if let Some((_, elements)) = element.array {
                return type_names::array_of(&element.base_type, elements.into());
            }
            name = &element.base_type;
        }
        None
    }
}
