//! A client of the channel: it sends requests, waits for their answers, and keeps the records that come between.

mod connection;
mod error;
#[cfg(test)]
mod tests;

use std::collections::VecDeque;
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::time::{Duration, Instant};

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::messages::{Answer, Incoming, Refusal, Request, Verb};
use connection::Connection;
pub use error::ClientError;

/// The time in which a twin answers, beside the time that the request itself takes.
const ANSWER_WITHIN: Duration = Duration::from_secs(10);
/// Records that wait to be taken. Later ones are lost.
const RECORDS_MAX: usize = 10_000;

/// A connection to a twin. Its methods wait.
#[derive(Debug)]
pub struct Client {
    connection: Connection,
    /// The number of the newest request, which is its `id`.
    requests: u64,
    records: VecDeque<Streamed>,
}

/// What a subscription has brought.
#[derive(Clone, Debug, PartialEq)]
pub enum Streamed {
    /// A record, as in `run --events`.
    Record(Map<String, Value>),
    /// This number of records is missing here.
    Lost(u64),
}

/// What was asked for, and when.
#[derive(Clone, Debug, PartialEq)]
pub struct Answered<T> {
    /// Nanoseconds since power-on of the twin.
    pub at_ns: u64,
    /// The content of the answer.
    pub content: T,
}

/// The content of an answer that has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
pub struct Nothing {}

impl Client {
    /// Connects to the socket of a twin.
    ///
    /// # Errors
    /// [`ClientError::NotThere`].
    pub fn connect(path: &Path) -> Result<Self, ClientError> {
        let connected = UnixStream::connect(path).and_then(Self::over);
        connected.map_err(|source| ClientError::NotThere { path: path.to_owned(), source })
    }

    /// A client on a connected socket.
    ///
    /// # Errors
    /// Those of the system.
    pub fn over(stream: UnixStream) -> std::io::Result<Self> {
        Ok(Self { connection: Connection::over(stream)?, requests: 0, records: VecDeque::new() })
    }

    /// Carries out an order.
    ///
    /// # Errors
    /// [`ClientError`].
    pub fn apply(&mut self, order: &str) -> Result<Answered<Nothing>, ClientError> {
        self.ask(Verb::Do(order.to_owned()))
    }

    /// Sends a request, and waits for the content of its answer.
    ///
    /// # Errors
    /// [`ClientError`].
    pub fn ask<T: DeserializeOwned>(&mut self, verb: Verb) -> Result<Answered<T>, ClientError> {
        let answer = self.answer(verb)?;
        let at_ns = answer.at_ns.unwrap_or_default();
        let content = answer.content().map_err(ClientError::Refused)?;
        Ok(Answered { at_ns, content })
    }

    /// Sends a request, and waits for its answer.
    ///
    /// # Errors
    /// [`ClientError`]; a refused request is one.
    pub fn answer(&mut self, verb: Verb) -> Result<Answer, ClientError> {
        self.requests += 1;
        let id = Value::from(self.requests);
        let time = time_of(&verb);
        self.connection.send(&Request { id: id.clone(), verb }.line())?;
        let until = Instant::now().checked_add(time);
        loop {
            let Some(incoming) = self.connection.next(until)? else {
                return Err(ClientError::Silent { waited: time });
            };
            if let Some(answer) = self.sort(incoming, &id)? {
                return Ok(answer);
            }
        }
    }

    /// The answer, if it is that of this request. Records are kept.
    fn sort(&mut self, incoming: Incoming, id: &Value) -> Result<Option<Answer>, ClientError> {
        match incoming {
            // A refusal without an id concerns the connection, such as one client too many.
            Incoming::Answer(answer) if answer.id == *id || (answer.id.is_null() && !answer.ok) => {
                if answer.ok { Ok(Some(answer)) } else { Err(refused(answer)) }
            }
            // The late answer of a request that was given up.
            Incoming::Answer(_) => Ok(None),
            Incoming::Record(record) => {
                self.keep(Streamed::Record(record));
                Ok(None)
            }
            Incoming::Lost(count) => {
                self.keep(Streamed::Lost(count));
                Ok(None)
            }
        }
    }

    fn keep(&mut self, streamed: Streamed) {
        if self.records.len() < RECORDS_MAX {
            return self.records.push_back(streamed);
        }
        let more = if let Streamed::Lost(more) = streamed { more } else { 1 };
        match self.records.back_mut() {
            Some(Streamed::Lost(count)) => *count = count.saturating_add(more),
            _ => self.records.push_back(Streamed::Lost(more)),
        }
    }

    /// The next record of the subscriptions; none if there is none until this time. Without a time, this waits.
    ///
    /// # Errors
    /// [`ClientError`].
    pub fn next_record(&mut self, until: Option<Instant>) -> Result<Option<Streamed>, ClientError> {
        loop {
            if let Some(streamed) = self.records.pop_front() {
                return Ok(Some(streamed));
            }
            let Some(incoming) = self.connection.next(until)? else { return Ok(None) };
            if self.sort(incoming, &Value::Null)?.is_some() {
                return Err(ClientError::Refused(Refusal::new("an answer without a request", "")));
            }
        }
    }
}

fn refused(answer: Answer) -> ClientError {
    ClientError::Refused(answer.error.unwrap_or_default())
}

/// The time that the answer may take.
fn time_of(verb: &Verb) -> Duration {
    let own = match verb {
        Verb::Expect { within: Some(within), .. } => Duration::from_nanos(within.as_nanos()),
        _ => Duration::ZERO,
    };
    ANSWER_WITHIN.saturating_add(own)
}
