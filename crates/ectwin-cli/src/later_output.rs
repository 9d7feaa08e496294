//! An output that is a file or stdout, and is written in pieces.

use std::io::{self, Write};
use std::path::Path;

use link::Medium;

use crate::failure::Failure;
use crate::output::{self, is_stdout};
use crate::output_file::{BegunFile, OutputFile, ReplacedFile};

/// The output of a command that can be stdout too.
pub(crate) enum LaterOutput {
    Stdout,
    File(OutputFile),
}

impl LaterOutput {
    /// Opens the file, or makes it.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        if is_stdout(path) { Ok(Self::stdout()) } else { OutputFile::open(path).map(Self::File) }
    }

    fn stdout() -> Self {
        output::warn_of_closed_stdout();
        Self::Stdout
    }

    /// Checks that the file can be written. Until it is written as a whole, it is not there, or keeps its old contents.
    pub(crate) fn open_whole(path: &Path) -> Result<Self, Failure> {
        if is_stdout(path) { Ok(Self::stdout()) } else { Ok(Self::File(OutputFile::open(path)?.unmade())) }
    }

    /// The new contents follow, and take the place of the old ones when they are complete.
    pub(crate) fn begin_whole(self) -> io::Result<WholeOut> {
        match self {
            Self::Stdout => Ok(WholeOut::Stdout),
            Self::File(file) => file.begin_whole().map(WholeOut::File),
        }
    }

    /// The new contents follow.
    pub(crate) fn begin(self) -> ResultOut {
        match self {
            Self::Stdout => ResultOut::Stdout,
            Self::File(file) => ResultOut::File(file.begin()),
        }
    }
}

/// The target of a result that is written in pieces.
pub(crate) enum Out<F> {
    Stdout,
    File(F),
}

/// A file is written from its beginning on.
pub(crate) type ResultOut = Out<BegunFile>;

/// A file is there as a whole or not at all.
pub(crate) type WholeOut = Out<ReplacedFile>;

impl ResultOut {
    /// Cuts off everything after the first `length_bytes`, if that is possible.
    pub(crate) fn cut(&mut self, length_bytes: u64) -> io::Result<()> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(file) => file.cut(length_bytes),
        }
    }

    /// The result is complete, even if it is empty.
    pub(crate) fn complete(&mut self) -> io::Result<()> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(file) => file.complete(),
        }
    }
}

impl WholeOut {
    /// The result is complete.
    pub(crate) fn complete(self) -> io::Result<()> {
        match self {
            Self::Stdout => Ok(()),
            Self::File(file) => file.complete(),
        }
    }
}

impl<F: Write> Write for Out<F> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Stdout => unless_closed(io::stdout().write(bytes), bytes.len()),
            Self::File(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Stdout => unless_closed(io::stdout().flush(), ()),
            Self::File(file) => file.flush(),
        }
    }
}

/// If the reader closes the pipe, that is not an error.
fn unless_closed<T>(result: io::Result<T>, closed: T) -> io::Result<T> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(closed),
        result => result,
    }
}
