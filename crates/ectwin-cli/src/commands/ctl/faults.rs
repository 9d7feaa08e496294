//! `ctl faults` and `ctl clear`: the faults at work.

use control::client::Answered;
use control::messages::{ActiveFault, Faults, Verb};
use ectwin::happenings::time_words;

use super::shown::Shown;
use super::twin;
use crate::cli::CtlArgs;
use crate::failure::Failure;

pub(super) fn list(args: &CtlArgs) -> Result<Shown, Failure> {
    ask(args, Verb::Faults)
}

/// Ends one or all; shows those that are left.
pub(super) fn clear(args: &CtlArgs, fault: &str) -> Result<Shown, Failure> {
    ask(args, Verb::Clear(fault.to_owned()))
}

fn ask(args: &CtlArgs, verb: Verb) -> Result<Shown, Failure> {
    let Answered::<Faults> { content, .. } = twin::ask(args, verb)?;
    let text = if content.faults.is_empty() {
        "no fault is at work\n".to_owned()
    } else {
        content.faults.iter().map(fault).collect()
    };
    Shown::of(&content, text)
}

fn fault(fault: &ActiveFault) -> String {
    let ActiveFault { clear, sentence, ends_at_ns, frames_seen, frames_met, .. } = fault;
    let mut text = format!("{}: {sentence}", clear.as_deref().unwrap_or("without a name"));
    if let (Some(seen), Some(met)) = (frames_seen, frames_met) {
        text.push_str(&format!(", has met {met} of {seen} frames"));
    }
    text.extend(ends_at_ns.map(|at_ns| format!(", ends at {}", time_words(at_ns))));
    text + "\n"
}
