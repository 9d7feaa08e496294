//! `ectwin esi FILE` and `ectwin sii FILE`.

use std::slice;

use plant::UnitFile;

use crate::cli::ExportArgs;
use crate::failure::Failure;
use crate::overwrite::Output;
use crate::{output, overwrite, unit_files};

/// The ESI file, which the configuration tool of a master reads.
pub(crate) fn esi(args: &ExportArgs) -> Result<(), Failure> {
    let file = unit_file(args)?;
    let section = file.section();
    write(args, &file, esi::xml(&section.description(), &section.objects()).as_bytes())
}

/// The SII image: the contents of the unit's EEPROM at power-on.
pub(crate) fn sii(args: &ExportArgs) -> Result<(), Failure> {
    let file = unit_file(args)?;
    write(args, &file, &esi::sii::image(&file.section().description()))
}

fn unit_file(args: &ExportArgs) -> Result<UnitFile, Failure> {
    unit_files::parse(&args.unit).map(|(file, _)| file)
}

fn write(args: &ExportArgs, file: &UnitFile, result: &[u8]) -> Result<(), Failure> {
    if let Some(path) = &args.output {
        let output = Output { option: "-o", path };
        overwrite::refuse(&[output], slice::from_ref(&args.unit))?;
        overwrite::refuse_named(&output, unit_files::named_files(&args.unit, file))?;
    }
    output::write(args.output.as_deref(), result)
}
