//! A script from the parts of a file, with their places.

use toml::Spanned;

use super::entries::{File, MasterEntry};
use super::places::MasterPlaces;
use super::reader::Reader;
use super::steps::{StepReading, read_step};
use crate::model::{Script, ScriptMaster};
use crate::ready::Draft;

impl Reader<'_> {
    /// The script with the words of its steps; wrong parts are left out.
    pub(super) fn draft(&mut self, file: File) -> Draft {
        let has_master = file.master.is_some();
        let script = self.script(file);
        let is_whole = script.master.is_some() == has_master;
        Draft { script, written: core::mem::take(&mut self.written), is_whole }
    }

    fn script(&mut self, file: File) -> Script {
        let mut script = Script::new(file.title.get_ref());
        script.seed = file.seed.unwrap_or(script.seed);
        script.limit = self.duration(file.limit.as_ref()).unwrap_or(script.limit);
        self.places.cycle = file.cycle.as_ref().map(Spanned::span).unwrap_or_default();
        script.cycle = self.duration(file.cycle.as_ref()).unwrap_or(script.cycle);
        script.cycle_phase = self.duration(file.cycle_phase.as_ref());
        script.capture = file.capture;
        script.master = file.master.and_then(|entry| self.master(entry.into_inner()));
        for unit in file.units {
            self.places.units.push(unit.span());
            script.units.push(unit.into_inner());
        }
        for entry in file.steps {
            if let Some(StepReading { step, places, written }) = read_step(self, entry) {
                script.steps.push(step);
                self.places.steps.push(places);
                self.written.push(written);
            }
        }
        script
    }

    fn master(&mut self, entry: MasterEntry) -> Option<ScriptMaster> {
        let MasterEntry { program, device_names, task_period } = entry;
        self.places.master = MasterPlaces {
            program: program.span(),
            device_names: device_names.as_ref().map(Spanned::span).unwrap_or_default(),
            task_period: task_period.as_ref().map(Spanned::span).unwrap_or_default(),
        };
        let period = self.duration(task_period.as_ref());
        if task_period.is_some() && period.is_none() {
            return None;
        }
        let device_names = device_names.map(Spanned::into_inner).unwrap_or_default();
        Some(ScriptMaster { program: program.into_inner(), device_names, task_period: period })
    }
}
