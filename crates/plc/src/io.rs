//! The I/O of one unit for a program: its entries by data set, its status, the raw images, and the time.

use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;

use nx_bus::{SlaveStatus, UnitHeader};
use time::Instant;
use variables::{Area, Place, VariableTable};

use crate::cpu_event::{CpuEvent, CpuEventLog};
use crate::device_variables::{DeviceVariables, Memory};
use crate::nx_bus_function::{IoRefreshing, NxBusReset};
use crate::nx_object_client::NxObjectClient;
use crate::observed_events::ObservedEvents;
use crate::program_event::ProgramEvent;
use crate::scan_watch::ScanWatch;

/// The series of units that exchange arrays and numbers with their master.
const UINTS: &str = "UINTs";
const BYTES: &str = "BYTES";
const UDINT: &str = "UDINT";

/// The I/O of one unit from the last I/O refresh, and the outputs for the next one.
#[derive(Clone, Debug)]
pub struct Io {
    pub(crate) memory: Memory,
    pub(crate) variables: DeviceVariables,
    pub(crate) nx_objects: NxObjectClient,
    /// The positions of the entries that exist in both directions.
    twins: Vec<(Place, Place)>,
    pub(crate) events: CpuEventLog,
    /// The same for an observer, if there is one.
    pub(crate) observed: Option<ObservedEvents>,
    /// The reports of programs since the end of the last task period.
    pub(crate) program_reports: CpuEventLog,
    /// Start of the task period, counted from power-on.
    now: Instant,
    system_time_ns: Option<u64>,
    pub(crate) nx_bus_reset: NxBusReset,
    /// Number of times that the CPU Unit was powered on again. It wraps.
    power_cycles: u32,
    /// The running program has reported that it stops.
    has_stopped: bool,
    /// The owner of the CPU Unit sets it to end a scan early.
    pub(crate) switch_off: Arc<AtomicBool>,
    /// Another thread ends one scan by it, so that another program can be loaded.
    pub(crate) scan: Arc<ScanWatch>,
}

impl Io {
    pub(crate) fn new(variables: DeviceVariables) -> Self {
        let mut io = Self {
            memory: Memory::new(&variables),
            nx_objects: NxObjectClient::default(),
            twins: twins(&variables),
            variables,
            events: CpuEventLog::new(),
            observed: None,
            program_reports: CpuEventLog::new(),
            now: Instant::ZERO,
            system_time_ns: None,
            nx_bus_reset: NxBusReset::None,
            power_cycles: 0,
            has_stopped: false,
            switch_off: Arc::default(),
            scan: Arc::default(),
        };
        io.take_inputs(UnitHeader::default(), IoRefreshing::GoesOn, &[]);
        io
    }

    /// UINTs `number` M to C, 1 to 40; none if it is not allocated.
    #[must_use]
    pub fn uints(&self, number: u8) -> Option<[u16; 15]> {
        let entry = self.entry(UINTS, number)?;
        let mut elements = [0; 15];
        for (element, octets) in elements.iter_mut().zip(entry.chunks_exact(2)) {
            *element = u16::from_le_bytes(octets.try_into().ok()?);
        }
        Some(elements)
    }

    /// BYTES `number` M to C, 1 to 10; none if it is not allocated.
    #[must_use]
    pub fn bytes(&self, number: u8) -> Option<[u8; 10]> {
        self.entry(BYTES, number)?.try_into().ok()
    }

    /// UDINT `number` M to C, 1 to 32; none if it is not allocated.
    #[must_use]
    pub fn udint(&self, number: u8) -> Option<u32> {
        self.entry(UDINT, number)?.try_into().map(u32::from_le_bytes).ok()
    }

    /// Sets UINTs `number` C to M, 1 to 40; false if it is not allocated.
    pub fn set_uints(&mut self, number: u8, elements: [u16; 15]) -> bool {
        let Some(entry) = self.entry_mut(UINTS, number) else { return false };
        for (octets, element) in entry.chunks_exact_mut(2).zip(elements) {
            octets.copy_from_slice(&element.to_le_bytes());
        }
        true
    }

    /// Sets BYTES `number` C to M, 1 to 10; false if it is not allocated.
    pub fn set_bytes(&mut self, number: u8, elements: [u8; 10]) -> bool {
        self.set_entry(BYTES, number, &elements)
    }

    /// Sets UDINT `number` C to M, 1 to 32; false if it is not allocated.
    pub fn set_udint(&mut self, number: u8, value: u32) -> bool {
        self.set_entry(UDINT, number, &value.to_le_bytes())
    }

    /// The raw bytes of entry `number` of a series M to C, little endian, such as entry 1 of `UINTs`; none if the unit has
    /// no such entry, or if it is a single bit.
    #[must_use]
    pub fn entry(&self, series: &str, number: u8) -> Option<&[u8]> {
        let place = self.whole_entry(Area::MToC, series, number)?;
        self.memory.m_to_c.bytes.get(place.start..place.start + place.length_bytes)
    }

    /// The raw bytes of entry `number` of a series C to M, little endian; none if the unit has no such entry, or if it is
    /// a single bit.
    #[must_use]
    pub fn entry_mut(&mut self, series: &str, number: u8) -> Option<&mut [u8]> {
        let place = self.whole_entry(Area::CToM, series, number)?;
        self.memory.c_to_m.bytes.get_mut(place.start..place.start + place.length_bytes)
    }

    /// The whole image M to C, entry after entry.
    #[must_use]
    pub fn m_to_c(&self) -> &[u8] {
        &self.memory.m_to_c.bytes
    }

    /// The whole image C to M, entry after entry.
    #[must_use]
    pub fn c_to_m(&self) -> &[u8] {
        &self.memory.c_to_m.bytes
    }

    /// The whole image C to M, for changes. Forced values are restored before it is sent.
    #[must_use]
    pub fn c_to_m_mut(&mut self) -> &mut [u8] {
        &mut self.memory.c_to_m.bytes
    }

    /// Reads and writes NX objects of the unit.
    #[must_use]
    pub const fn nx_objects(&mut self) -> &mut NxObjectClient {
        &mut self.nx_objects
    }

    /// Start of this task period, counted from power-on of the CPU Unit: constant during a scan.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.now
    }

    /// The system time at the start of this task period, in nanoseconds since 1970-01-01 00:00:00; none if the
    /// CPU Unit has none.
    #[must_use]
    pub const fn system_time_ns(&self) -> Option<u64> {
        self.system_time_ns
    }

    /// Reports an event of a program to the owner of the CPU Unit ([`crate::CpuUnit::take_events`]). A program
    /// that reports [`ProgramEvent::Stopped`] does not run until it is started again.
    pub fn report(&mut self, event: ProgramEvent) {
        self.has_stopped |= matches!(event, ProgramEvent::Stopped(_));
        let event = CpuEvent::Program(event);
        self.program_reports.add(self.now, event.clone());
        self.log(event);
    }

    /// Resets the errors of the NX Bus Function Module and, with its next refresh, those of the unit, as
    /// [`crate::CpuUnit::reset_errors`] does.
    pub const fn reset_nx_bus(&mut self) {
        self.nx_bus_reset = NxBusReset::Asked;
    }

    /// The status word of the unit, as an EtherCAT slave unit means it.
    #[must_use]
    pub fn status(&self) -> SlaveStatus {
        SlaveStatus::from_bits(self.memory.status())
    }

    /// Whether the unit says that the data of both directions is valid.
    #[must_use]
    pub fn is_data_valid(&self) -> bool {
        [Area::MToC, Area::CToM].into_iter().all(|area| self.memory.is_data_valid(area))
    }

    /// NX Unit I/O Data Active Status: the unit's I/O data can be used for control.
    #[must_use]
    pub fn io_data_active(&self) -> bool {
        self.memory.io_data_active()
    }

    /// NX Unit Error Status: the unit has an error.
    #[must_use]
    pub fn unit_error(&self) -> bool {
        self.memory.unit_error()
    }

    /// Whether the scan must end immediately, because the CPU Unit is switched off, or another program waits for one
    /// that does not return. A program whose scan can be long checks this about once a millisecond.
    #[must_use]
    pub fn ends_scan(&self) -> bool {
        self.switch_off.load(Ordering::Relaxed) || self.scan.is_to_end()
    }

    /// Stores the data and statuses of the unit; forced values are kept.
    pub(crate) fn take_inputs(&mut self, header: UnitHeader, refreshing: IoRefreshing, m_to_c: &[u8]) {
        self.memory.refresh(self.variables.unit_number(), header, refreshing, m_to_c);
    }

    /// The CPU Unit is powered on again: all values are initialized, and nothing is forced. NX object calls are
    /// kept: a program drops its own when it starts or ends, if it has no use for them, and outside runtimes still wait
    /// for theirs.
    pub(crate) fn power_on(&mut self) {
        self.memory = Memory::new(&self.variables);
        self.power_cycles = self.power_cycles.wrapping_add(1);
        self.nx_bus_reset = NxBusReset::None;
        self.now = Instant::ZERO;
        self.take_inputs(UnitHeader::default(), IoRefreshing::GoesOn, &[]);
    }

    /// Another number after each power-on: for what begins again with it.
    pub(crate) const fn power_cycles(&self) -> u32 {
        self.power_cycles
    }

    /// A task period begins, at this time after power-on.
    pub(crate) const fn begin_period(&mut self, now: Instant, system_time_ns: Option<u64>) {
        self.now = now;
        self.system_time_ns = system_time_ns;
    }

    /// Whether the executed program has reported that it stops.
    pub(crate) const fn take_stop(&mut self) -> bool {
        core::mem::replace(&mut self.has_stopped, false)
    }

    pub(crate) fn log(&mut self, event: CpuEvent) {
        if let Some(observed) = &mut self.observed {
            observed.log_mut().add(self.now, event.clone());
        }
        self.events.add(self.now, event);
    }

    /// Copies every entry M to C to the same entry C to M.
    pub(crate) fn copy_twins(&mut self) {
        for &(from, to) in &self.twins {
            self.memory.copy_to_master(from, to);
        }
    }

    fn set_entry(&mut self, series: &str, number: u8, value: &[u8]) -> bool {
        let Some(entry) = self.entry_mut(series, number) else { return false };
        let is_fitting = entry.len() == value.len();
        if is_fitting {
            entry.copy_from_slice(value);
        }
        is_fitting
    }

    fn whole_entry(&self, area: Area, series: &str, number: u8) -> Option<Place> {
        let (_, variable) = self.variables.entry(area, series, number)?;
        Some(variable.place).filter(|place| place.bit_number().is_none())
    }
}

/// The positions of the entries that exist in both directions, by series and number.
fn twins(table: &VariableTable) -> Vec<(Place, Place)> {
    let entries = table.iter().filter(|(_, variable)| variable.place.area == Area::MToC);
    let twins = entries.filter_map(|(_, from)| {
        let series = from.series?;
        let (_, to) = table.entry(Area::CToM, series.name, series.number)?;
        (from.variable_type == to.variable_type).then_some((from.place, to.place))
    });
    twins.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nx_ect101::{DataSetKind, Direction, IoAllocation, variable_table};

    fn io() -> Io {
        let mut allocation = IoAllocation::factory();
        for direction in [Direction::MToC, Direction::CToM] {
            allocation.select(direction, DataSetKind::Bytes, 2);
            allocation.select(direction, DataSetKind::Udint, 4);
        }
        Io::new(DeviceVariables::of(variable_table("N1", 1, &allocation)))
    }

    #[test]
    fn entries_are_read_where_they_lie() {
        let mut io = io();
        io.memory.m_to_c.bytes[30..34].copy_from_slice(&[0x34, 0x12, 0x78, 0x56]);
        io.memory.m_to_c.bytes[180] = 0xAB;
        io.memory.m_to_c.bytes[204..208].copy_from_slice(&0xDEAD_BEEF_u32.to_le_bytes());
        assert_eq!(io.uints(2).expect("allocated")[..2], [0x1234, 0x5678]);
        assert_eq!(io.bytes(1).expect("allocated")[0], 0xAB);
        assert_eq!(io.udint(2), Some(0xDEAD_BEEF));
    }

    #[test]
    fn entries_are_written_where_they_lie() {
        let mut io = io();
        assert!(io.set_uints(6, [0x0102; 15]) && io.set_bytes(2, [7; 10]) && io.set_udint(4, 0x0304_0506));
        let expected =
            [vec![0; 150], [2, 1].repeat(15), vec![0; 10], vec![7; 10], vec![0; 12], vec![6, 5, 4, 3]];
        assert_eq!(io.c_to_m(), expected.concat());
    }

    #[test]
    fn what_is_not_allocated_is_not_there() {
        let mut io = io();
        assert_eq!((io.uints(0), io.uints(7), io.bytes(3), io.udint(5)), (None, None, None, None));
        assert!(!io.set_uints(7, [0; 15]) && !io.set_bytes(0, [0; 10]) && !io.set_udint(33, 0));
    }
}
