//! Sentences of the line: cables, and faults of frames.

use crate::model::LineOrder::{self, *};
use crate::model::{Disturbance, FrameFault, Way};
use crate::words::sentence::{Sentence, row};

/// All of them.
#[rustfmt::skip]
pub const LINE: &[Sentence<LineOrder>] = &[
    row!("unplug cable {cable}", "unplug cable 1",
        "the cable in front of this unit, 1 for the cable to the master; nothing is plugged in behind the last unit",
        |cable| Unplug { cable }),
    row!("plug cable {cable}", "plug cable 1",
        "the cable in front of this unit, 1 for the cable to the master; nothing is plugged in behind the last unit",
        |cable| Plug { cable }),
    row!("lose {frames} {way} {lasting} {called}", "lose the next 3 frames",
        "they do not reach the units behind the place; on the way back their answers are lost",
        |frames, way, lasts, name| Disturb(Disturbance { fault: FrameFault::Lose, frames, way, lasts, name })),
    row!("lose the answers of {frames} {lasting} {called}", "lose the answers of 5 % of the mailbox frames",
        "the units process them, but their answers are lost",
        |frames, lasts, name| Disturb(Disturbance { fault: FrameFault::LoseAnswer, frames, way: Way::ANYWHERE, lasts, name })),
    row!("delay {frames} {way} by {delay} {lasting} {called}", "delay 10 % of the frames by 200us",
        "later frames may overtake them",
        |frames, way, by, lasts, name| Disturb(Disturbance { fault: FrameFault::Delay { by }, frames, way, lasts, name })),
    row!("duplicate {frames} {direction} {lasting} {called}", "duplicate number 7 of the frames",
        "they pass the units twice; on the way back only their answers arrive twice",
        |frames, direction, lasts, name| Disturb(Disturbance { fault: FrameFault::Duplicate, frames, way: Way { cable: None, direction }, lasts, name })),
    row!("swap {frames} with the next one {direction} {lasting} {called}", "swap every 10th of the frames with the next one",
        "they pass the units after the frame that follows, or after 100 ms without one; on the way back the answers change places",
        |frames, direction, lasts, name| Disturb(Disturbance { fault: FrameFault::Swap, frames, way: Way { cable: None, direction }, lasts, name })),
    row!("cut {frames} {direction} to {length} bytes {lasting} {called}", "cut the next 1 frames to 40 bytes",
        "they are cut, so that no unit accepts them; on the way back the answers arrive cut",
        |frames, direction, length_bytes, lasts, name| Disturb(Disturbance { fault: FrameFault::Cut { length_bytes }, frames, way: Way { cable: None, direction }, lasts, name })),
    row!("corrupt {frames} on cable {cable} {direction} {lasting} {called}", "corrupt numbers 3 to 9 of the process data frames on cable 1",
        "a bit error: the unit after the cable counts an invalid frame, the units after it count forwarded errors; none of them accepts it. On the way back the units before the cable count them, and the answer is lost",
        |frames, cable, direction, lasts, name| Disturb(Disturbance { fault: FrameFault::Corrupt { cable }, frames, way: Way { cable: None, direction }, lasts, name })),
    row!("lower the working counter of {frames} {lasting} {called}", "lower the working counter of all process data frames",
        "by one, in all datagrams of the answer; with `of unit 2` only in those that address this unit",
        |frames, lasts, name| Disturb(Disturbance { fault: FrameFault::LowerWorkingCounter, frames, way: Way::ANYWHERE, lasts, name })),
    row!("lower the working counter of {frames} by {lowering} {lasting} {called}", "lower the working counter of all LRW frames of unit 1 by 3",
        "the same by this number; no working counter goes below 0",
        |frames, by, lasts, name| Disturb(Disturbance { fault: FrameFault::LowerWorkingCounterBy { by }, frames, way: Way::ANYWHERE, lasts, name })),
    row!("end {fault-name}", "end storm",
        "ends the fault with this name; frames that it has delayed still arrive",
        |name| End { name }),
    row!("be quiet", "be quiet",
        "ends all faults of frames; frames that are delayed still arrive, and cables stay as they are",
        || BeQuiet),
];
