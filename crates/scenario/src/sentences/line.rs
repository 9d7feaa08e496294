//! Sentences of the line: cables, and what happens to frames.

use crate::orders::Choice::{All, Behind, Next, Percent};
use crate::orders::{Choice, Disturbance, FrameFault, FrameKind, LineOrder};
use crate::sentence::{Sentence, Values};

const fn row(
    pattern: &'static str,
    example: &'static str,
    meaning: &'static str,
    build: fn(&Values) -> LineOrder,
) -> Sentence<LineOrder> {
    Sentence { pattern, example, meaning, build }
}

fn disturb(fault: FrameFault, kind: FrameKind, choice: Choice) -> LineOrder {
    LineOrder::Disturb(Disturbance { fault, kind, choice })
}

/// All of them.
#[rustfmt::skip]
pub const LINE: &[Sentence<LineOrder>] = &[
    row("unplug cable {cable}", "unplug cable 1", "the cable in front of a unit, 1 for the one to the master",
        |v| LineOrder::Cable { number: v.number(0).saturating_sub(1) as usize, plugged: false }),
    row("plug cable {cable}", "plug cable 1", "the cable in front of a unit, 1 for the one to the master",
        |v| LineOrder::Cable { number: v.number(0).saturating_sub(1) as usize, plugged: true }),
    row("lose the next {number} {frames}", "lose the next 3 frames", "they do not come to the units",
        |v| disturb(FrameFault::Lose, v.frames(1), Next(v.number(0)))),
    row("lose number {number} of the {frames}", "lose number 100 of the process data frames",
        "this one, counted from now", |v| disturb(FrameFault::Lose, v.frames(1), Behind(v.number(0).saturating_sub(1)))),
    row("lose all {frames}", "lose all process data frames", "until the line is quiet again",
        |v| disturb(FrameFault::Lose, v.frames(0), All)),
    row("lose {percent} of the {frames}", "lose 5 % of the frames", "each by the scenario's dice",
        |v| disturb(FrameFault::Lose, v.frames(1), Percent(v.percent(0)))),
    row("lose the answers of the next {number} {frames}", "lose the answers of the next 2 mailbox frames",
        "the units see them, the master gets nothing back", |v| disturb(FrameFault::LoseAnswer, v.frames(1), Next(v.number(0)))),
    row("lose the answers of {percent} of the {frames}", "lose the answers of 5 % of the mailbox frames",
        "each by the scenario's dice", |v| disturb(FrameFault::LoseAnswer, v.frames(1), Percent(v.percent(0)))),
    row("delay the next {number} {frames} by {duration}", "delay the next 2 frames by 5ms",
        "later frames may come before them", |v| disturb(FrameFault::Delay(v.duration(2)), v.frames(1), Next(v.number(0)))),
    row("delay {percent} of the {frames} by {duration}", "delay 10 % of the frames by 200us",
        "each by the scenario's dice", |v| disturb(FrameFault::Delay(v.duration(2)), v.frames(1), Percent(v.percent(0)))),
    row("duplicate the next {number} {frames}", "duplicate the next 1 frames", "they pass the units twice",
        |v| disturb(FrameFault::Duplicate, v.frames(1), Next(v.number(0)))),
    row("duplicate {percent} of the {frames}", "duplicate 5 % of the frames", "each by the scenario's dice",
        |v| disturb(FrameFault::Duplicate, v.frames(1), Percent(v.percent(0)))),
    row("cut the next {number} {frames} to {word} bytes", "cut the next 1 frames to 40 bytes",
        "they end early, so that no unit takes them", |v| disturb(FrameFault::Truncate(v.number(2) as usize), v.frames(1), Next(v.number(0)))),
    row("corrupt the next {number} {frames} on cable {cable}", "corrupt the next 1 frames on cable 1",
        "a bit error: the unit behind the cable counts an invalid frame, those behind it forwarded errors; nobody takes it",
        |v| disturb(FrameFault::Corrupt(v.number(2).saturating_sub(1) as usize), v.frames(1), Next(v.number(0)))),
    row("lower the working counter of the next {number} {frames}", "lower the working counter of the next 1 process data frames",
        "by one, in the answer", |v| disturb(FrameFault::WorkingCounter, v.frames(1), Next(v.number(0)))),
    row("be quiet", "be quiet", "no frame meets a fault any more; cables stay as they are", |_| LineOrder::Quiet),
];
