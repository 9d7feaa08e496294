//! Process data that steps name: whether the unit has these bytes, and whether they can ever be valid.

use super::maker::Maker;
use super::problem::Part;
use crate::model::{Bytes, Condition, CpuOrder, DataDirection, MasterOrder, UnitSet, WhichUnit};

/// Bytes that a step names.
struct Named<'a> {
    unit: &'a WhichUnit,
    /// Such as `output`.
    kind: &'static str,
    first: u16,
    bytes: &'a Bytes,
    /// The number of bytes that exist.
    exist: usize,
}

impl Maker<'_> {
    /// Whether the master can send the outputs of an order.
    pub(super) fn check_outputs(&mut self, order: &MasterOrder, part: Part) -> Option<()> {
        let MasterOrder::SetOutputs { unit, at, bytes } = order else { return Some(()) };
        let exist = self.units[unit.position()].file.section().process_data_bytes().outputs.into();
        self.check_bytes(&Named { unit, kind: "output", first: *at, bytes, exist }, part)
    }

    /// Whether the CPU Unit has the inputs of an order.
    pub(super) fn check_inputs(&mut self, order: &CpuOrder, part: Part) -> Option<()> {
        let CpuOrder::SetInputs { unit, bytes } = order else { return Some(()) };
        let exist = self.units[unit.position()].file.variables().unit().c_to_m_bytes;
        self.check_bytes(&Named { unit, kind: "input", first: 0, bytes, exist }, part)
    }

    /// Whether the process data of a condition can be as it says.
    pub(super) fn check_process_data(&mut self, condition: &Condition, part: Part) -> Option<()> {
        match condition {
            Condition::Outputs { unit, at, bytes } => {
                // As in the CPU Unit.
                let exist = self.units[unit.position()].file.variables().unit().m_to_c_bytes;
                self.check_bytes(&Named { unit, kind: "output", first: *at, bytes, exist }, part)
            }
            Condition::Inputs { unit, at, bytes } => {
                let exist = self.units[unit.position()].file.section().process_data_bytes().inputs.into();
                self.check_bytes(&Named { unit, kind: "input", first: *at, bytes, exist }, part)
            }
            Condition::DataValid { units, .. } => self.check_can_be_valid(units, &BOTH, part),
            Condition::DirectionValid { units, direction, .. } => {
                self.check_can_be_valid(units, &[*direction], part)
            }
            _ => Some(()),
        }
    }

    fn check_bytes(&mut self, named: &Named<'_>, part: Part) -> Option<()> {
        let Named { unit, kind, first, bytes, exist } = named;
        let last = usize::from(*first) + bytes.0.len().saturating_sub(1);
        if last < *exist {
            return Some(());
        }
        let help = match exist {
            0 => format!("it has no {kind} bytes"),
            _ => format!("the last one is {}", exist - 1),
        };
        self.refuse(part, format!("{unit} has no {kind} byte {last}"), help);
        None
    }

    fn check_can_be_valid(&mut self, units: &UnitSet, wanted: &[DataDirection], part: Part) -> Option<()> {
        let lacks = units.positions(self.units.len()).find_map(|at| {
            let lacking = wanted.iter().find(|direction| !self.has_data(at, **direction))?;
            Some((at, words(*lacking)))
        });
        let Some((at, lacking)) = lacks else { return Some(()) };
        let model = self.units[at].file.section().model().name();
        let message = format!(
            "unit {} is of the model {model} and has no data {lacking}, which are never valid",
            at + 1
        );
        let has = BOTH.into_iter().find(|direction| self.has_data(at, *direction));
        let help = match has.map(words) {
            Some(has) => format!("name the data that it has: `the data {has} of unit {} is valid`", at + 1),
            None => "it has no process data".to_owned(),
        };
        self.refuse(part, message, help);
        None
    }

    fn has_data(&self, at: usize, direction: DataDirection) -> bool {
        let bytes = self.units[at].file.section().process_data_bytes();
        match direction {
            DataDirection::MToC => bytes.outputs > 0,
            DataDirection::CToM => bytes.inputs > 0,
        }
    }
}

const BOTH: [DataDirection; 2] = [DataDirection::MToC, DataDirection::CToM];

const fn words(direction: DataDirection) -> &'static str {
    match direction {
        DataDirection::MToC => "M to C",
        DataDirection::CToM => "C to M",
    }
}
