//! The condition that a value is one value: the sentences with `is`.

use super::amount::{Amount, Number};
use super::bytes::Bytes;
use super::condition::Condition;
use super::spelling::NotAValue;
use super::value::Quantity;

/// What `is` compares with.
pub(crate) enum Same {
    /// The condition with `is`.
    Condition(Condition),
    /// A number.
    Number(Number),
}

impl Quantity {
    /// That it is the value of a text, as the sentence with `is` has it.
    pub(crate) fn is(&self, text: &str) -> Result<Same, NotAValue> {
        let bytes = || text.parse::<Bytes>();
        Ok(Same::Condition(match self {
            Self::Object { unit, entry } => {
                Condition::Object { unit: unit.clone(), entry: *entry, value: bytes()? }
            }
            Self::Register { unit, register } => {
                Condition::Register { unit: unit.clone(), register: *register, value: bytes()? }
            }
            Self::OutputByte { unit, at } => {
                Condition::Outputs { unit: unit.clone(), at: *at, bytes: bytes()? }
            }
            Self::InputByte { unit, at } => {
                Condition::Inputs { unit: unit.clone(), at: *at, bytes: bytes()? }
            }
            Self::Outputs { unit } => Condition::Outputs { unit: unit.clone(), at: 0, bytes: bytes()? },
            Self::Inputs { unit } => Condition::Inputs { unit: unit.clone(), at: 0, bytes: bytes()? },
            Self::Variable { variable } if ["TRUE", "FALSE"].contains(&text) => {
                Condition::VariableValue { variable: variable.clone(), value: text.to_owned() }
            }
            Self::Variable { variable } => {
                Condition::VariableBytes { variable: variable.clone(), bytes: bytes()? }
            }
            Self::ProgramVariable { controller, name } => Condition::ProgramVariable {
                controller: controller.clone(),
                name: name.clone(),
                value: text.to_owned(),
            },
            Self::WorkingCounter { .. }
            | Self::Records { .. }
            | Self::Acts { .. }
            | Self::MeanPeriod { .. }
            | Self::LongestPeriod { .. }
            | Self::Emergencies { .. }
            | Self::Cycles => {
                return text.parse::<Amount>().map(|amount| Same::Number(amount.number()));
            }
        }))
    }
}
