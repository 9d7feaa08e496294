//! The failure of a command: a message, the remedy, an exit code.

use std::io::{self, Write};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;

use ectwin::ChangesLost;
use ectwin::control::BindError;
use ectwin::explain::Unexplained;
use ectwin::user_files::Unreadable;
use link::OpenError;
use user_file::escaped;

use crate::descriptors;
use crate::ending_signal::Signal;
use crate::file_problem::{FileProblem, FileProblems};

/// The exit code of `exec` for what is not its command's result, as with env(1) and timeout(1).
pub(crate) const OWN_FAILURE: u8 = 125;

/// Why a command failed.
pub(crate) enum Failure {
    /// `explain` has no such subject.
    Unexplained(Unexplained),
    /// A file is not valid, with the places of its mistakes.
    BadFile(FileProblems),
    /// The setting rules are not satisfied. The findings are the command's result, already printed.
    RulesBroken,
    /// A program has problems, with their places; empty if they have already been printed.
    ProgramWrong(FileProblems),
    /// A case of a campaign failed. This has already been printed.
    CasesFailed,
    /// A condition was not true. This has already been printed.
    NotHeld,
    /// No twin answers.
    NoTwin { message: String, help: String },
    /// A run has ended before its scenario.
    NoVerdict { message: String, help: String },
    /// A signal has ended a campaign or a search.
    Interrupted { signal: Signal, message: String, help: String },
    /// The arguments contradict each other, or the existing files.
    Refused { message: String, help: String },
    /// A file cannot be read.
    Unreadable { path: PathBuf, source: Unreadable },
    /// A folder cannot be read.
    FolderUnreadable { path: PathBuf, source: io::Error },
    /// A file cannot be written.
    Unwritable { path: PathBuf, source: io::Error },
    /// The last changes of a memory could not be stored until the end.
    ChangesLost(ChangesLost),
    /// The link cannot be opened.
    Link(OpenError),
    /// Modbus TCP cannot be served there.
    Modbus { address: SocketAddr, source: io::Error },
    /// OPC UA cannot be served there.
    #[cfg(feature = "opcua")]
    OpcUa { address: SocketAddr, source: io::Error },
    /// The control socket cannot be made.
    Control(BindError),
    /// The link was lost while it was in use.
    LinkLost(io::Error),
    /// A step of the demo failed.
    #[cfg(feature = "ethercrab")]
    Demo(String),
    /// `exec` itself failed, before its command or beside it.
    Exec(Box<Self>),
    /// The command of `exec` ended with this exit code. Its output says why.
    Command(u8),
    /// The command of `exec` cannot be started; the exit code is that of a shell.
    NotStarted { program: PathBuf, source: io::Error, code: u8 },
    /// The system refuses something that it usually gives.
    System(io::Error),
}

impl Failure {
    /// Reports it to the user on stderr, and returns the exit code defined for the command line.
    pub(crate) fn report(self) -> ExitCode {
        let (message, help) = self.words();
        let mut text = match self.cause() {
            Self::BadFile(_)
            | Self::ProgramWrong(_)
            | Self::RulesBroken
            | Self::CasesFailed
            | Self::NotHeld
            | Self::Command(_) => message,
            _ => format!("error: {}\n", escaped(&message)),
        };
        if let Some(help) = help {
            text.push_str(&format!("help: {}\n", escaped(&help)));
        }
        // If stderr is closed, the message cannot be delivered.
        let _ = io::stderr().write_all(text.as_bytes());
        ExitCode::from(self.exit_code())
    }

    /// What has failed, if it was a part of `exec`.
    fn cause(&self) -> &Self {
        if let Self::Exec(cause) = self { cause.cause() } else { self }
    }

    /// Whether user files are at fault, so that other files can be examined beside them.
    pub(crate) fn is_of_files(&self) -> bool {
        matches!(self, Self::BadFile(_) | Self::Unreadable { .. })
            && !self.source().is_some_and(descriptors::are_exhausted)
    }

    /// This failure of a file, and then that of another one. A failure of another kind takes precedence.
    pub(crate) fn and(self, other: Self) -> Self {
        match (self.into_problems(), other.into_problems()) {
            (Ok(mut problems), Ok(more)) => {
                problems.append_new(more);
                Self::BadFile(problems)
            }
            (Err(failure), _) | (_, Err(failure)) => failure,
        }
    }

    fn into_problems(self) -> Result<FileProblems, Self> {
        match self {
            Self::BadFile(problems) => Ok(problems),
            failure if failure.is_of_files() => {
                let (message, help) = failure.words();
                Ok(FileProblem::of_file(&message, help.as_deref().unwrap_or_default()).into())
            }
            failure => Err(failure),
        }
    }

    fn exit_code(&self) -> u8 {
        match self {
            Self::Exec(_) => OWN_FAILURE,
            Self::Command(code) | Self::NotStarted { code, .. } => *code,
            // Whatever the reason was: the units have run.
            Self::ChangesLost(_) => 2,
            Self::Interrupted { signal, .. } => signal.exit_code(),
            _ if self.source().is_some_and(descriptors::are_exhausted) => 3,
            Self::Unexplained(_)
            | Self::ProgramWrong(_)
            | Self::RulesBroken
            | Self::CasesFailed
            | Self::NotHeld
            | Self::NoVerdict { .. }
            | Self::LinkLost(_)
            | Self::System(_) => 1,
            #[cfg(feature = "ethercrab")]
            Self::Demo(_) => 1,
            Self::BadFile(_)
            | Self::Refused { .. }
            | Self::Unreadable { .. }
            | Self::FolderUnreadable { .. }
            | Self::Unwritable { .. } => 2,
            Self::Link(_) | Self::Modbus { .. } | Self::Control(_) | Self::NoTwin { .. } => 3,
            #[cfg(feature = "opcua")]
            Self::OpcUa { .. } => 3,
        }
    }

    /// The error of the system.
    fn source(&self) -> Option<&io::Error> {
        match self {
            Self::Unreadable { source, .. } => source.refused_by_system(),
            Self::FolderUnreadable { source, .. }
            | Self::Unwritable { source, .. }
            | Self::ChangesLost(ChangesLost { source, .. })
            | Self::Modbus { source, .. }
            | Self::Link(OpenError::Failed { source, .. })
            | Self::LinkLost(source)
            | Self::NotStarted { source, .. }
            | Self::System(source) => Some(source),
            Self::Exec(cause) => cause.source(),
            #[cfg(feature = "opcua")]
            Self::OpcUa { source, .. } => Some(source),
            _ => None,
        }
    }

    /// The message and the remedy.
    pub(crate) fn words(&self) -> (String, Option<String>) {
        let (message, help) = self.message_and_help();
        match self.source() {
            Some(source) if descriptors::are_exhausted(source) => {
                (message, Some("allow this process more open files, such as `ulimit -n 1024`".to_owned()))
            }
            _ => (message, help),
        }
    }

    fn message_and_help(&self) -> (String, Option<String>) {
        match self {
            Self::Unexplained(reason) => (reason.to_string(), Some(reason.help().to_owned())),
            Self::BadFile(problems) | Self::ProgramWrong(problems) => (problems.pictures(), None),
            Self::RulesBroken | Self::CasesFailed | Self::NotHeld | Self::Command(_) => (String::new(), None),
            Self::Exec(cause) => cause.message_and_help(),
            Self::Refused { message, help }
            | Self::NoTwin { message, help }
            | Self::NoVerdict { message, help }
            | Self::Interrupted { message, help, .. } => (message.clone(), Some(help.clone())),
            Self::Unreadable { path, source } => {
                (format!("cannot read {}: {source}", path.display()), Some(source.help()))
            }
            Self::FolderUnreadable { path, source } => {
                let help = "check the path and its permissions".to_owned();
                (format!("cannot read {}: {source}", path.display()), Some(help))
            }
            Self::Unwritable { path, source } | Self::ChangesLost(ChangesLost { path, source }) => {
                (format!("cannot write {}: {source}", path.display()), None)
            }
            Self::Link(error) => (error.to_string(), Some(error.help())),
            Self::Modbus { address, source } => {
                (format!("Modbus TCP cannot be served at {address}: {source}"), help_to_listen(source))
            }
            #[cfg(feature = "opcua")]
            Self::OpcUa { address, source } => {
                (format!("OPC UA cannot be served at {address}: {source}"), help_to_listen(source))
            }
            Self::Control(error) => (error.to_string(), Some(error.help())),
            Self::LinkLost(error) => (format!("the link is lost: {error}"), None),
            #[cfg(feature = "ethercrab")]
            Self::Demo(reason) => (reason.clone(), None),
            Self::NotStarted { program, source, .. } => {
                let quote = if program.as_os_str().is_empty() { "\"" } else { "" };
                (format!("cannot run {quote}{}{quote}: {source}", program.display()), None)
            }
            Self::System(source) => (format!("the system refuses a process or a signal: {source}"), None),
        }
    }
}

fn help_to_listen(error: &io::Error) -> Option<String> {
    let help = match error.kind() {
        io::ErrorKind::AddrInUse => "another program uses this port; give another one, such as --modbus 1503",
        io::ErrorKind::PermissionDenied => {
            "ports below 1024 need a permission; give another, such as --modbus 1502"
        }
        io::ErrorKind::AddrNotAvailable => {
            "no interface of this machine has this address; 0.0.0.0 means all of them"
        }
        _ => return None,
    };
    Some(help.to_owned())
}
