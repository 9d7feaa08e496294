//! A scenario for a line on which another master is: what only the scripted master does or knows is refused, and its units
//! are those of the line.

use super::maker::{Maker, MasterOfLine};
use super::masters_words::is_of_master;
use super::problem::Part;
use crate::model::{Condition, MasterOrder, Script};
use crate::run::UnitSource;

impl Maker<'_> {
    /// The order has an addressee.
    pub(super) fn check_addressee(&mut self, order: &MasterOrder, part: Part) -> Option<()> {
        if self.master_of_line == MasterOfLine::Scripted {
            return Some(());
        }
        let message = format!("`{order}` is an order to the scripted master, and another master is here");
        self.refuse(
            part,
            message,
            "the master acts by itself: expect what it does, or give orders to units, CPU Units and the line",
        );
        None
    }

    /// The condition is not about the scripted master, if there is none.
    pub(super) fn check_master_is_there(&mut self, condition: &Condition, part: Part) -> Option<()> {
        if self.master_of_line == MasterOfLine::Scripted {
            return Some(());
        }
        let Some(wrong) = is_of_master(condition) else { return Some(()) };
        let message = format!("`{wrong}` is about the scripted master, and another master is here");
        self.refuse(part, message, "expect what units, CPU Units and variables show");
        None
    }

    /// Refuses the keys of the masters of scenarios, if another one is here.
    pub(super) fn check_keys_of_masters(&mut self, has_capture: bool, has_program: bool) {
        if self.master_of_line == MasterOfLine::Scripted {
            return;
        }
        if has_capture {
            let message = "`capture` makes a recorded master, and another master is here";
            self.refuse(Part::Script, message, "`ectwin replay` plays it in virtual time");
        }
        if has_program {
            let message = "`master` has the program of the scripted master, and another master is here";
            self.refuse(Part::MasterProgram, message, "`ectwin replay` runs it in virtual time");
        }
    }

    /// The units of a line. If the scenario has units too, they have to be the same.
    pub(super) fn units_of_line(&mut self, line: Vec<UnitSource>, script: &Script) {
        if !script.units.is_empty() {
            self.units(&script.units);
            self.check_agreement(&line);
        }
        self.variables = line.iter().map(|unit| unit.file.variables().clone()).collect();
        self.units = line;
    }

    fn check_agreement(&mut self, line: &[UnitSource]) {
        if !self.problems.is_empty() {
            return;
        }
        let help = "`ectwin run --scenario` without unit files takes the units of the scenario";
        if self.units.len() != line.len() {
            let counted = |count| user_file::counted(count, "unit");
            let message = format!(
                "the scenario has {}, and the line has {}",
                counted(self.units.len()),
                counted(line.len())
            );
            return self.refuse(Part::Unit(0), message, help);
        }
        let pairs = (0..).zip(self.units.iter().zip(line));
        let different = pairs.filter(|(_, (own, other))| !are_alike(own, other));
        let messages: Vec<(usize, String)> =
            different.map(|(at, (own, other))| (at, difference(at, own, other))).collect();
        for (at, message) in messages {
            self.refuse(Part::Unit(at), message, help);
        }
    }
}

/// Whether a master sees the same unit.
fn are_alike(one: &UnitSource, other: &UnitSource) -> bool {
    let (one, other) = (one.file.section(), other.file.section());
    one.name() == other.name() && one.description() == other.description()
}

fn difference(at: usize, own: &UnitSource, other: &UnitSource) -> String {
    let words = |unit: &UnitSource| format!("{} ({})", unit.file.name(), unit.file.section().model().name());
    let (number, own, other) = (at + 1, words(own), words(other));
    if own == other {
        return format!(
            "unit {number}, {own}, has other process data or another identity here than on the line"
        );
    }
    format!("unit {number} is {own} here, and {other} on the line")
}
