//! `ectwin check FILE`: the setting rules, before the file is used for a unit.

mod document;
mod exchange;
mod report;

use std::path::Path;

use esi::SyncManagerType;
use unit_model::SettingsCheck;
use user_file::{MISTAKES_MAX, and_more};

use crate::cli::CheckArgs;
use crate::failure::Failure;
use crate::failure_document::or_document;
use crate::{output, unit_files};

/// Shows the findings and the resulting exchange. A finding whose event is an observation is a warning.
pub(crate) fn run(args: &CheckArgs) -> Result<(), Failure> {
    let (file, text) = or_document(args.json, unit_files::parse(&args.unit))?;
    or_document(args.json, unit_files::refuse_wrong_files(&args.unit, &file, &text))?;
    let Some(check) = file.section().check_settings() else { return without_rules(args, &file) };
    if args.json {
        output::print(document::of(&check)?.as_bytes())?;
    } else {
        output::print_text(&for_people(&args.unit, &text, &check))?;
    }
    if check.has_errors() { Err(Failure::RulesBroken) } else { Ok(()) }
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
        output::shown(&args.unit),
        file.name(),
        description.name,
        size(outputs),
        size(inputs),
    ))
}

fn for_people(path: &Path, text: &str, check: &SettingsCheck) -> String {
    let findings = &check.findings;
    let mut told: String =
        findings.iter().take(MISTAKES_MAX).map(|finding| report::picture(path, text, finding)).collect();
    let more = and_more(findings.len().saturating_sub(MISTAKES_MAX));
    told.extend(more.map(|more| format!("{more}\n\n")));
    told.push_str(&format!("{}: {}\n", output::shown(path), check.consequence));
    told.push_str(&exchange::table(check));
    told
}
