//! Each frame in one line of the log, with `-vvv`: the frame thread only copies the headers.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};

use link::{Observer, Seen};
use time::Instant;
use wire::{Command, DatagramHeader, datagrams};

/// Datagrams that are named; of the others only their number.
const NAMED: usize = 3;
/// Frames that wait for the log.
const FRAMES_MAX: usize = 4_096;

/// A frame in small.
#[derive(Clone, Copy)]
pub(crate) struct FrameNote {
    pub(crate) at: Instant,
    /// The number of its request among all packets, from 1, as in a capture of them.
    pub(crate) number: u64,
    length_bytes: usize,
    named: [Option<(DatagramHeader, u16)>; NAMED],
    /// Number of its datagrams.
    datagrams: usize,
    fate: Fate,
    lost_before: u64,
}

#[derive(Clone, Copy)]
enum Fate {
    Returned,
    DidNotReturn,
    LateAnswer,
}

/// The frame thread's end.
pub(crate) struct FrameLog {
    notes: SyncSender<FrameNote>,
    /// Number of packets so far: requests and answers.
    packets: u64,
    /// Those that had no room since the last one that had.
    lost: u64,
    all_lost: Arc<AtomicU64>,
}

/// The log's end.
pub(crate) struct FrameLines {
    notes: Receiver<FrameNote>,
    all_lost: Arc<AtomicU64>,
    /// Those of the lost ones that have been logged.
    logged_lost: u64,
}

/// Both ends.
pub(crate) fn frame_log() -> (FrameLog, FrameLines) {
    let (sender, notes) = sync_channel(FRAMES_MAX);
    let all_lost = Arc::new(AtomicU64::new(0));
    let log = FrameLog { notes: sender, packets: 0, lost: 0, all_lost: Arc::clone(&all_lost) };
    (log, FrameLines { notes, all_lost, logged_lost: 0 })
}

impl FrameLog {
    fn note(&mut self, at: Instant, frame: &[u8], fate: Fate) {
        let mut named = [None; NAMED];
        let mut count = 0;
        for datagram in datagrams(frame) {
            if let Some(place) = named.get_mut(count) {
                *place = Some((datagram.header, datagram.working_counter));
            }
            count += 1;
        }
        let number = self.packets + 1;
        self.packets += if matches!(fate, Fate::Returned) { 2 } else { 1 };
        let note = FrameNote {
            at,
            number,
            length_bytes: frame.len(),
            named,
            datagrams: count,
            fate,
            lost_before: self.lost,
        };
        match self.notes.try_send(note) {
            Ok(()) => self.lost = 0,
            Err(_) => {
                self.lost += 1;
                self.all_lost.fetch_add(1, Ordering::Relaxed);
            }
        }
    }
}

impl Observer for FrameLog {
    fn frame(&mut self, seen: Seen<'_>) {
        match seen.answer {
            Some(answer) => self.note(seen.received, answer, Fate::Returned),
            None => self.note(seen.received, seen.request, Fate::DidNotReturn),
        }
    }

    fn late_answer(&mut self, answered: Instant, answer: &[u8]) {
        self.note(answered, answer, Fate::LateAnswer);
    }
}

impl FrameNote {
    /// Whether it has only process data and the time of distributed clocks, as most frames of a cycle.
    pub(super) fn is_cyclic(&self) -> bool {
        let is_cyclic = |(header, _): &(DatagramHeader, u16)| {
            matches!(
                header.command,
                Command::Lrd | Command::Lwr | Command::Lrw | Command::Frmw | Command::Armw
            )
        };
        self.datagrams <= NAMED && self.named.iter().flatten().all(is_cyclic)
    }
}

impl FrameLines {
    /// Takes the frames that wait, and not those that come meanwhile, so that this ends on a fast link.
    pub(crate) fn take(&mut self) -> Vec<FrameNote> {
        self.notes.try_iter().take(FRAMES_MAX).collect()
    }

    /// Logs one of them.
    pub(crate) fn log(&mut self, note: &FrameNote) {
        self.log_lost(note.lost_before);
        tracing::trace!("{}", words(note));
    }

    /// Logs how many were lost after the last one.
    pub(crate) fn end(&mut self) {
        self.log_lost(self.all_lost.load(Ordering::Relaxed).saturating_sub(self.logged_lost));
    }

    fn log_lost(&mut self, count: u64) {
        self.logged_lost += count;
        if count > 0 {
            tracing::trace!("{count} frames are missing here: more came than could be logged");
        }
    }
}

/// A frame in one line.
pub(super) fn words(note: &FrameNote) -> String {
    let (seconds, micros) = (note.at.as_nanos() / 1_000_000_000, note.at.as_nanos() / 1_000 % 1_000_000);
    let mut parts: Vec<String> =
        note.named.iter().flatten().map(|(header, counter)| datagram(header, *counter)).collect();
    match note.datagrams.saturating_sub(parts.len()) {
        0 => {}
        more => parts.push(format!("and {more} more")),
    }
    let what = if parts.is_empty() { "no datagram".to_owned() } else { parts.join("; ") };
    let fate = match note.fate {
        Fate::Returned => "",
        Fate::DidNotReturn => " (did not return)",
        Fate::LateAnswer => " (late or second answer)",
    };
    format!("{seconds}.{micros:06} s frame of {} bytes: {what}{fate}", note.length_bytes)
}

fn datagram(header: &DatagramHeader, counter: u16) -> String {
    let name = format!("{:?}", header.command).to_uppercase();
    let place = match header.command {
        Command::Lrd | Command::Lwr | Command::Lrw => format!("0x{:08X}", header.logical_address()),
        Command::Nop
        | Command::Aprd
        | Command::Apwr
        | Command::Aprw
        | Command::Fprd
        | Command::Fpwr
        | Command::Fprw
        | Command::Brd
        | Command::Bwr
        | Command::Brw
        | Command::Armw
        | Command::Frmw
        | Command::Other(_) => format!("0x{:04X} 0x{:04X}", header.address, header.offset),
    };
    format!("{name} {place}, {} bytes, WKC {counter}", header.length_bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_look_takes_as_many_frames_as_wait_and_the_end_knows_of_the_lost_ones() {
        let (mut log, mut lines) = frame_log();
        for at in 0..FRAMES_MAX as u64 + 5 {
            log.note(Instant::from_nanos(at), &[0; 60], Fate::Returned);
        }
        let taken = lines.take();
        assert_eq!(taken.len(), FRAMES_MAX);
        taken.iter().for_each(|note| lines.log(note));
        assert_eq!(lines.logged_lost, 0);
        lines.end();
        assert_eq!(lines.logged_lost, 5);
    }
}
