//! What a unit has recorded since it is in the line, as its model reports it.

use unit_model::{EventCode, Model};

use super::ledger::{Ledger, emergency_code};

/// Number of events that are kept one by one in a scenario.
const EVENTS_MAX: usize = 65_536;
/// The same of a line in real time, whose memory is allocated at power-on.
const EVENTS_MAX_IN_REAL_TIME: usize = 128;
/// More different events than a model has.
const CODES_MAX: usize = 64;

/// The events of a unit. The last ones are kept one by one, of older ones only their numbers.
#[derive(Debug)]
pub struct Records {
    /// At most `events_max`.
    events: Vec<EventCode>,
    events_max: usize,
    /// Events that are no longer kept one by one, and how many they were.
    older: Vec<(EventCode, u32)>,
    /// Number of events that are no longer kept one by one.
    forgotten: u64,
    /// Number of all events when the orders directly before the present step were given.
    marked: u64,
    /// Its diagnosis history, as the first of these events say.
    ledger: Ledger,
    /// Number of them. The others follow when the history is looked at, which the path of a frame never does.
    in_ledger: usize,
}

impl Records {
    /// Those of a unit in a line that runs for any time: after this, they never allocate.
    #[must_use]
    pub fn with_fixed_room() -> Self {
        Self {
            events: Vec::with_capacity(EVENTS_MAX_IN_REAL_TIME),
            events_max: EVENTS_MAX_IN_REAL_TIME,
            older: Vec::with_capacity(CODES_MAX),
            forgotten: 0,
            marked: 0,
            ledger: Ledger::default(),
            in_ledger: 0,
        }
    }

    /// The unit records an event.
    pub fn record(&mut self, event: EventCode) {
        if self.events.len() == self.events_max {
            self.forget_half();
        }
        self.events.push(event);
    }

    fn forget_half(&mut self) {
        let count = self.events_max / 2;
        self.forgotten += count as u64;
        for event in self.events.drain(..count) {
            match self.older.iter_mut().find(|(code, _)| *code == event) {
                Some((_, times)) => *times = times.saturating_add(1),
                None => self.older.push((event, 1)),
            }
        }
        if self.in_ledger < count {
            // The history has changed unseen, as by a start.
            self.ledger.start();
        }
        self.in_ledger = self.in_ledger.saturating_sub(count);
    }

    /// How often it has recorded this event.
    pub(crate) fn times(&self, event: EventCode) -> u64 {
        let kept = self.events.iter().filter(|code| **code == event).count() as u64;
        let older = self.older.iter().find(|(code, _)| *code == event);
        kept + older.map_or(0, |(_, times)| u64::from(*times))
    }

    /// Orders are given: what it records from now on is new.
    pub fn mark(&mut self) {
        self.marked = self.forgotten + self.events.len() as u64;
    }

    /// Whether it has recorded this event since the mark.
    pub(crate) fn has_again(&self, event: EventCode) -> bool {
        let before = self.marked.saturating_sub(self.forgotten) as usize;
        self.events.iter().skip(before).any(|code| *code == event)
    }

    /// Its events, the oldest first.
    pub(crate) fn events(&self) -> &[EventCode] {
        &self.events
    }

    /// They are those of another unit from now on.
    pub(crate) fn begin_anew(&mut self) {
        self.events.clear();
        self.older.clear();
        (self.forgotten, self.marked) = (0, 0);
        (self.ledger, self.in_ledger) = (Ledger::default(), 0);
    }

    /// The unit starts.
    pub(crate) const fn start(&mut self) {
        self.ledger.start();
    }

    /// Its diagnosis history, as all events of its model say.
    pub(crate) fn ledger(&mut self, model: &dyn Model) -> &mut Ledger {
        let Self { events, ledger, in_ledger, .. } = self;
        let news = events.iter().skip(*in_ledger);
        news.filter_map(|event| emergency_code(model, *event)).for_each(|code| ledger.record(code));
        *in_ledger = events.len();
        ledger
    }
}

impl Default for Records {
    fn default() -> Self {
        let (events, older) = (Vec::new(), Vec::new());
        let (forgotten, marked) = (0, 0);
        let ledger = Ledger::default();
        Self { events, events_max: EVENTS_MAX, older, forgotten, marked, ledger, in_ledger: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_events_count_and_the_last_ones_are_kept() {
        for mut records in [Records::default(), Records::with_fixed_room()] {
            let most = records.events_max as u32 + 1;
            (0..most).for_each(|number| records.record(EventCode(number % 2)));
            assert_eq!(records.events().len(), records.events_max / 2 + 1);
            let times = [0, 1, 2].map(|code| records.times(EventCode(code)));
            assert_eq!(times, [u64::from(most / 2 + 1), u64::from(most / 2), 0]);
        }
    }
}
