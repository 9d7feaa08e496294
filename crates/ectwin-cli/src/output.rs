//! Where results and logs go: results to stdout, logs to stderr.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tracing_subscriber::EnvFilter;

use crate::colour::colour_on_stderr;
use crate::failure::Failure;

/// Sends logs to stderr; `RUST_LOG` overrules the level that `-v` asks for.
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

/// A JSON document with its last line ended.
pub(crate) fn json(document: &impl serde::Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document);
    let source =
        |error| Failure::Unwritable { path: PathBuf::from("stdout"), source: io::Error::from(error) };
    text.map(|text| text + "\n").map_err(source)
}

/// Prints a result at once. A reader who has seen enough (`| head`) is no error.
pub(crate) fn print(result: &[u8]) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(result).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Unwritable { path: PathBuf::from("stdout"), source: error })
        }
        _ => Ok(()),
    }
}

/// Prints a line at once.
pub(crate) fn print_line(line: impl std::fmt::Display) -> Result<(), Failure> {
    print(format!("{line}\n").as_bytes())
}

/// Writes a result to `path`, or to stdout without one.
pub(crate) fn write(path: Option<&Path>, result: &[u8]) -> Result<(), Failure> {
    let Some(path) = path else { return print(result) };
    std::fs::write(path, result).map_err(|source| Failure::Unwritable { path: path.to_owned(), source })
}
