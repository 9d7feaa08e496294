//! `--on-failure DIR`: what is kept of each failed case.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use storage::Identity;

use super::campaign::Campaign;
use super::case_files::case_of;
use super::partition::Partition;
use super::result::CaseResult;
use super::story;
use crate::failure::Failure;
use crate::output::{self, People, shown};
use crate::overwrite::{self, Output};

const CAPTURE: &str = ".pcapng";
const TRACE: &str = ".trace.txt";
const REPORT: &str = ".txt";

/// The folder for failed cases.
pub(super) struct OnFailure {
    folder: PathBuf,
    /// What a scenario of the campaign uses is not replaced.
    inputs: Vec<PathBuf>,
}

impl OnFailure {
    /// Makes the folder, and removes what an earlier run of the cases of this part has left in it. What other campaigns
    /// have left stays, and is reported.
    pub(super) fn make(folder: PathBuf, campaign: &Campaign, partition: Partition) -> Result<Self, Failure> {
        let inputs = campaign.inputs().to_vec();
        let cleared = fs::create_dir_all(&folder).and_then(|()| remove_earlier(&folder, campaign, partition));
        match cleared.map_err(|source| Failure::Unwritable { path: folder.clone(), source })? {
            Others { count: 0, .. } => {}
            Others { count, first } => People::Stderr.print_line(format_args!(
                "warning: {} has files of another campaign: {count}, such as {}",
                shown(&folder),
                shown(&first)
            ))?,
        }
        Ok(Self { folder, inputs })
    }

    /// Writes capture, trace and report of a case; the report has the command that repeats it.
    pub(super) fn write(&self, result: &CaseResult, trace: &str, capture: &[u8]) -> Result<(), Failure> {
        let stem = result.file_stem();
        let report = story::failed_case(result);
        let files = [(CAPTURE, capture), (TRACE, trace.as_bytes()), (REPORT, report.as_bytes())];
        files.into_iter().try_for_each(|(ending, contents)| {
            let path = self.folder.join(format!("{stem}{ending}"));
            overwrite::refuse(&[Output { option: "--on-failure", path: &path }], self.inputs.iter())?;
            output::write(Some(&path), contents)
        })
    }
}

/// Files that look like ours and are not of this campaign.
#[derive(Default)]
struct Others {
    count: usize,
    /// The first by its name.
    first: PathBuf,
}

/// Removes the files of the cases of this part. Those of other parts may be new, and what the campaign reads stays.
fn remove_earlier(folder: &Path, campaign: &Campaign, partition: Partition) -> io::Result<Others> {
    let inputs: BTreeSet<Identity> = campaign.inputs().iter().filter_map(|path| Identity::of(path)).collect();
    let mut others = Others::default();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let Some(stem) = name.to_str().and_then(stem_of) else { continue };
        let Some(number) = case_of(stem) else { continue };
        let path = entry.path();
        if Identity::of(&path).is_none_or(|own| inputs.contains(&own)) {
            continue;
        }
        if !campaign.numbers().contains(&number) || campaign.case(number).file_stem() != stem {
            others.first = if others.count == 0 { name.into() } else { others.first.min(name.into()) };
            others.count += 1;
        } else if partition.has(number) {
            fs::remove_file(path)?;
        }
    }
    Ok(others)
}

/// The name of a file of a case without its ending.
fn stem_of(name: &str) -> Option<&str> {
    // The ending of a trace ends like that of a report.
    [CAPTURE, TRACE, REPORT].iter().find_map(|ending| name.strip_suffix(ending))
}
