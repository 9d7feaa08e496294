//! Registers and their bits.

use super::{explained, subjects};
use crate::explain::Subject;

#[test]
fn every_register_is_explained_at_each_of_its_bytes() {
    for register in esc::REGISTERS {
        let last = register.offset + (register.count - 1) * register.stride_bytes + register.size_bytes - 1;
        for offset in [register.offset, last] {
            assert!(
                subjects(&format!("{offset:04X}")).contains(&Subject::Register(offset)),
                "0x{offset:04X}"
            );
        }
    }
    let status = explained("0x0131");
    assert!(
        status.contains("register 0x0131: AL status\n  offset      0x0130 to 0x0131, 2 bytes"),
        "{status}"
    );
}

#[test]
fn the_bits_of_a_register_are_those_of_its_tables() {
    for (text, expected) in [
        ("0x0120", "\nAL control 0x0120\n  bit 3:0     requested state: 1 INIT"),
        ("AL status", "\n  bit 4       error indication"),
        ("DL status", "\n  bit 0       PDI operational / EEPROM loaded"),
        ("0x0502", "\n  bit 15      busy (r)"),
        ("0x0806", "\nActivate 0x0806+8n\n  bit 0       enable"),
        ("0x080E", "\nActivate 0x0806+8n\n  bit 0       enable"),
    ] {
        assert!(explained(text).contains(expected), "{text}: {}", explained(text));
    }
    assert!(!explained("AL status").contains("acknowledge"), "{}", explained("AL status"));
}
