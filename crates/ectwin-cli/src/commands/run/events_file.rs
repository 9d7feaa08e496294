//! The file of `--events`: JSON lines. A medium that refuses them is tried again, and the twin goes on.

use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

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
}

impl EventsFile {
    /// The file of this path, or stdout. Its contents are replaced with the first record.
    pub(crate) fn begin(path: &Path, out: LaterOutput) -> Self {
        let name = path.display().to_string();
        let out = out.begin();
        Self { name, out, waiting: Vec::new(), taken: 0, before: 0, refused_at: None, lost: 0 }
    }

    /// Adds a record.
    pub(crate) fn add(&mut self, record: &Record) {
        if self.waiting.len() > WAITING_BYTES_MAX {
            self.lost += 1;
            return;
        }
        if self.lost > 0 {
            let lost = lost_records(record.at, std::mem::take(&mut self.lost));
            self.waiting.extend_from_slice(format!("{}\n", lost.json()).as_bytes());
        }
        self.waiting.extend_from_slice(format!("{}\n", record.json()).as_bytes());
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
                        "the events cannot be written to {}: {error}; this is tried again, and the twin goes on",
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

    /// The last try. If it fails, the file ends with the last whole line.
    pub(crate) fn end(mut self) -> io::Result<()> {
        self.try_again().inspect_err(|_| {
            let written = self.waiting.get(..self.taken).unwrap_or_default();
            let whole = written.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
            // A pipe keeps a part of a line. The refusal is the more important error.
            let _kept = self.out.cut(self.before + whole as u64);
        })?;
        self.out.complete()
    }
}
