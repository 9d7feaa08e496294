//! What a user has to know of clients without a place: at once, then once a second with a count.

use std::future::pending;
use std::mem;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::time::{Instant, sleep_until};

use super::clients::{CONNECTIONS_MAX, Closed};

/// From one line of a log to the next of its kind.
const PERIOD: Duration = Duration::from_secs(1);

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Notice {
    /// A client was closed in favour of another one.
    Closed { closed: Closed, for_client: SocketAddr },
    /// No client could be accepted.
    NotAccepted(String),
}

/// What is to be reported, of each kind.
#[derive(Debug, Default)]
pub(super) struct Notices {
    kinds: [Kind; 2],
}

#[derive(Debug, Default)]
struct Kind {
    newest: Option<Notice>,
    count: u64,
    /// Nothing is reported before; none: nothing was reported yet.
    not_before: Option<Instant>,
}

impl Notices {
    /// Reports it now, or with those that happen within the second.
    pub(super) fn add(&mut self, notice: Notice) {
        let kind = &mut self.kinds[usize::from(matches!(notice, Notice::NotAccepted(_)))];
        kind.newest = Some(notice);
        kind.count += 1;
        self.report();
    }

    /// Waits until something is to be reported; for ever if there is nothing.
    pub(super) async fn due(&self) {
        match self.kinds.iter().filter_map(Kind::due).min() {
            Some(at) => sleep_until(at).await,
            None => pending().await,
        }
    }

    /// Reports what is due.
    pub(super) fn report(&mut self) {
        let now = Instant::now();
        for line in self.kinds.iter_mut().filter_map(|kind| kind.take(now)) {
            tracing::warn!("{line}");
        }
    }
}

impl Kind {
    fn due(&self) -> Option<Instant> {
        self.newest.as_ref().and(self.not_before)
    }

    fn take(&mut self, now: Instant) -> Option<String> {
        if self.due().is_some_and(|at| now < at) {
            return None;
        }
        let newest = self.newest.take()?;
        self.not_before = Some(now + PERIOD);
        Some(newest.words(mem::take(&mut self.count)))
    }
}

impl Notice {
    fn words(&self, count: u64) -> String {
        match (self, count) {
            (Self::Closed { closed: Closed { client, has_requested }, for_client }, 1) => {
                let why = if *has_requested { "silent longest" } else { "without a request so far" };
                format!(
                    "{CONNECTIONS_MAX} Modbus clients are connected: {client}, {why}, was closed for {for_client}"
                )
            }
            (Self::Closed { for_client, .. }, _) => format!(
                "{CONNECTIONS_MAX} Modbus clients are connected: {count} of them were closed for others, the last \
                 one for {for_client}"
            ),
            (Self::NotAccepted(error), 1) => format!("no Modbus client can be accepted: {error}"),
            (Self::NotAccepted(error), _) => {
                format!("no Modbus client can be accepted, tried {count} times: {error}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(port: u16) -> Notice {
        let closed = Closed { client: ([127, 0, 0, 1], port).into(), has_requested: port == 1 };
        Notice::Closed { closed, for_client: ([127, 0, 0, 1], 9).into() }
    }

    #[test]
    fn the_first_is_reported_at_once_and_further_ones_once_a_second_with_their_count() {
        let start = Instant::now();
        let mut kind = Kind::default();
        assert_eq!((kind.due(), kind.take(start)), (None, None));
        let mut happens = |after_ms: u64, notice: Option<Notice>| {
            if let Some(notice) = notice {
                kind.newest = Some(notice);
                kind.count += 1;
            }
            kind.take(start + Duration::from_millis(after_ms))
        };
        let first = happens(0, Some(closed(1))).unwrap();
        assert!(first.contains("127.0.0.1:1, silent longest, was closed for 127.0.0.1:9"), "{first}");
        for after_ms in [1, 500, 999] {
            assert_eq!(happens(after_ms, Some(closed(2))), None);
        }
        let next = happens(1000, None).unwrap();
        assert!(next.contains("3 of them were closed for others"), "{next}");
        assert_eq!(happens(3000, None), None, "nothing has happened");
        assert!(
            happens(3001, Some(closed(3)))
                .is_some_and(|line| line.contains("127.0.0.1:3, without a request"))
        );
    }
}
