//! Lines over a socket, each awaited for a limited time.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::net::UnixStream;
use std::time::{Duration, Instant};

use super::error::ClientError;
use crate::messages::Incoming;

/// A twin that does not take a request for this time is not there any more.
const SEND_WITHIN: Duration = Duration::from_secs(10);
/// The longest line: the status of several thousand units.
const LINE_BYTES_MAX: usize = 64 << 20;
/// The shortest time that a socket can wait for.
const SHORTEST: Duration = Duration::from_millis(1);

/// Both directions of a connected socket.
#[derive(Debug)]
pub(super) struct Connection {
    stream: UnixStream,
    reader: BufReader<UnixStream>,
    /// The beginning of a line whose end has not come yet.
    line: Vec<u8>,
}

impl Connection {
    pub(super) fn over(stream: UnixStream) -> io::Result<Self> {
        stream.set_write_timeout(Some(SEND_WITHIN))?;
        let reader = BufReader::new(stream.try_clone()?);
        Ok(Self { stream, reader, line: Vec::new() })
    }

    /// Sends a line.
    pub(super) fn send(&mut self, line: &str) -> Result<(), ClientError> {
        match self.stream.write_all(line.as_bytes()) {
            // What the twin said before it closed the connection is still to be read.
            Err(error) if is_closed(&error) => Ok(()),
            Err(error) if is_late(&error) => Err(ClientError::Silent { waited: SEND_WITHIN }),
            written => written.map_err(ClientError::System),
        }
    }

    /// Waits for the next line until this time; none: it is over.
    pub(super) fn next(&mut self, until: Option<Instant>) -> Result<Option<Incoming>, ClientError> {
        loop {
            let left = until.map(|until| until.saturating_duration_since(Instant::now()));
            let time = left.map(|left| left.max(SHORTEST));
            self.stream.set_read_timeout(time).map_err(ClientError::System)?;
            match self.read_line() {
                Ok(true) => break,
                Ok(false) => return Err(ClientError::Ended),
                Err(error) if is_closed(&error) => return Err(ClientError::Ended),
                Err(error) if !is_late(&error) => return Err(ClientError::System(error)),
                Err(_) if left.is_some_and(|left| left.is_zero()) => return Ok(None),
                Err(_) => {}
            }
        }
        let line = std::mem::take(&mut self.line);
        let read = std::str::from_utf8(&line).ok().and_then(|line| Incoming::read(line).ok());
        read.map(Some).ok_or_else(|| ClientError::no_twin(&line))
    }

    /// Reads the rest of the line; false: there is none any more.
    fn read_line(&mut self) -> io::Result<bool> {
        let room = LINE_BYTES_MAX.saturating_sub(self.line.len());
        self.reader.by_ref().take(room as u64).read_until(b'\n', &mut self.line)?;
        Ok(self.line.ends_with(b"\n") || self.line.len() >= LINE_BYTES_MAX)
    }
}

fn is_late(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::TimedOut)
}

fn is_closed(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::BrokenPipe | io::ErrorKind::ConnectionReset)
}
