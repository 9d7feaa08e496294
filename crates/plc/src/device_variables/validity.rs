//! Whether a value can be used for control.

use nx_bus::SlaveStatus;
use nx_ect101::Direction;

use super::error::VariableError;
use super::list::DeviceVariables;
use super::memory::Memory;
use super::ports::VariableSource;
use super::variable::VariableId;
use crate::io::Io;

/// Whether a value can be used for control, and if not, why: the conditions of the manual's A-3-2, in the order
/// in which its program checks them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Validity {
    /// It can be used.
    Valid,
    /// NX Unit I/O Data Active Status is FALSE: the unit does not refresh its I/O.
    IoDataNotActive,
    /// NX Unit Error Status is TRUE.
    UnitError,
    /// Data from EtherCAT Master to CPU Unit Valid, or the same for the other direction, is FALSE.
    DataNotValid,
}

impl Io {
    /// Whether the value of a variable can be used for control, according to the statuses that the user program
    /// sees. An I/O entry depends on all three conditions, EtherCAT Slave Status on the first two; statuses of
    /// the NX Bus Function Module are always valid.
    ///
    /// # Errors
    /// There is no such variable.
    pub fn validity(&self, id: VariableId) -> Result<Validity, VariableError> {
        self.memory.validity(&self.variables, id)
    }
}

impl Memory {
    pub(crate) fn validity(
        &self,
        variables: &DeviceVariables,
        id: VariableId,
    ) -> Result<Validity, VariableError> {
        let status = SlaveStatus::from_bits(self.slave_status());
        let data_valid = match variables.at(id)?.source {
            VariableSource::Entry { direction: Direction::MToC, .. } => status.m_to_c_valid,
            VariableSource::Entry { direction: Direction::CToM, .. } => status.c_to_m_valid,
            VariableSource::SlaveStatus | VariableSource::SlaveStatusBit { .. } => true,
            VariableSource::IoDataActive
            | VariableSource::UnitError
            | VariableSource::UnitMessageActiveTable
            | VariableSource::UnitErrorFlagTable => return Ok(Validity::Valid),
        };
        Ok(match () {
            () if !self.io_data_active() => Validity::IoDataNotActive,
            () if self.unit_error() => Validity::UnitError,
            () if !data_valid => Validity::DataNotValid,
            () => Validity::Valid,
        })
    }
}
