//! Variables whose changes clients have subscribed. Each of them is read and written as a line once for all clients.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::{Duration as Wait, Instant as Now};

use serde::Serialize;

use super::postbox::{ClientNumber, Post};
use crate::messages::{Refusal, VariableReport};
use crate::twin::Twin;

/// The time from one look to the next.
const LOOK_AGAIN: Wait = Wait::from_millis(10);
/// Variables of all clients.
const VARIABLES_MAX: usize = 1_024;

/// The variables that are watched.
pub(super) struct VariableWatch {
    variables: BTreeMap<String, Watched>,
    next_look: Now,
}

#[derive(Default)]
struct Watched {
    clients: BTreeSet<ClientNumber>,
    /// Those that have no record of it yet.
    new: BTreeSet<ClientNumber>,
    last: Option<VariableReport>,
}

/// The record of a variable.
#[derive(Serialize)]
struct Record<'a> {
    at_ns: u64,
    kind: &'static str,
    variable: &'a str,
    #[serde(flatten)]
    report: &'a VariableReport,
}

impl Default for VariableWatch {
    fn default() -> Self {
        Self { variables: BTreeMap::new(), next_look: Now::now() }
    }
}

impl VariableWatch {
    /// A client subscribes these, which the twin has. The first record has the present value.
    pub(super) fn add(&mut self, client: ClientNumber, names: &[&str]) -> Result<(), Refusal> {
        let new = names.iter().filter(|name| !self.variables.contains_key(**name)).count();
        if self.variables.len() + new > VARIABLES_MAX {
            let message = format!("{VARIABLES_MAX} variables are subscribed already");
            return Err(Refusal::new(message, "end subscriptions by `unsubscribe`"));
        }
        for name in names {
            let watched = self.variables.entry((*name).to_owned()).or_default();
            if watched.clients.insert(client) {
                watched.new.insert(client);
            }
        }
        if !names.is_empty() {
            self.next_look = Now::now();
        }
        Ok(())
    }

    /// A client ends a subscription.
    pub(super) fn remove(&mut self, client: ClientNumber, name: &str) {
        if let Some(watched) = self.variables.get_mut(name) {
            watched.forget(client);
        }
        self.drop_unwatched();
    }

    /// A client ends all subscriptions.
    pub(super) fn forget(&mut self, client: ClientNumber) {
        self.variables.values_mut().for_each(|watched| watched.forget(client));
        self.drop_unwatched();
    }

    fn drop_unwatched(&mut self) {
        self.variables.retain(|_, watched| !watched.clients.is_empty());
    }

    /// The variables of a client.
    pub(super) fn of(&self, client: ClientNumber) -> impl Iterator<Item = &str> {
        let those = self.variables.iter().filter(move |(_, watched)| watched.clients.contains(&client));
        those.map(|(name, _)| name.as_str())
    }

    /// When they are looked at; none: there are none.
    pub(super) fn due(&self) -> Option<Now> {
        (!self.variables.is_empty()).then_some(self.next_look)
    }

    /// Reads them: a record of each change.
    pub(super) fn look(&mut self, twin: &mut impl Twin) -> Vec<Post> {
        let names: Vec<&str> = self.variables.keys().map(String::as_str).collect();
        let (at, reports) = twin.read(&names);
        let mut records = Vec::new();
        for ((name, watched), report) in self.variables.iter_mut().zip(reports) {
            // A unit that has taken the place of another one may have no such variable.
            let Ok(report) = report else { continue };
            let has_changed = watched.last.as_ref() != Some(&report);
            let all = watched.clients.iter().copied();
            let receivers: Vec<ClientNumber> =
                if has_changed { all.collect() } else { watched.new.iter().copied().collect() };
            watched.new.clear();
            if receivers.is_empty() {
                continue;
            }
            let record = Record { at_ns: at.as_nanos(), kind: "variable", variable: name, report: &report };
            // Members with text as names and values of JSON can always be written.
            let line: Arc<str> = format!("{}\n", serde_json::to_string(&record).unwrap_or_default()).into();
            let posts =
                receivers.into_iter().map(|client| Post::RecordFor { client, line: Arc::clone(&line) });
            records.extend(posts);
            watched.last = Some(report);
        }
        self.next_look = Now::now() + LOOK_AGAIN;
        records
    }
}

impl Watched {
    fn forget(&mut self, client: ClientNumber) {
        self.clients.remove(&client);
        self.new.remove(&client);
    }
}
