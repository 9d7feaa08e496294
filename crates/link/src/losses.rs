//! Frames that did not return, by kind: each kind is logged as a warning once, and counted.

use segment::{Defect, FrameFate, FrameKind};

use crate::port::{Envelope, FRAME_BUFFER_BYTES};

/// Why a frame did not return.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Loss {
    Defective(Defect),
    Foreign,
    LeftAtFarEnd,
    NoWay,
    Answered,
}

const KINDS: usize = 8;
/// The header that the port puts before a UDP datagram.
const ETHERNET_HEADER_BYTES: usize = 14;

impl Loss {
    fn of(frame: &[u8], fate: FrameFate) -> Self {
        match FrameKind::of(frame) {
            _ if fate == FrameFate::CrossedOver => Self::LeftAtFarEnd,
            FrameKind::Defective(defect) => Self::Defective(defect),
            FrameKind::NotEtherCat => Self::Foreign,
            FrameKind::Datagrams(_) | FrameKind::OtherType => Self::NoWay,
        }
    }

    /// The position of its count, and the defect.
    const fn row(self, envelope: Envelope) -> (usize, &'static str) {
        match (self, envelope) {
            (Self::Defective(Defect::TooShort), Envelope::Ethernet) => {
                (0, "it ends within the Ethernet or the EtherCAT header")
            }
            (Self::Defective(Defect::TooShort), Envelope::Udp) => (0, "it ends within the EtherCAT header"),
            (Self::Defective(Defect::TooLong), Envelope::Ethernet) => (1, "it is longer than 1,518 bytes"),
            (Self::Defective(Defect::TooLong), Envelope::Udp) => (1, "it is longer than 1,504 bytes"),
            (Self::Defective(Defect::Truncated), _) => (2, "it ends before its EtherCAT length does"),
            (Self::Defective(Defect::DatagramBeyondEnd), _) => (3, "a datagram exceeds its EtherCAT length"),
            (Self::Foreign, _) => (4, "it is not EtherCAT"),
            (Self::LeftAtFarEnd, _) => (5, "it left at the far end of the line"),
            (Self::NoWay, _) => {
                (6, "the cable is pulled, the first unit is off, or a loop is open without a cable")
            }
            (Self::Answered, _) => (
                7,
                "a slave has already answered it: at the other end is another ectwin or a slave, or the network is a loop",
            ),
        }
    }
}

/// The frames of a run that did not return.
#[derive(Debug)]
pub(crate) struct Losses {
    envelope: Envelope,
    counts: [Option<(Loss, u64)>; KINDS],
}

impl Losses {
    /// None so far, for frames in such envelopes.
    pub(crate) const fn new(envelope: Envelope) -> Self {
        Self { envelope, counts: [None; KINDS] }
    }

    /// A frame did not return. The first one of its kind is logged.
    #[cold]
    pub(crate) fn count(&mut self, frame: &[u8], fate: FrameFate) {
        self.count_loss(frame, Loss::of(frame, fate));
    }

    /// A frame was no request, but an answer.
    #[cold]
    pub(crate) fn count_answered(&mut self, frame: &[u8]) {
        self.count_loss(frame, Loss::Answered);
    }

    fn count_loss(&mut self, frame: &[u8], loss: Loss) {
        let (place, reason) = loss.row(self.envelope);
        let Some(counted) = self.counts.get_mut(place) else { return };
        let (_, count) = counted.get_or_insert((loss, 0));
        *count += 1;
        if *count == 1 {
            let what = self.what_came(frame);
            tracing::warn!("{what} was destroyed: {reason}; further ones are counted until the end");
        }
    }

    /// The received data, with their length on the medium.
    fn what_came(&self, frame: &[u8]) -> String {
        let (name, header_bytes) = match self.envelope {
            Envelope::Ethernet => ("a frame", 0),
            Envelope::Udp => ("a UDP datagram", ETHERNET_HEADER_BYTES),
        };
        // The rest of a longer frame was cut off.
        let or_more = if frame.len() < FRAME_BUFFER_BYTES { "" } else { " or more" };
        format!("{name} of {} bytes{or_more}", frame.len().saturating_sub(header_bytes))
    }

    /// Logs the count of each kind that occurred more than the one time already logged.
    pub(crate) fn log(&self) {
        for (loss, count) in self.counts.iter().flatten().filter(|(_, count)| *count > 1) {
            let (_, reason) = loss.row(self.envelope);
            tracing::warn!("{count} frames were destroyed in all, each because {reason}");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame of each kind, and its fate.
    fn one_of_each() -> [(Vec<u8>, FrameFate); KINDS - 1] {
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
        let mut losses = Losses::new(Envelope::Ethernet);
        for (times, (frame, fate)) in one_of_each().iter().enumerate() {
            (0..=times).for_each(|_| losses.count(frame, *fate));
        }
        (0..8).for_each(|_| losses.count_answered(&[0; 60]));
        let counts: Vec<u64> = losses.counts.iter().flatten().map(|(_, count)| *count).collect();
        assert_eq!(counts, [1, 2, 3, 4, 5, 6, 7, 8]);
    }

    #[test]
    fn lengths_are_those_on_the_medium() {
        let [frames, datagrams] = [Envelope::Ethernet, Envelope::Udp].map(Losses::new);
        for (length_bytes, frame, datagram) in [
            (14, "a frame of 14 bytes", "a UDP datagram of 0 bytes"),
            (60, "a frame of 60 bytes", "a UDP datagram of 46 bytes"),
            (FRAME_BUFFER_BYTES, "a frame of 2048 bytes or more", "a UDP datagram of 2034 bytes or more"),
        ] {
            let came = vec![0; length_bytes];
            assert_eq!([frames.what_came(&came), datagrams.what_came(&came)], [frame, datagram]);
        }
        let too_long = Loss::Defective(Defect::TooLong);
        assert_eq!(too_long.row(Envelope::Udp).1, format!("it is longer than 1,{} bytes", 1518 - 1000 - 14));
    }
}
