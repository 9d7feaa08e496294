//! The keys `behaviour` and `loopback` of a unit file, for every model with variables.

use user_file::{Problem, Reader, Section, values};

use super::keys::behaviour;
use super::named_variables::{loop_of, numeric, overlap, variable, written_variable};
use super::section::{Behaviour, BehaviourSection};
use crate::device_variables::DeviceVariables;

/// The keys at the top of a unit file.
pub const BEHAVIOUR_KEYS: [&str; 2] = [BEHAVIOUR, LOOPBACK];

const BEHAVIOUR: &str = "behaviour";
const LOOPBACK: &str = "loopback";

impl BehaviourSection {
    /// Reads both keys; `variables` are those of the unit.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>, variables: &DeviceVariables) -> Self {
        let mut read = Self::default();
        let mut written = Vec::new();
        if let Some(section) = reader.section(file, BEHAVIOUR) {
            for (name, value) in section.entries() {
                let target = written_variable(reader, &section, &name, variables, &mut written);
                let numeric = target.and_then(|target| numeric(reader, &name, target, variables));
                let (Some(target), Some(numeric)) = (target, numeric) else { continue };
                if let Some(does) = behaviour(reader, &section.place_of(name.value), value, numeric) {
                    read.behaviours.push(Behaviour { target, numeric, does });
                }
            }
        }
        if let Some(section) = reader.section(file, LOOPBACK) {
            let mut places = Vec::new();
            for (name, value) in section.entries() {
                let to = written_variable(reader, &section, &name, variables, &mut written);
                let from = reader.read(&section.place_of(name.value), value, |place, value| {
                    let from = values::text(place, value, "the name of a variable")?;
                    variable(from, variables)
                });
                let (Some(to), Some(from)) = (to, from) else { continue };
                match loop_of(variables, to, from.value) {
                    Ok(pair) => {
                        read.loops.push(pair);
                        places.push(value.span());
                    }
                    Err(problem) => reader.refuse(value.span(), problem),
                }
            }
            for (pair, place) in read.loops.iter().zip(places) {
                if read.loops.iter().any(|other| overlap(pair.from, other.to)) {
                    let message = "the value comes from a variable that is looped back itself";
                    reader.refuse(
                        place,
                        Problem::new(message, "the variable from which that one has its value"),
                    );
                }
            }
        }
        read
    }
}

#[cfg(test)]
pub(super) mod tests;
