//! What stands in the places of a sentence.

use nx_ect101::{EventCode, Fault, Pattern};
use time::Duration;
use wire::AlState;

use crate::model::{Choice, Controller, FrameKind, IndicatorName, UnitSet};

/// What stands in a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    /// `unit 2`, `all units`.
    Units(UnitSet),
    /// `unit 2`.
    Unit(usize),
    /// `SAFE-OP`.
    State(AlState),
    /// `PS`, the letters of a transition.
    Transition(&'static str),
    /// `12`, `0x0C`.
    Number(u64),
    /// `1.5ms`.
    Duration(Duration),
    /// `01 02 0x03`.
    Bytes(Vec<u8>),
    /// `10F3:05`.
    Entry((u16, u8)),
    /// `7000:01 7000:02`, `7000:01..06`.
    Entries(Vec<(u16, u8)>),
    /// `1601 1602`, hexadecimal.
    Numbers(Vec<u64>),
    /// `85000000`.
    Event(EventCode),
    /// `Processing`.
    Fault(Fault),
    /// `blinking`.
    Pattern(Pattern),
    /// `RUN`.
    Indicator(IndicatorName),
    /// `5 %`.
    Percent(u8),
    /// `the next 3 frames`, `5 % of the mailbox frames`.
    Frames((Choice, FrameKind)),
    /// `N1_UINTs_01_M_to_C`.
    Variable(String),
    /// `the master`, `unit 2`.
    Controller(Controller),
    /// A word: the name of a variable of a program, or of a file.
    Name(String),
    /// All words to the end.
    Text(String),
    /// `5:9`, line and column.
    Position((usize, usize)),
}
