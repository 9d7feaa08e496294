//! The thread that carries out requests, one after the other, in the order in which they were received.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration as Wait, Instant as Now};

use serde::Serialize;
use serde_json::{Map, Value};
use time::{Duration, Instant};

use super::expectations::{Expectations, Waiting};
use super::notices::Notices;
use super::pace::Pace;
use super::postbox::{ClientNumber, Ends, Post, Postbox};
use super::subscription::{Kinds, Named, Subscription, is_all, variable_word};
use super::variables::VariableWatch;
use crate::messages::{
    Answer, Faults, Held, Refusal, Request, Sentences, Status, Subscribed, Variables, Verb,
};
use crate::twin::{Change, Twin};

/// Units that are reported at once: frames wait for that.
const UNITS_AT_ONCE: usize = 16;

/// What the thread of the lines asks for.
pub(super) enum Job {
    /// A client asks for something.
    Request {
        /// The client.
        client: ClientNumber,
        /// What it asks for.
        request: Request,
        /// Whether it is still there: nobody waits for the expectations of one that is not.
        is_there: Arc<AtomicBool>,
    },
    /// A client has left.
    Gone { client: ClientNumber },
}

/// The twin, and what clients wait for.
pub(super) struct Work<T: Twin> {
    twin: T,
    jobs: Receiver<Job>,
    postbox: Arc<Postbox>,
    kinds: Arc<Kinds>,
    /// The kinds that each client has subscribed.
    subscriptions: BTreeMap<ClientNumber, Subscription>,
    expectations: Expectations<T::Look>,
    variables: VariableWatch,
    pace: Pace,
    notices: Notices,
}

/// A request that was done.
struct Done {
    at: Instant,
    content: Value,
    subscription: Option<Subscription>,
}

impl Done {
    fn new(at: Instant, content: &impl Serialize) -> Self {
        // Members with text as names and values of JSON can always be written.
        Self { at, content: serde_json::to_value(content).unwrap_or_default(), subscription: None }
    }

    fn at(at: Instant) -> Self {
        Self::new(at, &Map::new())
    }
}

impl<T: Twin> Work<T> {
    pub(super) fn new(twin: T, jobs: Receiver<Job>, postbox: Arc<Postbox>, kinds: Arc<Kinds>) -> Self {
        Self {
            twin,
            jobs,
            postbox,
            kinds,
            subscriptions: BTreeMap::new(),
            expectations: Expectations::default(),
            variables: VariableWatch::default(),
            pace: Pace::of_requests(Now::now()),
            notices: Notices::default(),
        }
    }

    /// Carries out requests until the thread of the lines has ended.
    pub(super) fn run(mut self) {
        loop {
            let job = match self.next_look() {
                None => self.jobs.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(wait) => self.jobs.recv_timeout(wait),
            };
            match job {
                Ok(Job::Request { client, request, is_there }) => self.request(client, request, &is_there),
                Ok(Job::Gone { client }) => self.forget(client),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            self.look();
        }
    }

    /// The time until expectations and variables are looked at; none: nobody waits for any.
    fn next_look(&self) -> Option<Wait> {
        let due = [self.expectations.due(), self.variables.due()].into_iter().flatten().min()?;
        Some(due.saturating_duration_since(Now::now()))
    }

    fn look(&mut self) {
        let now = Now::now();
        if self.expectations.due().is_some_and(|due| due <= now) {
            let answers = self.expectations.look(&mut self.twin);
            self.postbox.post(answers);
        }
        if self.variables.due().is_some_and(|due| due <= now) {
            let records = paced(&mut self.pace, &mut self.twin, |twin| self.variables.look(twin));
            self.postbox.post(records);
        }
    }

    fn forget(&mut self, client: ClientNumber) {
        self.subscriptions.remove(&client);
        self.variables.forget(client);
    }

    fn request(&mut self, client: ClientNumber, Request { id, verb }: Request, is_there: &Arc<AtomicBool>) {
        if let Verb::Expect { condition, within: Some(within) } = &verb {
            if !is_there.load(Ordering::Relaxed) {
                return;
            }
            let look = paced(&mut self.pace, &mut self.twin, |twin| twin.look_for(condition, *within));
            match look {
                Ok(look) => {
                    let end = self.twin.now() + *within;
                    let is_there = Arc::clone(is_there);
                    self.expectations.add(Waiting { client, id, look, end, is_there });
                }
                Err(refusal) => self.answer(client, id, Err(refusal), Ends::Expectation),
            }
            return;
        }
        let done = self.carry_out(client, verb);
        self.answer(client, id, done, Ends::Request);
    }

    fn answer(&mut self, client: ClientNumber, id: Value, done: Result<Done, Refusal>, ends: Ends) {
        let (answer, subscription) = match done {
            Ok(Done { at, content, subscription }) => {
                (Answer::done(id, at.as_nanos(), &content), subscription)
            }
            Err(refusal) => {
                if self.notices.may_show() {
                    tracing::warn!("control: client {client}: {refusal}");
                }
                (Answer::refused(id, refusal), None)
            }
        };
        let line = answer.line().into();
        self.postbox.post([Post::Answer { client, line, ends, subscription }]);
    }

    fn carry_out(&mut self, client: ClientNumber, verb: Verb) -> Result<Done, Refusal> {
        match verb {
            Verb::Do(sentence) => self.order(client, &sentence),
            Verb::Expect { condition, within: _ } => self.expect_now(&condition),
            Verb::Status => self.status(),
            Verb::Read(names) => self.read(&names),
            Verb::Write(values) => self.change(changes(values, Change::Write)),
            Verb::Force(values) => self.change(changes(values, Change::Force)),
            Verb::Release(names) => {
                self.change(names.into_iter().map(|name| (name, Change::Release)).collect())
            }
            Verb::Object(object) => {
                let (at, report) = self.paced(|twin| twin.object(&object))?;
                Ok(Done::new(at, &report))
            }
            Verb::Subscribe(words) => self.subscribe(client, &words),
            Verb::Unsubscribe(words) => self.unsubscribe(client, &words),
            Verb::Faults => Ok(self.faults()),
            Verb::Clear(fault) => {
                let at = self.paced(|twin| twin.clear(&fault))?;
                Ok(Done { at, ..self.faults() })
            }
            Verb::Sentences => {
                Ok(Done::new(self.twin.now(), &Sentences { sentences: self.twin.sentences() }))
            }
        }
    }

    fn order(&mut self, client: ClientNumber, sentence: &str) -> Result<Done, Refusal> {
        let at = self.paced(|twin| twin.order(sentence))?;
        if self.notices.may_show() {
            tracing::info!("control: client {client}: {sentence}");
        }
        Ok(Done::at(at))
    }

    fn expect_now(&mut self, condition: &str) -> Result<Done, Refusal> {
        let (at, looked) = self.paced(|twin| {
            let mut look = twin.look_for(condition, Duration::ZERO)?;
            Ok(twin.look(&mut [&mut look]))
        })?;
        let seen = looked.into_iter().find_map(Result::err);
        Ok(Done::new(at, &Held { held: seen.is_none(), seen }))
    }

    fn status(&mut self) -> Result<Done, Refusal> {
        let count = self.twin.count();
        let (mut at, mut units) = (self.twin.now(), Vec::with_capacity(count));
        for first in (0..count).step_by(UNITS_AT_ONCE) {
            let (then, reports) = self.paced(|twin| twin.report(first..count.min(first + UNITS_AT_ONCE)));
            at = then;
            units.extend(reports);
        }
        Ok(Done::new(at, &Status { link: self.twin.link().to_owned(), units }))
    }

    fn read(&mut self, names: &[String]) -> Result<Done, Refusal> {
        let words: Vec<&str> = names.iter().map(String::as_str).collect();
        let (at, reports) = self.paced(|twin| twin.read(&words));
        let values = names.iter().cloned().zip(reports).map(|(name, report)| Ok((name, report?)));
        Ok(Done::new(at, &Variables { values: values.collect::<Result<_, Refusal>>()? }))
    }

    /// Changes variables, and reads them.
    fn change(&mut self, changes: Vec<(String, Change)>) -> Result<Done, Refusal> {
        let words: Vec<_> = changes.iter().map(|(name, change)| (name.as_str(), change.clone())).collect();
        let at = self.paced(|twin| twin.change(&words))?;
        let names: Vec<String> = changes.into_iter().map(|(name, _)| name).collect();
        Ok(Done { at, ..self.read(&names)? })
    }

    fn subscribe(&mut self, client: ClientNumber, words: &[String]) -> Result<Done, Refusal> {
        let mut kinds = self.subscriptions.get(&client).copied().unwrap_or_default();
        let mut variables = Vec::new();
        for word in words {
            match self.kinds.named(word)? {
                Named::Kinds(more) => kinds = kinds.and(more),
                Named::Variable(name) => variables.push(name),
            }
        }
        let (_, reports) = self.paced(|twin| twin.read(&variables));
        reports.into_iter().collect::<Result<Vec<_>, _>>()?;
        self.variables.add(client, &variables)?;
        Ok(self.subscribed(client, kinds))
    }

    fn unsubscribe(&mut self, client: ClientNumber, words: &[String]) -> Result<Done, Refusal> {
        let mut kinds = self.subscriptions.get(&client).copied().unwrap_or_default();
        let mut variables = Vec::new();
        for word in words {
            match self.kinds.named(word)? {
                Named::Kinds(less) => kinds = kinds.without(less),
                Named::Variable(name) => variables.push(name),
            }
        }
        if words.iter().any(|word| is_all(word)) {
            self.variables.forget(client);
        }
        variables.into_iter().for_each(|name| self.variables.remove(client, name));
        Ok(self.subscribed(client, kinds))
    }

    fn subscribed(&mut self, client: ClientNumber, kinds: Subscription) -> Done {
        self.subscriptions.insert(client, kinds);
        let mut subscribed = self.kinds.names(kinds);
        subscribed.extend(self.variables.of(client).map(variable_word));
        let done = Done::new(self.twin.now(), &Subscribed { subscribed });
        let has_variables = self.variables.of(client).next().is_some();
        let subscription = if has_variables { kinds.and(Subscription::VARIABLES) } else { kinds };
        Done { subscription: Some(subscription), ..done }
    }

    fn faults(&mut self) -> Done {
        let (at, faults) = self.paced(T::faults);
        Done::new(at, &Faults { faults })
    }

    fn paced<R>(&mut self, ask: impl FnOnce(&mut T) -> R) -> R {
        paced(&mut self.pace, &mut self.twin, ask)
    }
}

/// Asks the twin, but not too often.
fn paced<T: Twin, R>(pace: &mut Pace, twin: &mut T, ask: impl FnOnce(&mut T) -> R) -> R {
    pace.keep();
    pace.measured(twin, ask)
}

fn changes(values: Vec<(String, Value)>, change: fn(Value) -> Change) -> Vec<(String, Change)> {
    values.into_iter().map(|(name, value)| (name, change(value))).collect()
}
