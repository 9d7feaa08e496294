//! Notices to the user about clients without a place: immediately, then once a second with a count.

use std::future::pending;
use std::mem;
use std::net::SocketAddr;
use std::time::Duration;

use tokio::time::{Instant, sleep_until};

use super::clients::{CONNECTIONS_MAX, Closed};

/// Time between two log lines of the same kind.
const PERIOD: Duration = Duration::from_secs(1);

/// An event to report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Notice {
    /// A client was closed in favour of another one.
    Closed { closed: Closed, for_client: SocketAddr },
    /// A client was closed, because there was no file descriptor for the next one.
    NoDescriptor(Closed),
    /// No client could be accepted.
    NotAccepted(String),
}

const KINDS: usize = 3;

/// What is to be reported, of each kind.
#[derive(Debug, Default)]
pub(super) struct Notices {
    kinds: [Kind; KINDS],
}

#[derive(Debug, Default)]
struct Kind {
    newest: Option<Notice>,
    count: u64,
    /// Nothing is reported before this time; none: nothing was reported yet.
    not_before: Option<Instant>,
}

impl Notices {
    /// Reports it now, or together with those that occur within the second.
    pub(super) fn add(&mut self, notice: Notice) {
        let kind = &mut self.kinds[notice.kind()];
        kind.newest = Some(notice);
        kind.count += 1;
        self.report();
    }

    /// Waits until there is a notice to report; without end if there is none.
    pub(super) async fn due(&self) {
        match self.kinds.iter().filter_map(Kind::due).min() {
            Some(at) => sleep_until(at).await,
            None => pending().await,
        }
    }

    /// Reports the pending notices.
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
    const fn kind(&self) -> usize {
        match self {
            Self::Closed { .. } => 0,
            Self::NoDescriptor(_) => 1,
            Self::NotAccepted(_) => 2,
        }
    }

    fn words(&self, count: u64) -> String {
        match (self, count) {
            (Self::Closed { closed, for_client }, 1) => {
                format!(
                    "{CONNECTIONS_MAX} Modbus clients are connected: {closed} was closed for {for_client}"
                )
            }
            (Self::Closed { for_client, .. }, _) => format!(
                "{CONNECTIONS_MAX} Modbus clients are connected: {count} of them were closed for others, the last \
                 one for {for_client}"
            ),
            (Self::NoDescriptor(closed), 1) => {
                format!("{NO_DESCRIPTOR}: {closed} was closed; {MORE_DESCRIPTORS}")
            }
            (Self::NoDescriptor(_), _) => {
                format!("{NO_DESCRIPTOR}: {count} clients were closed for others; {MORE_DESCRIPTORS}")
            }
            (Self::NotAccepted(error), 1) => format!("no Modbus client can be accepted: {error}"),
            (Self::NotAccepted(error), _) => {
                format!("no Modbus client can be accepted, tried {count} times: {error}")
            }
        }
    }
}

const NO_DESCRIPTOR: &str = "too few open files for the next Modbus client";
const MORE_DESCRIPTORS: &str = "allow this process more, such as `ulimit -n 1024`";

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

    #[test]
    fn each_kind_is_counted_by_itself() {
        let Notice::Closed { closed: lost, .. } = closed(2) else { return };
        let mut notices = Notices::default();
        for notice in [closed(1), Notice::NoDescriptor(lost), Notice::NotAccepted("refused".to_owned())] {
            for _ in 0..3 {
                notices.add(notice.clone());
            }
        }
        let waiting = notices.kinds.map(|kind| kind.newest.map(|newest| newest.words(kind.count)));
        let [Some(full), Some(descriptors), Some(refused)] = waiting else { panic!("{waiting:?}") };
        assert!(full.contains("2 of them were closed"), "{full}");
        assert!(
            descriptors.contains("2 clients were closed for others; allow this process more"),
            "{descriptors}"
        );
        assert!(refused.contains("tried 2 times: refused"), "{refused}");
    }
}
