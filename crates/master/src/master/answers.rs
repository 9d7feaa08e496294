//! Answers: the job to which an answer belongs, what it completes, and what follows.

use time::Instant;
use wire::AlState;

use super::{EVERYBODYS, Master, NOBODYS};
use crate::access::{Address, Answer, word};
use crate::event::{Event, Failure, Outcome, RequestId};
use crate::queue::{Over, Task, Then};
use crate::runner::Pace;
use crate::sender::Sender;
use crate::state::AlReport;
use crate::walk::{has_mailbox, has_process_data, sets_process_data, way};

/// Maximum number of waiting events before emergencies are dropped.
const EVENTS_MAX: usize = 4_096;

impl Master {
    /// Processes the answer to a datagram; none: its frame is lost.
    pub(super) fn answer(&mut self, now: Instant, sender: Sender, answer: Option<Answer<'_>>) {
        match sender {
            Sender::Everybody(number) => {
                let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
                if let Some(over) = self.everybody.answer(number, answer, &pace) {
                    self.over_everybody(now, over);
                }
            }
            Sender::Slave(position, number) => self.answer_slave(now, position, number, answer),
            Sender::Cycle(number) => self.answer_cycle(number, answer),
            Sender::Owner(request) => {
                let result = answer.ok_or(Failure::Lost).map(|answer| Outcome::Datagram {
                    working_counter: answer.working_counter,
                    data: answer.data.to_vec(),
                });
                self.events.push_back(Event::Finished { request, slave: None, result });
            }
        }
    }

    fn answer_slave(&mut self, now: Instant, position: usize, number: u32, answer: Option<Answer<'_>>) {
        let Some(slave) = self.slaves.get_mut(position) else { return };
        let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
        let over = slave.queue.answer(number, answer, &pace);
        while let Some(emergency) = slave.queue.take_emergency() {
            if self.events.len() < EVENTS_MAX {
                self.events.push_back(Event::Emergency { slave: position, emergency });
            } else {
                self.emergencies_lost += 1;
            }
        }
        if let Some(over) = over {
            self.over(now, position, over);
        }
    }

    fn answer_cycle(&mut self, number: usize, answer: Option<Answer<'_>>) {
        let Some(answer) = answer else { return };
        if let Some((slave, status)) = self.process_data.answer(number, answer)
            && let Some(slave) = self.slaves.get_mut(slave)
        {
            slave.note_status(status);
        }
    }

    /// Ends jobs that have waited for too long.
    pub(super) fn give_up(&mut self, now: Instant) {
        let pace = Pace { now, habits: &self.habits, timeouts: &EVERYBODYS };
        if let Some(over) = self.everybody.give_up(&pace) {
            self.over_everybody(now, over);
        }
        for position in 0..self.slaves.len() {
            while let Some(over) = self.give_up_job(now, position) {
                self.over(now, position, over);
            }
        }
    }

    fn give_up_job(&mut self, now: Instant, position: usize) -> Option<Over> {
        let slave = self.slaves.get_mut(position)?;
        let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
        slave.queue.give_up(&pace)
    }

    /// A job of a slave is complete. With the last job of an order, or a failed one, its order is complete.
    fn over(&mut self, now: Instant, position: usize, Over { request, then, result }: Over) {
        let result = result.and_then(|outcome| self.follow(now, position, request, then, outcome));
        let Some(slave) = self.slaves.get_mut(position) else { return };
        slave.note_state(&result);
        if result.is_err() {
            let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
            slave.queue.drop_order(request, &pace);
        }
        if request != NOBODYS && !slave.queue.holds(request) {
            self.events.push_back(Event::Finished { request, slave: Some(position), result });
        }
    }

    /// The consequence of a job.
    fn follow(
        &mut self,
        now: Instant,
        position: usize,
        request: RequestId,
        then: Then,
        outcome: Outcome,
    ) -> Result<Outcome, Failure> {
        let slave = self.slaves.get_mut(position).ok_or(Failure::NoSlave)?;
        match (then, outcome) {
            (Then::UseStationAddress(address), _) => slave.address = Address::Station(address),
            (Then::Keep(found), outcome) => slave.keep(found, outcome),
            (Then::RestartMailbox, outcome) => {
                slave.queue.conduct.restart();
                return Ok(outcome);
            }
            (Then::Open, outcome) => {
                self.process_data.open(position, now);
                return Ok(outcome);
            }
            (Then::DeviceId, Outcome::Data(data)) => return Ok(Outcome::DeviceId(word(&data))),
            (Then::Walk(target), Outcome::Data(data)) => {
                let shown = AlReport::parse(&data);
                if sets_process_data(shown.status.state, target)
                    && let Some(length_bytes) = slave.settings.too_long_area()
                {
                    return Err(Failure::AreaTooLong { length_bytes });
                }
                self.walk(now, position, request, shown, target);
                return Ok(Outcome::State(shown));
            }
            (Then::Arrive(target), Outcome::Data(data)) => return arrived(AlReport::parse(&data), target),
            (Then::Continue | Then::DeviceId | Then::Walk(_) | Then::Arrive(_), outcome) => {
                return Ok(outcome);
            }
        }
        Ok(Outcome::Done)
    }

    /// Adds the jobs of the way from the state that a slave shows to a state.
    fn walk(&mut self, now: Instant, position: usize, request: RequestId, shown: AlReport, target: AlState) {
        if !has_process_data(target) {
            self.process_data.close(position);
        }
        if sets_process_data(shown.status.state, target) {
            self.process_data.close(position);
            self.place(position);
        }
        let Some(slave) = self.slaves.get_mut(position) else { return };
        let listens = has_mailbox(target) && slave.settings.mailbox.is_some();
        slave.next_listen =
            self.habits.listen_period.filter(|_| listens).map_or(Instant::NEVER, |period| now + period);
        let fmmus: Vec<_> = self.process_data.fmmus(position).collect();
        let jobs = way(shown, target, &slave.settings, &fmmus);
        let tasks = jobs.into_iter().map(|(job, then)| Task { request, job, then }).collect();
        let pace = Pace { now, habits: &self.habits, timeouts: &slave.settings.timeouts };
        slave.queue.push_front(tasks, &pace);
        // A slave that has stopped at SAFE-OP waits for outputs on its way to OP.
        if target == AlState::Op && self.process_data.is_open(position) {
            self.process_data.begin(now);
        }
    }

    fn over_everybody(&mut self, now: Instant, Over { request, result, .. }: Over) {
        if let Ok(Outcome::Found(count)) = result {
            self.identify(now, request, count);
        }
        self.events.push_back(Event::Finished { request, slave: None, result });
    }
}

/// Whether a slave has reached the target of its way.
fn arrived(report: AlReport, target: AlState) -> Result<Outcome, Failure> {
    let is_there = report.status.state == target && !report.status.error;
    if is_there { Ok(Outcome::State(report)) } else { Err(Failure::Refused(report)) }
}
