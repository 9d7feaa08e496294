//! A campaign that a signal has ended: what is said of the cases that were running.

use super::campaign::Campaign;
use super::case::Case;
use super::junit::{NotEnded, NotEndedBy};
use super::story;
use super::threads::Interrupted;
use crate::failure::Failure;
use crate::output::shown;

/// Most cases that are named; each thread has one.
const NAMED: usize = 8;

/// The message with the cases, and how to look at the first of them.
pub(super) fn failure(interrupted: &Interrupted, campaign: &Campaign) -> Failure {
    let Interrupted { signal, running } = interrupted;
    let cases = running.iter().map(|&number| campaign.case(number));
    let mut named: Vec<String> = cases.take(NAMED).map(|case| words(&case)).collect();
    if let Some(more @ 1..) = running.len().checked_sub(NAMED) {
        named.push(story::more_cases(more as u64));
    }
    let while_running = match named.as_slice() {
        [] => "before the next case".to_owned(),
        [one] => format!("while {one} was running"),
        several => format!("while these were running: {}", several.join("; ")),
    };
    let help = match running.first() {
        None => "the outputs have the cases that had ended".to_owned(),
        Some(&number) => {
            let case = campaign.case(number);
            let repeat = story::command(&shown(case.path), case.scenario.case.as_deref(), case.seed);
            format!(
                "the outputs have the cases that had ended; `{repeat} --trace` replays the first of these"
            )
        }
    };
    let message = format!("{} has ended the campaign {while_running}", signal.name());
    Failure::Interrupted { signal: *signal, message, help }
}

/// The cases that were running, for a report.
pub(super) fn test_cases(interrupted: &Interrupted, campaign: &Campaign) -> Vec<NotEnded> {
    let message = format!("{} has ended the campaign while this case was running", interrupted.signal.name());
    let test_case = |&number: &u64| {
        let case = campaign.case(number);
        let file = case.path.display().to_string();
        NotEnded { name: case.test_name(), file, why: NotEndedBy::Signal, message: message.clone() }
    };
    interrupted.running.iter().map(test_case).collect()
}

fn words(case: &Case<'_>) -> String {
    format!("case {} of {}, {} with seed {}", case.number, case.count, case.named(), case.seed)
}
