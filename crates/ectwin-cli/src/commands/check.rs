//! `ectwin check FILE`: the setting rules, before the file is used for a unit.

mod document;
mod exchange;
mod places;
mod report;

use std::path::Path;

use ectwin::unit_file::UnitFile;
use esi::SyncManagerType;
use nx_ect101::{Configuration, EventLevel, Finding, UnitSettings, Verdict};
use user_file::{MISTAKES_MAX, and_more};

use crate::cli::CheckArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::{output, unit_files};

/// Shows the findings and the resulting exchange. A finding whose event is an observation is a warning.
pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let (file, text) = or_document(args.json, unit_files::parse(&args.unit))?;
    let Some(file) = file.section().as_model::<UnitFile>() else { return without_rules(args, &file) };
    let configuration = Configuration::from_unit_file(file);
    let levels = UnitSettings::from_unit_file(file).event_levels;
    let verdict = configuration.check();
    if args.json {
        output::print(document::of(&configuration, levels, &verdict)?.as_bytes())?;
    } else {
        let level = |finding: &Finding| finding.level(levels);
        output::print_text(&for_people(&args.unit, file, &text, &configuration, &verdict, level))?;
    }
    let is_broken = verdict.findings.iter().any(|finding| finding.level(levels) == EventLevel::MinorFault);
    if is_broken { Err(Failure::RulesBroken) } else { Ok(()) }
}

/// A unit of a model without setting rules: what it exchanges with the master.
fn without_rules(args: &CheckArgs, file: &plant::UnitFile) -> Result<(), Failure> {
    let description = file.section().description();
    let bytes = |usage| {
        let of_usage = description.sync_managers.iter().filter(|sync_manager| sync_manager.usage == usage);
        of_usage.map(|sync_manager| usize::from(sync_manager.default_bytes)).sum::<usize>()
    };
    let [outputs, inputs] = [SyncManagerType::Outputs, SyncManagerType::Inputs].map(bytes);
    if args.json {
        return output::print(document::without_rules(outputs, inputs)?.as_bytes());
    }
    let size = |bytes: usize| if bytes == 1 { "1 byte".to_owned() } else { format!("{bytes} bytes") };
    output::print_text(&format!(
        "{}: no problems\n{} ({}): {} from the master, {} to the master\n",
        args.unit.display(),
        file.name(),
        description.name,
        size(outputs),
        size(inputs),
    ))
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
