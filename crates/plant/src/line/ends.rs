//! The ends of a line: who sends frames, and who records what happens to them.

use core::fmt;

use time::Instant;

use super::met::Met;
use super::order::Direction;

/// Who sends frames on a line, and who records them.
pub trait LineEnds<T> {
    /// A frame goes to the units.
    fn passes(&mut self, _now: Instant, _frame: &[u8], _met: &[Met]) {}

    /// A frame or its answer waits.
    fn waits(&mut self, _now: Instant, _fault: &Met) {}

    /// An answer arrives at the master.
    fn returns(&mut self, now: Instant, ticket: T, answer: Vec<u8>, met: &[Met]);

    /// A frame is lost on its way outward, or its answer on the way back.
    fn is_lost(&mut self, _now: Instant, _on_way: Direction, _frame: &[u8], _cause: Loss<'_>) {}
}

/// Why a frame is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss<'a> {
    /// By a fault.
    Fault(&'a Met),
    /// It would have to wait, and too many frames wait.
    NoRoom,
}

impl fmt::Display for Loss<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fault(met) => met.fmt(formatter),
            Self::NoRoom => formatter.write_str("a frame is lost, because too many frames wait on the line"),
        }
    }
}
