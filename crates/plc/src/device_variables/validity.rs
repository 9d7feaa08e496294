//! Whether a value can be used for control.

use variables::{Area, VariableError, VariableId, VariableTable};

use super::memory::Memory;
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
    /// The status word says so: Data from EtherCAT Master to CPU Unit Valid, or the same for the other direction, is
    /// FALSE.
    DataNotValid,
}

impl Io {
    /// Whether the value of a variable can be used for control, according to the statuses that the user program
    /// sees. The data of a direction depends on all three conditions, the status word of the unit on the first two;
    /// statuses of the NX Bus Function Module are always valid.
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
        variables: &VariableTable,
        id: VariableId,
    ) -> Result<Validity, VariableError> {
        let area = variables.place(id.into())?.area;
        if area == Area::CpuUnit {
            return Ok(Validity::Valid);
        }
        Ok(match () {
            () if !self.io_data_active() => Validity::IoDataNotActive,
            () if self.unit_error() => Validity::UnitError,
            () if !self.is_data_valid(area) => Validity::DataNotValid,
            () => Validity::Valid,
        })
    }
}
