use std::sync::Arc;

use esi::DeviceDescription;
use time::Duration;
use unit_model::keys::{self, CommonKeys, Shape};
use unit_model::{DataValid, Model, ModelUnit, PowerOn, PoweredUnit, UnitFiles, UnitSection};
use user_file::{Reader, Section, values};
use variables::VariableTable;

use crate::counter::{Counter, PERIOD};
use crate::description::{INPUTS_BYTES, description, device_config};
use crate::variables::variable_table;

/// The model: its name and its unit files.
pub(crate) struct CounterModel;

impl Model for CounterModel {
    fn name(&self) -> &'static str {
        "counter"
    }
}

impl UnitFiles for CounterModel {
    fn keys(&self) -> Vec<&'static str> {
        ["model", "step", "cpu"].into_iter().chain(keys::KEYS).collect()
    }

    fn read(&self, reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Arc<dyn UnitSection>> {
        reader.only(file, &self.keys());
        let step = reader
            .value(file, "step", |place, value| values::integer(place, value, 1..=1_000, "1 to 1000"))
            .map_or(1, |step| step.value);
        let common = CommonKeys::read(reader, file, Shape { mailbox: false, boot: false });
        let name = common.name.map_or_else(|| "C1".into(), |name| name.value);
        Some(Arc::new(CounterFile { name, step }))
    }
}

/// The contents of a unit file.
#[derive(Debug)]
struct CounterFile {
    name: String,
    step: u16,
}

impl UnitSection for CounterFile {
    fn model(&self) -> &'static dyn Model {
        &CounterModel
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn description(&self) -> DeviceDescription {
        description()
    }

    fn variables(&self) -> VariableTable {
        variable_table(&self.name)
    }

    fn refresh_period(&self) -> Option<Duration> {
        Some(PERIOD)
    }

    fn power_on(&self, _conditions: &PowerOn) -> PoweredUnit {
        let (bus, cpu) = nx_bus::connect(INPUTS_BYTES.into(), 0);
        let unit = Counter { step: self.step, count: 0, is_exchanging: false, bus };
        PoweredUnit { config: device_config(), unit: Box::new(unit), cpu }
    }
}

/// What the crates above see of the unit.
impl ModelUnit for Counter {
    fn model(&self) -> &'static dyn Model {
        &CounterModel
    }

    fn data_valid(&self) -> DataValid {
        DataValid { outputs: false, inputs: self.is_exchanging }
    }
}
