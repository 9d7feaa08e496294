//! Reading and writing registers: the simplest dialogues.

use crate::access::{Access, Answer, Dialogue, Patience, Progress};

/// Reads bytes until a slave answers.
#[derive(Clone, Debug)]
pub struct RegisterRead {
    offset: u16,
    length_bytes: u16,
    data: Vec<u8>,
}

impl RegisterRead {
    /// Reads this number of bytes from `offset` on.
    #[must_use]
    pub const fn new(offset: u16, length_bytes: u16) -> Self {
        Self { offset, length_bytes, data: Vec::new() }
    }

    /// The data read; empty before the answer.
    #[must_use]
    pub fn data(&self) -> &[u8] {
        &self.data
    }

    /// The data read.
    #[must_use]
    pub fn into_data(self) -> Vec<u8> {
        self.data
    }
}

impl Dialogue for RegisterRead {
    fn access(&self) -> Access<'_> {
        Access::Read { offset: self.offset, length_bytes: self.length_bytes }
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        let Some(answer) = answer else { return Progress::Next };
        let Some(data) = answer.taken() else { return Progress::Later };
        self.data = data.to_vec();
        Progress::Done
    }

    fn patience(&self) -> Patience {
        Patience::Access
    }
}

/// Writes bytes until a slave accepts them.
#[derive(Clone, Debug)]
pub struct RegisterWrite {
    offset: u16,
    data: Vec<u8>,
}

impl RegisterWrite {
    /// Writes these bytes from `offset` on.
    #[must_use]
    pub const fn new(offset: u16, data: Vec<u8>) -> Self {
        Self { offset, data }
    }
}

impl Dialogue for RegisterWrite {
    fn access(&self) -> Access<'_> {
        Access::Write { offset: self.offset, data: &self.data }
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        match answer {
            None => Progress::Next,
            Some(Answer { working_counter: 0, .. }) => Progress::Later,
            Some(_) => Progress::Done,
        }
    }

    fn patience(&self) -> Patience {
        Patience::Access
    }
}
