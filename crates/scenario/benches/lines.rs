//! How the cost of virtual time increases with a line: 36 s in OP, process data every 1 ms, for 1, 25 and 100
//! units; each with its own user program and small process data, as in the factory setting.
//!
//! `cargo bench -p ectwin-scenario --bench lines`, or with other lengths: `… --bench lines -- 10 1000`
//!
//! `… --bench lines -- once 25 300` replays 25 units once until 300 ms after all are in OP, to count instructions: the
//! difference between two durations is free of the start-up. docs/performance.md has the command.

use std::time::Instant;

use scenario::{Recording, Scenario};

/// Cycles of 1 ms that are counted.
const SECONDS: u32 = 36;
const LINES: [usize; 3] = [1, 25, 100];

fn main() {
    let arguments: Vec<String> = std::env::args().skip_while(|argument| argument != "once").collect();
    if let [_, count, millis, ..] = arguments.as_slice()
        && let (Ok(count), Ok(millis)) = (count.parse(), millis.parse())
    {
        replay(count, millis);
        return;
    }
    let named: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let lines = if named.is_empty() { LINES.to_vec() } else { named };
    let mut last: Option<(usize, f64)> = None;
    for count in lines {
        let seconds = measure(count);
        let faster = f64::from(SECONDS) / seconds;
        print!(
            "{count} units: {SECONDS} s of virtual time in {seconds:.2} s, {faster:.1} times as fast as reality"
        );
        if let Some((fewer, before)) = last {
            print!(", {:.2} times as long as {fewer} units", seconds / before);
        }
        println!();
        last = Some((count, seconds));
    }
}

/// The time of the exchange alone: the time of a line that ends when all units are in OP is subtracted.
fn measure(count: usize) -> f64 {
    replay(count, SECONDS * 1_000) - replay(count, 0)
}

fn replay(count: usize, millis: u32) -> f64 {
    let units = vec![r#"{ model = "nx-ect101", start_up = "0ms" }"#; count].join(", ");
    let text = format!(
        r#"
title = "a line in OP"
limit = "600s"
units = [{units}]
steps = [
  {{ master = "take all units to OP" }},
  {{ expect = "all units are in OP", within = "300s" }},
  {{ after = "{millis}ms", expect = "all units are in OP" }},
]
"#
    );
    let no_program = |_: &str| Err("no such program".to_owned());
    let scenario = match Scenario::parse(&text, no_program) {
        Ok(scenario) => scenario,
        Err(errors) => panic!("{errors}"),
    };
    let start = Instant::now();
    let report = scenario.replay(1, Recording::new(false, false));
    assert!(report.passes(), "{:?}", report.failure);
    start.elapsed().as_secs_f64()
}
