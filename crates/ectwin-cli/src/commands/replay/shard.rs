//! The part of a campaign or of a search that runs here. Only `--partition auto` reads the environment.

use std::fs;

use super::partition::{self, Partition, PartitionChoice};
use crate::failure::Failure;
use crate::output::People;

/// The part of the command line; without one, the whole.
pub(crate) fn chosen(choice: Option<PartitionChoice>) -> Result<Partition, Failure> {
    match choice {
        None => Ok(Partition::WHOLE),
        Some(PartitionChoice::Given(partition)) => Ok(partition),
        Some(PartitionChoice::Auto) => automatic(),
    }
}

fn automatic() -> Result<Partition, Failure> {
    let shard = partition::from_environment(&|name| std::env::var(name).ok()).map_err(|message| {
        let help = "use `--partition i/n`; docs/user/campaigns.md lists the variables of CI systems";
        Failure::Refused { message: format!("--partition auto: {message}"), help: help.to_owned() }
    })?;
    if let Some(doubt) = &shard.doubt {
        People::Stderr.print_line(format_args!("warning: --partition auto: {doubt}"))?;
    }
    if let Some(path) = &shard.status_file {
        fs::write(path, []).map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
    }
    Ok(shard.partition)
}
