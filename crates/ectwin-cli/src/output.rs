//! The targets of results and logs: results to stdout, logs to stderr.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use rustix::fs::{OFlags, fcntl_getfl, fstat, stat};
use tracing_subscriber::EnvFilter;
use user_file::{escaped, on_one_line};

use crate::colour::{colour_on_stderr, colour_on_stdout};
use crate::failure::Failure;
use crate::output_file::OutputFile;

/// Longer lines are cut. The longest useful line contains the bytes of a whole SyncManager.
const LINE_CHARACTERS_MAX: usize = 8_000;

/// Sends logs to stderr; `RUST_LOG` takes precedence over the level of `-v`.
pub(crate) fn start_logging(verbose: u8) {
    let level = match verbose {
        0 => "warn",
        1 => "info",
        2 => "debug",
        _ => "trace",
    };
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(level));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(io::stderr)
        .with_ansi(colour_on_stderr())
        // A line that cannot be written is lost, and does not end the thread that logs it.
        .log_internal_errors(false)
        .init();
}

/// A JSON document, with the end of its last line.
pub(crate) fn json(document: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document);
    text.map(|text| text + "\n").map_err(no_json)
}

/// A JSON document in one line, without its end.
pub(crate) fn json_line(document: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string(document).map_err(no_json)
}

fn no_json(error: serde_json::Error) -> Failure {
    Failure::Unwritable { path: PathBuf::from("stdout"), source: io::Error::from(error) }
}

/// Whether anybody reads stdout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reader {
    There,
    /// The pipe is closed, as by `| head`.
    Gone,
}

/// Prints a result immediately. If the reader closes the pipe (`| head`), that is not an error.
pub(crate) fn print(result: &[u8]) -> Result<(), Failure> {
    print_to_reader(result).map(drop)
}

/// The same, for a command that need not continue without a reader.
pub(crate) fn print_to_reader(result: &[u8]) -> Result<Reader, Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(result).and_then(|()| stdout.flush()) {
        Ok(()) => Ok(Reader::There),
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(Reader::Gone),
        Err(source) => Err(Failure::Unwritable { path: PathBuf::from("stdout"), source }),
    }
}

/// Prints a text for display immediately. Text from files and names is made safe for a terminal: control
/// characters are escaped, and overlong lines are cut.
pub(crate) fn print_text(text: &str) -> Result<(), Failure> {
    print(for_terminals(text).as_bytes())
}

/// Prints a line for display immediately.
pub(crate) fn print_line(line: impl std::fmt::Display) -> Result<(), Failure> {
    print_text(&format!("{line}\n"))
}

/// The path of a file in a line of a text for display: a name can contain line ends.
pub(crate) fn shown(path: &Path) -> String {
    on_one_line(&path.to_string_lossy())
}

/// The verdicts at the beginning of a line, with their colours (ECMA-48, select graphic rendition).
const VERDICTS: [(&str, &str); 2] = [("ok      ", "\u{1b}[32m"), ("FAILED  ", "\u{1b}[31;1m")];

fn coloured(line: &str) -> String {
    let verdict = VERDICTS.iter().find_map(|(word, colour)| Some((word, colour, line.strip_prefix(word)?)));
    match verdict {
        Some((word, colour, rest)) => format!("{colour}{word}\u{1b}[0m{rest}"),
        None => line.to_owned(),
    }
}

/// A text for display, safe for a terminal.
pub(crate) fn for_terminals(text: &str) -> String {
    text.split_inclusive('\n').map(|line| cut(&escaped(line))).collect()
}

fn cut(line: &str) -> String {
    match line.char_indices().nth(LINE_CHARACTERS_MAX) {
        None => line.to_owned(),
        Some((end, _)) => {
            let more = line[end..].trim_end_matches('\n').chars().count();
            format!("{}… and {more} characters more\n", &line[..end])
        }
    }
}

/// Writes a result to `path`, or to stdout without one and for `-`.
pub(crate) fn write(path: Option<&Path>, result: &[u8]) -> Result<(), Failure> {
    let Some(path) = path.filter(|path| !is_stdout(path)) else { return print(result) };
    OutputFile::open(path)?.write(result)
}

/// Whether an output of the command line is stdout.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// Warns if this process was started without a stdout (`>&-`): the runtime of Rust has put /dev/null in its place, opened
/// for reading and writing. A program that does the same, such as Python with DEVNULL, reads the output no more than a
/// closed one.
pub(crate) fn warn_of_closed_stdout() {
    let stdout = io::stdout();
    let is_closed = fcntl_getfl(&stdout).is_ok_and(|flags| flags.contains(OFlags::RDWR))
        && fstat(&stdout).is_ok_and(|own| stat("/dev/null").is_ok_and(|null| own.st_rdev == null.st_rdev));
    if is_closed {
        tracing::warn!("stdout is closed: nobody can read the output `-`");
    }
}

/// Refuses stdout as an output that cannot go there.
pub(crate) fn refuse_stdout(option: &str, path: &Path, why: &str) -> Result<(), Failure> {
    if !is_stdout(path) {
        return Ok(());
    }
    let message = format!("{option} - means stdout, and {why}");
    Err(Failure::Refused { message, help: "give a file; one of this name is ./-".to_owned() })
}

/// The target of text for people: stdout, unless a result for programs goes there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum People {
    Stdout,
    Stderr,
}

impl People {
    /// Beside these outputs.
    pub(crate) fn beside<'p>(outputs: impl IntoIterator<Item = &'p Path>) -> Self {
        if outputs.into_iter().any(is_stdout) { Self::Stderr } else { Self::Stdout }
    }

    /// Prints a text for display immediately.
    pub(crate) fn print_text(self, text: &str) -> Result<(), Failure> {
        match self {
            Self::Stdout => print_text(text),
            Self::Stderr => {
                // Nobody is left to read it if stderr is closed.
                let _ = io::stderr().write_all(for_terminals(text).as_bytes());
                Ok(())
            }
        }
    }

    /// Prints cases immediately; on a terminal their verdicts are coloured.
    pub(crate) fn print_cases(self, text: &str) -> Result<(), Failure> {
        let is_coloured = match self {
            Self::Stdout => colour_on_stdout(),
            Self::Stderr => colour_on_stderr(),
        };
        if !is_coloured {
            return self.print_text(text);
        }
        let coloured: String = for_terminals(text).split_inclusive('\n').map(coloured).collect();
        match self {
            Self::Stdout => print(coloured.as_bytes()),
            Self::Stderr => {
                let _ = io::stderr().write_all(coloured.as_bytes());
                Ok(())
            }
        }
    }

    /// Prints a line for display immediately.
    pub(crate) fn print_line(self, line: impl std::fmt::Display) -> Result<(), Failure> {
        self.print_text(&format!("{line}\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_of_a_case_is_coloured_and_nothing_else() {
        assert_eq!(coloured("ok      a: b\n"), "\u{1b}[32mok      \u{1b}[0ma: b\n");
        assert_eq!(coloured("FAILED  a: b"), "\u{1b}[31;1mFAILED  \u{1b}[0ma: b");
        assert_eq!(coloured("        FAILED  a"), "        FAILED  a");
    }

    #[test]
    fn a_terminal_obeys_nothing_that_is_printed_for_people() {
        assert_eq!(for_terminals("a\u{1b}[31m\n\u{7}b\r\n"), "a\\u{1b}[31m\n\\u{7}b\\r\n");
        let long = "ä".repeat(LINE_CHARACTERS_MAX + 5) + "\nb\n";
        let kept = "ä".repeat(LINE_CHARACTERS_MAX);
        assert_eq!(for_terminals(&long), format!("{kept}… and 5 characters more\nb\n"));
        assert_eq!(for_terminals("no end"), "no end");
    }
}
