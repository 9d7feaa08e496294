//! The queue of one slave: jobs one after the other, each with its time.

use std::collections::VecDeque;

use esi::Timeouts;
use time::Instant;
use wire::{AlState, Emergency};

use crate::access::{Address, Answer, Progress};
use crate::event::{Failure, Outcome, RequestId};
use crate::flight::Sender;
use crate::habits::Habits;
use crate::job::Job;
use crate::load::Load;
use crate::mailbox::MailboxConduct;

/// A job and what its end leads to.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    pub(crate) request: RequestId,
    pub(crate) job: Job,
    pub(crate) then: Then,
}

/// What is done with the outcome of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Then {
    /// Nothing.
    Continue,
    /// The slave has its station address from now on.
    UseStationAddress(u16),
    /// It is something that the search wants to know.
    Keep(Found),
    /// It is AL status, from which the way to this state begins.
    Walk(AlState),
    /// It is AL status, which has to show this state.
    Arrive(AlState),
    /// The slave exchanges process data from now on.
    Open,
    /// The slave has started its mailbox.
    RestartMailbox,
    /// It is a word: the Explicit Device ID.
    DeviceId,
}

/// What the search wants to know of a slave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Found {
    Information,
    DlStatus,
    Alias,
    Sii,
}

/// A job that is over.
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
    /// The first job sends then.
    at: Instant,
    /// It gives up then.
    until: Instant,
    /// The number of its datagram that is on its way.
    on_its_way: Option<u32>,
    /// Datagrams that have left so far.
    departed: u32,
    /// How the mailbox is treated, and its counters.
    pub(crate) conduct: MailboxConduct,
    /// Emergencies that nobody has taken yet.
    emergencies: VecDeque<Emergency>,
}

impl Queue {
    pub(crate) const fn new(conduct: MailboxConduct) -> Self {
        Self {
            tasks: VecDeque::new(),
            at: Instant::NEVER,
            until: Instant::NEVER,
            on_its_way: None,
            departed: 0,
            conduct,
            emergencies: VecDeque::new(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.tasks.is_empty()
    }

    /// Whether jobs of this order are still to be done.
    pub(crate) fn holds(&self, request: RequestId) -> bool {
        self.tasks.iter().any(|task| task.request == request)
    }

    pub(crate) fn push(&mut self, task: Task, pace: &Pace<'_>) {
        self.tasks.push_back(task);
        if self.tasks.len() == 1 {
            self.begin(pace);
        }
    }

    /// Puts jobs in front of all others, in their order.
    pub(crate) fn push_front(&mut self, tasks: Vec<Task>, pace: &Pace<'_>) {
        for task in tasks.into_iter().rev() {
            self.tasks.push_front(task);
        }
        self.begin(pace);
    }

    /// The first job begins.
    fn begin(&mut self, pace: &Pace<'_>) {
        self.on_its_way = None;
        self.at = if self.tasks.is_empty() { Instant::NEVER } else { pace.now };
        if let Some(Task { job: Job::Mailbox(mailbox), .. }) = self.tasks.front_mut() {
            mailbox.begin(self.conduct);
        }
        self.be_patient(pace);
    }

    fn be_patient(&mut self, pace: &Pace<'_>) {
        if let Some(task) = self.tasks.front() {
            self.until = pace.now + pace.habits.patience(task.job.dialogue().patience(), pace.timeouts);
        }
    }

    /// When it sends next; never while it waits for an answer.
    pub(crate) const fn deadline(&self) -> Instant {
        if self.on_its_way.is_some() { Instant::NEVER } else { self.at }
    }

    /// Whether the access of the first job is due.
    pub(crate) fn due(&self, now: Instant) -> bool {
        !self.tasks.is_empty() && self.deadline() <= now
    }

    /// Data bytes of the first job's access.
    pub(crate) fn access_bytes(&self) -> usize {
        self.tasks.front().map_or(0, |task| task.job.dialogue().access().length_bytes())
    }

    /// Puts the access of the first job into a frame.
    pub(crate) fn load(&self, sender: Sender, address: Address, load: &mut Load) {
        if let Some(task) = self.tasks.front() {
            load.access(sender, address, &task.job.dialogue().access());
        }
    }

    /// The access of the first job leaves; the number of its datagram.
    pub(crate) const fn depart(&mut self) -> u32 {
        self.departed = self.departed.wrapping_add(1);
        self.on_its_way = Some(self.departed);
        self.departed
    }

    /// Ends the first job, if it is due and has waited for too long.
    pub(crate) fn give_up(&mut self, pace: &Pace<'_>) -> Option<Over> {
        if self.deadline() > pace.now || self.until > pace.now {
            return None;
        }
        let Task { request, job, then } = self.pop(pace)?;
        Some(Over { request, then, result: Err(job.failure()) })
    }

    /// Takes the answer to a datagram, or its loss; what is over by it. The answer to a job that was dropped
    /// meanwhile is nothing.
    pub(crate) fn answer(
        &mut self,
        number: u32,
        answer: Option<Answer<'_>>,
        pace: &Pace<'_>,
    ) -> Option<Over> {
        if self.on_its_way != Some(number) {
            return None;
        }
        self.on_its_way = None;
        self.at = pace.now;
        match self.take(answer)? {
            Progress::Next => None,
            Progress::Later => {
                self.at = pace.now + pace.habits.poll_period;
                None
            }
            Progress::NextStage => {
                self.be_patient(pace);
                None
            }
            Progress::Done => {
                let Task { request, job, then } = self.pop(pace)?;
                Some(Over { request, then, result: job.result() })
            }
        }
    }

    /// The first job takes an answer.
    fn take(&mut self, answer: Option<Answer<'_>>) -> Option<Progress> {
        let task = self.tasks.front_mut()?;
        let progress = task.job.dialogue_mut().answer(answer);
        if let Job::Mailbox(mailbox) = &mut task.job {
            self.emergencies.extend(core::iter::from_fn(|| mailbox.take_emergency()));
        }
        Some(progress)
    }

    /// Takes the first job out; the next one begins.
    fn pop(&mut self, pace: &Pace<'_>) -> Option<Task> {
        let task = self.tasks.pop_front()?;
        if let Job::Mailbox(mailbox) = &task.job {
            self.conduct = mailbox.conduct();
        }
        self.begin(pace);
        Some(task)
    }

    /// Drops what is left of an order.
    pub(crate) fn drop_order(&mut self, request: RequestId, pace: &Pace<'_>) {
        if self.holds(request) {
            self.tasks.retain(|task| task.request != request);
            self.begin(pace);
        }
    }

    /// Changes how the mailbox is treated, by the present job too.
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

/// The present moment and what decides how long things take.
pub(crate) struct Pace<'a> {
    pub(crate) now: Instant,
    pub(crate) habits: &'a Habits,
    pub(crate) timeouts: &'a Timeouts,
}
