//! The lines of a file that may be larger than the memory.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::{MIB, Reason, Unreadable, Wanted, open_regular};

/// Longest line, with its end.
const LINE_BYTES_MAX: u64 = MIB;
/// Number of bytes in which the kind of a file is detected.
const HEAD_BYTES: usize = 64 << 10;
/// The mark before a text that some editors write.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads a file line by line.
#[derive(Debug)]
pub struct Lines {
    reader: BufReader<File>,
    wanted: Wanted,
    line: Vec<u8>,
    number: usize,
    /// Where the next line begins, in bytes.
    next: u64,
}

/// A line of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line<'l> {
    /// Its number, from 1.
    pub number: usize,
    /// Where it begins, in bytes.
    pub start: u64,
    /// Its bytes without its end.
    pub bytes: &'l [u8],
}

impl Lines {
    /// Opens a file of any size.
    ///
    /// # Errors
    /// It is not a regular file, cannot be read, or is of another kind than required, or its start is not UTF-8.
    pub fn open(path: &Path, wanted: Wanted) -> Result<Self, Unreadable> {
        let refused = |reason| Unreadable { reason, wanted };
        let file = open_regular(path, u64::MAX).map_err(refused)?;
        let mut reader = BufReader::with_capacity(HEAD_BYTES, file);
        let head = whole_lines(reader.fill_buf().map_err(Reason::Io).map_err(refused)?);
        let checked = user_file::text(head.to_vec(), &path.to_string_lossy(), wanted);
        checked.map_err(Reason::OfAnotherKind).map_err(refused)?;
        let mut next = 0;
        if reader.buffer().starts_with(BYTE_ORDER_MARK) {
            reader.consume(BYTE_ORDER_MARK.len());
            next = BYTE_ORDER_MARK.len() as u64;
        }
        Ok(Self { reader, wanted, line: Vec::new(), number: 0, next })
    }

    /// The next line; none behind the last.
    ///
    /// # Errors
    /// The file cannot be read, or the line is too long.
    pub fn next_line(&mut self) -> Result<Option<Line<'_>>, Unreadable> {
        let wanted = self.wanted;
        let refused = |reason| Unreadable { reason, wanted };
        self.line.clear();
        self.number += 1;
        let mut bounded = self.reader.by_ref().take(LINE_BYTES_MAX + 1);
        bounded.read_until(b'\n', &mut self.line).map_err(Reason::Io).map_err(refused)?;
        match self.line.len() as u64 {
            0 => Ok(None),
            length if length > LINE_BYTES_MAX => Err(refused(Reason::LineTooLong { number: self.number })),
            length => {
                let start = self.next;
                self.next += length;
                Ok(Some(Line { number: self.number, start, bytes: self.line.trim_ascii_end() }))
            }
        }
    }
}

/// The bytes up to the last end of a line, where no character is cut; all of them if there is none.
fn whole_lines(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().rposition(|byte| *byte == b'\n').map_or(bytes.len(), |end| end + 1);
    let lines = bytes.get(..end).unwrap_or(bytes);
    match core::str::from_utf8(lines) {
        // Cut within a character, which is not an error.
        Err(error) if error.error_len().is_none() => lines.get(..error.valid_up_to()).unwrap_or(lines),
        _ => lines,
    }
}
