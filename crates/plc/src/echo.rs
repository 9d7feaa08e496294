//! The copy program of the manual's example: what the master sends comes back.

use crate::io::Io;
use crate::program::Program;

/// Copies every entry M to C to the same entry C to M, as long as the I/O data can be used and the data of both
/// directions is valid. The manual's program stops at NX Unit Error Status too; this one does not, so that data
/// sets whose sizes do not match show what is exchanged of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Echo;

impl Program for Echo {
    fn scan(&mut self, io: &mut Io) {
        let usable = io.io_data_active();
        if !(usable && io.status().m_to_c_valid && io.status().c_to_m_valid) {
            return;
        }
        io.copy_twins();
    }
}
