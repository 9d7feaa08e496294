//! Why an order to a line that runs is not carried out, or a condition not checked.

use core::fmt;

/// An order or a condition that a line refuses; then nothing has changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// The kind of the reason.
    pub reason: Reason,
    /// The mistake.
    pub message: String,
    /// The remedy; empty if the message contains it.
    pub help: String,
    /// Sentences that are possible and like the one that is refused, the nearest first.
    pub nearest: Vec<String>,
}

/// The kind of a reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// It is no sentence.
    NoSentence,
    /// Only the scripted master of a scenario carries it out, or knows it.
    ScriptedMaster,
    /// The line has no such unit, cable, variable, fault or program, or the value is impossible there.
    NotThere,
    /// It is not possible now: a fault of this name is at work, or none is.
    NotNow,
    /// It would change nothing: the unit or the CPU Unit has no power, or has it already.
    WithoutEffect,
}

impl Refused {
    pub(crate) fn new(reason: Reason, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { reason, message: message.into(), help: help.into(), nearest: Vec::new() }
    }

    pub(crate) fn with_nearest(self, nearest: Vec<String>) -> Self {
        Self { nearest, ..self }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(formatter, "; {}", self.help) }
    }
}

impl core::error::Error for Refused {}
