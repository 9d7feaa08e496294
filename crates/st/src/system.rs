//! System-defined variables of the CPU Unit with the status of its programs (W501, A-3): they exist without a
//! declaration.

/// One of them. All are BOOLs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum System {
    AlwaysTrue,
    AlwaysFalse,
    /// TRUE in the first scan with RUN mode.
    FirstScan,
    /// TRUE from an instruction error on, until the program sets it to FALSE.
    InstructionError,
}

/// A program starts with RUN mode, so both flags for a first period are the same.
const NAMES: [(&str, System); 5] = [
    ("P_On", System::AlwaysTrue),
    ("P_Off", System::AlwaysFalse),
    ("P_First_RunMode", System::FirstScan),
    ("P_First_Run", System::FirstScan),
    ("P_PRGER", System::InstructionError),
];

impl System {
    /// The one with this name, in upper or lower case.
    pub(crate) fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, system)| *system)
    }

    /// Its value, if it is constant.
    pub(crate) const fn constant(self) -> Option<bool> {
        match self {
            Self::AlwaysTrue => Some(true),
            Self::AlwaysFalse => Some(false),
            Self::FirstScan | Self::InstructionError => None,
        }
    }

    /// Whether a program may write it.
    pub(crate) const fn is_writable(self) -> bool {
        matches!(self, Self::InstructionError)
    }
}
