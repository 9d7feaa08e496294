//! The subject of an explanation.

use std::fmt;

use coe_kit::indicators::Pattern;
use unit_model::EventCode;
use wire::{AlStatusCode, ObjectIndex, SdoAbort, SubIndex};

/// Kind of a name in a table of the user's pages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DocumentedKind {
    /// Fault that a scenario can inject.
    Fault,
    /// Elementary type of Structured Text.
    DataType,
    /// Variable that exists without a declaration.
    Variable,
    /// ErrorID of NX_ReadObj and NX_WriteObj.
    ErrorId,
    /// Counter that `ectwin run` prints.
    Counter,
}

impl DocumentedKind {
    /// Its words before a name.
    const fn words(self) -> &'static str {
        match self {
            Self::Fault => "fault of scenarios",
            Self::DataType => "data type",
            Self::Variable => "variable",
            Self::ErrorId => "ErrorID",
            Self::Counter => "counter",
        }
    }
}

/// Something that can be explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Event code of the model.
    Event(EventCode),
    /// Emergency error code, in an emergency message or a diagnosis code.
    Emergency(u16),
    /// AL status code, register 0x0134.
    AlStatus(AlStatusCode),
    /// SDO abort code.
    Abort(SdoAbort),
    /// Object of the CoE object dictionary.
    Object(ObjectIndex),
    /// One entry of such an object.
    Entry(ObjectIndex, SubIndex),
    /// NX object, which the CPU Unit can access.
    NxObject(ObjectIndex),
    /// One entry of an NX object.
    NxEntry(ObjectIndex, SubIndex),
    /// Register of the ESC, by the offset of one of its bytes.
    Register(u16),
    /// Indicator on the unit's front.
    Indicator(&'static str),
    /// Pattern of an indicator.
    Pattern(Pattern),
    /// I/O port of the unit at its CPU Unit, or a system-defined variable.
    Port(&'static str),
    /// Key of the unit file, by its path.
    Key(&'static str),
    /// Function or function block of Structured Text.
    Library(&'static str),
    /// Setting rule between I/O allocation and PDO mapping.
    Rule(&'static str),
    /// Name in a table of the user's pages: its kind, and all names of its row as in the page.
    Documented(DocumentedKind, &'static str),
    /// Word of the glossary.
    Word(&'static str),
}

impl fmt::Display for Subject {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Event(code) => write!(formatter, "event {code}"),
            Self::Emergency(code) => write!(formatter, "emergency error code 0x{code:04X}"),
            Self::AlStatus(code) => write!(formatter, "AL status code 0x{:04X}", code.0),
            Self::Abort(code) => {
                write!(formatter, "SDO abort code 0x{:04X}_{:04X}", code.0 >> 16, code.0 & 0xFFFF)
            }
            Self::Object(index) => write!(formatter, "object {index}"),
            Self::Entry(index, sub) => write!(formatter, "object {index}:{sub}"),
            Self::NxObject(index) => write!(formatter, "NX object {index}"),
            Self::NxEntry(index, sub) => write!(formatter, "NX object {index}:{sub}"),
            Self::Register(offset) => write!(formatter, "register 0x{offset:04X}"),
            Self::Indicator(name) => write!(formatter, "indicator {name}"),
            Self::Pattern(pattern) => write!(formatter, "pattern {}", pattern.id()),
            Self::Port(name) => write!(formatter, "I/O port {name}"),
            Self::Key(path) => write!(formatter, "key {path}"),
            Self::Library(name) => write!(formatter, "Structured Text {name}"),
            Self::Rule(name) => write!(formatter, "setting rule {name}"),
            Self::Documented(kind, names) => write!(formatter, "{} {}", kind.words(), names.replace('`', "")),
            Self::Word(word) => write!(formatter, "word {word}"),
        }
    }
}
