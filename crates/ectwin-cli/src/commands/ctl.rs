//! `ectwin ctl`: sees and steers a twin that runs, over its control channel.

mod faults;
mod sentences;
mod shown;
mod status;
mod steer;
mod twin;
mod variables;
mod watch;

use crate::cli::{Action, CtlArgs};
use crate::failure::Failure;
use crate::failure_document::or_document;
use shown::Shown;

/// Does what is asked for.
pub(crate) fn run(args: &CtlArgs) -> Result<(), Failure> {
    let print = |shown| or_document(args.json, shown).and_then(|shown: Shown| shown.print(args.json));
    match &args.action {
        Action::Do { sentences } => steer::carry_out(args, sentences),
        Action::Expect { sentences, within } => steer::expect(args, sentences, *within),
        Action::Watch { subjects } => watch::run(args, subjects),
        Action::Status => print(status::ask(args)),
        Action::Sentences { words } => print(sentences::list(args, &words.join(" "))),
        Action::Read { names } => print(variables::read(args, names)),
        Action::Write { values } => print(variables::write(args, values)),
        Action::Force { values } => print(variables::force(args, values)),
        Action::Release { names } => print(variables::release(args, names)),
        Action::Object { unit, entry } => print(variables::object(args, unit, entry)),
        Action::Faults => print(faults::list(args)),
        Action::Clear { fault } => print(faults::clear(args, &fault.join(" "))),
    }
}
