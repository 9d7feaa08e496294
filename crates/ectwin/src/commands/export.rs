//! `ectwin esi FILE` and `ectwin sii FILE`.

use crate::cli::ExportArgs;
use crate::failure::Failure;
use crate::{output, unit_files};

/// The ESI file: what the configuration tool of a master reads.
pub(crate) fn esi(args: &ExportArgs) -> Result<(), Failure> {
    let settings = unit_files::settings(&args.unit)?;
    let xml = esi::xml(&nx_ect101::description(&settings), &nx_ect101::object_table());
    output::write(args.output.as_deref(), xml.as_bytes())
}

/// The SII image: what the EEPROM of the unit holds at power-on.
pub(crate) fn sii(args: &ExportArgs) -> Result<(), Failure> {
    let settings = unit_files::settings(&args.unit)?;
    let image = esi::sii::image(&nx_ect101::description(&settings));
    output::write(args.output.as_deref(), &image)
}
