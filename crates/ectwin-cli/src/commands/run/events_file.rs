//! The file of `--events`: JSON lines. A medium that refuses them is tried again, and the twin continues.

use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use ectwin::Instant as Time;
use ectwin::happenings::{Record, lost_records};

use crate::later_output::{LaterOutput, ResultOut};

/// Bytes that wait at most while the medium refuses them. Further records are lost.
const WAITING_BYTES_MAX: usize = 1 << 20;
/// Time between two tries.
const RETRY: Duration = Duration::from_millis(200);

/// The file, and what it has not accepted yet.
pub(crate) struct EventsFile {
    name: String,
    out: ResultOut,
    /// Whole lines, except for the beginning of the first one, which may have been written.
    waiting: Vec<u8>,
    /// Number of bytes of `waiting` that have been written.
    taken: usize,
    /// Bytes that were written before `waiting`.
    before: u64,
    refused_at: Option<Instant>,
    /// Records that had no room since the last one that had.
    lost: u64,
    /// The time of the newest record, also of a lost one.
    newest: Time,
}

impl EventsFile {
    /// The file of this path, or stdout. Its contents are replaced with the first record.
    pub(crate) fn begin(path: &Path, out: LaterOutput) -> Self {
        let name = path.display().to_string();
        let out = out.begin();
        Self {
            name,
            out,
            waiting: Vec::new(),
            taken: 0,
            before: 0,
            refused_at: None,
            lost: 0,
            newest: Time::ZERO,
        }
    }

    /// Adds a record.
    pub(crate) fn add(&mut self, record: &Record) {
        self.newest = self.newest.max(record.at);
        if self.waiting.len() > WAITING_BYTES_MAX {
            self.lost += 1;
            return;
        }
        self.add_lost(record.at);
        self.waiting.extend_from_slice(format!("{}\n", record.json()).as_bytes());
    }

    /// Adds the number of lost records, if there are any.
    fn add_lost(&mut self, at: Time) {
        let lost = std::mem::take(&mut self.lost);
        if lost > 0 {
            self.waiting.extend_from_slice(format!("{}\n", lost_records(at, lost).json()).as_bytes());
        }
    }

    /// Writes what waits, unless it was refused a moment ago.
    pub(crate) fn write(&mut self) {
        if self.refused_at.is_none_or(|at| at.elapsed() >= RETRY) {
            // It has been reported, and is tried again.
            let _refused = self.try_again();
        }
    }

    /// Tries to write everything. The first refusal is reported, and the end of the refusals.
    fn try_again(&mut self) -> io::Result<()> {
        let written = self.try_write();
        match (&written, self.refused_at) {
            (Ok(()), None) => {}
            (Ok(()), Some(_)) => {
                tracing::warn!("the events are written to {} again", self.name);
                self.refused_at = None;
            }
            (Err(error), known) => {
                if known.is_none() {
                    tracing::error!(
                        "the events cannot be written to {}: {error}; this is tried again, and the twin continues",
                        self.name
                    );
                }
                self.refused_at = Some(Instant::now());
            }
        }
        written
    }

    fn try_write(&mut self) -> io::Result<()> {
        while let Some(rest) = self.waiting.get(self.taken..).filter(|rest| !rest.is_empty()) {
            match self.out.write(rest) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(taken) => self.taken += taken,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        self.before += self.taken as u64;
        self.taken = 0;
        self.waiting.clear();
        self.out.flush()
    }

    /// The last try. If it fails, the file ends with the last whole line. A file that lacks the last records is an error too.
    pub(crate) fn end(mut self) -> io::Result<()> {
        let lost = self.lost;
        self.add_lost(self.newest);
        self.try_again().inspect_err(|_| {
            let written = self.waiting.get(..self.taken).unwrap_or_default();
            let whole = written.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
            // A pipe keeps a part of a line. The refusal is the more important error.
            let _kept = self.out.cut(self.before + whole as u64);
        })?;
        self.out.complete()?;
        match lost {
            0 => Ok(()),
            lost => Err(io::Error::other(format!(
                "the last {lost} records are missing: it refused what came before for too long"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn records_that_are_lost_at_the_end_are_counted_in_the_file_and_are_an_error() {
        let path = std::env::temp_dir().join(format!("ectwin-events-{}.jsonl", std::process::id()));
        let out = LaterOutput::open(&path).ok().unwrap();
        let mut file = EventsFile::begin(&path, out);
        let record = lost_records(Time::from_nanos(7), 1);
        while file.lost < 3 {
            file.add(&record);
        }
        let error = file.end().unwrap_err().to_string();
        let text = fs::read_to_string(&path).unwrap();
        fs::remove_file(&path).unwrap();
        assert!(error.starts_with("the last 3 records are missing"), "{error}");
        assert_eq!(text.lines().last().unwrap(), lost_records(Time::from_nanos(7), 3).json());
    }
}
