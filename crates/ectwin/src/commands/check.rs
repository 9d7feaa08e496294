//! `ectwin check FILE`: the setting rules, before the file comes to a unit.

mod document;
mod exchange;
mod places;
mod report;

use std::path::Path;

use ectwin::unit_file::UnitFile;
use nx_ect101::{Configuration, Finding, Verdict};

use crate::cli::CheckArgs;
use crate::failure::Failure;
use crate::{output, unit_files};

/// Tells all findings and what would be exchanged.
pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let (file, text) = unit_files::parse(&args.unit)?;
    let configuration = Configuration::from_unit_file(&file);
    let verdict = configuration.check();
    if args.json {
        output::print(document::findings(&verdict)?.as_bytes())?;
    } else {
        output::print(for_people(&args.unit, &file, &text, &configuration, &verdict).as_bytes())?;
    }
    if verdict.is_satisfied() { Ok(()) } else { Err(Failure::RulesBroken) }
}

fn for_people(
    path: &Path,
    file: &UnitFile,
    text: &str,
    configuration: &Configuration,
    verdict: &Verdict,
) -> String {
    let picture = |finding: &Finding| report::picture(path, text, finding, places::of(file, finding));
    let mut told: String = verdict.findings.iter().map(picture).collect();
    told.push_str(&format!("{}: {}\n", path.display(), exchange::consequence(verdict)));
    told.push_str(&exchange::table(configuration, verdict));
    told
}
