//! The pulse program of the manual's example: while the pulse is received, the CPU Unit is in RUN mode.

use crate::io::Io;
use crate::program::Program;

/// Counts up in the first byte C to M by one in every task period. In PROGRAM mode the count stops, which a
/// master detects when it has not changed for longer than the I/O response time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pulse;

impl Program for Pulse {
    fn scan(&mut self, io: &mut Io) {
        if let Some(first) = io.c_to_m_mut().first_mut() {
            *first = first.wrapping_add(1);
        }
    }
}
