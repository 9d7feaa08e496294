//! `--list`: the files, their titles, and how many of their cases would be replayed.

use user_file::on_one_line;

use super::campaign::Campaign;
use super::partition::Partition;
use super::story;
use crate::failure::Failure;
use crate::output;

/// Prints a line for each file with cases in this part.
pub(super) fn print(campaign: &Campaign, partition: Partition) -> Result<(), Failure> {
    let mut listed: Vec<(String, u64)> = Vec::new();
    for number in campaign.cases_of(partition) {
        let case = campaign.case(number);
        let title = on_one_line(&case.scenario.title);
        let line = format!("{}: {title}", case.named());
        match listed.last_mut() {
            Some((last, count)) if *last == line => *count += 1,
            _ => listed.push((line, 1)),
        }
    }
    for (line, count) in &listed {
        output::print_line(format_args!("{line} ({})", story::cases(*count)))?;
    }
    output::print_line(story::cases(listed.iter().map(|(_, count)| count).sum()))
}
