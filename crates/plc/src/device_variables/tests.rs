//! The list of variables and their memory.

mod list;
mod terminal;

use nx_ect101::{DataSetKind, Direction, IoAllocation, variable_table};

use crate::device_variables::DeviceVariables;
use crate::io::Io;

/// An allocation of this number of 15 UINT, 10 BYTE and UDINT entries in each direction.
fn allocation(m_to_c: [u8; 3], c_to_m: [u8; 3]) -> IoAllocation {
    let mut allocation = IoAllocation::empty();
    for (direction, counts) in [(Direction::MToC, m_to_c), (Direction::CToM, c_to_m)] {
        for (kind, count) in DataSetKind::ALL.into_iter().zip(counts) {
            allocation.select(direction, kind, count);
        }
    }
    allocation
}

fn io_of(allocation: &IoAllocation) -> Io {
    Io::new(DeviceVariables::of(variable_table("N1", 1, allocation)))
}
