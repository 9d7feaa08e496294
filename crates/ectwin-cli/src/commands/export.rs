//! `ectwin esi FILE` and `ectwin sii FILE`.

use std::slice;

use crate::cli::ExportArgs;
use crate::failure::Failure;
use crate::overwrite::Output;
use crate::{output, overwrite, unit_files};

/// The ESI file: what the configuration tool of a master reads.
pub(crate) fn esi(args: &ExportArgs) -> Result<(), Failure> {
    let settings = unit_files::settings(&args.unit)?;
    let xml = esi::xml(&nx_ect101::description(&settings), &nx_ect101::object_table());
    write(args, xml.as_bytes())
}

/// The SII image: what the EEPROM of the unit holds at power-on.
pub(crate) fn sii(args: &ExportArgs) -> Result<(), Failure> {
    let settings = unit_files::settings(&args.unit)?;
    let image = esi::sii::image(&nx_ect101::description(&settings));
    write(args, &image)
}

fn write(args: &ExportArgs, result: &[u8]) -> Result<(), Failure> {
    if let Some(path) = &args.output {
        overwrite::refuse(&[Output { option: "-o", path }], slice::from_ref(&args.unit))?;
    }
    output::write(args.output.as_deref(), result)
}
