//! `ectwin explain CODE`.

use crate::failure::Failure;
use crate::output::print_line;

pub(crate) fn run(code: &str) -> Result<(), Failure> {
    print_line(ectwin::explain::explain(code).map_err(Failure::Unexplained)?)
}
