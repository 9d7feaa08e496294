//! The terminal for the crates above: without events, faults and switches. The controller itself drives RUN and the
//! indicators of the ports.

use core::fmt::Debug;
use std::sync::Arc;

use coe_kit::indicators::{self, Pattern};
use esi::DeviceDescription;
use time::Duration;
use unit_model::{
    DataValid, Model, ModelTables, ModelUnit, PowerOn, PoweredUnit, SlaveView, UnitFiles, UnitSection,
};
use user_file::{Reader, Section};
use variables::VariableTable;

use crate::bus_wiring::BusWiring;
use crate::channels::Channels;
use crate::config::device_config;
use crate::description::description;
use crate::settings::TerminalSettings;
use crate::tables::{self, PORT_IN, PORT_OUT, RUN};
use crate::terminal::{self, Terminal};
use crate::unit_file::{self, UnitFile};
use crate::variables::variable_table;
use crate::wiring::Wiring;

/// The model.
pub static MODEL: DigitalModel = DigitalModel;

/// The values that are the same for all terminals.
#[derive(Clone, Copy, Debug)]
pub struct DigitalModel;

impl Model for DigitalModel {
    fn name(&self) -> &'static str {
        unit_file::MODEL
    }

    fn indicators(&self) -> &'static [&'static str] {
        &[RUN, PORT_IN, PORT_OUT]
    }

    fn tables(&self) -> &'static ModelTables {
        tables::tables()
    }

    /// Those of the largest terminal.
    fn every_variable(&self) -> Vec<VariableTable> {
        let all = Channels::new(Channels::MAX).unwrap_or_default();
        let largest = TerminalSettings { inputs: all, outputs: all, ..TerminalSettings::default() };
        vec![variable_table(unit_file::NAME, &largest)]
    }
}

impl UnitFiles for DigitalModel {
    fn keys(&self) -> Vec<&'static str> {
        unit_file::all_keys()
    }

    fn read(&self, reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Arc<dyn UnitSection>> {
        Some(Arc::new(UnitFile::read(reader, file)))
    }
}

impl UnitSection for UnitFile {
    fn model(&self) -> &'static dyn Model {
        &MODEL
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn node_address(&self) -> u16 {
        self.settings.alias
    }

    fn description(&self) -> DeviceDescription {
        description(&self.settings)
    }

    fn variables(&self) -> VariableTable {
        variable_table(&self.name, &self.settings)
    }

    fn refresh_period(&self) -> Option<Duration> {
        terminal::refresh_period(self.settings.inputs)
    }

    fn names_refresh_phase(&self) -> bool {
        self.names_refresh_phase
    }

    fn power_on(&self, conditions: &PowerOn) -> PoweredUnit {
        let mut settings = if conditions.fast { &self.fast } else { &self.settings }.clone();
        if !self.names_refresh_phase {
            settings.refresh_phase = conditions.refresh_phase;
        }
        let (wiring, cpu) = BusWiring::connect(settings.outputs, settings.inputs);
        let unit = Box::new(Terminal::power_on(&settings, wiring));
        PoweredUnit { config: device_config(&settings), unit, cpu }
    }
}

impl<W: Wiring + Debug + Send + 'static> ModelUnit for Terminal<W> {
    fn model(&self) -> &'static dyn Model {
        &MODEL
    }

    fn data_valid(&self) -> DataValid {
        self.data_valid
    }

    fn indicator(&self, name: &str, slave: &SlaveView) -> Option<Pattern> {
        match name {
            RUN => Some(indicators::run(slave.al_status.state)),
            PORT_IN => Some(slave.in_port.pattern()),
            PORT_OUT => Some(slave.out_port.pattern()),
            _ => None,
        }
    }
}
