//! The twin as the channel sees it.

use core::ops::Range;

use serde_json::Value;
use time::{Duration, Instant};

use crate::messages::{ActiveFault, ObjectReport, Refusal, SentenceRow, UnitReport, VariableReport};

/// A change of a variable.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// It is written once.
    Write(Value),
    /// It has this value until it is released.
    Force(Value),
    /// It is released.
    Release,
}

/// A twin that can be seen and steered. Each call takes effect between two frames; the time that it returns is that of
/// its effect. A [`Refusal`] means that nothing has changed.
pub trait Twin: Send {
    /// A condition that is looked at again and again.
    type Look: Send;

    /// The present time.
    fn now(&self) -> Instant;

    /// How long frames and task periods may have waited for calls of this trait so far, in all.
    fn time_taken(&self) -> Duration;

    /// The link, as in the line `ready`.
    fn link(&self) -> &str;

    /// Number of units.
    fn count(&self) -> usize;

    /// Carries out the order of a sentence.
    ///
    /// # Errors
    /// [`Refusal`].
    fn order(&mut self, sentence: &str) -> Result<Instant, Refusal>;

    /// Reads the sentence of a condition, which is to become true within a time.
    ///
    /// # Errors
    /// [`Refusal`].
    fn look_for(&mut self, condition: &str, within: Duration) -> Result<Self::Look, Refusal>;

    /// Looks whether conditions are true, all at the same moment; the actual state of those that are not.
    fn look(&mut self, looks: &mut [&mut Self::Look]) -> (Instant, Vec<Result<(), String>>);

    /// What these units show, counted from 0.
    fn report(&mut self, units: Range<usize>) -> (Instant, Vec<UnitReport>);

    /// Variables, all of the same moment, in the order of their names.
    fn read(&mut self, names: &[&str]) -> (Instant, Vec<Result<VariableReport, Refusal>>);

    /// Changes variables, all in the same task period.
    ///
    /// # Errors
    /// [`Refusal`].
    fn change(&mut self, changes: &[(&str, Change)]) -> Result<Instant, Refusal>;

    /// The entry of an object, such as `N1 1018:04`.
    ///
    /// # Errors
    /// [`Refusal`].
    fn object(&mut self, unit_and_entry: &str) -> Result<(Instant, ObjectReport), Refusal>;

    /// The faults at work.
    fn faults(&mut self) -> (Instant, Vec<ActiveFault>);

    /// Ends a fault, or `all`.
    ///
    /// # Errors
    /// [`Refusal`].
    fn clear(&mut self, fault: &str) -> Result<Instant, Refusal>;

    /// All sentences.
    fn sentences(&self) -> Vec<SentenceRow>;
}
