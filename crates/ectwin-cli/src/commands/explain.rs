//! `ectwin explain WHAT`.

use crate::failure::Failure;
use crate::output::print_line;

/// Prints all that it means, with an empty line between two meanings.
pub(crate) fn run(what: &str) -> Result<(), Failure> {
    let meanings = ectwin::explain::explain(what).map_err(Failure::Unexplained)?;
    let texts: Vec<String> = meanings.iter().map(ToString::to_string).collect();
    print_line(texts.join("\n\n"))
}
