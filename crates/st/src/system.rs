//! System-defined variables of the CPU Unit that tell of its programs (W501, A-3): there without a declaration.

/// One of them. All are BOOLs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum System {
    AlwaysTrue,
    AlwaysFalse,
    /// TRUE in the first scan with RUN mode.
    FirstScan,
    /// TRUE from an instruction error on, until the program makes it FALSE.
    InstructionError,
}

/// A program begins with RUN mode, so that both flags of a first period are one.
const NAMES: [(&str, System); 5] = [
    ("P_On", System::AlwaysTrue),
    ("P_Off", System::AlwaysFalse),
    ("P_First_RunMode", System::FirstScan),
    ("P_First_Run", System::FirstScan),
    ("P_PRGER", System::InstructionError),
];

impl System {
    /// The one of this name, in whatever case.
    pub(crate) fn named(name: &str) -> Option<Self> {
        NAMES.iter().find(|(own, _)| own.eq_ignore_ascii_case(name)).map(|(_, system)| *system)
    }

    /// Its value, if it never changes.
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
