//! What a fuzzer is.

use std::time::Duration;

use crate::random::Random;
use crate::real_files::Seeds;

/// What an input came to, in a word or two for the statistics, such as `accepted`; or what did not hold.
pub type Checked = Result<&'static str, String>;

/// A fuzzer.
pub struct Fuzzer {
    /// Its name on the command line, and that of its folder in tests/fuzz.
    pub name: &'static str,
    /// What ends the name of a file that holds an input.
    pub extension: &'static str,
    /// Reads the real files that inputs are made of.
    pub seeds: fn() -> Seeds,
    /// Makes an input.
    pub generate: fn(&Seeds, &mut Random) -> Vec<u8>,
    /// Tries an input. A panic is a finding too.
    pub check: fn(&[u8]) -> Checked,
    /// What an input may cost.
    pub limits: Limits,
    /// The parts that are left out of a failing input, the largest first.
    pub grains: &'static [Grain],
}

/// What an input of a length may cost.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For any input.
    pub milliseconds: u64,
    /// For each KiB beside.
    pub milliseconds_per_kib: u64,
    /// Memory for any input, in KiB.
    pub memory_kib: u64,
    /// Memory for each byte beside, in bytes.
    pub memory_per_byte: u64,
}

impl Limits {
    /// The longest time.
    #[must_use]
    pub const fn time(&self, input_bytes: usize) -> Duration {
        Duration::from_millis(
            self.milliseconds + self.milliseconds_per_kib * (input_bytes as u64).div_ceil(1024),
        )
    }

    /// The most bytes that are allocated at once.
    #[must_use]
    pub const fn memory_bytes(&self, input_bytes: usize) -> u64 {
        self.memory_kib * 1024 + self.memory_per_byte * input_bytes as u64
    }
}

/// A kind of part of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grain {
    /// Lines with their ends.
    Lines,
    /// What stands between semicolons.
    Clauses,
    /// Words, numbers, blanks and signs.
    Words,
    /// Two bytes: in a text, a byte in hexadecimal digits.
    Pairs,
    /// Single bytes.
    Bytes,
}
