//! What a description requires of the master: init commands, time-outs, presets, texts.

use wire::{ObjectIndex, SubIndex};

/// A transition of the EtherCAT state machine, by the standard's letters (ETG.1000.6).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transition {
    /// INIT to PRE-OP.
    Ip,
    /// PRE-OP to INIT.
    Pi,
    /// PRE-OP to SAFE-OP.
    Ps,
    /// SAFE-OP to PRE-OP.
    Sp,
    /// SAFE-OP to INIT.
    Si,
    /// SAFE-OP to OP.
    So,
    /// OP to SAFE-OP.
    Os,
    /// OP to PRE-OP.
    Op,
    /// OP to INIT.
    Oi,
    /// INIT to BOOT.
    Ib,
    /// BOOT to INIT.
    Bi,
}

impl Transition {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Ip,
        Self::Pi,
        Self::Ps,
        Self::Sp,
        Self::Si,
        Self::So,
        Self::Os,
        Self::Op,
        Self::Oi,
        Self::Ib,
        Self::Bi,
    ];

    /// Its letters.
    #[must_use]
    pub const fn letters(self) -> &'static str {
        match self {
            Self::Ip => "IP",
            Self::Pi => "PI",
            Self::Ps => "PS",
            Self::Sp => "SP",
            Self::Si => "SI",
            Self::So => "SO",
            Self::Os => "OS",
            Self::Op => "OP",
            Self::Oi => "OI",
            Self::Ib => "IB",
            Self::Bi => "BI",
        }
    }
}

/// An SDO download that the master makes at a transition.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InitCommand {
    /// The transition.
    pub transition: Transition,
    /// Index of the entry.
    pub index: ObjectIndex,
    /// Subindex of the entry.
    pub sub: SubIndex,
    /// The value, as in the SDO (little endian).
    pub data: Vec<u8>,
    /// The reason.
    pub comment: String,
}

/// Time-outs of the master, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timeouts {
    /// INIT to PRE-OP.
    pub pre_op_ms: u32,
    /// PRE-OP to SAFE-OP, SAFE-OP to OP.
    pub safe_op_op_ms: u32,
    /// Any state to INIT.
    pub back_to_init_ms: u32,
    /// OP to SAFE-OP.
    pub back_to_safe_op_ms: u32,
    /// Until the mailbox accepts a request.
    pub mailbox_request_ms: u32,
    /// From a mailbox request to its reply.
    pub mailbox_response_ms: u32,
}

impl Timeouts {
    /// The usual values of ESI files.
    pub const USUAL: Self = Self {
        pre_op_ms: 3_000,
        safe_op_op_ms: 9_000,
        back_to_init_ms: 5_000,
        back_to_safe_op_ms: 200,
        mailbox_request_ms: 100,
        mailbox_response_ms: 2_000,
    };
}

impl Default for Timeouts {
    fn default() -> Self {
        Self::USUAL
    }
}

/// Registers of the ESC that the master should preset; none: the register keeps its reset value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EscPresets {
    /// 0x0108, read/write offset.
    pub read_write_offset: Option<u16>,
    /// 0x0400, watchdog divider.
    pub watchdog_divider: Option<u16>,
    /// 0x0410, PDI watchdog time.
    pub pdi_watchdog: Option<u16>,
    /// 0x0420, process data watchdog time.
    pub process_data_watchdog: Option<u16>,
}

/// A text of the diagnosis history (ETG.1020, object 10F3).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiagMessage {
    /// The text ID in a message.
    pub text_id: u16,
    /// The text, with placeholders such as `%d` for its parameters.
    pub text: String,
}
