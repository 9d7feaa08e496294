//! Reading, writing and forcing by id.

use variables::{Target, VariableError, VariableId, VariableTable, VariableType, VariableValue};

use super::list::DeviceVariables;
use super::memory::Memory;
use crate::io::Io;

/// Variables by id. A value is little endian; a BOOL takes one byte.
///
/// A *forced* value is fixed until it is released: for an input the user program sees the forced value whatever
/// the master sends, for an output the unit gets it whatever the program writes. It is kept when operating mode
/// or user program change. After the release the value is kept until the next I/O refresh or the next write.
impl Io {
    /// The variables of this CPU Unit.
    #[must_use]
    pub const fn variables(&self) -> &DeviceVariables {
        &self.variables
    }

    /// The variable with this name or AT specification, in upper or lower case: to be called once, and not in a scan.
    #[must_use]
    pub fn find(&self, name_or_at: &str) -> Option<VariableId> {
        self.variables.find(name_or_at)
    }

    /// The value.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn read(&self, target: impl Into<Target>) -> Result<VariableValue, VariableError> {
        self.memory.value(&self.variables, target.into())
    }

    /// Writes an output: the value for the next I/O refresh. A forced value is kept.
    ///
    /// # Errors
    /// There is no such variable or element, it is read-only, or the value does not fit.
    pub fn write(&mut self, target: impl Into<Target>, value: &[u8]) -> Result<(), VariableError> {
        let place = self.variables.writable(target.into(), value)?;
        self.memory.write(place, value);
        Ok(())
    }

    /// Forces a variable or an element, independent of its access right.
    ///
    /// # Errors
    /// There is no such variable or element, or the value does not fit.
    pub fn force(&mut self, target: impl Into<Target>, value: &[u8]) -> Result<(), VariableError> {
        let place = self.variables.fitting(target.into(), value)?;
        self.memory.force(place, value);
        Ok(())
    }

    /// Releases the forced part of a variable or an element; without effect if nothing is forced.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn release(&mut self, target: impl Into<Target>) -> Result<(), VariableError> {
        let place = self.variables.place(target.into())?;
        self.memory.release(place);
        Ok(())
    }

    /// Releases everything.
    pub fn release_all(&mut self) {
        self.memory.release_all();
    }

    /// Whether all of a variable or an element is forced.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn is_forced(&self, target: impl Into<Target>) -> Result<bool, VariableError> {
        self.memory.is_forced(&self.variables, target.into())
    }

    /// All forced values: whole variables, and elements of arrays that are forced in part.
    pub fn forced(&self) -> impl Iterator<Item = Target> {
        self.variables.iter().flat_map(|(id, variable)| {
            let whole = Some(Target::from(id)).filter(|&target| self.is_forced(target) == Ok(true));
            let parts = variable.variable_type.elements.filter(|_| whole.is_none()).unwrap_or(0);
            let parts = (0..parts).map(move |element| id.element(element));
            whole.into_iter().chain(parts.filter(|&target| self.is_forced(target) == Ok(true)))
        })
    }

    /// The type of a variable, or of the selected element.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn type_of(&self, target: impl Into<Target>) -> Result<VariableType, VariableError> {
        self.variables.type_of(target.into())
    }
}

impl Memory {
    pub(crate) fn value(
        &self,
        variables: &VariableTable,
        target: Target,
    ) -> Result<VariableValue, VariableError> {
        let place = variables.place(target)?;
        Ok(self.of(place.area).read(place))
    }

    /// Whether all of it is forced.
    pub(crate) fn is_forced(&self, variables: &VariableTable, target: Target) -> Result<bool, VariableError> {
        let place = variables.place(target)?;
        Ok(self.of(place.area).is_forced(place))
    }
}
