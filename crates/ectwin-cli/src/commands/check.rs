//! `ectwin check FILE`: the setting rules, before the file is used for a unit.

mod document;
mod exchange;
mod places;
mod report;

use std::path::Path;

use ectwin::unit_file::UnitFile;
use nx_ect101::{Configuration, EventLevel, Finding, UnitSettings, Verdict};
use user_file::{MISTAKES_MAX, and_more};

use crate::cli::CheckArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::{output, unit_files};

/// Shows the findings and the resulting exchange. A finding whose event is an observation is a warning.
pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let (file, text) = or_document(args.json, unit_files::parse(&args.unit))?;
    let configuration = Configuration::from_unit_file(&file);
    let levels = UnitSettings::from_unit_file(&file).event_levels;
    let verdict = configuration.check();
    if args.json {
        output::print(document::of(&configuration, levels, &verdict)?.as_bytes())?;
    } else {
        let level = |finding: &Finding| finding.level(levels);
        output::print_text(&for_people(&args.unit, &file, &text, &configuration, &verdict, level))?;
    }
    let is_broken = verdict.findings.iter().any(|finding| finding.level(levels) == EventLevel::MinorFault);
    if is_broken { Err(Failure::RulesBroken) } else { Ok(()) }
}

fn for_people(
    path: &Path,
    file: &UnitFile,
    text: &str,
    configuration: &Configuration,
    verdict: &Verdict,
    level: impl Fn(&Finding) -> EventLevel,
) -> String {
    let picture =
        |finding: &Finding| report::picture(path, text, finding, level(finding), places::of(file, finding));
    let mut told: String = verdict.findings.iter().take(MISTAKES_MAX).map(picture).collect();
    let more = and_more(verdict.findings.len().saturating_sub(MISTAKES_MAX));
    told.extend(more.map(|more| format!("{more}\n\n")));
    told.push_str(&format!("{}: {}\n", path.display(), exchange::consequence(verdict, level)));
    told.push_str(&exchange::table(configuration, verdict));
    told
}
