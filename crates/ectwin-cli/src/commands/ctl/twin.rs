//! The twin that is meant: by `--control`, by ECTWIN_CONTROL, or because it is the only one that runs.

use std::path::PathBuf;

use control::client::{Answered, Client, ClientError};
use control::messages::{Refusal, Verb};
use serde::de::DeserializeOwned;

use crate::cli::CtlArgs;
use crate::failure::Failure;

const VARIABLE: &str = "ECTWIN_CONTROL";
const START_ONE: &str = "start one with `ectwin run FILE… --link LINK --control`";

/// Asks the twin for one thing.
pub(super) fn ask<T: DeserializeOwned>(args: &CtlArgs, verb: Verb) -> Result<Answered<T>, Failure> {
    connect(args)?.ask(verb).map_err(failure)
}

/// Connects to the twin.
pub(super) fn connect(args: &CtlArgs) -> Result<Client, Failure> {
    Client::connect(&socket(args)?).map_err(failure)
}

fn socket(args: &CtlArgs) -> Result<PathBuf, Failure> {
    let named = std::env::var_os(VARIABLE).filter(|path| !path.is_empty()).map(PathBuf::from);
    if let Some(path) = args.control.clone().or(named) {
        return Ok(path);
    }
    let sockets = control::running();
    match sockets.as_slice() {
        [one] => Ok(one.clone()),
        [] => Err(Failure::NoTwin {
            message: "no twin with a control channel runs".to_owned(),
            help: format!("{START_ONE}, or give its socket with --control PATH or in {VARIABLE}"),
        }),
        several => {
            let paths: Vec<_> = several.iter().map(|path| path.display().to_string()).collect();
            Err(Failure::Refused {
                message: format!("{} twins run: {}", several.len(), paths.join(", ")),
                help: format!("give one of them with --control PATH or in {VARIABLE}"),
            })
        }
    }
}

/// Why the twin has not done what was asked for.
pub(super) fn failure(error: ClientError) -> Failure {
    let message = error.to_string();
    match error {
        ClientError::Refused(refusal) => refused(refusal),
        ClientError::System(source) => Failure::System(source),
        ClientError::NotThere { .. } => Failure::NoTwin {
            message,
            help: format!("{START_ONE}; its line `ready` has the path behind `control=`"),
        },
        ClientError::NoTwin(_) => Failure::NoTwin {
            message,
            help: "give the path that the line `ready` of a twin has behind `control=`".to_owned(),
        },
        ClientError::Ended => Failure::NoTwin { message, help: START_ONE.to_owned() },
        ClientError::Silent { .. } => {
            Failure::NoTwin { message, help: "look at the twin: its process may be stopped".to_owned() }
        }
    }
}

fn refused(refusal: Refusal) -> Failure {
    let Refusal { message, help, nearest } = refusal;
    let further: Vec<String> =
        nearest.iter().filter(|near| !help.contains(*near)).map(|near| format!("`{near}`")).collect();
    let help = match (help.as_str(), further.as_slice()) {
        (_, []) => help,
        ("", further) => format!("did you mean {}?", further.join(" or ")),
        (help, further) => {
            let end = if help.ends_with('?') { "" } else { "." };
            format!("{help}{end} Others like it: {}", further.join(", "))
        }
    };
    Failure::Refused { message, help }
}
