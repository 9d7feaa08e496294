//! The memory of the controllers: reserved bits, and that a defective frame leaves it alone.

use std::sync::LazyLock;

use esc::{EcatAccess, Esc, REGISTERS};
use time::Instant;

use super::units::Units;

/// Registers end here, and user RAM begins.
const REGISTER_BYTES: usize = 0x0F80;
/// All that a datagram can reach.
const MEMORY_BYTES: usize = 0x3000;
/// Error counters of ports and of the processing unit.
const COUNTERS: std::ops::Range<usize> = 0x0300..0x0314;

/// The bits of each register that can be other than 0 in any case.
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

/// What a write stores; all of a register that a master cannot write, or that only acts.
fn possible_bits(row: &esc::Register, byte: usize) -> u8 {
    let is_kept = row.ecat == EcatAccess::ReadWrite && row.stored.iter().any(|bits| *bits != 0);
    match row.stored.get(byte).filter(|_| is_kept) {
        // Status and PDI control of a SyncManager are the controller's.
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

/// What each controller of the line holds.
pub(super) fn snapshot(network: &Units, now: Instant) -> Vec<Vec<u8>> {
    let memory = |position| {
        // A copy: reading has effects.
        let mut esc = network.esc(position)?.clone();
        let mut memory = vec![0; MEMORY_BYTES];
        esc.read(0, &mut memory, now);
        Some(memory)
    };
    (0..network.len()).filter_map(memory).collect()
}

/// Nothing but error counters has changed, and those by 1 at most.
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
