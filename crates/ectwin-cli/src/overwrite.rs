//! The outputs of a command never replace its inputs, whatever paths are used.

use std::path::Path;

use storage::Identity;

use crate::failure::Failure;

/// A file of the command line.
#[derive(Clone, Copy)]
pub(crate) struct Output<'a> {
    /// Its option.
    pub(crate) option: &'a str,
    pub(crate) path: &'a Path,
}

/// Refuses outputs that are one of `inputs`, or the same file twice.
pub(crate) fn refuse(
    outputs: &[Output<'_>],
    inputs: impl IntoIterator<Item = impl AsRef<Path>>,
) -> Result<(), Failure> {
    refuse_all(outputs, inputs, "which this command uses")
}

/// Refuses an output that is one of the files of a unit file: its memory, its program.
pub(crate) fn refuse_named(
    output: &Output<'_>,
    named: impl IntoIterator<Item = impl AsRef<Path>>,
) -> Result<(), Failure> {
    refuse_all(std::slice::from_ref(output), named, "which the unit file uses")
}

fn refuse_all(
    outputs: &[Output<'_>],
    inputs: impl IntoIterator<Item = impl AsRef<Path>>,
    use_of_input: &str,
) -> Result<(), Failure> {
    let written: Vec<_> =
        outputs.iter().filter_map(|output| Some((output, Identity::of(output.path)?))).collect();
    for (place, (output, identity)) in written.iter().enumerate() {
        if let Some((other, _)) = written.iter().take(place).find(|(_, other)| other == identity) {
            return Err(refused(output, &format!("is the file of {} too", other.option)));
        }
    }
    for input in inputs {
        let identity = Identity::of(input.as_ref());
        if let Some((output, _)) = written.iter().find(|(_, written)| Some(written) == identity.as_ref()) {
            let input = input.as_ref().display();
            return Err(refused(output, &format!("would overwrite {input}, {use_of_input}")));
        }
    }
    Ok(())
}

fn refused(output: &Output<'_>, why: &str) -> Failure {
    let message = format!("{} {} {why}", output.option, output.path.display());
    Failure::Refused { message, help: "give another file; nothing has been written".to_owned() }
}
