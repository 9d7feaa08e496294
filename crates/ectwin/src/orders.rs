//! Orders and conditions of scenarios, for a line in virtual time and for one in real time.

use std::fmt;

use scenario::model::{Condition, Order};
use scenario::words::Say;
use scenario::{Brought, Look, ReadyOrder, Refused};
use time::Duration;

use crate::Twin;
use crate::files_here::FilesHere;
use crate::lending::replaced_place;
use crate::runtime::Handle;

/// Why an expectation is not fulfilled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotHeld {
    /// The line cannot show whether the condition is true.
    Refused(Refused),
    /// It was not true within its time.
    False {
        /// The sentence of the condition.
        condition: String,
        /// The actual state at the end.
        seen: String,
        /// The time.
        within: Duration,
    },
}

impl fmt::Display for NotHeld {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(refused) => refused.fmt(formatter),
            Self::False { condition, seen, within } if within.is_zero() => {
                write!(formatter, "`{condition}` is not true now: {seen}")
            }
            Self::False { condition, seen, within } => {
                write!(formatter, "`{condition}` was not true within {within}: {seen}")
            }
        }
    }
}

impl std::error::Error for NotHeld {}

impl From<Refused> for NotHeld {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

/// Orders and conditions, as sentences or as typed values.
impl Twin {
    /// Carries out an order to units, to CPU Units or to the line, such as `unplug cable 1`. Files that it names are read
    /// from the current folder on.
    ///
    /// # Errors
    /// [`Refused`]: the line cannot carry it out; then nothing has changed.
    pub fn apply(&mut self, order: impl Say<Order>) -> Result<(), Refused> {
        let ReadyOrder { order, brought } = self.known_mut().order(order, &mut FilesHere)?;
        if let Some(position) = replaced_place(&order) {
            self.will_be_replaced(position);
        }
        self.carry_out(&order, &brought)?;
        self.run_for(Duration::ZERO);
        Ok(())
    }

    /// Whether a condition is true now, such as `unit 1 is in OP`.
    ///
    /// # Errors
    /// [`Refused`]: the line cannot show it.
    pub fn holds(&mut self, condition: impl Say<Condition>) -> Result<bool, Refused> {
        let condition = self.known_mut().condition(condition, Duration::ZERO)?;
        self.with_bench(&Brought::default(), |bench| Ok(Look::of(condition, bench)?.look(bench).is_ok()))
    }

    /// Advances virtual time until a condition is true, for this time at most.
    ///
    /// # Errors
    /// [`NotHeld`]: the time has passed, or the line cannot show it.
    pub fn expect(&mut self, condition: impl Say<Condition>, within: Duration) -> Result<(), NotHeld> {
        let condition = self.known_mut().condition(condition, within)?;
        let end = self.now() + within;
        let nothing = Brought::default();
        let mut look = self.with_bench(&nothing, |bench| Look::of(condition.clone(), bench))?;
        loop {
            match self.with_bench(&nothing, |bench| look.look(bench)) {
                Ok(()) => return Ok(()),
                Err(seen) if self.now() >= end => {
                    return Err(NotHeld::False { condition: condition.to_string(), seen, within });
                }
                Err(_) => {
                    let next = self.deadline().max(self.now()).min(end);
                    self.run_to(next);
                }
            }
        }
    }
}

/// Orders and conditions, as sentences or as typed values. Frames and tasks wait while an order is carried out or a
/// condition is checked; files are read before.
impl Handle {
    /// Carries out an order to units, to CPU Units or to the line, such as `unplug cable 1`. Files that it names are read
    /// from the current folder on.
    ///
    /// # Errors
    /// [`Refused`]: the line cannot carry it out; then nothing has changed.
    pub fn apply(&self, order: impl Say<Order>) -> Result<(), Refused> {
        let mut known = self.known();
        let ReadyOrder { order, brought } = known.order(order, &mut FilesHere)?;
        self.carry_out(&order, &brought).map(drop)
    }

    /// Whether a condition is true now, such as `unit 1 is in OP`.
    ///
    /// # Errors
    /// [`Refused`]: the line cannot show it.
    pub fn holds(&self, condition: impl Say<Condition>) -> Result<bool, Refused> {
        let condition = self.known().condition(condition, Duration::ZERO)?;
        self.with_bench(&Brought::default(), |bench| Ok(Look::of(condition, bench)?.look(bench).is_ok()))
    }

    /// Waits until a condition is true, for this time at most. It is checked whenever a unit or a CPU Unit may have
    /// changed, at most once in a millisecond; a state that lasts for less may pass unseen.
    ///
    /// # Errors
    /// [`NotHeld`]: the time has passed, or the line cannot show it.
    pub fn expect(&self, condition: impl Say<Condition>, within: Duration) -> Result<(), NotHeld> {
        let condition = self.known().condition(condition, within)?;
        let nothing = Brought::default();
        let mut look = self.with_bench(&nothing, |bench| Look::of(condition.clone(), bench))?;
        let held = self.wait_for(within, || self.with_bench(&nothing, |bench| look.look(bench)));
        held.map_err(|seen| NotHeld::False { condition: condition.to_string(), seen, within })
    }
}
