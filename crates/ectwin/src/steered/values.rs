//! Values of variables and objects as JSON.

use control::messages::{ObjectReport, Refusal, VariableReport};
use plc::{CpuUnits, Validity, VariableType, VariableValue};
use serde_json::Value;
use st::{Class, Elementary};
use wire::DataType;

use crate::object_words::type_name;

/// A variable as it was found in its CPU Unit.
pub(super) struct Found {
    variable_type: VariableType,
    value: VariableValue,
    validity: Validity,
    is_forced: bool,
}

/// A variable of one of these CPU Units.
pub(super) fn find(cpus: &CpuUnits, name: &str) -> Option<Found> {
    cpus.iter().find_map(|cpu| {
        let io = cpu.io();
        let target = io.variables().find_target(name).ok()?;
        Some(Found {
            variable_type: io.type_of(target).ok()?,
            value: io.read(target).ok()?,
            validity: io.validity(target.variable).ok()?,
            is_forced: io.is_forced(target).ok()?,
        })
    })
}

impl Found {
    pub(super) fn report(self) -> VariableReport {
        VariableReport {
            variable_type: self.variable_type.to_string(),
            value: json(self.variable_type, &self.value),
            validity: validity(self.validity).to_owned(),
            forced: self.is_forced,
        }
    }
}

const fn validity(validity: Validity) -> &'static str {
    match validity {
        Validity::Valid => "valid",
        Validity::IoDataNotActive => "io_data_not_active",
        Validity::UnitError => "unit_error",
        Validity::DataNotValid => "data_not_valid",
    }
}

/// A value, little endian, as JSON.
fn json(variable_type: VariableType, bytes: &[u8]) -> Value {
    let of = variable_type.elementary;
    match variable_type.elements {
        None => element(of, bytes),
        Some(_) => bytes.chunks(of.size_bytes()).map(|bytes| element(of, bytes)).collect(),
    }
}

fn element(of: Elementary, bytes: &[u8]) -> Value {
    match of.class() {
        Class::Bool => number(bytes).eq(&1).into(),
        Class::BitString | Class::Unsigned => number(bytes).into(),
        Class::Signed => signed(bytes).into(),
        // The number that is none has no JSON.
        Class::Real if of == Elementary::Real => f32::from_bits(number(bytes) as u32).into(),
        Class::Real => f64::from_bits(number(bytes)).into(),
        Class::Time | Class::Date => VariableType::single(of).show(bytes).to_string().into(),
    }
}

fn number(bytes: &[u8]) -> u64 {
    bytes.iter().take(8).rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}

fn signed(bytes: &[u8]) -> i64 {
    let unused = 64 - 8 * bytes.len().clamp(1, 8);
    (number(bytes) << unused) as i64 >> unused
}

/// A value of a request in the notation of Structured Text.
pub(super) fn text(name: &str, value: &Value) -> Result<String, Refusal> {
    match value {
        Value::Bool(true) => Ok("TRUE".to_owned()),
        Value::Bool(false) => Ok("FALSE".to_owned()),
        Value::Number(number) => Ok(number.to_string()),
        Value::String(text) => Ok(text.clone()),
        Value::Array(values) => {
            let texts: Vec<String> =
                values.iter().map(|value| text(name, value)).collect::<Result<_, _>>()?;
            Ok(format!("[{}]", texts.join(", ")))
        }
        Value::Null | Value::Object(_) => {
            let help =
                "a number, true, false, a list of them, or a text as in Structured Text, such as \"16#1234\"";
            Err(Refusal::new(format!("`{value}` is no value of {name}"), help))
        }
    }
}

/// An entry of an object with its value, as on the wire.
pub(super) fn object(words: &str, data_type: DataType, bytes: &[u8]) -> ObjectReport {
    let shown: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    let shown = shown.join(" ");
    let value = match data_type {
        DataType::BOOLEAN => number(bytes).eq(&1).into(),
        DataType::UNSIGNED8 | DataType::UNSIGNED16 | DataType::UNSIGNED32 | DataType::UNSIGNED64 => {
            number(bytes).into()
        }
        DataType::INTEGER16 => signed(bytes).into(),
        DataType::VISIBLE_STRING => String::from_utf8_lossy(bytes).trim_end_matches('\0').into(),
        _ => shown.clone().into(),
    };
    ObjectReport { object: words.to_owned(), data_type: type_name(data_type), value, bytes: shown }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn values_are_numbers_truth_values_and_lists() {
        let rows = [
            (VariableType::single(Elementary::Bool), vec![1], json!(true)),
            (VariableType::single(Elementary::Word), vec![0x34, 0x12], json!(0x1234)),
            (VariableType::single(Elementary::Int), vec![0xFF, 0xFF], json!(-1)),
            (VariableType::single(Elementary::Lint), vec![0xFF; 8], json!(-1)),
            (VariableType::single(Elementary::Ulint), vec![0xFF; 8], json!(u64::MAX)),
            (VariableType::single(Elementary::Real), 1.5_f32.to_le_bytes().to_vec(), json!(1.5)),
            (VariableType::single(Elementary::Lreal), f64::NAN.to_le_bytes().to_vec(), Value::Null),
            (VariableType::array(Elementary::Uint, 2), vec![1, 0, 2, 0], json!([1, 2])),
        ];
        for (variable_type, bytes, value) in rows {
            assert_eq!(json(variable_type, &bytes), value, "{variable_type}");
        }
    }

    #[test]
    fn values_of_requests_are_those_of_structured_text() {
        let of = |value| text("V", &value);
        assert_eq!(of(json!([1, true, "16#F"])), Ok("[1, TRUE, 16#F]".to_owned()));
        assert!(of(json!(null)).unwrap_err().message.contains("`null` is no value of V"));
        assert!(of(json!([{}])).is_err());
    }
}
