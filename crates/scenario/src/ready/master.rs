//! The master's own user program: its file, its device names, its period.

use coe_kit::pdo::PdoSettings;
use st::{TASK_PERIODS, is_task_period};
use time::Duration;

use super::maker::Maker;
use super::problem::Part;
use crate::model::{MasterOrder, Order, ScriptMaster, ScriptStep, WhichUnit, in_order};
use crate::run::{MasterProgram, MasterVariables, Node, UnitSource, changed_settings};

/// Maximum number of characters of a device name.
const NAME_MAX: usize = 127;

impl Maker<'_> {
    pub(super) fn master_program(
        &mut self,
        master: &ScriptMaster,
        steps: &[ScriptStep],
    ) -> Option<MasterProgram> {
        let nodes = self.nodes(&master.device_names)?;
        if let Some(period) = master.task_period {
            self.check_task_period(period)?;
        }
        let variables = variables(&nodes, steps);
        let paths = master.program.list();
        let sources = self.program_sources(paths, Part::MasterProgram)?;
        match MasterProgram::compile(&paths.join(", "), sources, &variables, nodes, master.task_period) {
            Ok(compiled) => Some(compiled),
            Err(problems) => {
                self.refuse_program(Part::MasterProgram, &problems);
                None
            }
        }
    }

    /// The units for the program.
    fn nodes(&mut self, device_names: &[String]) -> Option<Vec<Node>> {
        let devices: Vec<_> = self.units.iter().map(UnitSource::known_device).collect();
        let addresses = self.node_addresses()?;
        let names = self.device_names(device_names, &addresses)?;
        let nodes = addresses.into_iter().zip(names).zip(devices).enumerate();
        let node = |(unit, ((address, device_name), device))| Node { unit, address, device_name, device };
        Some(nodes.map(node).collect())
    }

    /// A name for each unit: those in the script, then by the node address, such as E005.
    fn device_names(&mut self, given: &[String], addresses: &[u16]) -> Option<Vec<String>> {
        let count = addresses.len();
        if given.len() > count {
            let message = format!("{} device names for {count} units", given.len());
            let help = "one for each unit at most, in the order of the line";
            self.refuse(Part::DeviceNames, message, help);
            return None;
        }
        let unnamed = addresses.iter().skip(given.len()).map(|address| format!("E{address:03}"));
        let names: Vec<String> = given.iter().cloned().chain(unnamed).collect();
        self.check_names(&names).map(|()| names)
    }

    fn check_names(&mut self, names: &[String]) -> Option<()> {
        for (at, name) in names.iter().enumerate() {
            if !is_identifier(name) {
                let help = "letters, digits and _, such as E001";
                self.refuse(Part::DeviceNames, format!("`{name}` is not a device name"), help);
                return None;
            }
            if names[..at].iter().any(|other| other.eq_ignore_ascii_case(name)) {
                self.refuse(Part::DeviceNames, format!("two units have the device name {name}"), "");
                return None;
            }
        }
        Some(())
    }

    fn check_task_period(&mut self, period: Duration) -> Option<()> {
        if !is_task_period(period.as_nanos()) {
            let message = format!("no CPU Unit has a task period of {period}");
            self.refuse(Part::TaskPeriod, message, TASK_PERIODS);
            return None;
        }
        Some(())
    }
}

/// The variables of all PDO entries that the master has in the factory setting, and through the orders of the steps.
fn variables(nodes: &[Node], steps: &[ScriptStep]) -> MasterVariables {
    let mut variables = MasterVariables::new();
    let described = |node: &Node| PdoSettings::of_description(&node.device.description);
    let mut settings: Vec<_> = nodes.iter().map(described).collect();
    for (node, settings) in nodes.iter().zip(&settings) {
        variables.add_slave(node, settings);
    }
    for (unit, order) in in_order(steps).into_iter().filter_map(pdo_order) {
        let at = unit.position();
        if let (Some(settings), Some(node)) = (settings.get_mut(at), nodes.get(at)) {
            changed_settings(settings, &node.device, order);
            variables.add_slave(node, settings);
        }
    }
    variables
}

/// An order that changes the PDO settings of a unit.
fn pdo_order(step: &ScriptStep) -> Option<(&WhichUnit, &MasterOrder)> {
    let ScriptStep::Step(step) = step else { return None };
    let Order::Master(order) = &step.order else { return None };
    let (MasterOrder::MapPdo { unit, .. } | MasterOrder::AssignPdos { unit, .. }) = order else {
        return None;
    };
    Some((unit, order))
}

fn is_identifier(name: &str) -> bool {
    let starts = name.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_');
    let rest = name.chars().all(|character| character.is_ascii_alphanumeric() || character == '_');
    starts && rest && !name.ends_with('_') && !name.contains("__") && name.len() <= NAME_MAX
}
