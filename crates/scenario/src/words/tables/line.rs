//! Sentences of the line: cables, and faults of frames.

use crate::model::LineOrder::{self, *};
use crate::model::{Disturbance, FrameFault};
use crate::words::sentence::{Sentence, row};

/// All of them.
#[rustfmt::skip]
pub const LINE: &[Sentence<LineOrder>] = &[
    row!("unplug cable {cable}", "unplug cable 1",
        "the cable before a unit, 1 for the one to the master; the last unit has no other",
        |cable| Unplug { cable }),
    row!("plug cable {cable}", "plug cable 1",
        "the cable before a unit, 1 for the one to the master; the last unit has no other",
        |cable| Plug { cable }),
    row!("lose {frames}", "lose the next 3 frames",
        "they do not reach the units",
        |frames| Disturb(Disturbance { fault: FrameFault::Lose, frames })),
    row!("lose the answers of {frames}", "lose the answers of 5 % of the mailbox frames",
        "the units process them, but their answers are lost",
        |frames| Disturb(Disturbance { fault: FrameFault::LoseAnswer, frames })),
    row!("delay {frames} by {period}", "delay 10 % of the frames by 200us",
        "later frames may overtake them",
        |frames, by| Disturb(Disturbance { fault: FrameFault::Delay { by }, frames })),
    row!("duplicate {frames}", "duplicate number 7 of the frames",
        "they pass the units twice",
        |frames| Disturb(Disturbance { fault: FrameFault::Duplicate, frames })),
    row!("cut {frames} to {length} bytes", "cut the next 1 frames to 40 bytes",
        "they are cut, so that no unit accepts them",
        |frames, length_bytes| Disturb(Disturbance { fault: FrameFault::Cut { length_bytes }, frames })),
    row!("corrupt {frames} on cable {cable}", "corrupt numbers 3 to 9 of the process data frames on cable 1",
        "a bit error: the unit after the cable counts an invalid frame, the units after it count forwarded errors; none of them accepts it",
        |frames, cable| Disturb(Disturbance { fault: FrameFault::Corrupt { cable }, frames })),
    row!("lower the working counter of {frames}", "lower the working counter of all process data frames",
        "by one, in the answer",
        |frames| Disturb(Disturbance { fault: FrameFault::LowerWorkingCounter, frames })),
    row!("be quiet", "be quiet",
        "no frame meets a fault any more; cables stay as they are",
        || BeQuiet),
];
