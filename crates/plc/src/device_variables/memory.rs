//! The memory of the variables, and its forced bits.

use nx_bus::UnitHeader;

use super::ports::{
    ERROR_TABLE, IO_DATA_ACTIVE, MESSAGE_TABLE, SLAVE_STATUS, STATUS_BYTES, SYSTEM_TABLE_ELEMENTS, UNIT_ERROR,
};
use super::variable::VariableValue;
use crate::nx_bus_function::IoRefreshing;

/// The image that contains a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Area {
    /// From the master to the CPU Unit.
    MToC,
    /// From the CPU Unit to the master.
    CToM,
    /// The statuses of the unit and the NX bus.
    Status,
}

/// The position of a value. A BOOL may be one bit of a byte, all others have whole bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(super) area: Area,
    pub(super) start: usize,
    pub(super) length_bytes: usize,
    /// The bits of each byte that belong to it: all, or one.
    pub(super) mask: u8,
}

impl Place {
    pub(super) const fn whole(area: Area, start: usize, length_bytes: usize) -> Self {
        Self { area, start, length_bytes, mask: 0xFF }
    }

    pub(super) const fn bit(area: Area, start: usize, bit: u8) -> Self {
        Self { area, start: start + bit as usize / 8, length_bytes: 1, mask: 1 << (bit % 8) }
    }

    /// A byte of a value in the form of the memory.
    const fn to_memory(self, byte: u8) -> u8 {
        if self.mask == 0xFF || byte == 0 { byte } else { self.mask }
    }

    /// A byte of memory as a byte of the value.
    const fn to_value(self, byte: u8) -> u8 {
        if self.mask == 0xFF { byte } else { (byte & self.mask != 0) as u8 }
    }
}

/// The three images.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    pub(crate) m_to_c: Image,
    pub(crate) c_to_m: Image,
    pub(crate) status: Image,
}

impl Memory {
    /// Zeros, nothing forced. The default of EtherCAT Slave Status (manual, 6-3-2) is the unit's: it comes with the first
    /// I/O refresh.
    pub(crate) fn new(m_to_c_bytes: usize, c_to_m_bytes: usize) -> Self {
        Self {
            m_to_c: Image::new(m_to_c_bytes),
            c_to_m: Image::new(c_to_m_bytes),
            status: Image::new(STATUS_BYTES),
        }
    }

    /// Stores the report of the unit with this NX Unit number. Forced values are kept. The system-defined
    /// tables end at unit 32: a unit with a higher number has no element in them.
    ///
    /// The data M to C and EtherCAT Slave Status are I/O data: they keep their last values while no I/O is
    /// refreshed. The other statuses come from the NX Bus Function Module, which does not depend on I/O
    /// refreshing (manual, A-3-2).
    pub(crate) fn refresh(
        &mut self,
        unit_number: u8,
        header: UnitHeader,
        refreshing: IoRefreshing,
        m_to_c: &[u8],
    ) {
        let is_active = header.io_data_active && refreshing == IoRefreshing::GoesOn;
        if is_active {
            self.take_io_data(header.status, m_to_c);
        }
        let status = &mut self.status.bytes;
        status[IO_DATA_ACTIVE] = is_active.into();
        status[UNIT_ERROR] = header.error.into();
        // The NX Bus Function Module itself always supports message communications (manual, A-5-1).
        status[MESSAGE_TABLE] = 1;
        status[ERROR_TABLE] = (refreshing == IoRefreshing::Stopped).into();
        if u16::from(unit_number) < SYSTEM_TABLE_ELEMENTS {
            status[MESSAGE_TABLE + usize::from(unit_number)] = header.messages_enabled.into();
            status[ERROR_TABLE + usize::from(unit_number)] = header.error.into();
        }
        self.apply_forced();
    }

    fn take_io_data(&mut self, slave_status: u16, m_to_c: &[u8]) {
        let length_bytes = self.m_to_c.bytes.len().min(m_to_c.len());
        self.m_to_c.bytes[..length_bytes].copy_from_slice(&m_to_c[..length_bytes]);
        self.status.bytes[SLAVE_STATUS..][..2].copy_from_slice(&slave_status.to_le_bytes());
    }

    pub(crate) fn slave_status(&self) -> u16 {
        u16::from_le_bytes([self.status.bytes[SLAVE_STATUS], self.status.bytes[SLAVE_STATUS + 1]])
    }

    pub(crate) fn io_data_active(&self) -> bool {
        self.status.bytes[IO_DATA_ACTIVE] != 0
    }

    pub(crate) fn unit_error(&self) -> bool {
        self.status.bytes[UNIT_ERROR] != 0
    }

    /// Restores the value of all forced bits that have been overwritten.
    pub(crate) fn apply_forced(&mut self) {
        self.m_to_c.apply_forced();
        self.c_to_m.apply_forced();
        self.status.apply_forced();
    }

    /// Copies values and forcing from another memory of the same size.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.m_to_c.copy_from(&other.m_to_c);
        self.c_to_m.copy_from(&other.c_to_m);
        self.status.copy_from(&other.status);
    }

    pub(super) const fn of(&self, area: Area) -> &Image {
        match area {
            Area::MToC => &self.m_to_c,
            Area::CToM => &self.c_to_m,
            Area::Status => &self.status,
        }
    }

    pub(super) const fn of_mut(&mut self, area: Area) -> &mut Image {
        match area {
            Area::MToC => &mut self.m_to_c,
            Area::CToM => &mut self.c_to_m,
            Area::Status => &mut self.status,
        }
    }
}

/// Bytes, and which of their bits are forced to which value.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    pub(crate) bytes: Vec<u8>,
    /// The forced bits.
    forced: Vec<u8>,
    /// Their values; 0 where nothing is forced.
    values: Vec<u8>,
    has_forced: bool,
}

impl Image {
    /// Zeros, nothing forced.
    pub(crate) fn new(size_bytes: usize) -> Self {
        let zeros = vec![0; size_bytes];
        Self { bytes: zeros.clone(), forced: zeros.clone(), values: zeros, has_forced: false }
    }

    fn apply_forced(&mut self) {
        if !self.has_forced {
            return;
        }
        for ((byte, forced), value) in self.bytes.iter_mut().zip(&self.forced).zip(&self.values) {
            *byte = *byte & !forced | value;
        }
    }

    fn copy_from(&mut self, other: &Self) {
        let pairs = [
            (&mut self.bytes, &other.bytes),
            (&mut self.forced, &other.forced),
            (&mut self.values, &other.values),
        ];
        for (own, other) in pairs {
            let length_bytes = own.len().min(other.len());
            own[..length_bytes].copy_from_slice(&other[..length_bytes]);
        }
        self.has_forced = other.has_forced;
    }

    /// Releases everything; the values are kept until they are written or refreshed.
    pub(crate) fn release_all(&mut self) {
        self.apply_forced();
        self.forced.fill(0);
        self.values.fill(0);
        self.has_forced = false;
    }

    /// The value; forced bits have their forced value even after they have been overwritten.
    pub(super) fn read(&self, place: Place) -> VariableValue {
        let bytes = self.bytes.iter().zip(&self.forced).zip(&self.values);
        let own = bytes.skip(place.start).take(place.length_bytes);
        own.map(|((byte, forced), value)| place.to_value(byte & !forced | value)).collect()
    }

    /// Writes the bits that are not forced. Excess bytes are ignored.
    pub(super) fn write(&mut self, place: Place, value: &[u8]) {
        let bytes = self.bytes.iter_mut().zip(&self.forced).skip(place.start).take(place.length_bytes);
        for ((byte, forced), new) in bytes.zip(value) {
            let mask = place.mask & !forced;
            *byte = *byte & !mask | place.to_memory(*new) & mask;
        }
    }

    /// Forces the value. Excess bytes are ignored.
    pub(super) fn force(&mut self, place: Place, value: &[u8]) {
        let bits = self.forced.iter_mut().zip(&mut self.values).skip(place.start).take(place.length_bytes);
        for ((forced, fixed), new) in bits.zip(value) {
            *forced |= place.mask;
            *fixed = *fixed & !place.mask | place.to_memory(*new) & place.mask;
        }
        self.has_forced = true;
        self.apply_forced();
    }

    /// Releases the value; it is kept until it is written or refreshed.
    pub(super) fn release(&mut self, place: Place) {
        self.apply_forced();
        let bits = self.forced.iter_mut().zip(&mut self.values).skip(place.start).take(place.length_bytes);
        for (forced, fixed) in bits {
            *forced &= !place.mask;
            *fixed &= !place.mask;
        }
        self.has_forced = self.forced.iter().any(|&forced| forced != 0);
    }

    /// Whether all of it is forced.
    pub(super) fn is_forced(&self, place: Place) -> bool {
        let mut own = self.forced.iter().skip(place.start).take(place.length_bytes);
        own.all(|forced| forced & place.mask == place.mask)
    }
}
