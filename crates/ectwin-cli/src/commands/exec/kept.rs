//! `--on-failure DIR`: what is kept of a command that failed.

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::cli::ExecArgs;
use crate::failure::Failure;
use crate::output;

const CAPTURE: &str = "capture.pcapng";
const EVENTS: &str = "events.jsonl";
const REPORT: &str = "command.txt";
/// A folder with this number of failures is not searched any further.
const FOLDERS_MAX: u32 = 100_000;

/// A new folder for one run. It is removed if the command does not fail.
pub(super) struct Kept {
    folder: PathBuf,
}

impl Kept {
    /// Makes a folder in `parent` that no other run has: several can use the same `parent` at once.
    pub(super) fn begin(parent: &Path, command: &[OsString]) -> Result<Self, Failure> {
        let unwritable = |path: &Path| {
            let path = path.to_owned();
            move |source| Failure::Unwritable { path, source }
        };
        fs::create_dir_all(parent).map_err(unwritable(parent))?;
        let stem = stem(command);
        for number in 1..=FOLDERS_MAX {
            let folder = parent.join(format!("{stem}-{number}"));
            match fs::create_dir(&folder) {
                Ok(()) => return Ok(Self { folder }),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(unwritable(&folder)(error)),
            }
        }
        Err(Failure::Refused {
            message: format!("{} has {FOLDERS_MAX} folders of this command", parent.display()),
            help: "remove the old ones".to_owned(),
        })
    }

    /// The path of the capture.
    pub(super) fn capture(&self) -> PathBuf {
        self.folder.join(CAPTURE)
    }

    /// The path of the events.
    pub(super) fn events(&self) -> PathBuf {
        self.folder.join(EVENTS)
    }

    /// After the end of the command with this exit code, which stays as it is if nothing can be kept.
    pub(super) fn end(self, code: u8, args: &ExecArgs) {
        if code == 0 {
            // What somebody else has put there is kept.
            let _removed = [self.capture(), self.events()].map(fs::remove_file);
            let _ = fs::remove_dir(&self.folder);
            return;
        }
        let report = format!("exit code {code}\n{}\n", again(args));
        let folder = self.folder.display();
        match output::write(Some(&self.folder.join(REPORT)), report.as_bytes()) {
            Ok(()) => tracing::warn!("exit code {code}: capture and events are kept in {folder}"),
            Err(failure) => {
                let (reason, _) = failure.words();
                tracing::warn!("exit code {code}: not everything could be kept in {folder}: {reason}");
            }
        }
    }
}

/// The name of the program, as a part of a file name.
fn stem(command: &[OsString]) -> String {
    let program = command.first().map(Path::new).and_then(Path::file_stem).map(OsStr::to_string_lossy);
    let program = program.unwrap_or_default();
    program.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' }).collect()
}

/// The command line that repeats the run, for a shell.
fn again(args: &ExecArgs) -> String {
    let repeated = ExecArgs { on_failure: None, pcap: None, events: None, ..args.clone() };
    let words = repeated.arguments().into_iter().map(|word| quoted(&word.to_string_lossy()));
    ["ectwin exec".to_owned()].into_iter().chain(words).collect::<Vec<_>>().join(" ")
}

fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_a_shell() {
        assert_eq!(quoted("units/a.toml"), "units/a.toml");
        assert_eq!(quoted("it's $HOME"), r"'it'\''s $HOME'");
        assert_eq!(quoted(""), "''");
    }

    #[test]
    fn a_folder_has_the_name_of_the_program() {
        assert_eq!(stem(&["/usr/bin/my test.sh".into(), "x".into()]), "my_test");
        assert_eq!(stem(&["..".into()]), "");
    }
}
