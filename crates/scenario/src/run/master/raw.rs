//! What the master reads without any service, right or wrong: registers, whole mailbox messages, whole frames.

use time::Instant;

use crate::model::hex;

/// A kind of reads, of which the last one has its answer here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Register,
    Mailbox,
    Frame,
}

impl Kind {
    /// The words for a trace, and those before an answer.
    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Register => ("the last register read", "gave"),
            Self::Mailbox => ("the last mailbox message", "was answered with"),
            Self::Frame => ("the last frame", "came back as"),
        }
    }
}

/// A read that a step has ordered: its kind, and its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RawNumber {
    kind: Kind,
    number: u64,
}

/// The answer to the last read of a kind.
#[derive(Debug, Default)]
pub(crate) enum LastAnswer {
    /// None was ordered.
    #[default]
    None,
    /// It has no answer yet.
    Awaited(RawNumber),
    /// Its answer.
    Received(Vec<u8>),
    /// The master has given it up.
    Missing,
}

impl LastAnswer {
    /// The answer; none before it is received.
    pub(crate) const fn bytes(&self) -> Option<&Vec<u8>> {
        match self {
            Self::Received(bytes) => Some(bytes),
            Self::None | Self::Awaited(_) | Self::Missing => None,
        }
    }

    pub(crate) const fn is_missing(&self) -> bool {
        matches!(self, Self::Missing)
    }

    pub(crate) fn words(&self, kind: Kind) -> String {
        let (what, gave) = kind.words();
        match self {
            Self::None => format!("{what}: none was ordered"),
            Self::Awaited(_) => format!("{what} is not answered yet"),
            Self::Received(bytes) => format!("{what} {gave} {}", hex(bytes)),
            Self::Missing => format!("{what} has no answer"),
        }
    }
}

/// The reads of a master.
#[derive(Debug, Default)]
pub(crate) struct Raw {
    ordered: u64,
    register: LastAnswer,
    mailbox: LastAnswer,
    frame: LastAnswer,
    /// Frames that are sent now.
    unsent: Vec<(RawNumber, Vec<u8>)>,
    /// The frames in flight, with the time at which each is lost.
    in_flight: Vec<(RawNumber, Instant)>,
}

impl Raw {
    /// A step orders a read. From now on the answers to older ones of its kind are ignored.
    pub(super) fn order(&mut self, kind: Kind) -> RawNumber {
        self.ordered += 1;
        let number = RawNumber { kind, number: self.ordered };
        *self.last_mut(kind) = LastAnswer::Awaited(number);
        number
    }

    /// A read is answered. Returns the words for the trace.
    pub(super) fn answer(&mut self, number: RawNumber, bytes: Vec<u8>) -> String {
        let answer = LastAnswer::Received(bytes);
        let words = answer.words(number.kind);
        self.settle(number, answer);
        words
    }

    /// A read is given up.
    pub(super) fn give_up(&mut self, number: RawNumber) {
        self.settle(number, LastAnswer::Missing);
    }

    fn settle(&mut self, number: RawNumber, answer: LastAnswer) {
        let last = self.last_mut(number.kind);
        if matches!(last, LastAnswer::Awaited(awaited) if *awaited == number) {
            *last = answer;
        }
    }

    const fn last_mut(&mut self, kind: Kind) -> &mut LastAnswer {
        match kind {
            Kind::Register => &mut self.register,
            Kind::Mailbox => &mut self.mailbox,
            Kind::Frame => &mut self.frame,
        }
    }

    pub(crate) const fn register(&self) -> &LastAnswer {
        &self.register
    }

    pub(crate) const fn mailbox(&self) -> &LastAnswer {
        &self.mailbox
    }

    pub(crate) const fn frame(&self) -> &LastAnswer {
        &self.frame
    }
}

/// Whole frames.
impl Raw {
    pub(super) fn order_frame(&mut self, frame: Vec<u8>) {
        let number = self.order(Kind::Frame);
        self.unsent.push((number, frame));
    }

    /// The time of its next frame or time-out.
    pub(super) fn deadline(&self) -> Instant {
        if self.unsent.is_empty() {
            self.in_flight.iter().map(|(_, until)| *until).min().unwrap_or(Instant::NEVER)
        } else {
            Instant::ZERO
        }
    }

    /// Whether it waits for no frame.
    pub(super) const fn is_idle(&self) -> bool {
        self.unsent.is_empty() && self.in_flight.is_empty()
    }

    /// The frames that are sent now, and are lost at `due`. Frames that should have come back by now are lost; `story` gets
    /// the words for the trace.
    pub(super) fn send(
        &mut self,
        now: Instant,
        due: Instant,
        story: &mut Vec<String>,
    ) -> Vec<(RawNumber, Vec<u8>)> {
        let lost: Vec<RawNumber> =
            self.in_flight.extract_if(.., |(_, until)| *until <= now).map(|(number, _)| number).collect();
        for number in lost {
            self.give_up(number);
            story.push("the last frame did not come back".to_owned());
        }
        let unsent = core::mem::take(&mut self.unsent);
        self.in_flight.extend(unsent.iter().map(|(number, _)| (*number, due)));
        unsent
    }

    /// Processes a returned frame; returns the words for the trace, none if it is no longer awaited.
    pub(super) fn receive(&mut self, number: RawNumber, frame: Vec<u8>) -> Option<String> {
        let place = self.in_flight.iter().position(|(awaited, _)| *awaited == number)?;
        self.in_flight.remove(place);
        Some(self.answer(number, frame))
    }

    /// The reads of a master that restarts: it has ordered none, and the answers to older ones are not its own.
    pub(super) fn restarted(&self) -> Self {
        Self { ordered: self.ordered, ..Self::default() }
    }
}
