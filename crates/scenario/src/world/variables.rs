//! Device variables of the CPU Unit, by the names that the manual gives them (A-3-2).

use nx_ect101::DataSetKind;

use super::World;

/// A device variable of one unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variable {
    /// An I/O entry M to C or C to M.
    Entry { kind: DataSetKind, number: u8, m_to_c: bool },
    /// EtherCAT Slave Status, the whole word.
    SlaveStatus,
    /// Data … Valid, M to C or C to M.
    Valid { m_to_c: bool },
    /// NX Unit I/O Data Active Status.
    IoDataActive,
    /// NX Unit Error Status.
    Error,
}

impl Variable {
    /// The variable of this name, if it is one of the unit with this device name.
    pub(crate) fn named(name: &str, unit: &str) -> Option<Self> {
        if let Some(rest) = name.strip_prefix("NXBus_").and_then(|rest| own(rest, unit)) {
            return match rest {
                "NX_Unit_I_O_Data_Active_Status" => Some(Self::IoDataActive),
                "NX_Unit_Error_Status" => Some(Self::Error),
                _ => None,
            };
        }
        match own(name, unit)? {
            "EtherCAT_Slave_Status" => Some(Self::SlaveStatus),
            "Data_from_EtherCAT_Master_to_CPU_Unit_Valid" => Some(Self::Valid { m_to_c: true }),
            "Data_from_CPU_Unit_to_EtherCAT_Master_Valid" => Some(Self::Valid { m_to_c: false }),
            rest => entry(rest),
        }
    }
}

/// The name behind the device name.
fn own<'a>(name: &'a str, unit: &str) -> Option<&'a str> {
    name.strip_prefix(unit)?.strip_prefix('_')
}

/// `UINTs_01_M_to_C` and its kind.
fn entry(rest: &str) -> Option<Variable> {
    let (kind, rest) = rest.split_once('_')?;
    let (number, direction) = rest.split_once('_')?;
    let kind = match kind {
        "UINTs" => DataSetKind::Uints,
        "BYTES" | "BYTEs" => DataSetKind::Bytes,
        "UDINT" => DataSetKind::Udint,
        _ => return None,
    };
    let m_to_c = match direction {
        "M_to_C" => true,
        "C_to_M" => false,
        _ => return None,
    };
    Some(Variable::Entry { kind, number: number.parse().ok()?, m_to_c })
}

impl World {
    /// The bytes of a variable, little endian; none if no unit has it.
    pub(crate) fn variable(&mut self, name: &str) -> Option<Vec<u8>> {
        let found =
            self.names.iter().enumerate().find_map(|(at, unit)| Some((at, Variable::named(name, unit)?)));
        let (at, variable) = found?;
        let io = self.cpus.get_mut(at)?.unit.io_mut();
        match variable {
            Variable::Entry { kind, number, m_to_c: true } => io.entry(kind, number).map(<[u8]>::to_vec),
            Variable::Entry { kind, number, m_to_c: false } => {
                io.entry_mut(kind, number).map(|entry| entry.to_vec())
            }
            Variable::SlaveStatus => Some(io.status().bits().to_le_bytes().to_vec()),
            Variable::Valid { m_to_c: true } => Some(vec![io.status().m_to_c_valid.into()]),
            Variable::Valid { m_to_c: false } => Some(vec![io.status().c_to_m_valid.into()]),
            Variable::IoDataActive => Some(vec![io.io_data_active().into()]),
            Variable::Error => Some(vec![io.unit_error().into()]),
        }
    }
}
