//! Frames that did not come back, by kind: each kind is warned of once, and counted.

use segment::{Defect, FrameFate, FrameKind};

/// Why a frame did not come back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Loss {
    Defective(Defect),
    Foreign,
    LeftAtFarEnd,
    NoWay,
}

const KINDS: usize = 7;

impl Loss {
    fn of(frame: &[u8], fate: FrameFate) -> Self {
        match FrameKind::of(frame) {
            _ if fate == FrameFate::CrossedOver => Self::LeftAtFarEnd,
            FrameKind::Defective(defect) => Self::Defective(defect),
            FrameKind::NotEtherCat => Self::Foreign,
            FrameKind::Datagrams(_) | FrameKind::OtherType => Self::NoWay,
        }
    }

    /// The place of its count, and what was wrong.
    const fn row(self) -> (usize, &'static str) {
        match self {
            Self::Defective(Defect::TooShort) => (0, "it ends within the Ethernet or the EtherCAT header"),
            Self::Defective(Defect::TooLong) => (1, "it is longer than 1,518 bytes"),
            Self::Defective(Defect::Truncated) => (2, "it ends before its EtherCAT length does"),
            Self::Defective(Defect::DatagramBeyondEnd) => (3, "a datagram ends behind its EtherCAT length"),
            Self::Foreign => (4, "it is not EtherCAT"),
            Self::LeftAtFarEnd => (5, "it left at the far end of the line"),
            Self::NoWay => {
                (6, "the cable is pulled, the first unit is off, or a loop is open without a cable")
            }
        }
    }
}

/// The frames of a run that did not come back.
#[derive(Debug, Default)]
pub(crate) struct Losses([Option<(Loss, u64)>; KINDS]);

impl Losses {
    /// A frame did not come back. The first one of its kind is logged.
    #[cold]
    pub(crate) fn count(&mut self, frame: &[u8], fate: FrameFate) {
        let loss = Loss::of(frame, fate);
        let (place, reason) = loss.row();
        let Some(counted) = self.0.get_mut(place) else { return };
        let (_, count) = counted.get_or_insert((loss, 0));
        *count += 1;
        if *count == 1 {
            let length_bytes = frame.len();
            tracing::warn!(
                "a frame of {length_bytes} bytes was destroyed: {reason}; further ones are counted until the end"
            );
        }
    }

    /// Logs the count of each kind of which there was more than the one that has been logged.
    pub(crate) fn log(&self) {
        for (loss, count) in self.0.iter().flatten().filter(|(_, count)| *count > 1) {
            tracing::warn!("{count} frames were destroyed in all, each because {}", loss.row().1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of each kind, and its fate.
    fn one_of_each() -> [(Vec<u8>, FrameFate); KINDS] {
        let ethercat = |length_field: u16, datagram_bytes: u8| {
            let mut frame = vec![0xFF; 12];
            frame.extend([0x88, 0xA4]);
            frame.extend((0x1000 | length_field).to_le_bytes());
            frame.extend([0; 6]);
            frame.extend([datagram_bytes, 0, 0, 0]);
            frame.resize(60, 0);
            frame
        };
        [
            (vec![0xFF; 13], FrameFate::Destroyed),
            (vec![0; 1600], FrameFate::Destroyed),
            (ethercat(100, 60), FrameFate::Destroyed),
            (ethercat(20, 30), FrameFate::Destroyed),
            (vec![0; 60], FrameFate::Destroyed),
            (ethercat(14, 2), FrameFate::CrossedOver),
            (ethercat(14, 2), FrameFate::Destroyed),
        ]
    }

    #[test]
    fn each_kind_has_a_count_of_its_own() {
        let mut losses = Losses::default();
        for (times, (frame, fate)) in one_of_each().iter().enumerate() {
            (0..=times).for_each(|_| losses.count(frame, *fate));
        }
        let counts: Vec<u64> = losses.0.iter().flatten().map(|(_, count)| *count).collect();
        assert_eq!(counts, [1, 2, 3, 4, 5, 6, 7]);
    }
}
