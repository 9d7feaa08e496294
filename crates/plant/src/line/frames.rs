//! Frames by their kind, the unit that they address, and a selection of them.

use serde::{Deserialize, Serialize};
use wire::Command;

use super::numbers::WhichUnit;
use crate::dice::Dice;

/// Frames by their kind, and a selection of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Frames {
    /// The kind.
    #[serde(default)]
    pub kind: FrameKind,
    /// Only those with a datagram that addresses this unit; none: all of the kind.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<WhichUnit>,
    /// The selection.
    pub choice: Choice,
}

impl Frames {
    /// A selection of all frames.
    #[must_use]
    pub const fn of(choice: Choice) -> Self {
        Self { kind: FrameKind::Any, unit: None, choice }
    }

    /// The same of this kind.
    #[must_use]
    pub fn with_kind(self, kind: FrameKind) -> Self {
        Self { kind, ..self }
    }

    /// The same of those that address this unit.
    #[must_use]
    pub fn of_unit(self, unit: impl Into<WhichUnit>) -> Self {
        Self { unit: Some(unit.into()), ..self }
    }
}

/// A kind of frames. A frame is of each kind of which it has a datagram.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameKind {
    /// All, also those that are not EtherCAT.
    #[default]
    Any,
    /// With a logical datagram: LRD, LWR or LRW.
    ProcessData,
    /// With a datagram in the mailbox of a unit that it addresses: the area of a SyncManager in mailbox mode, or its status
    /// and its repeat request.
    Mailbox,
    /// With a datagram that reads or writes a register of the SII, 0x0500 to 0x050F.
    Sii,
    /// With a NOP.
    Nop,
    /// With an APRD.
    Aprd,
    /// With an APWR.
    Apwr,
    /// With an APRW.
    Aprw,
    /// With an FPRD.
    Fprd,
    /// With an FPWR.
    Fpwr,
    /// With an FPRW.
    Fprw,
    /// With a BRD.
    Brd,
    /// With a BWR.
    Bwr,
    /// With a BRW.
    Brw,
    /// With an LRD.
    Lrd,
    /// With an LWR.
    Lwr,
    /// With an LRW.
    Lrw,
    /// With an ARMW.
    Armw,
    /// With an FRMW.
    Frmw,
}

/// The kinds that are the name of a command.
const COMMANDS: [(FrameKind, Command, &str); 15] = [
    (FrameKind::Nop, Command::Nop, "NOP"),
    (FrameKind::Aprd, Command::Aprd, "APRD"),
    (FrameKind::Apwr, Command::Apwr, "APWR"),
    (FrameKind::Aprw, Command::Aprw, "APRW"),
    (FrameKind::Fprd, Command::Fprd, "FPRD"),
    (FrameKind::Fpwr, Command::Fpwr, "FPWR"),
    (FrameKind::Fprw, Command::Fprw, "FPRW"),
    (FrameKind::Brd, Command::Brd, "BRD"),
    (FrameKind::Bwr, Command::Bwr, "BWR"),
    (FrameKind::Brw, Command::Brw, "BRW"),
    (FrameKind::Lrd, Command::Lrd, "LRD"),
    (FrameKind::Lwr, Command::Lwr, "LWR"),
    (FrameKind::Lrw, Command::Lrw, "LRW"),
    (FrameKind::Armw, Command::Armw, "ARMW"),
    (FrameKind::Frmw, Command::Frmw, "FRMW"),
];

impl FrameKind {
    /// The kind of the frames with this command, by its name such as `BRD`.
    #[must_use]
    pub fn of_command(name: &str) -> Option<Self> {
        COMMANDS.iter().find(|(_, _, known)| *known == name).map(|(kind, _, _)| *kind)
    }

    /// The command and its name, of the kinds that are one.
    #[must_use]
    pub fn command(self) -> Option<(Command, &'static str)> {
        COMMANDS.iter().find(|(kind, _, _)| *kind == self).map(|(_, command, name)| (*command, *name))
    }
}

/// The selected frames of a kind, by their numbers: 1 is the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Choice {
    /// This number of frames, starting with the next one.
    Next(u64),
    /// Some frames after others.
    Behind {
        /// Number of frames that first pass without a fault.
        skip: u64,
        /// Number of frames with the fault after that.
        count: u64,
    },
    /// All from now on.
    All,
    /// Each with this probability, in per cent, 0 to 100; with 0 it is there and no frame meets it.
    Percent(u8),
    /// Each with this probability, in per mille, 0 to 1,000.
    PerMille(u16),
    /// One of this number, which is at least 1: with 10 the frames 10, 20, 30 and so on.
    Every(u64),
}

impl Choice {
    /// Whether its number of frames is 0. A probability of 0 is a probability like the others, for comparison with them.
    #[must_use]
    pub const fn is_none(self) -> bool {
        match self {
            Self::Next(count) | Self::Behind { count, .. } | Self::Every(count) => count == 0,
            Self::Percent(_) | Self::PerMille(_) | Self::All => false,
        }
    }

    /// Whether a probability selects frames, also one of 0.
    #[must_use]
    pub const fn is_chance(self) -> bool {
        matches!(self, Self::Percent(_) | Self::PerMille(_))
    }

    /// Whether the random generator decides which frames it selects.
    #[must_use]
    pub const fn is_random(self) -> bool {
        match self {
            Self::Percent(percent) => percent > 0,
            Self::PerMille(per_mille) => per_mille > 0,
            Self::Next(_) | Self::Behind { .. } | Self::Every(_) | Self::All => false,
        }
    }

    /// Whether its numbers are within their limits.
    #[must_use]
    pub const fn is_possible(self) -> bool {
        let within = match self {
            Self::Percent(percent) => percent <= 100,
            Self::PerMille(per_mille) => per_mille <= 1_000,
            Self::Next(_) | Self::Behind { .. } | Self::Every(_) | Self::All => true,
        };
        within && !self.is_none()
    }

    /// Whether it selects the frame with this number.
    pub(super) fn selects(self, number: u64, dice: &mut Dice) -> bool {
        match self {
            Self::All => true,
            Self::Next(count) => number <= count,
            Self::Behind { skip, count } => number > skip && number - skip <= count,
            Self::Percent(percent) => dice.hits(percent),
            Self::PerMille(per_mille) => dice.hits_per_mille(per_mille),
            Self::Every(period) => number.checked_rem(period) == Some(0),
        }
    }

    /// Whether it selects no frame after this number of frames.
    pub(super) const fn is_over(self, number: u64) -> bool {
        match self {
            Self::Next(count) => number >= count,
            Self::Behind { skip, count } => number >= skip.saturating_add(count),
            Self::All | Self::Percent(_) | Self::PerMille(_) | Self::Every(_) => false,
        }
    }
}
