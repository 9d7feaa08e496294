//! `ectwin import CAPTURE`: a scenario that sends the frames of a capture again and compares the answers.

use std::path::{Component, Path, PathBuf};

use ectwin::UnitFile;
use ectwin::user_files::{self, Wanted};
use scenario::RecordedFrames;
use time::Duration;
use user_file::of_another_kind;

use super::search::{folder_of, refuse_existing, write_new};
use crate::cli::ImportArgs;
use crate::failure::Failure;
use crate::output::{self, People};
use crate::unit_files;

/// Maximum number of default units that are written for a capture: the position of a slave in a datagram can be
/// any number.
const UNITS_MAX: usize = 1_000;

/// Writes the scenario, and reports its contents.
pub(crate) fn run(args: &ImportArgs) -> Result<(), Failure> {
    let is_stdout = output::is_stdout(&args.output);
    if !is_stdout {
        refuse_existing(&args.output)?;
    }
    let frames = read(&args.capture)?;
    if args.units.is_empty() && frames.units() > UNITS_MAX {
        return Err(Failure::Refused {
            message: format!(
                "{} contains a line of {} units; at most {UNITS_MAX} default units can be written",
                args.capture.display(),
                frames.units()
            ),
            help: "if the capture is correct, give the unit files with --unit".to_owned(),
        });
    }
    unit_files::all(args.units.iter().map(|unit| unit_files::parse(unit)))?;
    let text = text(args, &frames)?;
    if is_stdout {
        output::print(text.as_bytes())?;
    } else {
        write_new(&args.output, &text)?;
    }
    People::beside([args.output.as_path()]).print_line(format_args!(
        "{}: {} frames, {} of them answered, in {}",
        output::shown(&args.output),
        frames.len(),
        frames.answers(),
        frames.duration()
    ))?;
    let (given, seen) = (args.units.len(), frames.units());
    if given > 0 && given != seen {
        tracing::warn!("the capture contains a line of {seen} units, but {given} are given");
    }
    Ok(())
}

/// The frames of a capture; one without a master, or without an answer, is refused.
fn read(path: &Path) -> Result<RecordedFrames, Failure> {
    let refused = |reason: String| Failure::Refused {
        message: format!("{}: {reason}", path.display()),
        help: "give a capture of master and units, as `ectwin run --pcap` writes it".to_owned(),
    };
    let unreadable = |source| Failure::Unreadable { path: path.to_owned(), source };
    let bytes = user_files::bytes(path, Wanted::Capture).map_err(unreadable)?;
    if let Some(refusal) = of_another_kind(&bytes, &path.to_string_lossy(), Wanted::Capture) {
        return Err(Failure::Refused {
            message: format!("{}: {}", path.display(), refusal.message),
            help: refusal.help,
        });
    }
    let frames = RecordedFrames::read(&bytes).map_err(|error| refused(error.to_string()))?;
    match (frames.len(), frames.answers()) {
        (0, _) => Err(refused("it contains no EtherCAT frame of a master".to_owned())),
        (_, 0) => Err(refused("it contains no answer to a frame".to_owned())),
        _ => Ok(frames),
    }
}

fn text(args: &ImportArgs, frames: &RecordedFrames) -> Result<String, Failure> {
    let folder = folder_of(&args.output);
    let units = match args.units.as_slice() {
        [] => vec![format!("{{ {} }}", UnitFile::factory_text()); frames.units().max(1)],
        units => units.iter().map(|unit| seen_from(folder, unit)).collect::<Result<_, _>>()?,
    };
    let whole_seconds = frames.duration().as_nanos().div_ceil(1_000_000_000);
    let (within, limit) = (Duration::from_secs(whole_seconds + 1), Duration::from_secs(whole_seconds + 2));
    let name = args.capture.file_name().unwrap_or_default().display();
    Ok(format!(
        "title = {}\ncapture = {}\nlimit = \"{limit}\"\nunits = [{}]\nsteps = [\n  \
         {{ expect = \"the capture is replayed\", within = \"{within}\" }},\n  \
         {{ expect = \"every answer is as captured\" }},\n]\n",
        toml_string(&format!("the answers are those of {name}")),
        seen_from(folder, &args.capture)?,
        units.join(", ")
    ))
}

/// The relative path of a file from a folder, as a string of TOML.
fn seen_from(folder: &Path, path: &Path) -> Result<String, Failure> {
    let whole = |path: &Path| {
        path.canonicalize().map_err(|source| Failure::Unwritable { path: path.to_owned(), source })
    };
    let (folder, path) = (whole(folder)?, whole(path)?);
    let relative = relative(&folder, &path);
    let name = relative.to_str().ok_or_else(|| Failure::Refused {
        message: format!("the path {} is not UTF-8, so no scenario can name it", relative.display()),
        help: "rename the file or its folder".to_owned(),
    })?;
    Ok(toml_string(name))
}

/// The relative path from a folder to a file, both given from the root.
fn relative(folder: &Path, path: &Path) -> PathBuf {
    let same = folder.components().zip(path.components()).take_while(|(one, other)| one == other).count();
    let up = folder.components().skip(same).map(|_| Component::ParentDir);
    up.chain(path.components().skip(same)).collect()
}

/// A string in JSON is written as in TOML, which also has U+007F as an escape only.
fn toml_string(text: &str) -> String {
    serde_json::Value::from(text).to_string().replace('\u{7F}', r"\u007F")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_leads_up_and_down() {
        for (folder, path, expected) in [
            ("/a/b", "/a/b/c.pcapng", "c.pcapng"),
            ("/a/b", "/a/c/d.pcapng", "../c/d.pcapng"),
            ("/", "/a", "a"),
            ("/a/b/c", "/d", "../../../d"),
        ] {
            assert_eq!(relative(Path::new(folder), Path::new(path)), Path::new(expected));
        }
    }

    #[test]
    fn strings_are_escaped() {
        assert_eq!(toml_string("a \"b\"\\\n"), r#""a \"b\"\\\n""#);
        assert_eq!(toml_string("a\u{7F}\u{1}"), r#""a\u007F\u0001""#);
    }
}
