//! Messages for the mailbox of a unit: SDOs of every kind, SDO information, and other messages.
//!
//! An input is a text with one step per line: see [`step`].

mod generate;
mod objects;
mod service;
mod step;

use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::real_files::Seeds;
use service::Service;
use step::Step;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "mailbox",
    extension: ".txt",
    seeds: || Seeds::of(&["tests/fuzz/mailbox"], ".txt"),
    generate: |_, random| generate::text(random).into_bytes(),
    check,
    limits: Limits {
        milliseconds: 2_000,
        milliseconds_per_kib: 50,
        memory_kib: 8 << 10,
        memory_per_byte: 256,
    },
    grains: &[Grain::Lines, Grain::Pairs],
};

fn check(input: &[u8]) -> Checked {
    let Ok(text) = std::str::from_utf8(input) else { return Ok("no steps") };
    let mut steps = text.lines().filter_map(|line| line.parse::<Step>().ok());
    let Some(Step::Unit { model, receive_bytes, send_bytes }) = steps.next() else { return Ok("no steps") };
    let mut service = Service::of(model, receive_bytes, send_bytes);
    for (number, step) in (2..).zip(steps) {
        service.step(&step).map_err(|reason| format!("step {number}, `{step}`: {reason}"))?;
    }
    Ok(service.outcome())
}
