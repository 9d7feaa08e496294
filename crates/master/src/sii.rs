//! Reading the SII: command, status, data, from category to category.

use core::fmt;

use esi::sii::{self, SiiContents, SiiError, category};

use crate::access::{Access, Answer, Dialogue, Patience, Progress, word};
use crate::registers;

const TAKEN_BY_FORCE: [u8; 1] = [0x02];
const OWNED_BY_MASTER: [u8; 1] = [0x00];

const COMMAND_READ: u16 = 0x0100;
const COMMAND_NOP: [u8; 2] = [0; 2];

const READS_EIGHT_BYTES: u16 = 1 << 6;
const COMMAND_ERROR: u16 = 1 << 13;
const BUSY: u16 = 1 << 15;

/// Words 0x20 to 0x3D are reserved.
const RESERVED: core::ops::Range<usize> = 0x20..0x3E;
/// Word with the size in Kibit, less one.
const SIZE: usize = 0x3E;
const WORDS_PER_KIBIT: usize = 64;
/// The first category.
const CATEGORIES: usize = 0x40;
/// Maximum number of words that are read, whatever the size in the SII is: 64 KiB.
const WORDS_MAX: usize = 0x8000;
/// Number of consecutive commands that the SII may refuse.
const REFUSALS_MAX: u8 = 3;

/// The categories that a master needs; the others are skipped.
const NEEDED: &[u16] = &[
    category::STRINGS,
    category::GENERAL,
    category::FMMU,
    category::SYNC_MANAGER,
    category::TX_PDO,
    category::RX_PDO,
];

/// Why an SII could not be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiiFailure {
    /// It refuses read commands; the status register shows this.
    Refused {
        /// Register 0x0502.
        status: u16,
    },
    /// Its categories exceed its end.
    TooLong {
        /// Start of the category, in words.
        category_at: usize,
        /// End of the SII, in words.
        end: usize,
    },
    /// Its contents are not an SII.
    Malformed(SiiError),
}

impl fmt::Display for SiiFailure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused { status } => write!(formatter, "the SII refuses to be read, status {status:#06X}"),
            Self::TooLong { category_at, end } => {
                write!(formatter, "the SII category at word {category_at:#06X} ends after word {end:#06X}")
            }
            Self::Malformed(error) => error.fmt(formatter),
        }
    }
}

impl core::error::Error for SiiFailure {}

/// Reads header and categories, 4 or 8 bytes with each command, as the controller supports.
#[derive(Clone, Debug)]
pub struct SiiReader {
    phase: Phase,
    /// The SII as far as it has been read; skipped parts are zero.
    image: Vec<u8>,
    /// The next word to read.
    next: usize,
    /// The word before which reading pauses, to check what was read.
    until: usize,
    /// Start of the category that is being read.
    category_at: usize,
    refusals: u8,
    /// Status and address of the command, as they are written.
    command: [u8; 6],
    result: Option<Result<SiiContents, SiiFailure>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    TakeByForce,
    Own,
    Command,
    Status,
    Data { length_bytes: u16 },
    ClearError,
}

impl SiiReader {
    /// Takes the SII from the PDI and reads it.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            phase: Phase::TakeByForce,
            image: Vec::new(),
            next: 0,
            until: RESERVED.start,
            category_at: CATEGORIES,
            refusals: 0,
            command: [0; 6],
            result: None,
        }
    }

    /// The contents; none before it is done.
    #[must_use]
    pub fn into_result(self) -> Option<Result<SiiContents, SiiFailure>> {
        self.result
    }

    fn finish(&mut self, result: Result<SiiContents, SiiFailure>) -> Progress {
        self.result = Some(result);
        Progress::Done
    }

    /// The next command reads the next word.
    const fn set_command(&mut self) {
        let [c0, c1] = COMMAND_READ.to_le_bytes();
        let [a0, a1, a2, a3] = (self.next as u32).to_le_bytes();
        self.command = [c0, c1, a0, a1, a2, a3];
        self.phase = Phase::Command;
    }

    fn status(&mut self, status: u16) -> Progress {
        if status & BUSY != 0 {
            return Progress::Later;
        }
        if status & COMMAND_ERROR != 0 {
            self.refusals += 1;
            if self.refusals > REFUSALS_MAX {
                return self.finish(Err(SiiFailure::Refused { status }));
            }
            self.phase = Phase::ClearError;
            return Progress::Next;
        }
        self.phase = Phase::Data { length_bytes: if status & READS_EIGHT_BYTES == 0 { 4 } else { 8 } };
        Progress::Next
    }

    fn data(&mut self, data: &[u8]) -> Progress {
        self.refusals = 0;
        let at = 2 * self.next;
        self.image.resize(self.image.len().max(at + data.len()), 0);
        self.image[at..at + data.len()].copy_from_slice(data);
        self.next += data.len() / 2;
        let progress = if self.next < self.until { Progress::NextStage } else { self.follow() };
        self.set_command();
        progress
    }

    /// Checks what was read, and sets what is read next.
    fn follow(&mut self) -> Progress {
        if self.until == RESERVED.start {
            self.skip_to(RESERVED.end);
            self.until = CATEGORIES;
            return Progress::NextStage;
        }
        let end = self.end();
        loop {
            if self.needs(self.category_at + 2) {
                return Progress::NextStage;
            }
            let (number, length) = (self.word(self.category_at), self.word(self.category_at + 1));
            if number == category::END {
                self.image.truncate(2 * self.category_at + 2);
                let contents = sii::parse(&self.image).map_err(SiiFailure::Malformed);
                return self.finish(contents);
            }
            let behind = self.category_at + 2 + usize::from(length);
            if behind >= end {
                let category_at = self.category_at;
                return self.finish(Err(SiiFailure::TooLong { category_at, end }));
            }
            if !NEEDED.contains(&number) {
                self.skip_to(behind);
            } else if self.needs(behind) {
                return Progress::NextStage;
            }
            self.category_at = behind;
        }
    }

    /// Whether words before `end` are missing; then they are read next.
    const fn needs(&mut self, end: usize) -> bool {
        self.until = end;
        self.next < end
    }

    fn skip_to(&mut self, word: usize) {
        self.next = self.next.max(word);
    }

    fn word(&self, at: usize) -> u16 {
        self.image.get(2 * at..).map_or(0, word)
    }

    /// The word after the last one, according to the size in the SII.
    fn end(&self) -> usize {
        ((usize::from(self.word(SIZE)) + 1) * WORDS_PER_KIBIT).min(WORDS_MAX)
    }
}

impl Default for SiiReader {
    fn default() -> Self {
        Self::new()
    }
}

impl Dialogue for SiiReader {
    fn access(&self) -> Access<'_> {
        match self.phase {
            Phase::TakeByForce => Access::Write { offset: registers::SII_OWNER, data: &TAKEN_BY_FORCE },
            Phase::Own => Access::Write { offset: registers::SII_OWNER, data: &OWNED_BY_MASTER },
            Phase::Command => Access::Write { offset: registers::SII_CONTROL, data: &self.command },
            Phase::Status => Access::Read { offset: registers::SII_CONTROL, length_bytes: 2 },
            Phase::Data { length_bytes } => Access::Read { offset: registers::SII_DATA, length_bytes },
            Phase::ClearError => Access::Write { offset: registers::SII_CONTROL, data: &COMMAND_NOP },
        }
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        let Some(answer) = answer else { return Progress::Next };
        // A command that is not accepted finds the SII busy.
        let Some(data) = answer.taken() else { return Progress::Later };
        match self.phase {
            Phase::TakeByForce => self.phase = Phase::Own,
            Phase::Own | Phase::ClearError => self.set_command(),
            Phase::Command => self.phase = Phase::Status,
            Phase::Status => return self.status(word(data)),
            Phase::Data { .. } => return self.data(data),
        }
        Progress::Next
    }

    fn patience(&self) -> Patience {
        Patience::Sii
    }
}
