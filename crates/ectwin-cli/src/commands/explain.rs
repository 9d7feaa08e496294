//! `ectwin explain WHAT`.

use crate::failure::Failure;
use crate::output::print_line;

/// Prints all its meanings.
pub(crate) fn run(what: &str) -> Result<(), Failure> {
    let meanings = ectwin::explain::explain(what).map_err(Failure::Unexplained)?;
    print_line(ectwin::explain::to_text(&meanings))
}
