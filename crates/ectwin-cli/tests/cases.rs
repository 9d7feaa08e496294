//! The files of tests/cases: each is one test, and the end of its name selects how the command is tested with it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use libtest_mimic::{Arguments, Failed, Trial};

/// The tests for files whose names end like this. The first ending that matches is used.
struct Kind {
    ending: &'static str,
    command: &'static [&'static str],
    exit_code: i32,
    /// The required contents of stdout or stderr.
    says: &'static [&'static str],
}

const KINDS: &[Kind] = &[
    Kind { ending: ".check.st", command: &["st", "check"], exit_code: 0, says: &["no problems"] },
    // A program for the scenario with the same name.
    Kind { ending: ".st", command: &["st", "check"], exit_code: 0, says: &["no problems"] },
    Kind { ending: ".mustfail.toml", command: &["replay"], exit_code: 1, says: &["FAILED"] },
    Kind { ending: ".toml", command: &["replay"], exit_code: 0, says: &["1 ok, 0 failed"] },
    Kind { ending: ".xml", command: &["check"], exit_code: 2, says: &["this is an ESI file", "ectwin "] },
];

fn main() {
    let arguments = Arguments::from_args();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/cases");
    let trials = files(&folder).into_iter().map(trial).collect();
    libtest_mimic::run(&arguments, trials).exit();
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.file_name().is_some_and(|name| name != "README.md"))
        .collect();
    files.sort();
    files
}

fn trial(file: PathBuf) -> Trial {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Trial::test(name.clone(), move || {
        let kind = KINDS.iter().find(|kind| name.ends_with(kind.ending));
        kind.ok_or(format!("{name}: its ending is none of the table"))?.check(&file)
    })
}

impl Kind {
    fn check(&self, file: &Path) -> Result<(), Failed> {
        let output = Command::new(env!("CARGO_BIN_EXE_ectwin")).args(self.command).arg(file).output()?;
        let text =
            [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
        if output.status.code() != Some(self.exit_code) {
            return Err(format!(
                "exit code {:?} in place of {}\n{text}",
                output.status.code(),
                self.exit_code
            )
            .into());
        }
        match self.says.iter().find(|fragment| !text.contains(**fragment)) {
            Some(fragment) => Err(format!("it does not say `{fragment}`\n{text}").into()),
            None => Ok(()),
        }
    }
}
