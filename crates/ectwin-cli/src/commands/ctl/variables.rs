//! `ctl read`, `write`, `force`, `release` and `object`: values from the side of the CPU Unit and of the unit.

use control::client::Answered;
use control::messages::{ObjectReport, VariableReport, Variables, Verb};
use serde_json::Value;

use super::shown::Shown;
use super::twin;
use crate::cli::CtlArgs;
use crate::failure::Failure;

pub(super) fn read(args: &CtlArgs, names: &[String]) -> Result<Shown, Failure> {
    ask(args, Verb::Read(names.to_vec()))
}

pub(super) fn write(args: &CtlArgs, values: &[String]) -> Result<Shown, Failure> {
    ask(args, Verb::Write(assignments(values)?))
}

pub(super) fn force(args: &CtlArgs, values: &[String]) -> Result<Shown, Failure> {
    ask(args, Verb::Force(assignments(values)?))
}

pub(super) fn release(args: &CtlArgs, names: &[String]) -> Result<Shown, Failure> {
    ask(args, Verb::Release(names.to_vec()))
}

pub(super) fn object(args: &CtlArgs, unit: &str, entry: &str) -> Result<Shown, Failure> {
    let verb = Verb::Object(format!("{unit} {entry}"));
    let Answered::<ObjectReport> { content, .. } = twin::ask(args, verb)?;
    let ObjectReport { object, data_type, value, bytes } = &content;
    let text = format!("{object}  {data_type}  {}  bytes {bytes}\n", value_words(value));
    Shown::of(&content, text)
}

fn ask(args: &CtlArgs, verb: Verb) -> Result<Shown, Failure> {
    let Answered::<Variables> { content, .. } = twin::ask(args, verb)?;
    let text = content.values.iter().map(|(name, report)| variable(name, report)).collect();
    Shown::of(&content, text)
}

fn variable(name: &str, report: &VariableReport) -> String {
    let VariableReport { variable_type, value, validity, forced } = report;
    let forced = if *forced { ", forced" } else { "" };
    format!("{name}  {variable_type}  {}  {validity}{forced}\n", value_words(value))
}

/// A value as in Structured Text.
pub(super) fn value_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Bool(true) => "TRUE".to_owned(),
        Value::Bool(false) => "FALSE".to_owned(),
        Value::Array(values) => {
            format!("[{}]", values.iter().map(value_words).collect::<Vec<_>>().join(", "))
        }
        Value::Null | Value::Number(_) | Value::Object(_) => value.to_string(),
    }
}

/// `NAME=VALUE`, each.
fn assignments(arguments: &[String]) -> Result<Vec<(String, Value)>, Failure> {
    arguments.iter().map(|argument| assignment(argument)).collect()
}

fn assignment(argument: &str) -> Result<(String, Value), Failure> {
    let (name, value) = argument.split_once('=').ok_or_else(|| Failure::Refused {
        message: format!("`{argument}` gives no value"),
        help: "write NAME=VALUE, such as N1_UINTs_01_C_to_M[0]=5".to_owned(),
    })?;
    Ok((name.trim_end_matches(':').trim_end().to_owned(), value_of(value.trim())))
}

fn value_of(text: &str) -> Value {
    let truth = ["FALSE", "TRUE"].iter().position(|word| word.eq_ignore_ascii_case(text));
    match truth {
        Some(truth) => Value::Bool(truth == 1),
        None => serde_json::from_str(text).unwrap_or_else(|_| Value::String(text.to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_value_is_json_or_in_the_notation_of_structured_text() {
        for (argument, name, value) in [
            ("A[0]=5", "A[0]", json!(5)),
            ("A := 5", "A", json!(5)),
            ("A=TRUE", "A", json!(true)),
            ("A=[1, 2]", "A", json!([1, 2])),
            ("A=T#5ms", "A", json!("T#5ms")),
            ("A=16#FF", "A", json!("16#FF")),
            ("A='x=y'", "A", json!("'x=y'")),
        ] {
            let read = assignment(argument).unwrap_or_else(|_| panic!("{argument} is refused"));
            assert_eq!(read, (name.to_owned(), value));
        }
        assert!(assignment("A").is_err());
    }
}
