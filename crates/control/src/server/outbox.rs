//! What a client is to receive: answers always, records only as long as there is room.

use std::collections::VecDeque;
use std::io::{self, IoSlice, Write};
use std::sync::Arc;

use crate::messages::Incoming;

/// Bytes that wait for a client; further records are lost, and it is asked for no further request.
pub(super) const WAITING_BYTES_MAX: usize = 256 * 1024;
/// Lines that are written by one system call.
const LINES_AT_ONCE: usize = 64;

/// The lines that wait for a client.
#[derive(Debug, Default)]
pub(super) struct Outbox {
    lines: VecDeque<Arc<str>>,
    /// Bytes of the first line that have been written.
    written: usize,
    waiting_bytes: usize,
    /// Records that had no room since the last one that had.
    lost: u64,
}

impl Outbox {
    /// Adds an answer.
    pub(super) fn answer(&mut self, line: Arc<str>) {
        self.waiting_bytes += line.len();
        self.lines.push_back(line);
    }

    /// Adds a record, or counts it as lost.
    pub(super) fn record(&mut self, line: Arc<str>) {
        if self.is_full() {
            self.lost += 1;
            return;
        }
        self.tell_lost();
        self.answer(line);
    }

    /// So many records are missing here.
    pub(super) const fn lose(&mut self, count: u64) {
        self.lost += count;
    }

    pub(super) const fn is_full(&self) -> bool {
        self.waiting_bytes >= WAITING_BYTES_MAX
    }

    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Forgets everything: the client is gone.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Writes as much as the client takes now.
    pub(super) fn write_to(&mut self, stream: &mut impl Write) -> io::Result<()> {
        loop {
            if self.lines.is_empty() {
                self.tell_lost();
            }
            let mut slices = [IoSlice::new(&[]); LINES_AT_ONCE];
            let mut skipped = self.written;
            for (slice, line) in slices.iter_mut().zip(&self.lines) {
                *slice =
                    IoSlice::new(line.as_bytes().get(std::mem::take(&mut skipped)..).unwrap_or_default());
            }
            let count = self.lines.len().min(LINES_AT_ONCE);
            if count == 0 {
                return Ok(());
            }
            match stream.write_vectored(slices.get(..count).unwrap_or_default()) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(length_bytes) => self.have_been_written(length_bytes),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => return Ok(()),
                Err(error) => return Err(error),
            }
        }
    }

    fn have_been_written(&mut self, length_bytes: usize) {
        self.waiting_bytes -= length_bytes;
        self.written += length_bytes;
        while let Some(first) = self.lines.front().filter(|first| first.len() <= self.written) {
            self.written -= first.len();
            self.lines.pop_front();
        }
    }

    fn tell_lost(&mut self) {
        let lost = std::mem::take(&mut self.lost);
        if lost > 0 {
            self.answer(Incoming::lost_line(lost).into());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A client that takes at most this number of bytes.
    struct Slow {
        taken: Vec<u8>,
        room: usize,
    }

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let length_bytes = bytes.len().min(self.room).min(7);
            if length_bytes == 0 {
                return Err(io::ErrorKind::WouldBlock.into());
            }
            self.taken.extend(&bytes[..length_bytes]);
            self.room -= length_bytes;
            Ok(length_bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_slow_client_gets_what_was_kept_then_the_number_of_the_lost_records_and_then_the_rest() {
        let mut outbox = Outbox::default();
        let record: Arc<str> = format!("{}\n", "x".repeat(1023)).into();
        (0..300).for_each(|_| outbox.record(Arc::clone(&record)));
        outbox.answer("an answer\n".into());
        let mut client = Slow { taken: Vec::new(), room: 10_000 };
        outbox.write_to(&mut client).unwrap();
        outbox.record("later\n".into());
        client.room = usize::MAX;
        outbox.write_to(&mut client).unwrap();
        assert!(outbox.is_empty());

        let taken = String::from_utf8(client.taken).unwrap();
        let lines: Vec<&str> = taken.lines().collect();
        assert_eq!(lines[..256], [&record[..1023]; 256]);
        assert_eq!(lines[256..], ["an answer", "{\"lost\":44}", "later"]);
    }

    #[test]
    fn lost_records_are_told_without_a_further_record() {
        let mut outbox = Outbox::default();
        outbox.lose(3);
        let mut client = Slow { taken: Vec::new(), room: usize::MAX };
        outbox.write_to(&mut client).unwrap();
        assert_eq!(client.taken, b"{\"lost\":3}\n");
    }
}
