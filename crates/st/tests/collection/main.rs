//! The collection of programs: each file under `tests/programs` is a case, with its expectations in its first
//! comment. `tests/programs/README.md` describes the notation.

mod case;
mod host;
mod replay;
mod scan;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

/// Fewer would mean that some of them are not found.
const CASES_MIN: usize = 300;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/programs");
    let mut files = match collect(&root) {
        Ok(files) => files,
        Err(error) => {
            eprintln!("{}: {error}", root.display());
            return ExitCode::FAILURE;
        }
    };
    files.sort();
    let count = files.len();
    let mut trials: Vec<Trial> = files
        .into_iter()
        .map(|file| {
            let name = file.strip_prefix(&root).unwrap_or(&file).with_extension("");
            Trial::test(name.display().to_string(), move || replay_file(&file))
        })
        .collect();
    trials.push(Trial::test("the_collection_is_complete", move || match count {
        CASES_MIN.. => Ok(()),
        _ => Err(format!("{count} cases were found, {CASES_MIN} are there at least").into()),
    }));
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn collect(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(collect(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "st") {
            files.push(path);
        }
    }
    Ok(files)
}

fn replay_file(file: &Path) -> Result<(), Failed> {
    let text = fs::read_to_string(file)?;
    let case = case::Case::read(&text)?;
    replay::replay(&case).map_err(Failed::from)
}
