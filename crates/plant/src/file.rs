//! A unit file, whatever its model.

use std::sync::Arc;

use plc::behaviour::BehaviourSection;
use plc::{CpuSection, DeviceVariables, WithCpu};
use unit_model::{UnitFiles, UnitSection};
use user_file::{FileErrors, Problem, Reader, Section, Wanted, read_toml, values};

use crate::registry::{default_model, models};

const MODEL: &str = "model";
const NAME: &str = "name";

/// One unit with its CPU Unit, before it has power.
#[derive(Clone, Debug)]
pub struct UnitFile {
    section: Arc<dyn UnitSection>,
    cpu: CpuSection,
    variables: DeviceVariables,
    behaviours: BehaviourSection,
    is_named: bool,
}

impl UnitFile {
    /// Reads the text of a unit file.
    ///
    /// # Errors
    /// Everything that is wrong, in the order of the file. Of a file without a known model only that is reported.
    pub fn parse(text: &str) -> Result<Self, FileErrors> {
        Self::parse_with(models(), text)
    }

    /// The same with these models in place of those of the registry.
    ///
    /// # Errors
    /// As [`UnitFile::parse`].
    pub fn parse_with(models: &[&'static dyn UnitFiles], text: &str) -> Result<Self, FileErrors> {
        read_toml(text, Wanted::UnitFile, |reader, file| Self::read_with(models, reader, file))
    }

    /// The shortest file of the default model: its factory setting.
    #[must_use]
    pub fn factory_text() -> String {
        format!("{MODEL} = \"{}\"", default_model().name())
    }

    /// A unit of the default model with its factory setting.
    #[must_use]
    pub fn factory() -> Self {
        Self::parse(&Self::factory_text()).unwrap_or_else(|_| unreachable!("the only key that a file needs"))
    }

    /// Reads a unit that is a table of another file. What is wrong is refused by `reader`.
    pub fn read(reader: &mut Reader<'_>, table: &Section<'_, '_>) -> Option<Self> {
        Self::read_with(models(), reader, table)
    }

    fn read_with(
        models: &[&'static dyn UnitFiles],
        reader: &mut Reader<'_>,
        table: &Section<'_, '_>,
    ) -> Option<Self> {
        let model = model(models, reader, table)?;
        refuse_keys_of_others(models, reader, table, model);
        let WithCpu { unit: section, cpu } =
            WithCpu::read(reader, table, |reader, table| model.read(reader, table))?;
        let variables = DeviceVariables::of(section.variables());
        let behaviours = BehaviourSection::read(reader, table, &variables);
        Some(Self { section, cpu, variables, behaviours, is_named: table.get(NAME).is_some() })
    }

    /// The part that its model has read.
    #[must_use]
    pub fn section(&self) -> &dyn UnitSection {
        &*self.section
    }

    /// The name of the unit.
    #[must_use]
    pub fn name(&self) -> &str {
        self.section.name()
    }

    /// Whether the file has this name, or the model has given it.
    #[must_use]
    pub const fn is_named(&self) -> bool {
        self.is_named
    }

    /// Its CPU Unit.
    #[must_use]
    pub const fn cpu(&self) -> &CpuSection {
        &self.cpu
    }

    /// The device variables of the CPU Unit.
    #[must_use]
    pub const fn variables(&self) -> &DeviceVariables {
        &self.variables
    }

    /// What variables do by themselves.
    #[must_use]
    pub const fn behaviours(&self) -> &BehaviourSection {
        &self.behaviours
    }

    /// The same, to read the files that it names. One that is not read has no effect.
    pub const fn behaviours_mut(&mut self) -> &mut BehaviourSection {
        &mut self.behaviours
    }
}

/// The model that the file names.
fn model(
    models: &[&'static dyn UnitFiles],
    reader: &mut Reader<'_>,
    table: &Section<'_, '_>,
) -> Option<&'static dyn UnitFiles> {
    let choices: Vec<(&str, &'static dyn UnitFiles)> =
        models.iter().map(|&model| (model.name(), model)).collect();
    if table.get(MODEL).is_none() {
        let names: Vec<String> =
            models.iter().map(|model| format!("`model = \"{}\"`", model.name())).collect();
        reader.require(table, MODEL, &names.join(" or "));
    }
    reader.value(table, MODEL, |place, value| values::choice(place, value, &choices)).map(|model| model.value)
}

/// A key of another model is refused in other words than one that no model has.
fn refuse_keys_of_others(
    models: &[&'static dyn UnitFiles],
    reader: &mut Reader<'_>,
    table: &Section<'_, '_>,
    model: &dyn UnitFiles,
) {
    let own = model.keys();
    for (key, _) in table.entries().into_iter().filter(|(key, _)| !own.contains(&key.value)) {
        if let Some(other) = models.iter().find(|other| other.keys().contains(&key.value)) {
            let message =
                format!("`{}` is a key of the model {}, not of {}", key.value, other.name(), model.name());
            reader.refuse_key(&key, Problem::new(message, ""));
        }
    }
}

#[cfg(test)]
mod tests {
    use plc::VariableAccess;

    use super::*;

    fn messages(text: &str) -> Vec<String> {
        match UnitFile::parse(text) {
            Ok(file) => panic!("{file:?}"),
            Err(errors) => errors.iter().map(ToString::to_string).collect(),
        }
    }

    #[test]
    fn the_model_reads_its_file() {
        for (text, model, name) in [
            ("model = \"nx-ect101\"", "nx-ect101", "N1"),
            ("model = \"digital\"\nname = \"K7\"\ninputs = 8", "digital", "K7"),
        ] {
            let file = UnitFile::parse(text).unwrap_or_else(|errors| panic!("{errors}"));
            assert_eq!((file.section().model().name(), file.name()), (model, name));
            assert_eq!(file.is_named(), text.contains("name ="));
        }
    }

    #[test]
    fn the_factory_setting_needs_no_file() {
        let file = UnitFile::factory();
        assert_eq!((file.section().model().name(), file.name()), (default_model().name(), "N1"));
    }

    #[test]
    fn no_two_variables_of_the_largest_terminal_share_a_modbus_address() {
        let file =
            UnitFile::parse("model = \"digital\"\nname = \"K7\"\noutputs = 64\ninputs = 64").expect("a unit");
        let mut taken = std::collections::BTreeSet::new();
        for (_, variable) in file.variables().iter() {
            let Some(address) = variable.modbus else { continue };
            let is_read_only = variable.access == VariableAccess::ReadOnly;
            for element in 0..variable.variable_type.elements.unwrap_or(1) {
                assert!(taken.insert((is_read_only, address.first + element)), "{}", variable.name);
            }
            if let Some(forced) = address.forced {
                assert!(taken.insert((false, forced)), "{}", variable.name);
            }
        }
        assert!(
            file.variables().find("K7_Output_64").is_some() && file.variables().find("K7_Input_64").is_some()
        );
    }

    #[test]
    fn a_file_without_a_known_model_is_told_which_there_are() {
        assert_eq!(
            messages("name = \"N1\""),
            ["1:1: `model` is missing, expected `model = \"nx-ect101\"` or `model = \"digital\"`"]
        );
        assert_eq!(
            messages("model = \"digitel\"\ninputs = 8"),
            ["1:9: `model` is \"digitel\", expected \"nx-ect101\" or \"digital\"; did you mean `digital`?"]
        );
    }

    #[test]
    fn a_key_of_another_model_is_refused_once_with_that_model() {
        assert_eq!(
            messages("model = \"digital\"\nid_switch = 1"),
            ["2:1: `id_switch` is a key of the model nx-ect101, not of digital"]
        );
        assert_eq!(
            messages("model = \"nx-ect101\"\ninputs = 1"),
            ["2:1: `inputs` is a key of the model digital, not of nx-ect101"]
        );
        assert!(
            messages("model = \"digital\"\nputs = 1")[0]
                .starts_with("2:1: unknown key `puts`, expected `model`")
        );
    }
}
