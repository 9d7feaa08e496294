//! Variables, objects and sentences of a line that runs, for those who name them without a sentence.

use plc::DeviceVariables;
use user_file::nearest;

use super::known_line::{KnownLine, NoFiles, PART};
use super::masters_words::is_of_master;
use crate::model::{Condition, Entry, UnitWords, WhichUnit};
use crate::refused::{Reason, Refused};
use crate::words::{Sentence, Spoken};

impl KnownLine {
    /// The names of the units at the beginning, by which sentences name their places.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether there is a device variable, or an element of one, such as `N1_UINTs_01_M_to_C[3]`.
    ///
    /// # Errors
    /// [`Refused`]: there is none, with the nearest name; or several units have it.
    pub fn variable(&mut self, name: &str) -> Result<(), Refused> {
        let checked = self.check(&mut NoFiles, |maker| {
            maker.type_of_variable(name, PART);
        });
        checked.map(drop).map_err(|refused| refused.with_nearest(self.near_variable(name)))
    }

    fn near_variable(&self, name: &str) -> Vec<String> {
        let all = self.variables.iter().flat_map(|variables: &DeviceVariables| variables.iter());
        let names: Vec<&str> = all.map(|(_, variable)| variable.name.as_str()).collect();
        nearest(name, &names).into_iter().collect()
    }

    /// The position of a unit and an entry of one of its objects, from words such as `N1 1018:04` or `2 1018:04`.
    ///
    /// # Errors
    /// [`Refused`]: the words are others, or there is none.
    pub fn object(&mut self, words: &str) -> Result<(usize, Entry), Refused> {
        let (unit, entry) = words.trim().rsplit_once(char::is_whitespace).unwrap_or_default();
        let unit = unit.trim();
        let unit: Option<WhichUnit> = unit.strip_prefix("unit ").unwrap_or(unit).trim().parse().ok();
        let (Some(mut unit), Ok(entry)) = (unit, entry.parse::<Entry>()) else {
            let message = format!("`{words}` is no unit with an entry of an object");
            return Err(Refused::new(Reason::NotThere, message, "such as `N1 1018:04` or `1 1018:04`"));
        };
        self.number(Some(UnitWords::One(&mut unit)))?;
        self.check(&mut NoFiles, |maker| {
            if maker.check_units(Some(UnitWords::One(&mut unit.clone())), PART).is_some() {
                maker.check_object_exists(&unit, entry, PART);
            }
        })?;
        Ok((unit.position(), entry))
    }

    /// Whether a condition of the tables is about the scripted master of a scenario, which is not here.
    #[must_use]
    pub fn is_of_scripted_master(row: &Sentence<Condition>) -> bool {
        Condition::from_sentence(row.example).is_ok_and(|condition| is_of_master(&condition).is_some())
    }
}
