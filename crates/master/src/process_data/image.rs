//! The values of process data: outputs and inputs of each slave as separate bytes.

use crate::settings::{Direction, SlaveSettings};

/// Outputs and inputs of one slave. Areas of fewer than eight bits begin with a byte each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Image {
    pub(crate) outputs: Vec<u8>,
    pub(crate) inputs: Vec<u8>,
    /// The working counters of this cycle so far, added up; none: no datagram has returned.
    counted: Option<u16>,
    /// The same, or that of the cycle before until the first datagram returns.
    pub(crate) working_counter: Option<u16>,
}

impl Image {
    /// Zeros, with the lengths in the settings.
    pub(crate) fn of(settings: &SlaveSettings) -> Self {
        let zeros = |direction| {
            let length_bytes = settings.areas(direction).map(|area| area.bits.div_ceil(8) as usize).sum();
            vec![0; length_bytes]
        };
        let (outputs, inputs) = (zeros(Direction::Outputs), zeros(Direction::Inputs));
        Self { outputs, inputs, ..Self::default() }
    }

    pub(crate) fn way(&self, direction: Direction) -> &[u8] {
        match direction {
            Direction::Outputs => &self.outputs,
            Direction::Inputs => &self.inputs,
        }
    }

    /// The next cycle begins.
    pub(crate) const fn begin_cycle(&mut self) {
        self.working_counter = self.counted.take();
    }

    /// A datagram with its process data has returned.
    pub(crate) fn count(&mut self, working_counter: u16) {
        self.counted = Some(self.counted.unwrap_or(0).saturating_add(working_counter));
        self.working_counter = self.counted;
    }
}

/// A run of bits within bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bits {
    pub(crate) start: usize,
    pub(crate) count: usize,
}

impl Bits {
    const fn is_bytewise(self) -> bool {
        self.start.is_multiple_of(8) && self.count.is_multiple_of(8)
    }

    const fn bytes(self) -> core::ops::Range<usize> {
        self.start / 8..(self.start + self.count) / 8
    }
}

/// Copies a run of bits to another place. Bits beyond the end of the bytes are cut off.
pub(crate) fn copy(from: &[u8], source: Bits, to: &mut [u8], target_start: usize) {
    let target = Bits { start: target_start, count: source.count };
    if source.is_bytewise() && target.is_bytewise() {
        if let (Some(from), Some(to)) = (from.get(source.bytes()), to.get_mut(target.bytes())) {
            to.copy_from_slice(from);
        }
        return;
    }
    for n in 0..source.count {
        let (at, to_at) = (source.start + n, target.start + n);
        if let (Some(byte), Some(target)) = (from.get(at / 8), to.get_mut(to_at / 8)) {
            *target = *target & !(1 << (to_at % 8)) | (byte >> (at % 8) & 1) << (to_at % 8);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bit(bytes: &[u8], at: usize) -> Option<bool> {
        bytes.get(at / 8).map(|byte| byte >> (at % 8) & 1 != 0)
    }

    proptest! {
        #[test]
        fn bits_arrive_and_their_neighbours_stay(
            from: [u8; 4], before: [u8; 4], start in 0_usize..32, target in 0_usize..32, count in 0_usize..32,
        ) {
            let count = count.min(32 - start.max(target));
            let mut to = before;
            copy(&from, Bits { start, count }, &mut to, target);
            for at in 0..32 {
                let is_target = (target..target + count).contains(&at);
                let expected = if is_target { bit(&from, at - target + start) } else { bit(&before, at) };
                prop_assert_eq!(bit(&to, at), expected);
            }
        }

        #[test]
        fn runs_that_leave_their_bytes_do_no_harm(start in 0_usize..64, target in 0_usize..64, count in 0_usize..64) {
            copy(&[0xFF; 3], Bits { start, count }, &mut [0; 3], target);
        }
    }
}
