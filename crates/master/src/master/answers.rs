//! What comes back: whose answer it is, what is over by it, what follows.

use time::Instant;
use wire::DatagramView;

use super::{EVERYBODYS, Master};
use crate::access::{Address, Answer};
use crate::event::{Event, Failure, Outcome};
use crate::flight::Sender;
use crate::queue::{Over, Pace, Then};

impl Master {
    /// Takes the answer to a datagram; none: its frame is lost.
    pub(super) fn answer(&mut self, now: Instant, sender: Sender, datagram: Option<DatagramView<'_>>) {
        let answer = datagram
            .map(|datagram| Answer { working_counter: datagram.working_counter, data: datagram.data });
        match sender {
            Sender::Everybody(number) => {
                let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
                if let Some(over) = self.everybody.answer(number, answer, &pace) {
                    self.over_everybody(now, over);
                }
            }
            Sender::Slave(position, number) => {
                let Some(slave) = self.slaves.get_mut(position) else { return };
                let pace = Pace { now, habits: &self.habits, timeouts: &slave.timeouts };
                if let Some(over) = slave.queue.answer(number, answer, &pace) {
                    self.over(now, position, over);
                }
            }
            Sender::Owner(request) => {
                let result = answer.ok_or(Failure::Lost).map(|answer| Outcome::Datagram {
                    working_counter: answer.working_counter,
                    data: answer.data.to_vec(),
                });
                self.events.push_back(Event::Finished { request, slave: None, result });
            }
        }
    }

    /// Ends jobs that have waited for too long.
    pub(super) fn give_up(&mut self, now: Instant) {
        let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
        if let Some(over) = self.everybody.give_up(&pace) {
            self.over_everybody(now, over);
        }
        for position in 0..self.slaves.len() {
            let slave = &mut self.slaves[position];
            let pace = Pace { now, habits: &self.habits, timeouts: &slave.timeouts };
            if let Some(over) = slave.queue.give_up(&pace) {
                self.over(now, position, over);
            }
        }
    }

    /// A job of a slave is over. With the last job of an order, or a failed one, its order is over.
    fn over(&mut self, now: Instant, position: usize, Over { request, then, result }: Over) {
        let Some(slave) = self.slaves.get_mut(position) else { return };
        slave.note_state(&result);
        let result = match (then, result) {
            (_, Err(failure)) => {
                let pace = Pace { now, habits: &self.habits, timeouts: &slave.timeouts };
                slave.queue.drop_order(request, &pace);
                Err(failure)
            }
            (Then::Report, Ok(outcome)) => Ok(outcome),
            (Then::Continue, Ok(_)) => Ok(Outcome::Done),
            (Then::UseStationAddress(address), Ok(_)) => {
                slave.address = Address::Station(address);
                Ok(Outcome::Done)
            }
            (Then::Keep(found), Ok(outcome)) => {
                slave.keep(found, outcome);
                Ok(Outcome::Done)
            }
        };
        if !slave.queue.holds(request) {
            self.events.push_back(Event::Finished { request, slave: Some(position), result });
        }
    }

    fn over_everybody(&mut self, now: Instant, Over { request, result, .. }: Over) {
        if let Ok(Outcome::Found(count)) = result {
            self.identify(now, request, count);
        }
        self.events.push_back(Event::Finished { request, slave: None, result });
    }
}
