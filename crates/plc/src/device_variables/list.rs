//! The list of the variables of one CPU Unit.

use core::ops::Deref;

use variables::VariableTable;

use super::ports::{self, NodeLocation};

/// The variables of one CPU Unit: those of its unit, then what the NX Bus Function Module reports of the unit, then the
/// system-defined ones. The [`VariableTable`] finds them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceVariables(VariableTable);

impl DeviceVariables {
    /// The variables of a CPU Unit whose unit has this table.
    #[must_use]
    pub fn of(mut table: VariableTable) -> Self {
        let of_bus = ports::of_bus(table.unit());
        table.extend(of_bus);
        table.extend(ports::system_defined());
        Self(table)
    }

    /// Device name of the unit on the NX bus.
    #[must_use]
    pub fn device_name(&self) -> &str {
        &self.unit().device_name
    }

    /// NX Unit number of the unit.
    #[must_use]
    pub fn unit_number(&self) -> u8 {
        self.unit().unit_number
    }

    /// The location of the unit, for programs.
    #[must_use]
    pub fn node_location(&self) -> NodeLocation {
        NodeLocation::new(self.device_name(), self.unit_number())
    }
}

impl Deref for DeviceVariables {
    type Target = VariableTable;

    fn deref(&self) -> &VariableTable {
        &self.0
    }
}
