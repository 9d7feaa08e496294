//! Built-in user programs, by their names.

use core::fmt;

use crate::program::Program;
use crate::{Echo, MessageEcho, Pulse};

/// A user program that a unit file names instead of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    /// `builtin:copy`: copies the data from the master back to it ([`Echo`]).
    Copy,
    /// `builtin:pulse`: counts in the first byte to the master ([`Pulse`]).
    Pulse,
    /// `builtin:messages`: copies the data, and also sends messages back ([`MessageEcho`]).
    Messages,
}

/// The beginning of the names. A file with such a name is `./builtin:…`.
const PREFIX: &str = "builtin:";

/// Why a list of programs is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BuiltinRefused {
    name: String,
    why: Why,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Why {
    /// There is no built-in program of this name.
    Unknown,
    /// It is one of several programs.
    BesideOthers,
}

impl BuiltinRefused {
    /// The remedy.
    #[must_use]
    pub fn help(&self) -> String {
        let file = format!("a file of this name is ./{}", self.name);
        match self.why {
            Why::Unknown => {
                format!("programs without a file are {}; {file}", Builtin::ALL.map(Builtin::name).join(", "))
            }
            Why::BesideOthers => format!("give it alone, or only files and folders; {file}"),
        }
    }
}

impl fmt::Display for BuiltinRefused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.why {
            Why::Unknown => write!(formatter, "there is no program {}", self.name),
            Why::BesideOthers => {
                write!(formatter, "{} is a whole program, which no other program can be part of", self.name)
            }
        }
    }
}

impl core::error::Error for BuiltinRefused {}

impl Builtin {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Copy, Self::Pulse, Self::Messages];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Copy => "builtin:copy",
            Self::Pulse => "builtin:pulse",
            Self::Messages => "builtin:messages",
        }
    }

    /// The program with this name; none if there is no such program.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|builtin| builtin.name() == name)
    }

    /// The only program in a list of programs; none if the list names files and folders.
    ///
    /// # Errors
    /// The list names a built-in program beside others, or one that does not exist.
    pub fn only<N: AsRef<str>>(names: &[N]) -> Result<Option<Self>, BuiltinRefused> {
        let builtin = names.iter().map(AsRef::as_ref).find(|name| name.starts_with(PREFIX));
        let Some(name) = builtin else { return Ok(None) };
        match Self::named(name) {
            Some(builtin) if names.len() == 1 => Ok(Some(builtin)),
            Some(_) => Err(BuiltinRefused { name: name.to_owned(), why: Why::BesideOthers }),
            None => Err(BuiltinRefused { name: name.to_owned(), why: Why::Unknown }),
        }
    }

    /// The program in its initial state.
    #[must_use]
    pub fn program(self) -> Box<dyn Program + Send> {
        match self {
            Self::Copy => Box::new(Echo),
            Self::Pulse => Box::new(Pulse),
            Self::Messages => Box::new(MessageEcho::default()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_built_in_program_is_the_only_one() {
        assert_eq!(Builtin::only(&["builtin:pulse"]), Ok(Some(Builtin::Pulse)));
        assert_eq!(Builtin::only(&["a.st", "./builtin:pulse"]), Ok(None));
        for (names, why, way_out) in [
            (&["builtin:copy", "a.st"][..], "builtin:copy is a whole program", "give it alone"),
            (&["a.st", "builtin:copy"], "builtin:copy is a whole program", "./builtin:copy"),
            (&["builtin:cpy"], "there is no program builtin:cpy", "builtin:copy, builtin:pulse"),
        ] {
            let refused = Builtin::only(names).expect_err("refused");
            assert!(refused.to_string().contains(why), "{refused}");
            assert!(refused.help().contains(way_out), "{}", refused.help());
        }
    }
}
