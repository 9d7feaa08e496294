//! The copy program of the manual's example: it returns the data of the master.

use crate::io::Io;
use crate::program::Program;

/// Copies every entry M to C to the same entry C to M, while the I/O data can be used and the data of both
/// directions are valid. The manual's program also stops at NX Unit Error Status; this one does not, so that
/// data sets with different sizes show the part that is exchanged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Echo;

impl Program for Echo {
    fn scan(&mut self, io: &mut Io) {
        if !(io.io_data_active() && io.is_data_valid()) {
            return;
        }
        io.copy_twins();
    }
}
