//! The memory of the controllers: reserved bits are 0, and a defective frame changes nothing.

use std::sync::LazyLock;

use esc::{EcatAccess, Esc, REGISTERS};
use time::Instant;

use super::units::Units;

/// End of the registers, and start of the user RAM.
const REGISTER_BYTES: usize = 0x0F80;
/// The whole memory that a datagram can access.
const MEMORY_BYTES: usize = 0x3000;
/// Error counters of ports and of the processing unit.
const COUNTERS: std::ops::Range<usize> = 0x0300..0x0314;

/// The bits of each register that can have a value other than 0.
static POSSIBLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut possible = vec![0; REGISTER_BYTES];
    for row in REGISTERS {
        for number in 0..row.count {
            for byte in 0..row.size_bytes {
                let at = usize::from(row.offset + number * row.stride_bytes + byte);
                if let Some(bits) = possible.get_mut(at) {
                    *bits |= possible_bits(row, usize::from(byte));
                }
            }
        }
    }
    possible
});

/// The bits that a write stores; the whole register if a master cannot write it, or a write is only a command.
fn possible_bits(row: &esc::Register, byte: usize) -> u8 {
    let is_kept = row.ecat == EcatAccess::ReadWrite && row.stored.iter().any(|bits| *bits != 0);
    match row.stored.get(byte).filter(|_| is_kept) {
        // The controller sets status and PDI control of a SyncManager.
        Some(0) if row.offset == 0x0800 && byte == 5 => 0xFF,
        Some(0) if row.offset == 0x0800 && byte == 7 => 0x03,
        Some(stored) => *stored | (row.reset >> (8 * byte.min(3)) & if byte < 4 { 0xFF } else { 0 }) as u8,
        None => 0xFF,
    }
}

/// Reserved bits are 0, whatever was written.
pub(super) fn check(esc: &mut Esc, now: Instant) -> Result<(), String> {
    let mut registers = vec![0; REGISTER_BYTES];
    esc.read(0, &mut registers, now);
    match registers.iter().zip(POSSIBLE.iter()).position(|(value, possible)| value & !possible != 0) {
        None => Ok(()),
        Some(at) => {
            let (value, possible) = (registers[at], POSSIBLE[at]);
            Err(format!("0x{at:04X} is {value:02X}, possible bits are {possible:02X}"))
        }
    }
}

/// The memory of each controller of the line.
pub(super) fn snapshot(network: &Units, now: Instant) -> Vec<Vec<u8>> {
    let memory = |position| {
        // A copy: reading has side effects.
        let mut esc = network.esc(position)?.clone();
        let mut memory = vec![0; MEMORY_BYTES];
        esc.read(0, &mut memory, now);
        Some(memory)
    };
    (0..network.len()).filter_map(memory).collect()
}

/// Only error counters have changed, and those by 1 at most.
pub(super) fn unchanged(before: &[Vec<u8>], after: &[Vec<u8>]) -> Result<(), String> {
    for (position, (before, after)) in before.iter().zip(after).enumerate() {
        for (at, (was, is)) in before.iter().zip(after).enumerate() {
            let counts = COUNTERS.contains(&at) && is.wrapping_sub(*was) <= 1;
            if was != is && !counts {
                return Err(format!(
                    "a defective frame changed 0x{at:04X} of unit {position} from {was:02X} to {is:02X}"
                ));
            }
        }
    }
    Ok(())
}
