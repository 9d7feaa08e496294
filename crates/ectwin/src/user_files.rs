//! Reading user files: regular files, up to a maximum size, of the required kind.

mod beside;
mod folders;
mod lines;

use std::collections::BTreeSet;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use st::Sources;
use storage::Identity;
use user_file::{Refusal, escaped};

pub use beside::Beside;
pub use folders::below;
pub use lines::{Line, Lines};
pub use user_file::Wanted;

const MIB: u64 = 1 << 20;
/// The name that means stdin, as `-` of an output means stdout.
const STDIN: &str = "-";
/// The ending of programs in Structured Text.
const STRUCTURED_TEXT: &str = "st";

/// The largest file of a kind.
const fn limit_bytes(wanted: Wanted) -> u64 {
    match wanted {
        Wanted::UnitFile | Wanted::Scenario | Wanted::Program => 4 * MIB,
        Wanted::SiiImage => 8 * MIB,
        Wanted::Esi | Wanted::Csv => 64 * MIB,
        Wanted::Capture | Wanted::Results | Wanted::Trace => 256 * MIB,
    }
}

/// Why a file cannot be read.
#[derive(Debug)]
pub struct Unreadable {
    reason: Reason,
    wanted: Wanted,
}

#[derive(Debug)]
enum Reason {
    Io(io::Error),
    /// The path means stdin.
    Stdin,
    /// Its kind, if it is not a regular file.
    NotRegular(&'static str),
    TooLarge,
    LineTooLong {
        number: usize,
    },
    OfAnotherKind(Refusal),
}

/// The bytes of a file.
///
/// # Errors
/// It is not a regular file, is too large, or cannot be read.
pub fn bytes(path: &Path, wanted: Wanted) -> Result<Vec<u8>, Unreadable> {
    read(path, limit_bytes(wanted)).map_err(|reason| Unreadable { reason, wanted })
}

/// The text of a file.
///
/// # Errors
/// As [`bytes`], or the file is of another kind than required, or not UTF-8.
pub fn text(path: &Path, wanted: Wanted) -> Result<String, Unreadable> {
    let text = user_file::text(bytes(path, wanted)?, &path.to_string_lossy(), wanted);
    text.map_err(|refusal| Unreadable { reason: Reason::OfAnotherKind(refusal), wanted })
}

/// The text of a file that is compared with another text: of any kind, and with its byte order mark.
///
/// # Errors
/// As [`bytes`], or the text is not UTF-8.
pub fn exact_text(path: &Path, wanted: Wanted) -> Result<String, Unreadable> {
    let text = user_file::exact_text(bytes(path, wanted)?, wanted);
    text.map_err(|refusal| Unreadable { reason: Reason::OfAnotherKind(refusal), wanted })
}

/// The files of a program: the given files, and of a folder all that end with .st, in the order of their paths.
/// A file that occurs twice, by any path, is one file, at its first position.
///
/// # Errors
/// The folder that cannot be read, or contains no such files, and why.
pub fn program_files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, (PathBuf, Unreadable)> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            let failed =
                |error| (path.clone(), Unreadable { reason: Reason::Io(error), wanted: Wanted::Program });
            let found = below(path, STRUCTURED_TEXT).map_err(failed)?;
            if found.is_empty() {
                return Err(failed(io::Error::other("no file below it ends with .st")));
            }
            files.extend(found);
        } else {
            files.push(path.clone());
        }
    }
    let mut taken = BTreeSet::new();
    files.retain(|path| Identity::of(path).is_none_or(|file| taken.insert(file)));
    Ok(files)
}

/// The texts of the files of a program in Structured Text.
///
/// # Errors
/// The first file that cannot be read, and why.
pub fn program_sources(paths: &[PathBuf]) -> Result<Sources, (PathBuf, Unreadable)> {
    let read = |path: PathBuf| match text(&path, Wanted::Program) {
        Ok(text) => Ok((path.display().to_string(), text)),
        Err(reason) => Err((path, reason)),
    };
    let files: Vec<_> = program_files(paths)?.into_iter().map(read).collect::<Result<_, _>>()?;
    Ok(Sources::files(files))
}

fn read(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, Reason> {
    let mut bytes = Vec::new();
    // It may grow meanwhile.
    open_regular(path, limit_bytes)?.take(limit_bytes + 1).read_to_end(&mut bytes).map_err(Reason::Io)?;
    if bytes.len() as u64 > limit_bytes { Err(Reason::TooLarge) } else { Ok(bytes) }
}

/// Opening a device may have side effects, and a FIFO waits for a writer: they are refused before.
fn open_regular(path: &Path, limit_bytes: u64) -> Result<File, Reason> {
    if path == Path::new(STDIN) {
        return Err(Reason::Stdin);
    }
    refuse_irregular(&fs::metadata(path).map_err(Reason::Io)?, limit_bytes)?;
    let file = open(path).map_err(Reason::Io)?;
    refuse_irregular(&file.metadata().map_err(Reason::Io)?, limit_bytes)?;
    Ok(file)
}

/// Without waiting: some files of `/proc` claim to be regular, and their readers wait for the next message.
#[cfg(unix)]
fn open(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    let flags = rustix::fs::OFlags::NONBLOCK.bits() as i32;
    File::options().read(true).custom_flags(flags).open(path)
}

#[cfg(not(unix))]
fn open(path: &Path) -> io::Result<File> {
    File::open(path)
}

fn refuse_irregular(metadata: &fs::Metadata, limit_bytes: u64) -> Result<(), Reason> {
    if !metadata.is_file() {
        return Err(Reason::NotRegular(kind_of(metadata)));
    }
    if metadata.len() > limit_bytes { Err(Reason::TooLarge) } else { Ok(()) }
}

#[cfg(unix)]
fn kind_of(metadata: &fs::Metadata) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    let kind = metadata.file_type();
    match () {
        () if kind.is_dir() => "a folder",
        () if kind.is_fifo() => "a pipe",
        () if kind.is_socket() => "a socket",
        () => "a device",
    }
}

#[cfg(not(unix))]
fn kind_of(metadata: &fs::Metadata) -> &'static str {
    if metadata.is_dir() { "a folder" } else { "a device" }
}

impl Unreadable {
    /// The remedy.
    #[must_use]
    pub fn help(&self) -> String {
        match (&self.reason, self.wanted) {
            (Reason::OfAnotherKind(refusal), _) => refusal.help.clone(),
            (Reason::Io(error), wanted) if error.kind() == io::ErrorKind::NotFound => {
                not_found(wanted).to_owned()
            }
            (Reason::Io(_), Wanted::Program) => not_found(Wanted::Program).to_owned(),
            (Reason::Io(_), _) => "check the path and its permissions".to_owned(),
            (Reason::Stdin, _) => "give the path of a file; one of this name is ./-".to_owned(),
            (Reason::NotRegular(_), _) => "give the path of a regular file".to_owned(),
            (Reason::TooLarge, Wanted::Capture) => {
                "`editcap -c` cuts a capture into several, `editcap -A` and `-B` by time".to_owned()
            }
            (Reason::TooLarge | Reason::LineTooLong { .. }, _) => "is it the right file?".to_owned(),
        }
    }

    /// The error of the system; none if the file itself is refused.
    #[must_use]
    pub const fn refused_by_system(&self) -> Option<&io::Error> {
        match &self.reason {
            Reason::Io(error) => Some(error),
            _ => None,
        }
    }

    /// Whether the file may be in the process of being replaced, so that it may be readable soon.
    pub(crate) fn may_pass(&self) -> bool {
        matches!(self.reason, Reason::Io(_))
    }
}

const fn not_found(wanted: Wanted) -> &'static str {
    match wanted {
        Wanted::UnitFile => "give the path of a unit file, such as one in the folder units",
        Wanted::Scenario => "give the path of a scenario file, or of a folder of them",
        Wanted::Program => "give the path of a user program, such as scenarios/programs/a-3-3.st",
        Wanted::Capture => "give a capture of master and units, as `ectwin run --pcap` writes it",
        Wanted::Results => "give the files that the parts have written by `ectwin replay --json`",
        Wanted::SiiImage => "`ectwin sii FILE.toml` writes the image of a unit",
        Wanted::Esi => "give the path of an ESI file, such as one in the folder units/esi",
        Wanted::Csv => "give the path of a table of values over time",
        Wanted::Trace => "`ectwin replay SCENARIO --bless` writes the trace of the scenario",
    }
}

impl fmt::Display for Unreadable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.reason {
            Reason::Io(error) => error.fmt(formatter),
            Reason::Stdin => formatter.write_str("it means stdin, which no command reads"),
            Reason::NotRegular(what) => write!(formatter, "it is {what}, not a regular file"),
            Reason::TooLarge => {
                write!(formatter, "it is larger than {} MiB", limit_bytes(self.wanted) / MIB)
            }
            Reason::LineTooLong { number } => write!(formatter, "line {number} is longer than 1 MiB"),
            Reason::OfAnotherKind(refusal) => formatter.write_str(&escaped(&refusal.message)),
        }
    }
}

impl std::error::Error for Unreadable {}
