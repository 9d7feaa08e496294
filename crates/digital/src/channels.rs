//! The channels of one direction.

/// How many channels a terminal has in one direction: 0 to 64. Channel 1 is bit 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Channels(u8);

impl Channels {
    /// No channels.
    pub const NONE: Self = Self(0);
    /// Maximum number of channels.
    pub const MAX: u8 = 64;

    /// This number of channels; none beyond [`Channels::MAX`].
    #[must_use]
    pub const fn new(count: u8) -> Option<Self> {
        if count <= Self::MAX { Some(Self(count)) } else { None }
    }

    /// The number of channels.
    #[must_use]
    pub const fn count(self) -> u8 {
        self.0
    }

    /// Their numbers, from 1.
    pub fn numbers(self) -> impl Iterator<Item = u8> {
        1..=self.0
    }

    /// The bytes of their process data.
    #[must_use]
    pub const fn length_bytes(self) -> u16 {
        self.0.div_ceil(8) as u16
    }

    /// Whether there are none.
    #[must_use]
    pub const fn is_none(self) -> bool {
        self.0 == 0
    }

    /// Their bits.
    const fn mask(self) -> u64 {
        match self.0 {
            0 => 0,
            count => u64::MAX >> (Self::MAX - count),
        }
    }

    /// The levels in process data.
    pub(crate) fn levels(self, bytes: &[u8]) -> u64 {
        let bits = bytes.iter().take(8).rev().fold(0, |bits, &byte| bits << 8 | u64::from(byte));
        bits & self.mask()
    }

    /// Writes levels to process data; bits that are not a channel are 0.
    pub(crate) fn put(self, levels: u64, bytes: &mut [u8]) {
        for (byte, level) in bytes.iter_mut().zip((levels & self.mask()).to_le_bytes()) {
            *byte = level;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_go_into_bytes_and_back_and_nothing_else_does() {
        for count in 0..=Channels::MAX {
            let channels = Channels::new(count).expect("0 to 64");
            let mut bytes = vec![0xFF; usize::from(channels.length_bytes())];
            assert_eq!(channels.levels(&bytes).count_ones(), u32::from(count));
            channels.put(u64::MAX, &mut bytes);
            assert_eq!(bytes.iter().map(|byte| byte.count_ones()).sum::<u32>(), u32::from(count));
        }
        assert_eq!(Channels::new(65), None);
    }

    #[test]
    fn channel_1_is_bit_0_of_the_first_byte() {
        let channels = Channels::new(12).expect("0 to 64");
        assert_eq!(channels.levels(&[0x01, 0x08]), 0x0801);
        let mut bytes = [0; 2];
        channels.put(0x0801, &mut bytes);
        assert_eq!(bytes, [0x01, 0x08]);
    }
}
