//! What a program sees of its CPU Unit: the variables that it has requested, as at the start of the scan, and the time.

use core::fmt;

use arrayvec::ArrayVec;
use plc::{DeviceVariables, Io, ProgramEvent, ProgramTrouble, VariableAccess, VariableId, VariableValue};
use time::Instant;
use wasmi::{Memory, StoreLimits};

/// Maximum number of reports of one scan; further ones are dropped.
pub const REPORTS_MAX: usize = 4;
/// Longest text of a report in bytes; a longer one is cut.
pub const REPORT_BYTES_MAX: usize = 200;

/// Why a variable cannot be read or written. The program gets the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// No variable was found under this number.
    NoSuchVariable = 1,
    /// The array has no such element; a variable that is not an array has only element 0.
    NoSuchElement = 2,
    /// Its value is set by the I/O refresh, not by the program.
    ReadOnly = 3,
    /// The value is not a value of the type.
    DoesNotFit = 4,
    /// The number of bytes differs from the length of the variable.
    WrongLength = 5,
}

impl Refusal {
    /// The number for the program.
    #[must_use]
    pub const fn number(self) -> i32 {
        self as i32
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::NoSuchVariable => "no variable has this number",
            Self::NoSuchElement => "the variable has no such element",
            Self::ReadOnly => "the variable is read-only",
            Self::DoesNotFit => "the value is not one of the variable's type",
            Self::WrongLength => "the bytes are not as many as the variable has",
        })
    }
}

/// The present phase of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// It is being initialized or started: it may request variables.
    Start,
    /// It is executing a scan: the variables that it uses are fixed.
    Scan,
}

/// The CPU Unit, while a program runs on it.
pub(crate) struct Host {
    pub(crate) limits: StoreLimits,
    /// None until the module has been initialized.
    pub(crate) memory: Option<Memory>,
    pub(crate) phase: Phase,
    variables: DeviceVariables,
    bindings: Vec<Binding>,
    reports: ArrayVec<String, REPORTS_MAX>,
    now_ns: u64,
    /// Fuel of this scan that has not been assigned yet.
    pub(crate) fuel_reserve: u64,
}

/// A variable that the program has requested. Its number is its position in the list.
struct Binding {
    variable: VariableId,
    /// Length of the variable, or of one element.
    element_bytes: usize,
    access: VariableAccess,
    is_bool: bool,
    value: VariableValue,
    is_written: bool,
}

impl Host {
    pub(crate) fn new(variables: DeviceVariables, limits: StoreLimits) -> Self {
        // Each variable is in the list once at most, so that a scan allocates nothing here.
        let bindings = Vec::with_capacity(variables.iter().len());
        let phase = Phase::Start;
        let reports = ArrayVec::new();
        Self { limits, memory: None, phase, variables, bindings, reports, now_ns: 0, fuel_reserve: 0 }
    }

    /// The number of a variable, by name or AT specification.
    pub(crate) fn find(&mut self, name: &str) -> Option<i32> {
        let variable = self.variables.find(name)?;
        let known = self.bindings.iter().position(|binding| binding.variable == variable);
        let number = known.unwrap_or(self.bindings.len());
        if known.is_none() {
            self.bindings.push(Binding::of(&self.variables, variable)?);
        }
        i32::try_from(number).ok()
    }

    /// Reads the variables, before a scan.
    pub(crate) fn take_in(&mut self, io: &Io) {
        self.now_ns = io.now().saturating_since(Instant::ZERO).as_nanos();
        for binding in &mut self.bindings {
            binding.is_written = false;
            // The identifiers belong to the variables of this CPU Unit.
            if let Ok(value) = io.read(binding.variable) {
                binding.value = value;
            }
        }
    }

    /// Writes the changed variables, and passes on the reports.
    pub(crate) fn give_out(&mut self, io: &mut Io) {
        for binding in self.bindings.iter().filter(|binding| binding.is_written) {
            // It was checked when it was written.
            let _ = io.write(binding.variable, &binding.value);
        }
        for text in self.reports.drain(..) {
            io.report(ProgramEvent::Error(ProgramTrouble {
                what: text.into(),
                line: 0,
                column: 0,
                file: None,
            }));
        }
    }

    pub(crate) const fn now_ns(&self) -> u64 {
        self.now_ns
    }

    /// The value of a variable or an element; all types are unsigned.
    pub(crate) fn read(&self, number: i32, element: u32) -> Result<i64, Refusal> {
        let octets = self.binding(number)?.element(element)?;
        Ok(octets.iter().rev().fold(0, |value, octet| value << 8 | i64::from(*octet)))
    }

    pub(crate) fn write(&mut self, number: i32, element: u32, value: i64) -> Result<(), Refusal> {
        let octets = value.to_le_bytes();
        let binding = self.writable(number)?;
        let length_bytes = binding.element(element)?.len();
        let (own, above) = octets.split_at(length_bytes.min(octets.len()));
        if above.iter().any(|&octet| octet != 0) || binding.is_bool && value > 1 {
            return Err(Refusal::DoesNotFit);
        }
        let start = element as usize * binding.element_bytes;
        for (place, octet) in binding.value.iter_mut().skip(start).zip(own) {
            *place = *octet;
        }
        binding.is_written = true;
        Ok(())
    }

    /// The whole variable, little endian; a BOOL takes one byte.
    pub(crate) fn bytes(&self, number: i32) -> Result<VariableValue, Refusal> {
        self.binding(number).map(|binding| binding.value.clone())
    }

    /// Sets the whole variable.
    pub(crate) fn write_bytes(&mut self, number: i32, octets: &[u8]) -> Result<(), Refusal> {
        let binding = self.writable(number)?;
        if octets.len() != binding.value.len() {
            return Err(Refusal::WrongLength);
        }
        if binding.is_bool && octets.iter().any(|&octet| octet > 1) {
            return Err(Refusal::DoesNotFit);
        }
        binding.value.copy_from_slice(octets);
        binding.is_written = true;
        Ok(())
    }

    /// Keeps a report until the scan ends. A character that is not suitable for a log becomes a blank.
    pub(crate) fn report(&mut self, text: &[u8]) {
        if !self.reports.is_full() {
            let text = String::from_utf8_lossy(text.get(..REPORT_BYTES_MAX).unwrap_or(text));
            self.reports.push(text.replace(char::is_control, " "));
        }
    }

    fn binding(&self, number: i32) -> Result<&Binding, Refusal> {
        let number = usize::try_from(number).map_err(|_| Refusal::NoSuchVariable)?;
        self.bindings.get(number).ok_or(Refusal::NoSuchVariable)
    }

    fn writable(&mut self, number: i32) -> Result<&mut Binding, Refusal> {
        let number = usize::try_from(number).map_err(|_| Refusal::NoSuchVariable)?;
        let binding = self.bindings.get_mut(number).ok_or(Refusal::NoSuchVariable)?;
        match binding.access {
            VariableAccess::ReadOnly => Err(Refusal::ReadOnly),
            VariableAccess::ReadWrite => Ok(binding),
        }
    }
}

impl Binding {
    fn of(variables: &DeviceVariables, id: VariableId) -> Option<Self> {
        let variable = variables.get(id)?;
        let value_bytes = variable.variable_type.size_bytes();
        Some(Self {
            variable: id,
            element_bytes: variable.variable_type.elementary.size_bytes(),
            access: variable.access,
            is_bool: variable.variable_type.is_bool(),
            value: core::iter::repeat_n(0, value_bytes).collect(),
            is_written: false,
        })
    }

    fn element(&self, element: u32) -> Result<&[u8], Refusal> {
        let mut elements = self.value.chunks(self.element_bytes.max(1));
        elements.nth(element as usize).ok_or(Refusal::NoSuchElement)
    }
}
