//! The NX bus between a unit and its CPU Unit: the connection of two threads.
//!
//! Each direction is a [`ProcessImage`] in a triple buffer: wait-free on both sides, always consistent, and the
//! reader gets the newest complete image. Writer and reader are two types, and each exists once. In addition
//! there are the NX messages, in two queues for which neither end waits. The meaning of the bytes of an image is
//! defined by the unit.

mod headers;
mod image;
mod messages;
mod slave_status;

pub use headers::{CpuHeader, UnitHeader};
pub use image::{ProcessImage, ProcessImageReader, ProcessImageWriter};
pub use messages::{
    CpuMessages, NotSent, NxMessageError, NxRequest, NxResponse, NxValue, REQUESTS_MAX, UnitMessages,
    VALUE_BYTES_MAX,
};
pub use slave_status::SlaveStatus;

/// The unit's end of the NX bus.
#[derive(Debug)]
pub struct UnitEnd {
    /// Data from the master to the CPU Unit.
    pub m_to_c: ProcessImageWriter<UnitHeader>,
    /// Data from the CPU Unit to the master.
    pub c_to_m: ProcessImageReader<CpuHeader>,
    /// NX messages.
    pub messages: UnitMessages,
}

/// The CPU Unit's end of the NX bus.
#[derive(Debug)]
pub struct CpuEnd {
    /// Data from the master to the CPU Unit.
    pub m_to_c: ProcessImageReader<UnitHeader>,
    /// Data from the CPU Unit to the master.
    pub c_to_m: ProcessImageWriter<CpuHeader>,
    /// NX messages.
    pub messages: CpuMessages,
}

/// The NX bus of one unit whose images have these sizes.
#[must_use]
pub fn connect(m_to_c_bytes: usize, c_to_m_bytes: usize) -> (UnitEnd, CpuEnd) {
    let (unit_writes, cpu_reads) = ProcessImage::split(UnitHeader::default(), m_to_c_bytes);
    let (cpu_writes, unit_reads) = ProcessImage::split(CpuHeader::default(), c_to_m_bytes);
    let (unit_answers, messages) = messages::connect();
    let unit = UnitEnd { m_to_c: unit_writes, c_to_m: unit_reads, messages: unit_answers };
    (unit, CpuEnd { m_to_c: cpu_reads, c_to_m: cpu_writes, messages })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bus_starts_with_zeros_and_without_refreshing_on_both_ends() {
        let (mut unit, mut cpu) = connect(180, 20);
        assert_eq!(unit.c_to_m.newest().bytes(), [0; 20]);
        assert!(!unit.c_to_m.newest().header.refreshing);
        assert_eq!(cpu.m_to_c.newest().bytes(), [0; 180]);
        assert!(!cpu.m_to_c.newest().header.io_data_active);
    }
}
