//! Sentences of the line: cables, and what happens to frames.

use crate::model::{Choice, Disturbance, FrameFault, FrameKind, LineOrder};
use crate::words::sentence::{Sentence, row};

fn disturb(fault: FrameFault, (choice, kind): (Choice, FrameKind)) -> LineOrder {
    LineOrder::Disturb(Disturbance { fault, kind, choice })
}

/// All of them.
#[rustfmt::skip]
pub const LINE: &[Sentence<LineOrder>] = &[
    row("unplug cable {cable}", "unplug cable 1", "the cable in front of a unit, 1 for the one to the master",
        |v| LineOrder::Cable { number: v.number(0).saturating_sub(1) as usize, plugged: false }),
    row("plug cable {cable}", "plug cable 1", "the cable in front of a unit, 1 for the one to the master",
        |v| LineOrder::Cable { number: v.number(0).saturating_sub(1) as usize, plugged: true }),
    row("lose {frames}", "lose the next 3 frames", "they do not come to the units", |v| disturb(FrameFault::Lose, v.frames(0))),
    row("lose the answers of {frames}", "lose the answers of 5 % of the mailbox frames",
        "the units see them, the master gets nothing back", |v| disturb(FrameFault::LoseAnswer, v.frames(0))),
    row("delay {frames} by {duration}", "delay 10 % of the frames by 200us", "later frames may come before them",
        |v| disturb(FrameFault::Delay(v.duration(1)), v.frames(0))),
    row("duplicate {frames}", "duplicate number 7 of the frames", "they pass the units twice",
        |v| disturb(FrameFault::Duplicate, v.frames(0))),
    row("cut {frames} to {word} bytes", "cut the next 1 frames to 40 bytes", "they end early, so that no unit takes them",
        |v| disturb(FrameFault::Truncate(v.number(1) as usize), v.frames(0))),
    row("corrupt {frames} on cable {cable}", "corrupt numbers 3 to 9 of the process data frames on cable 1",
        "a bit error: the unit behind the cable counts an invalid frame, those behind it forwarded errors; nobody takes it",
        |v| disturb(FrameFault::Corrupt(v.number(1).saturating_sub(1) as usize), v.frames(0))),
    row("lower the working counter of {frames}", "lower the working counter of all process data frames",
        "by one, in the answer", |v| disturb(FrameFault::WorkingCounter, v.frames(0))),
    row("be quiet", "be quiet", "no frame meets a fault any more; cables stay as they are", |_| LineOrder::Quiet),
];
