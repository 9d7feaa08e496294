//! The NX bus between the unit and the CPU Unit: the connection of two threads.
//!
//! Each direction is a [`ProcessImage`] in a triple buffer: wait-free on both sides, always consistent, and the
//! reader gets the newest complete image. Writer and reader are two types, and each exists once. In addition
//! there are the NX messages, in two queues for which neither end waits.

mod messages;

use time::Duration;

use crate::allocation::{ImageLayout, IoAllocation};
use crate::data_sets::Direction;
use crate::status::SlaveStatus;

pub use messages::{
    CpuMessages, NotSent, NxMessageError, NxRequest, NxResponse, NxValue, REQUESTS_MAX, UnitMessages,
};

/// A process image and its header.
#[derive(Clone, Debug)]
pub struct ProcessImage<H> {
    /// The information sent with the data.
    pub header: H,
    bytes: Vec<u8>,
}

impl<H: Clone + Send> ProcessImage<H> {
    /// Two ends of an image of `size_bytes` zeros. All the memory that they ever use is allocated here.
    #[must_use]
    pub fn split(header: H, size_bytes: usize) -> (ProcessImageWriter<H>, ProcessImageReader<H>) {
        let (input, output) = triple_buffer::triple_buffer(&Self { header, bytes: vec![0; size_bytes] });
        (ProcessImageWriter(input), ProcessImageReader(output))
    }

    /// The data, with the length of the image.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// The end that writes an image.
#[derive(Debug)]
pub struct ProcessImageWriter<H: Send>(triple_buffer::Input<ProcessImage<H>>);

impl<H: Send> ProcessImageWriter<H> {
    /// Publishes a complete image. Excess bytes of `bytes` are ignored, missing bytes keep an older value: both
    /// ends are made for one size.
    pub fn publish(&mut self, header: H, bytes: &[u8]) {
        let image = self.0.input_buffer_mut();
        image.header = header;
        let length_bytes = image.bytes.len().min(bytes.len());
        image.bytes[..length_bytes].copy_from_slice(&bytes[..length_bytes]);
        self.0.publish();
    }
}

/// The end that reads an image.
#[derive(Debug)]
pub struct ProcessImageReader<H: Send>(triple_buffer::Output<ProcessImage<H>>);

impl<H: Send> ProcessImageReader<H> {
    /// The newest complete image; the initial one if none has been published yet.
    pub fn newest(&mut self) -> &ProcessImage<H> {
        self.0.read()
    }
}

/// The information from the unit to the CPU Unit, sent with the data M to C.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UnitHeader {
    /// EtherCAT Slave Status, NX object 6003:01.
    pub status: SlaveStatus,
    /// NX Unit I/O Data Active Status: the unit refreshes, its I/O data can be used for control.
    pub io_data_active: bool,
    /// NX Unit Error Status: the unit has an error.
    pub error: bool,
    /// The unit supports NX message communications.
    pub messages_enabled: bool,
    /// The unit has an error for which the fail-soft operation of the NX bus determines the reaction (manual, 8-3-4).
    pub fail_soft_error: bool,
    /// The last [`CpuHeader::error_resets`] that it has completed.
    pub error_resets: u32,
}

/// The information from the CPU Unit to the unit, sent with the data C to M.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CpuHeader {
    /// The CPU Unit does I/O refreshing.
    pub refreshing: bool,
    /// The CPU Unit does NX message communications with the unit.
    pub messages_enabled: bool,
    /// The NX Bus Function Module has stopped I/O refreshing because of an error: no data is exchanged, but
    /// that is not an I/O communications error of the unit.
    pub io_stopped: bool,
    /// Number of error resets in the NX Bus Function Module; with each the unit resets its errors too. It wraps.
    pub error_resets: u32,
    /// Number of task periods of the primary periodic task, from 1. It wraps. If it does not change any more,
    /// the task has stopped.
    pub task_periods: u32,
    /// Period of the primary periodic task; zero: not known, and the unit does not monitor the task.
    pub task_period: Duration,
    /// System time of the CPU Unit in nanoseconds since 1970-01-01 00:00:00; 0 if it has none.
    pub system_time_ns: u64,
}

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
    /// The positions of the entries in it.
    pub m_to_c_layout: ImageLayout,
    /// Data from the CPU Unit to the master.
    pub c_to_m: ProcessImageWriter<CpuHeader>,
    /// The positions of the entries in it.
    pub c_to_m_layout: ImageLayout,
    /// NX messages.
    pub messages: CpuMessages,
}

/// The NX bus of one unit with this I/O allocation.
#[must_use]
pub fn connect(allocation: &IoAllocation) -> (UnitEnd, CpuEnd) {
    let m_to_c_layout = allocation.layout(Direction::MToC);
    let c_to_m_layout = allocation.layout(Direction::CToM);
    let (unit_writes, cpu_reads) = ProcessImage::split(UnitHeader::default(), m_to_c_layout.size_bytes());
    let (cpu_writes, unit_reads) = ProcessImage::split(CpuHeader::default(), c_to_m_layout.size_bytes());
    let (unit_answers, messages) = messages::connect();
    let unit = UnitEnd { m_to_c: unit_writes, c_to_m: unit_reads, messages: unit_answers };
    (unit, CpuEnd { m_to_c: cpu_reads, m_to_c_layout, c_to_m: cpu_writes, c_to_m_layout, messages })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reader_gets_the_newest_whole_image() {
        let (mut writer, mut reader) = ProcessImage::split(0, 4);
        assert_eq!((reader.newest().header, reader.newest().bytes()), (0, &[0; 4][..]));
        for generation in 1..=5u8 {
            writer.publish(i32::from(generation), &[generation; 4]);
        }
        assert_eq!((reader.newest().header, reader.newest().bytes()), (5, &[5; 4][..]));
        assert_eq!(reader.newest().header, 5, "without a new image the last one stays");
    }

    #[test]
    fn an_image_is_never_torn_between_threads() {
        let (mut writer, mut reader) = ProcessImage::split(0u8, 1200);
        let writing = std::thread::spawn(move || {
            for generation in 0..20_000u32 {
                let value = (generation % 251) as u8;
                writer.publish(value, &[value; 1200]);
            }
        });
        while !writing.is_finished() {
            let image = reader.newest();
            assert!(image.bytes().iter().all(|&byte| byte == image.header));
        }
        writing.join().expect("the writer ends");
    }

    #[test]
    fn a_bus_starts_with_defaults_on_both_ends() {
        let (mut unit, mut cpu) = connect(&IoAllocation::factory());
        assert_eq!(unit.c_to_m.newest().bytes(), [0; 180]);
        assert!(!unit.c_to_m.newest().header.refreshing);
        assert_eq!(cpu.m_to_c.newest().bytes(), [0; 180]);
        assert_eq!(cpu.m_to_c.newest().header.status.bits(), 0x0200);
    }
}
