//! The table of the variables of one unit, and the search in it.

use iec_types::Class;

use crate::error::VariableError;
use crate::place::{Area, Place};
use crate::text::{TextProblem, ValueTextError};
use crate::variable::{Target, Variable, VariableAccess, VariableId, VariableType};

/// The data of a unit that its CPU Unit needs for the bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BusUnit {
    /// Device name: the first part of its variables' names.
    pub device_name: String,
    /// NX Unit number, from 1.
    pub unit_number: u8,
    /// Length of the image M to C in bytes.
    pub m_to_c_bytes: usize,
    /// Length of the image C to M in bytes.
    pub c_to_m_bytes: usize,
    /// Its status word.
    pub status: StatusWord,
}

/// The bits of the status word of a unit that make data valid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StatusWord {
    /// The bits that are 1 while the data M to C is valid; 0: it always is.
    pub m_to_c_valid: u16,
    /// The bits that are 1 while the data C to M is valid; 0: it always is.
    pub c_to_m_valid: u16,
}

impl StatusWord {
    /// Whether the data of an area is valid with this status. Other areas are always valid.
    #[must_use]
    #[inline]
    pub const fn allows(self, area: Area, status: u16) -> bool {
        let needed = match area {
            Area::MToC => self.m_to_c_valid,
            Area::CToM => self.c_to_m_valid,
            Area::Status | Area::CpuUnit => 0,
        };
        status & needed == needed
    }
}

/// The variables of one unit, in the order of the I/O map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VariableTable {
    unit: BusUnit,
    list: Vec<Variable>,
}

impl VariableTable {
    /// The table of a unit.
    #[must_use]
    pub const fn new(unit: BusUnit, list: Vec<Variable>) -> Self {
        Self { unit, list }
    }

    /// The unit on its bus.
    #[must_use]
    #[inline]
    pub const fn unit(&self) -> &BusUnit {
        &self.unit
    }

    /// Adds variables behind the others, as the CPU Unit does with its own.
    pub fn extend(&mut self, variables: impl IntoIterator<Item = Variable>) {
        self.list.extend(variables);
    }

    /// All of them with their ids, in the order of the I/O map.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (VariableId, &Variable)> {
        // No unit has as many as 65,536: a frame has 1,500 bytes.
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
    #[inline]
    pub fn get(&self, id: VariableId) -> Option<&Variable> {
        self.list.get(usize::from(id.0))
    }

    #[inline]
    fn at(&self, id: VariableId) -> Result<&Variable, VariableError> {
        self.get(id).ok_or(VariableError::NoSuchVariable)
    }

    /// The variable of the entry of a series; none if there is no such entry in this direction.
    #[must_use]
    pub fn entry(&self, area: Area, series: &str, number: u8) -> Option<(VariableId, &Variable)> {
        self.iter().find(|(_, variable)| {
            let is_it = |own: &crate::Series| own.number == number && own.name == series;
            variable.place.area == area && variable.series.as_ref().is_some_and(is_it)
        })
    }

    /// The word that a bit variable is a part of; none if it is a part of none.
    #[must_use]
    pub fn word_of(&self, part: &Variable) -> Option<&Variable> {
        part.place.bit_number()?;
        self.list.iter().find(|word| word.place.bit_number().is_none() && word.place.contains(part.place))
    }

    /// The position of a variable or an element.
    ///
    /// # Errors
    /// There is no such variable or element.
    #[inline]
    pub fn place(&self, target: Target) -> Result<Place, VariableError> {
        let variable = self.at(target.variable)?;
        let Some(element) = target.element else { return Ok(variable.place) };
        let elements = variable.variable_type.elements.ok_or(VariableError::NotAnArray)?;
        if element >= elements {
            return Err(VariableError::NoSuchElement { element, elements });
        }
        Ok(variable.place.element(element, variable.variable_type.elementary.size_bytes()))
    }

    /// The type of a variable, or of the selected element.
    ///
    /// # Errors
    /// There is no such variable or element.
    #[inline]
    pub fn type_of(&self, target: Target) -> Result<VariableType, VariableError> {
        self.place(target)?;
        let whole = self.at(target.variable)?.variable_type;
        Ok(if target.element.is_some() { VariableType::single(whole.elementary) } else { whole })
    }

    /// The position at which a value is written.
    ///
    /// # Errors
    /// There is no such variable or element, it is read-only, or the value does not fit.
    #[inline]
    pub fn writable(&self, target: Target, value: &[u8]) -> Result<Place, VariableError> {
        let place = self.fitting(target, value)?;
        match self.at(target.variable)?.access {
            VariableAccess::ReadOnly => Err(VariableError::NotWritable),
            VariableAccess::ReadWrite => Ok(place),
        }
    }

    /// The position at which a value is written or forced.
    ///
    /// # Errors
    /// There is no such variable or element, or the value does not fit.
    #[inline]
    pub fn fitting(&self, target: Target, value: &[u8]) -> Result<Place, VariableError> {
        let place = self.place(target)?;
        let (length_bytes, expected_bytes) = (value.len(), place.length_bytes);
        if length_bytes != expected_bytes {
            return Err(VariableError::WrongLength { length_bytes, expected_bytes });
        }
        let elementary = self.at(target.variable)?.variable_type.elementary;
        match value.iter().find(|&&byte| byte > 1) {
            Some(&value) if elementary.class() == Class::Bool => Err(VariableError::NotABool { value }),
            _ => Ok(place),
        }
    }
}
