//! The list of the variables of one CPU Unit, and the search in it.

use nx_ect101::unit_file::UnitFile;
use nx_ect101::{Direction, ImageLayout, IoAllocation};

use super::error::VariableError;
use super::memory::Place;
use super::ports::{self, NodeLocation, Ports};
use super::text::{TextProblem, ValueTextError};
use super::variable::{Target, Variable, VariableId};

/// The variables of one CPU Unit: I/O ports M to C, C to M and statuses, then the system-defined ones. Each I/O
/// entry that belongs to its data set has one, and so has each bit of EtherCAT Slave Status.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceVariables {
    device_name: String,
    unit_number: u8,
    pub(crate) m_to_c: ImageLayout,
    pub(crate) c_to_m: ImageLayout,
    list: Vec<Variable>,
}

impl DeviceVariables {
    /// The variables for a unit with this device name, NX Unit number and I/O allocation.
    #[must_use]
    pub fn of_allocation(device_name: &str, unit_number: u8, allocation: &IoAllocation) -> Self {
        let [m_to_c, c_to_m] = Direction::ALL.map(|direction| allocation.layout(direction));
        let ports = Ports { device_name, unit_number };
        let mut list = ports.entries(Direction::MToC, &m_to_c);
        list.extend(ports.entries(Direction::CToM, &c_to_m));
        list.extend(ports.statuses());
        list.extend(ports::system_defined());
        Self { device_name: device_name.to_owned(), unit_number, m_to_c, c_to_m, list }
    }

    /// Length of the image M to C in bytes.
    #[must_use]
    pub const fn m_to_c_bytes(&self) -> usize {
        self.m_to_c.size_bytes()
    }

    /// Length of the image C to M in bytes.
    #[must_use]
    pub const fn c_to_m_bytes(&self) -> usize {
        self.c_to_m.size_bytes()
    }

    /// Device name of the unit on the NX bus.
    #[must_use]
    pub fn device_name(&self) -> &str {
        &self.device_name
    }

    /// NX Unit number of the unit.
    #[must_use]
    pub const fn unit_number(&self) -> u8 {
        self.unit_number
    }

    /// The location of the unit, for programs.
    #[must_use]
    pub fn node_location(&self) -> NodeLocation {
        NodeLocation::new(&self.device_name, self.unit_number)
    }

    /// The variables for the unit of a unit file.
    #[must_use]
    pub fn of_unit_file(file: &UnitFile) -> Self {
        Self::of_allocation(&file.name.value, file.unit_number.value, &file.io_allocation())
    }

    /// All of them with their ids, in the order of the I/O map.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (VariableId, &Variable)> {
        // At most 255 entries of three data sets in two directions and a few statuses: they fit.
        self.list.iter().enumerate().map(|(at, variable)| (VariableId(at as u16), variable))
    }

    /// The variable with this name or AT specification, in upper or lower case.
    #[must_use]
    pub fn find(&self, name_or_at: &str) -> Option<VariableId> {
        let found = self.iter().find(|(_, variable)| variable.is_called(name_or_at));
        found.map(|(id, _)| id)
    }

    /// A variable, or an element of it as in `N1_UINTs_01_M_to_C[3]`.
    ///
    /// # Errors
    /// There is no such variable or element, or the text in brackets is not a number; with its position in the text.
    pub fn find_target(&self, text: &str) -> Result<Target, ValueTextError> {
        let (name, element) = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
            Some((name, element)) => (name, Some(element)),
            None => (text, None),
        };
        let fail = |start: usize, end: usize, problem| Err(ValueTextError { start, end, problem });
        let Some(variable) = self.find(name.trim()) else {
            return fail(0, name.len(), TextProblem::NoSuchVariable);
        };
        let Some(digits) = element else { return Ok(variable.into()) };
        let (start, end) = (name.len() + 1, name.len() + 1 + digits.len());
        let Ok(element) = digits.trim().parse() else { return fail(start, end, TextProblem::NotANumber) };
        let target = variable.element(element);
        match self.place(target) {
            Ok(_) => Ok(target),
            Err(error) => fail(start, end, TextProblem::NoSuchPlace(error)),
        }
    }

    /// A variable of this list.
    #[must_use]
    pub fn get(&self, id: VariableId) -> Option<&Variable> {
        self.list.get(usize::from(id.0))
    }

    pub(super) fn at(&self, id: VariableId) -> Result<&Variable, VariableError> {
        self.get(id).ok_or(VariableError::NoSuchVariable)
    }

    /// The position of a variable or an element.
    pub(super) fn place(&self, target: Target) -> Result<Place, VariableError> {
        let variable = self.at(target.variable)?;
        let Some(element) = target.element else { return Ok(variable.place) };
        let elements = variable.variable_type.elements.ok_or(VariableError::NotAnArray)?;
        if element >= elements {
            return Err(VariableError::NoSuchElement { element, elements });
        }
        let length_bytes = variable.variable_type.elementary.size_bytes();
        let start = variable.place.start + usize::from(element) * length_bytes;
        Ok(Place { start, length_bytes, ..variable.place })
    }
}
