//! The definition of a fuzzer.

use std::time::Duration;

use crate::random::Random;
use crate::real_files::Seeds;

/// The result of an input, in a word or two for the statistics, such as `accepted`; or the violated condition.
pub type Checked = Result<&'static str, String>;

/// A fuzzer.
pub struct Fuzzer {
    /// Its name on the command line, and that of its folder in tests/fuzz.
    pub name: &'static str,
    /// The end of the name of a file with an input.
    pub extension: &'static str,
    /// Reads the real files from which inputs are made.
    pub seeds: fn() -> Seeds,
    /// Makes an input.
    pub generate: fn(&Seeds, &mut Random) -> Vec<u8>,
    /// Tries an input. A panic is a finding too.
    pub check: fn(&[u8]) -> Checked,
    /// The permitted cost of an input.
    pub limits: Limits,
    /// The parts that are removed from a failing input, the largest first.
    pub grains: &'static [Grain],
}

/// The permitted cost of an input of a given length.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// For any input.
    pub milliseconds: u64,
    /// For each KiB in addition.
    pub milliseconds_per_kib: u64,
    /// Memory for any input, in KiB.
    pub memory_kib: u64,
    /// Memory for each byte in addition, in bytes.
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

    /// The maximum number of bytes that are allocated at the same time.
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
    /// The text between semicolons.
    Clauses,
    /// Words, numbers, blanks and signs.
    Words,
    /// Two bytes: in a text, a byte in hexadecimal digits.
    Pairs,
    /// Single bytes.
    Bytes,
}
