//! The differences of the answers of a replayed capture: every difference has a kind, and each kind is counted.

use wire::{Command, Returned};

use super::areas::{self, Mailboxes};
use crate::model::hex;

/// Number of differences that are described one by one.
const DESCRIBED: usize = 3;

/// What differs from the capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// Other units, or other SyncManagers and FMMUs of them, have processed the datagram.
    WorkingCounter,
    /// The data of the datagram.
    Data,
    /// The answer has other datagrams.
    Datagrams,
    /// The captured answer does not return.
    MissingAnswer,
}

/// Differences of one kind: the same aspect of the same command at the same place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DifferenceKind {
    /// What differs.
    pub aspect: Aspect,
    /// The command of the datagram; none if it concerns a whole frame.
    pub command: Option<Command>,
    /// The target of the datagram, such as `mailbox to the master`; none if it concerns a whole frame.
    pub place: Option<&'static str>,
    /// Their number.
    pub count: u64,
    /// The first of them.
    pub first: String,
}

impl Aspect {
    /// The name in files of results.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::WorkingCounter => "working_counter",
            Self::Data => "data",
            Self::Datagrams => "datagrams",
            Self::MissingAnswer => "missing_answer",
        }
    }
}

impl DifferenceKind {
    /// The command by its mnemonic, such as `FPRD`.
    #[must_use]
    pub fn mnemonic(&self) -> Option<String> {
        self.command.map(|command| format!("{command:?}").to_uppercase())
    }
}

/// All differences so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Differences {
    mailboxes: Mailboxes,
    kinds: Vec<DifferenceKind>,
    described: Vec<String>,
}

impl Differences {
    /// None yet, of units with these mailboxes.
    pub(super) fn none(mailboxes: Mailboxes) -> Self {
        Self { mailboxes, ..Self::default() }
    }

    pub(super) fn count(&self) -> u64 {
        self.kinds.iter().map(|kind| kind.count).sum()
    }

    /// The first ones, as text.
    pub(super) fn described(&self) -> &[String] {
        &self.described
    }

    /// The most frequent kind first.
    pub(super) fn kinds(&self) -> Vec<DifferenceKind> {
        let mut kinds = self.kinds.clone();
        kinds.sort_by_key(|kind| core::cmp::Reverse(kind.count));
        kinds
    }

    /// Compares the datagrams of an answer, the one to frame `number`, with the captured ones.
    pub(super) fn compare(&mut self, number: usize, seen: &[Returned], captured: &[Returned]) {
        let frame = format!("frame {}", number + 1);
        let commands = |datagrams: &[Returned]| -> Vec<Command> {
            datagrams.iter().map(|datagram| datagram.header.command).collect()
        };
        if commands(seen) != commands(captured) {
            let (now, then) = (seen.len(), captured.len());
            let words = format!("{frame}: {now} datagrams, captured {then}, or other commands");
            self.add(Aspect::Datagrams, None, words);
            return;
        }
        for (place, (seen, captured)) in seen.iter().zip(captured).enumerate() {
            if let Some((aspect, words)) = difference(seen, captured) {
                self.add(aspect, Some(captured), format!("{frame}, datagram {}: {words}", place + 1));
            }
        }
    }

    /// These frames were answered in the capture, and are not answered now.
    pub(super) fn with_missing(mut self, numbers: impl Iterator<Item = usize>) -> Self {
        for number in numbers {
            self.add(Aspect::MissingAnswer, None, format!("frame {}: no answer comes back", number + 1));
        }
        self
    }

    /// What a datagram asks for.
    fn place(&self, datagram: &Returned) -> &'static str {
        if is_logical(datagram) { "process data" } else { self.mailboxes.name(datagram.header.offset) }
    }

    fn add(&mut self, aspect: Aspect, datagram: Option<&Returned>, words: String) {
        if self.described.len() < DESCRIBED {
            self.described.push(words.clone());
        }
        let command = datagram.map(|datagram| datagram.header.command);
        let place = datagram.map(|datagram| self.place(datagram));
        let same =
            |kind: &&mut DifferenceKind| (kind.aspect, kind.command, kind.place) == (aspect, command, place);
        match self.kinds.iter_mut().find(same) {
            Some(kind) => kind.count += 1,
            None => self.kinds.push(DifferenceKind { aspect, command, place, count: 1, first: words }),
        }
    }
}

fn is_logical(datagram: &Returned) -> bool {
    matches!(datagram.header.command, Command::Lrd | Command::Lwr | Command::Lrw)
}

/// The difference; none if there is none. If other units have processed a datagram, its data differ too.
fn difference(seen: &Returned, captured: &Returned) -> Option<(Aspect, String)> {
    let header = &captured.header;
    let name = format!("{:?} of {:#06X}", header.command, header.offset);
    if seen.working_counter != captured.working_counter {
        let (now, then) = (seen.working_counter, captured.working_counter);
        return Some((Aspect::WorkingCounter, format!("{name}: working counter {now}, captured {then}")));
    }
    // Process data depend on the phase of the CPU Unit.
    let is_compared = !is_logical(captured) && areas::are_compared(header.offset, header.length_bytes);
    if !is_compared || seen.data == captured.data {
        return None;
    }
    let place = seen.data.iter().zip(&captured.data).position(|(now, then)| now != then).unwrap_or(0);
    let part = |data: &[u8]| hex(data.get(place..data.len().min(place + 8)).unwrap_or_default());
    let words =
        format!("{name}: from byte {place} on {}, captured {}", part(&seen.data), part(&captured.data));
    Some((Aspect::Data, words))
}

#[cfg(test)]
mod tests {
    use wire::{FrameBuilder, returned_datagrams};

    use super::*;

    const DL_STATUS: u16 = 0x0110;
    const AL_CONTROL: u16 = 0x0120;

    fn read(offset: u16, data: u8) -> Vec<Returned> {
        returned_datagrams(&FrameBuilder::new().physical(Command::Fprd, 1, offset, &[data]).finish())
    }

    fn process_data(data: u8, working_counter: u16) -> Vec<Returned> {
        let frame = FrameBuilder::new().logical(Command::Lrw, 0x0001_0000, &[data]).finish();
        returned_datagrams(&frame).into_iter().map(|seen| Returned { working_counter, ..seen }).collect()
    }

    #[test]
    fn a_kind_is_an_aspect_of_a_command_at_a_place() {
        let mut differences = Differences::default();
        let nothing = Vec::new();
        for (seen, captured) in [
            (read(DL_STATUS, 1), read(DL_STATUS, 2)),
            (read(AL_CONTROL, 1), read(AL_CONTROL, 2)),
            (read(AL_CONTROL, 3), read(AL_CONTROL, 2)),
            (read(AL_CONTROL, 2), read(AL_CONTROL, 2)),
            (nothing, read(AL_CONTROL, 2)),
            (process_data(1, 3), process_data(1, 0)),
            // Process data depend on the phase of the CPU Unit.
            (process_data(1, 3), process_data(2, 3)),
        ] {
            differences.compare(0, &seen, &captured);
        }
        let kinds = differences.kinds();
        let kinds = kinds.iter().map(|kind| (kind.count, kind.aspect, kind.mnemonic(), kind.place));
        let fprd = || Some("FPRD".to_owned());
        let expected = [
            (2, Aspect::Data, fprd(), Some("AL control")),
            (1, Aspect::Data, fprd(), Some("DL status")),
            (1, Aspect::Datagrams, None, None),
            (1, Aspect::WorkingCounter, Some("LRW".to_owned()), Some("process data")),
        ];
        assert_eq!(kinds.collect::<Vec<_>>(), expected);
    }
}
