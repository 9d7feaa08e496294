//! The memory of the variables, and its forced bits.

use nx_bus::UnitHeader;
use variables::{Area, Place, STATUS_BYTES, StatusWord, VariableTable, VariableValue};

use super::ports::{
    CPU_UNIT_BYTES, ERROR_TABLE, IO_DATA_ACTIVE, MESSAGE_TABLE, SYSTEM_TABLE_ELEMENTS, UNIT_ERROR,
};
use crate::nx_bus_function::IoRefreshing;

/// The images of all areas.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    pub(crate) m_to_c: Image,
    pub(crate) c_to_m: Image,
    status: Image,
    cpu_unit: Image,
    /// What its bits mean.
    status_word: StatusWord,
    /// Bits of at least one image are forced: mostly none are, and no image is looked at.
    has_forced: bool,
}

impl Memory {
    /// Zeros, nothing forced. The first value of the status word is the unit's: it comes with the first I/O refresh.
    pub(crate) fn new(table: &VariableTable) -> Self {
        let unit = table.unit();
        Self {
            m_to_c: Image::new(unit.m_to_c_bytes),
            c_to_m: Image::new(unit.c_to_m_bytes),
            status: Image::new(STATUS_BYTES),
            cpu_unit: Image::new(CPU_UNIT_BYTES),
            status_word: unit.status,
            has_forced: false,
        }
    }

    /// Stores the report of the unit with this NX Unit number. Forced values are kept. The system-defined
    /// tables end at unit 32: a unit with a higher number has no element in them.
    ///
    /// The data M to C and the status word are I/O data: they keep their last values while no I/O is refreshed.
    /// The rest comes from the NX Bus Function Module, which needs no I/O refreshing (manual, A-3-2).
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
        let cpu_unit = &mut self.cpu_unit.bytes;
        cpu_unit[IO_DATA_ACTIVE] = is_active.into();
        cpu_unit[UNIT_ERROR] = header.error.into();
        // The NX Bus Function Module itself can always be asked (manual, A-5-1).
        cpu_unit[MESSAGE_TABLE] = 1;
        cpu_unit[ERROR_TABLE] = (refreshing == IoRefreshing::Stopped).into();
        if u16::from(unit_number) < SYSTEM_TABLE_ELEMENTS {
            cpu_unit[MESSAGE_TABLE + usize::from(unit_number)] = header.messages_enabled.into();
            cpu_unit[ERROR_TABLE + usize::from(unit_number)] = header.error.into();
        }
        self.apply_forced();
    }

    fn take_io_data(&mut self, status: u16, m_to_c: &[u8]) {
        let length_bytes = self.m_to_c.bytes.len().min(m_to_c.len());
        self.m_to_c.bytes[..length_bytes].copy_from_slice(&m_to_c[..length_bytes]);
        self.status.bytes.copy_from_slice(&status.to_le_bytes());
    }

    /// The status word of the unit.
    pub(crate) fn status(&self) -> u16 {
        u16::from_le_bytes([self.status.bytes[0], self.status.bytes[1]])
    }

    /// Whether the data of an area is valid by the status word.
    pub(crate) fn is_data_valid(&self, area: Area) -> bool {
        self.status_word.allows(area, self.status())
    }

    pub(crate) fn io_data_active(&self) -> bool {
        self.cpu_unit.bytes[IO_DATA_ACTIVE] != 0
    }

    pub(crate) fn unit_error(&self) -> bool {
        self.cpu_unit.bytes[UNIT_ERROR] != 0
    }

    /// Copies a value M to C to another one of the same type C to M. Forced bits are restored by the caller.
    pub(crate) fn copy_to_master(&mut self, from: Place, to: Place) {
        let source = &self.m_to_c.bytes[from.start..][..from.length_bytes];
        let target = &mut self.c_to_m.bytes[to.start..][..to.length_bytes];
        if from.bit_number().is_none() && to.bit_number().is_none() {
            return target.copy_from_slice(source);
        }
        for (byte, source) in target.iter_mut().zip(source) {
            *byte = *byte & !to.mask() | to.to_memory(from.to_value(*source)) & to.mask();
        }
    }

    /// Restores the value of all forced bits that have been overwritten.
    pub(crate) fn apply_forced(&mut self) {
        if self.has_forced {
            self.images_mut().into_iter().for_each(Image::apply_forced);
        }
    }

    /// Writes the bits of a place that are not forced. Excess bytes are ignored.
    pub(super) fn write(&mut self, place: Place, value: &[u8]) {
        self.of_mut(place.area).write(place, value);
    }

    /// Forces a place. Excess bytes are ignored.
    pub(super) fn force(&mut self, place: Place, value: &[u8]) {
        self.of_mut(place.area).force(place, value);
        self.has_forced = true;
    }

    /// Releases a place; it keeps its value until it is written or refreshed.
    pub(super) fn release(&mut self, place: Place) {
        self.of_mut(place.area).release(place);
        self.has_forced = self.images_mut().iter().any(|image| image.has_forced());
    }

    /// Releases everything that is forced.
    pub(crate) fn release_all(&mut self) {
        self.images_mut().into_iter().for_each(Image::release_all);
        self.has_forced = false;
    }

    const fn images_mut(&mut self) -> [&mut Image; 4] {
        [&mut self.m_to_c, &mut self.c_to_m, &mut self.status, &mut self.cpu_unit]
    }

    /// Copies values and forcing from another memory of the same size.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.m_to_c.copy_from(&other.m_to_c);
        self.c_to_m.copy_from(&other.c_to_m);
        self.status.copy_from(&other.status);
        self.cpu_unit.copy_from(&other.cpu_unit);
        self.has_forced = other.has_forced;
    }

    pub(super) const fn of(&self, area: Area) -> &Image {
        match area {
            Area::MToC => &self.m_to_c,
            Area::CToM => &self.c_to_m,
            Area::Status => &self.status,
            Area::CpuUnit => &self.cpu_unit,
        }
    }

    const fn of_mut(&mut self, area: Area) -> &mut Image {
        match area {
            Area::MToC => &mut self.m_to_c,
            Area::CToM => &mut self.c_to_m,
            Area::Status => &mut self.status,
            Area::CpuUnit => &mut self.cpu_unit,
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
}

impl Image {
    /// Zeros, nothing forced.
    pub(crate) fn new(size_bytes: usize) -> Self {
        let zeros = vec![0; size_bytes];
        Self { bytes: zeros.clone(), forced: zeros.clone(), values: zeros }
    }

    fn apply_forced(&mut self) {
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
    }

    /// Frees everything; it stays until it is written or refreshed.
    fn release_all(&mut self) {
        self.apply_forced();
        self.forced.fill(0);
        self.values.fill(0);
    }

    /// The value; forced bits have their forced value even after they have been overwritten.
    pub(super) fn read(&self, place: Place) -> VariableValue {
        let bytes = self.bytes.iter().zip(&self.forced).zip(&self.values);
        let own = bytes.skip(place.start).take(place.length_bytes);
        own.map(|((byte, forced), value)| place.to_value(byte & !forced | value)).collect()
    }

    /// Writes the bits that are not forced. Excess bytes are ignored.
    fn write(&mut self, place: Place, value: &[u8]) {
        let bytes = self.bytes.iter_mut().zip(&self.forced).skip(place.start).take(place.length_bytes);
        for ((byte, forced), new) in bytes.zip(value) {
            let mask = place.mask() & !forced;
            *byte = *byte & !mask | place.to_memory(*new) & mask;
        }
    }

    /// Forces the value. Excess bytes are ignored.
    fn force(&mut self, place: Place, value: &[u8]) {
        let bits = self.forced.iter_mut().zip(&mut self.values).skip(place.start).take(place.length_bytes);
        for ((forced, fixed), new) in bits.zip(value) {
            *forced |= place.mask();
            *fixed = *fixed & !place.mask() | place.to_memory(*new) & place.mask();
        }
        self.apply_forced();
    }

    /// Releases the value; it is kept until it is written or refreshed.
    fn release(&mut self, place: Place) {
        self.apply_forced();
        let bits = self.forced.iter_mut().zip(&mut self.values).skip(place.start).take(place.length_bytes);
        for (forced, fixed) in bits {
            *forced &= !place.mask();
            *fixed &= !place.mask();
        }
    }

    fn has_forced(&self) -> bool {
        self.forced.iter().any(|&forced| forced != 0)
    }

    /// Whether all of it is forced.
    pub(super) fn is_forced(&self, place: Place) -> bool {
        let mut own = self.forced.iter().skip(place.start).take(place.length_bytes);
        own.all(|forced| forced & place.mask() == place.mask())
    }
}
