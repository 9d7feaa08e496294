//! The master's own user program: its file, its device names, its period.

use core::ops::Range;

use nx_ect101::PdoSettings;
use st::{TASK_PERIODS, is_task_period};
use time::Duration;
use toml::Spanned;

use crate::file::{MasterEntry, Reader, StepEntry};
use crate::model::MasterOrder;
use crate::run::{MasterProgram, MasterVariables, Node, changed_settings};
use crate::words::{self, MASTER};

/// Most characters of a device name.
const NAME_MAX: usize = 127;

impl Reader<'_> {
    pub(crate) fn master_program(
        &mut self,
        entry: Spanned<MasterEntry>,
        steps: &[Spanned<StepEntry>],
    ) -> Option<MasterProgram> {
        let MasterEntry { program, device_names, task_period } = entry.into_inner();
        let nodes = self.nodes(device_names)?;
        let task_period = match task_period {
            Some(period) => Some(self.task_period(&period)?),
            None => None,
        };
        let variables = variables(&nodes, steps);
        let (span, paths) = (program.span(), program.into_inner().list());
        let sources = self.program_sources(&paths, span.clone())?;
        match MasterProgram::compile(&paths.join(", "), sources, &variables, nodes, task_period) {
            Ok(compiled) => Some(compiled),
            Err(problems) => {
                self.refuse_program(span, &problems);
                None
            }
        }
    }

    /// The units as the program knows them.
    fn nodes(&mut self, device_names: Option<Spanned<Vec<String>>>) -> Option<Vec<Node>> {
        let addresses = self.node_addresses()?;
        let names = self.device_names(device_names, &addresses)?;
        let nodes = addresses.into_iter().zip(names).enumerate();
        Some(nodes.map(|(unit, (address, device_name))| Node { unit, address, device_name }).collect())
    }

    /// A name for each unit: those that the file gives, then by the node address, such as E005.
    fn device_names(
        &mut self,
        given: Option<Spanned<Vec<String>>>,
        addresses: &[u16],
    ) -> Option<Vec<String>> {
        let count = addresses.len();
        let (span, mut names) = match given {
            Some(given) => (given.span(), given.into_inner()),
            None => (0..0, Vec::new()),
        };
        if names.len() > count {
            let message = format!("{} device names for {count} units", names.len());
            self.refuse(span, message, "one for each unit at most, in the order of the line");
            return None;
        }
        let unnamed = addresses.iter().skip(names.len());
        names.extend(unnamed.map(|address| format!("E{address:03}")).collect::<Vec<_>>());
        self.check_names(&names, span).map(|()| names)
    }

    fn check_names(&mut self, names: &[String], span: Range<usize>) -> Option<()> {
        for (at, name) in names.iter().enumerate() {
            if !is_identifier(name) {
                self.refuse(
                    span,
                    format!("`{name}` is no device name"),
                    "letters, digits and _, such as E001",
                );
                return None;
            }
            if names[..at].iter().any(|other| other.eq_ignore_ascii_case(name)) {
                self.refuse(span, format!("two units have the device name {name}"), "");
                return None;
            }
        }
        Some(())
    }

    fn task_period(&mut self, text: &Spanned<String>) -> Option<Duration> {
        let period = self.duration(text)?;
        if !is_task_period(period.as_nanos()) {
            let message = format!("no CPU Unit has a task period of {period}");
            self.refuse(text.span(), message, TASK_PERIODS);
            return None;
        }
        Some(period)
    }
}

/// The variables of all PDO entries that the master has by the factory setting, and by the orders of the steps.
fn variables(nodes: &[Node], steps: &[Spanned<StepEntry>]) -> MasterVariables {
    let mut variables = MasterVariables::new();
    let mut settings = vec![PdoSettings::factory(); nodes.len()];
    for (node, settings) in nodes.iter().zip(&settings) {
        variables.add_slave(node, settings);
    }
    for order in steps.iter().filter_map(master_order) {
        let (MasterOrder::Map(unit, ..) | MasterOrder::Assign(unit, ..)) = order else { continue };
        if let (Some(settings), Some(node)) = (settings.get_mut(unit), nodes.get(unit)) {
            changed_settings(settings, &order);
            variables.add_slave(node, settings);
        }
    }
    variables
}

fn master_order(step: &Spanned<StepEntry>) -> Option<MasterOrder> {
    let text = step.get_ref().master.as_ref()?;
    words::read(MASTER, text.get_ref()).ok()
}

fn is_identifier(name: &str) -> bool {
    let starts = name.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_');
    let rest = name.chars().all(|character| character.is_ascii_alphanumeric() || character == '_');
    starts && rest && !name.ends_with('_') && !name.contains("__") && name.len() <= NAME_MAX
}
