//! The names of units in what is seen: a step that names a unit is answered with this name.

use super::report::Failure;
use super::scenario::Scenario;
use crate::model::UnitName;

/// The names of the units of a line, the one next to the master first; empty for one that another unit has too.
pub(super) struct NamedUnits {
    names: Vec<String>,
}

impl NamedUnits {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let all: Vec<&str> = scenario.units.iter().map(|unit| unit.file.name()).collect();
        let is_unique = |name: &str| all.iter().filter(|other| **other == name).count() == 1;
        let names = all.iter().map(|name| if is_unique(name) { (*name).to_owned() } else { String::new() });
        Self { names: names.collect() }
    }

    /// The failure with the names that its step has in place of the numbers of these units.
    pub(super) fn in_failure(&self, failure: Failure) -> Failure {
        let Failure { text, mut seen, .. } = failure;
        for (at, name) in self.names.iter().enumerate().filter(|(_, name)| has_name(&text, name)) {
            seen = named(&seen, at + 1, name);
        }
        Failure { text, seen, ..failure }
    }
}

/// Whether one of the words of a step is this name.
fn has_name(text: &str, name: &str) -> bool {
    let mut words = text.split(|letter: char| letter.is_whitespace() || "(),;".contains(letter));
    words.any(|word| word.parse().is_ok_and(|word: UnitName| word.is(name)))
}

/// The text with `unit NAME` in place of `unit NUMBER`.
fn named(text: &str, number: usize, name: &str) -> String {
    let numbered = format!("unit {number}");
    let mut parts = text.split(numbered.as_str());
    let mut named = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        // `unit 12` is not `unit 1`.
        let is_other = part.starts_with(|letter: char| letter.is_ascii_digit());
        named += &if is_other { numbered.clone() } else { format!("unit {name}") };
        named += part;
    }
    named
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_unit_of_this_number_gets_the_name() {
        assert_eq!(named("unit 1 and unit 12: unit 1", 1, "Lamps"), "unit Lamps and unit 12: unit Lamps");
        assert_eq!(named("nothing", 1, "Lamps"), "nothing");
    }

    #[test]
    fn a_name_is_a_word_of_the_step() {
        assert!(has_name("all of (unit lamps is in OP; unit 2 is in OP)", "Lamps"));
        assert!(!has_name("Lamps_Input_1 is TRUE", "Lamps") && !has_name("unit 1 is in OP", ""));
    }
}
