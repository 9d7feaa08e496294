//! Frames for a line of units: chains of datagrams, damaged ones, cables and power, and the states in between.
//!
//! An input is a text with one step per line: see [`step`].

mod end_state;
mod even;
mod frame_rules;
mod generate;
mod images;
mod line;
mod line_rules;
mod step;
mod units;
mod watched;

use std::fmt::Write;

use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::real_files::Seeds;
use line::Line;
use step::Step;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "frames",
    extension: ".txt",
    seeds: || Seeds::of(&["tests/fuzz/frames"], ".txt"),
    generate: |_, random| text(&generate::steps(random)).into_bytes(),
    check,
    limits: Limits {
        milliseconds: 4_000,
        milliseconds_per_kib: 50,
        memory_kib: 16 << 10,
        memory_per_byte: 256,
    },
    grains: &[Grain::Lines, Grain::Clauses, Grain::Pairs],
};

fn text(steps: &[Step]) -> String {
    let mut text = String::new();
    for step in steps {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{step}");
    }
    text
}

fn check(input: &[u8]) -> Checked {
    let Ok(text) = std::str::from_utf8(input) else { return Ok("no steps") };
    let mut steps = text.lines().filter_map(|line| line.parse::<Step>().ok()).peekable();
    let Some(Step::Line(models)) = steps.next() else { return Ok("no steps") };
    let mut line = Line::of(&models);
    for (number, step) in (2..).zip(steps) {
        line.step(&step).map_err(|reason| format!("step {number}, `{step}`: {reason}"))?;
    }
    line.end()?;
    Ok(line.outcome())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn steps_are_read_as_they_are_written() {
        for seed in 0..2_000 {
            let steps = generate::steps(&mut Random::of_input(seed, 0));
            let read: Vec<Step> = text(&steps).lines().map(|line| line.parse().unwrap()).collect();
            assert_eq!(read, steps);
        }
    }

    #[test]
    fn a_fresh_line_comes_to_op() {
        for models in ["line nx nx nx", "line even even even", "line terminal nx even"] {
            let steps = "bring 0 op\nbring 1 op\nbring 2 op\ncycle 5A\nwait 2000\ncycle 5B\n";
            assert_eq!(check(format!("{models}\n{steps}").as_bytes()), Ok("op"), "{models}");
        }
    }
}
