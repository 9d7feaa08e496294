//! The targets of results and logs: results to stdout, logs to stderr.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tracing_subscriber::EnvFilter;
use user_file::escaped;

use crate::colour::colour_on_stderr;
use crate::failure::Failure;

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
        .init();
}

/// A JSON document, with the end of its last line.
pub(crate) fn json(document: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document);
    let source =
        |error| Failure::Unwritable { path: PathBuf::from("stdout"), source: io::Error::from(error) };
    text.map(|text| text + "\n").map_err(source)
}

/// Prints a result immediately. If the reader closes the pipe (`| head`), that is not an error.
pub(crate) fn print(result: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(result).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Unwritable { path: PathBuf::from("stdout"), source: error })
        }
        _ => Ok(()),
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

fn for_terminals(text: &str) -> String {
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

/// Writes a result to `path`, or to stdout without one.
pub(crate) fn write(path: Option<&Path>, result: &[u8]) -> Result<(), Failure> {
    let Some(path) = path else { return print(result) };
    std::fs::write(path, result).map_err(|source| Failure::Unwritable { path: path.to_owned(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_obeys_nothing_that_is_printed_for_people() {
        assert_eq!(for_terminals("a\u{1b}[31m\n\u{7}b\r\n"), "a\\u{1b}[31m\n\\u{7}b\\r\n");
        let long = "ä".repeat(LINE_CHARACTERS_MAX + 5) + "\nb\n";
        let kept = "ä".repeat(LINE_CHARACTERS_MAX);
        assert_eq!(for_terminals(&long), format!("{kept}… and 5 characters more\nb\n"));
        assert_eq!(for_terminals("no end"), "no end");
    }
}
