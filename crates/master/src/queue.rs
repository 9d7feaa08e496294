//! The queue of one slave: jobs one after the other, each with its deadline.

use std::collections::VecDeque;

use time::Instant;
use wire::{AlState, Emergency};

use crate::access::{Address, Answer, Progress};
use crate::event::{Failure, Outcome, RequestId};
use crate::job::Job;
use crate::load::Load;
use crate::mailbox::MailboxConduct;
use crate::runner::{Pace, Runner};
use crate::sender::Sender;

/// A job and the consequence of its end.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    pub(crate) request: RequestId,
    pub(crate) job: Job,
    pub(crate) then: Then,
}

/// What is done with the result of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Then {
    /// Nothing.
    Continue,
    /// The slave has its station address from now on.
    UseStationAddress(u16),
    /// It is information for the search.
    Keep(Found),
    /// It is AL status, from which the way to this state begins.
    Walk(AlState),
    /// It is AL status, which must show this state.
    Arrive(AlState),
    /// The slave exchanges process data from now on.
    Open,
    /// The slave has started its mailbox.
    RestartMailbox,
    /// It is a word: the Explicit Device ID.
    DeviceId,
}

/// The information that the search needs about a slave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Found {
    Information,
    DlStatus,
    Alias,
    Sii,
}

/// A completed job.
#[derive(Debug)]
pub(crate) struct Over {
    pub(crate) request: RequestId,
    pub(crate) then: Then,
    pub(crate) result: Result<Outcome, Failure>,
}

/// Jobs one after the other.
#[derive(Debug)]
pub(crate) struct Queue {
    tasks: VecDeque<Task>,
    /// Runs the first job.
    runner: Runner,
    /// How the mailbox is handled, and its counters.
    pub(crate) conduct: MailboxConduct,
    /// Emergencies that have not been taken yet.
    emergencies: VecDeque<Emergency>,
}

impl Queue {
    pub(crate) const fn new(conduct: MailboxConduct) -> Self {
        Self { tasks: VecDeque::new(), runner: Runner::new(), conduct, emergencies: VecDeque::new() }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.tasks.is_empty()
    }

    /// Whether the slave is on its way to the exchange of process data.
    pub(crate) fn opens(&self) -> bool {
        self.tasks.iter().any(|task| task.then == Then::Open)
    }

    /// Whether jobs of this order are not complete yet.
    pub(crate) fn holds(&self, request: RequestId) -> bool {
        self.tasks.iter().any(|task| task.request == request)
    }

    pub(crate) fn push(&mut self, task: Task, pace: &Pace<'_>) {
        self.tasks.push_back(task);
        if self.tasks.len() == 1 {
            self.begin(pace);
        }
    }

    /// Puts jobs before all others, in their order.
    pub(crate) fn push_front(&mut self, tasks: Vec<Task>, pace: &Pace<'_>) {
        for task in tasks.into_iter().rev() {
            self.tasks.push_front(task);
        }
        self.begin(pace);
    }

    /// The first job begins.
    fn begin(&mut self, pace: &Pace<'_>) {
        let Some(task) = self.tasks.front_mut() else { return self.runner.rest() };
        if let Job::Mailbox(mailbox) = &mut task.job {
            mailbox.begin(self.conduct);
        }
        self.runner.begin(task.job.dialogue(), pace);
    }

    /// The time at which it sends next; never while it waits for an answer.
    pub(crate) const fn deadline(&self) -> Instant {
        self.runner.deadline()
    }

    /// Whether the access of the first job is due.
    pub(crate) fn due(&self, now: Instant) -> bool {
        !self.tasks.is_empty() && self.runner.is_due(now)
    }

    /// Number of data bytes of the first job's access.
    pub(crate) fn access_bytes(&self) -> usize {
        self.tasks.front().map_or(0, |task| task.job.dialogue().access().length_bytes())
    }

    /// Puts the access of the first job into a frame.
    pub(crate) fn load(&self, sender: Sender, address: Address, load: &mut Load<Sender>) {
        if let Some(task) = self.tasks.front() {
            load.access(sender, address, &task.job.dialogue().access());
        }
    }

    /// The access of the first job is sent; returns the number of its datagram.
    pub(crate) const fn depart(&mut self) -> u32 {
        self.runner.depart()
    }

    /// Ends the first job, if it is due and has waited for too long, or does not fit into any frame.
    pub(crate) fn give_up(&mut self, pace: &Pace<'_>) -> Option<Over> {
        if !self.due(pace.now) {
            return None;
        }
        let fits = self.tasks.front().is_none_or(|task| task.job.fits());
        let is_sendable = fits && !self.runner.is_too_late(pace.now);
        if is_sendable {
            return None;
        }
        let Task { request, job, then } = self.pop(pace)?;
        Some(Over { request, then, result: Err(job.failure()) })
    }

    /// Processes the answer to a datagram, or its loss; returns the completed job, if any. The answer to a job
    /// that was dropped meanwhile is ignored.
    pub(crate) fn answer(
        &mut self,
        number: u32,
        answer: Option<Answer<'_>>,
        pace: &Pace<'_>,
    ) -> Option<Over> {
        let task = self.tasks.front_mut()?;
        let progress = self.runner.answer(number, task.job.dialogue_mut(), answer, pace)?;
        if let Job::Mailbox(mailbox) = &mut task.job {
            self.emergencies.extend(core::iter::from_fn(|| mailbox.take_emergency()));
        }
        if progress != Progress::Done {
            return None;
        }
        let Task { request, job, then } = self.pop(pace)?;
        Some(Over { request, then, result: job.result() })
    }

    /// Removes the first job; the next one begins.
    fn pop(&mut self, pace: &Pace<'_>) -> Option<Task> {
        let task = self.tasks.pop_front()?;
        if let Job::Mailbox(mailbox) = &task.job {
            self.conduct = mailbox.conduct();
        }
        self.begin(pace);
        Some(task)
    }

    /// Drops the remaining jobs of an order.
    pub(crate) fn drop_order(&mut self, request: RequestId, pace: &Pace<'_>) {
        if self.holds(request) {
            self.tasks.retain(|task| task.request != request);
            self.begin(pace);
        }
    }

    /// Changes how the mailbox is handled, including by the present job.
    pub(crate) fn change_conduct(&mut self, mut change: impl FnMut(&mut MailboxConduct)) {
        change(&mut self.conduct);
        if let Some(Task { job: Job::Mailbox(mailbox), .. }) = self.tasks.front_mut() {
            change(mailbox.conduct_mut());
        }
    }

    /// Takes the oldest emergency.
    pub(crate) fn take_emergency(&mut self) -> Option<Emergency> {
        self.emergencies.pop_front()
    }
}
