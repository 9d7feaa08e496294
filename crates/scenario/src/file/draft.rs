//! A script from a file, with the places of its parts.

use time::Duration;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};
use user_file::{Located, Problem, Reader, Section, Value, field_names, wrong_type};

use super::groups::{Scope, read_steps};
use super::names::{Names, written};
use super::parameters::{USE, WITH};
use super::places::MasterPlaces;
use super::reader::{FileReader, span_of};
use super::values;
use crate::model::{FileWithProgram, Script, ScriptMaster, ScriptUnit};
use crate::ready::{Draft, LIMIT_MAX, STEPS_WAY_OUT, empty_list, is_unit};

/// The key of the title, a text.
const TITLE: &str = "title";

impl FileReader<'_, '_> {
    /// The script with the words of its steps; wrong parts are left out. `names` are replaced in all texts.
    pub(super) fn draft<'d, 'i>(&mut self, file: &Section<'d, 'i>, names: &Names<'_, 'i>) -> Draft {
        self.keys(file);
        let whole = (!names.are_none()).then(|| head(file, self.reader, names));
        let replaced = whole.as_ref().and_then(|whole| Section::of("", whole));
        let mut draft = self.head(replaced.as_ref().unwrap_or(file));
        self.steps(file, names, &mut draft.script);
        Draft { written: core::mem::take(&mut self.written), ..draft }
    }

    fn keys(&mut self, file: &Section<'_, '_>) {
        let keys: Vec<&str> = field_names::<Script>().iter().copied().chain([WITH, USE]).collect();
        self.reader.only(file, &keys);
    }

    /// All but the steps.
    fn head(&mut self, file: &Section<'_, '_>) -> Draft {
        let mut script = self.whole(file);
        // Without `units`, an unknown key may be a misspelt `units`.
        let are_units_known = file.get("units").is_some() || self.reader.refused() == 0;
        let refused = self.reader.refused();
        script.master = self.reader.section(file, "master").and_then(|master| self.master(&master));
        self.units(file, &mut script);
        let is_whole = are_units_known && self.reader.refused() == refused;
        Draft { script, written: Vec::new(), is_whole }
    }

    /// The general part of the file.
    fn whole(&mut self, file: &Section<'_, '_>) -> Script {
        let mut script = Script::new(&self.value(file, TITLE, values::text).unwrap_or_default());
        script.seed = self.value(file, "seed", values::number).unwrap_or(script.seed);
        self.places.limit = span_of(file, "limit");
        script.limit = self.limit(file, script.limit);
        self.places.cycle = span_of(file, "cycle");
        script.cycle = self.value(file, "cycle", values::duration).unwrap_or(script.cycle);
        self.places.cycle_phase = span_of(file, "cycle_phase");
        script.cycle_phase = self.value(file, "cycle_phase", values::duration);
        script.calendar = self.value(file, "calendar", values::calendar).unwrap_or(script.calendar);
        script.capture = self.value(file, "capture", values::text);
        script
    }

    /// A limit that cannot be read is not applied.
    fn limit(&mut self, file: &Section<'_, '_>, default: Duration) -> Duration {
        let absent = if file.get("limit").is_none() { default } else { LIMIT_MAX };
        self.value(file, "limit", values::duration).unwrap_or(absent)
    }

    fn master(&mut self, section: &Section<'_, '_>) -> Option<ScriptMaster> {
        self.reader.only(section, field_names::<ScriptMaster>());
        self.reader.require(section, "program", "the user program of the master");
        self.places.master = MasterPlaces {
            program: span_of(section, "program"),
            device_names: span_of(section, "device_names"),
            task_period: span_of(section, "task_period"),
        };
        let program = self.value(section, "program", values::paths);
        let device_names = self.value(section, "device_names", values::names);
        let task_period = self.value(section, "task_period", values::duration);
        Some(ScriptMaster { program: program?, device_names: device_names.unwrap_or_default(), task_period })
    }

    fn units(&mut self, file: &Section<'_, '_>, script: &mut Script) {
        self.refuse_empty(file, "units", "leave `units` out for one unit at its factory setting");
        for (at, unit) in self.list(file, "units").iter().enumerate() {
            if let Some(read) = self.unit(at, unit) {
                self.places.units.push(unit.span());
                script.units.push(read);
            }
        }
    }

    fn unit(&mut self, at: usize, value: &Value<'_>) -> Option<ScriptUnit> {
        if let Some(path) = value.get_ref().as_str() {
            return Some(ScriptUnit::File(path.to_owned()));
        }
        let Some(section) = Section::of("", value) else {
            let expected = "the path of a unit file, or a table";
            let place = format!("units[{at}]");
            self.reader.refuse_by(value.span(), || wrong_type(&place, value.get_ref(), expected));
            return None;
        };
        if section.get("file").is_some() {
            self.reader.only(&section, field_names::<FileWithProgram>());
            let file = self.value(&section, "file", values::text);
            let program = self.value(&section, "program", values::paths);
            return Some(ScriptUnit::FileWithProgram(FileWithProgram { file: file?, program }));
        }
        if is_unit(self.reader, &section) { self.reader.typed("", value).map(ScriptUnit::Keys) } else { None }
    }

    fn steps<'d, 'i>(&mut self, file: &Section<'d, 'i>, names: &Names<'_, 'i>, script: &mut Script) {
        self.refuse_empty(file, "steps", STEPS_WAY_OUT);
        let steps = self.list(file, "steps");
        script.steps = read_steps(self, "steps", steps, Scope { names, depth: 0 });
    }

    /// The elements of a list.
    fn list<'d, 'i>(&mut self, file: &Section<'d, 'i>, key: &str) -> &'d [Value<'i>] {
        let Some(value) = file.get(key) else { return &[] };
        if let Some(elements) = value.get_ref().as_array() {
            return elements;
        }
        self.reader.refuse_by(value.span(), || wrong_type(key, value.get_ref(), "a list"));
        &[]
    }

    /// A list with nothing in it says nothing: `way_out` is what to write instead.
    fn refuse_empty(&mut self, file: &Section<'_, '_>, key: &str, way_out: &str) {
        let Some(value) = file.get(key) else { return };
        if value.get_ref().as_array().is_some_and(|list| list.is_empty()) {
            let problem = Problem::new(empty_list(key), "").with_help(way_out.to_owned());
            self.reader.refuse(value.span(), problem);
        }
    }
}

/// A copy of a file without its steps and its parameters, with the values of the names; without entries that have an
/// unknown name.
fn head<'i>(file: &Section<'_, 'i>, reader: &mut Reader<'_>, names: &Names<'_, 'i>) -> Value<'i> {
    let entries = file.entries().into_iter().filter(|(key, _)| ![WITH, USE, "steps"].contains(&key.value));
    let entry = |(key, value): (Located<&str>, &Value<'i>)| {
        let mut replaced = names.replaced(reader, value)?;
        if key.value == TITLE && value.get_ref().is_str() {
            // `title = "{loss}"` is a text, whatever the value is.
            let text = written(replaced.get_ref());
            *replaced.get_mut() = DeValue::String(text.into());
        }
        let name = DeString::Owned(key.value.to_owned());
        Some((Spanned::new(key.span.unwrap_or_default(), name), replaced))
    };
    let table: DeTable<'i> = entries.filter_map(entry).collect();
    Spanned::new(file.locate(()).span.unwrap_or_default(), DeValue::Table(table))
}
