//! Registers of the ESC, from its register map.

use esc::{EcatAccess, PdiAccess, REGISTERS, Register};

use super::{Explanation, Fact, Subject, register_bits};

/// The register with a byte at `offset`; none if there is none.
pub(super) fn explanation(offset: u16) -> Option<Explanation> {
    let (register, first) =
        REGISTERS.iter().find_map(|register| Some((register, first(register, offset)?)))?;
    let last = first + register.size_bytes.saturating_sub(1);
    let mut facts =
        vec![Fact::new("offset", format!("0x{first:04X} to 0x{last:04X}, {} bytes", register.size_bytes))];
    if register.count > 1 {
        let Register { offset, count, stride_bytes, .. } = register;
        facts.push(Fact::new("bank", format!("{count} from 0x{offset:04X} on, every {stride_bytes} bytes")));
    }
    facts.push(Fact::new(
        "master",
        match register.ecat {
            EcatAccess::Read => "reads",
            EcatAccess::ReadWrite => "reads, writes",
        },
    ));
    facts.push(Fact::new(
        "unit",
        match register.pdi {
            PdiAccess::Read => "reads",
            PdiAccess::ReadWrite => "reads, writes",
        },
    ));
    facts.push(Fact::new("power-on", format!("0x{:X}", register.reset)));
    let (subject, name) = (Subject::Register(offset), register.name.into());
    let sections = register_bits::sections(register);
    Some(Explanation { subject, name, facts, advice: Vec::new(), sections })
}

/// The first byte of the register in a bank that has a byte at `offset`.
fn first(register: &Register, offset: u16) -> Option<u16> {
    let behind = offset.checked_sub(register.offset)?;
    let number = behind / register.stride_bytes.max(1);
    let within = behind % register.stride_bytes.max(1);
    (number < register.count && within < register.size_bytes).then_some(offset - within)
}
