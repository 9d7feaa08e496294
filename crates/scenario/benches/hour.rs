//! How long an hour of virtual time takes: one unit in OP, process data every 1 ms, CPU task of 1 ms.
//!
//! `cargo bench -p ectwin-scenario --bench hour`

use std::time::Instant;

use scenario::{Recording, Scenario};

const HOUR: &str = r#"
title = "an hour in OP"
limit = "3601s"
steps = [
  { master = "take all units to OP" },
  { at = "3600s", expect = "unit 1 is in OP" },
]
"#;

fn main() {
    let scenario = match Scenario::parse(HOUR, |_| Err("no files here".to_owned())) {
        Ok(scenario) => scenario,
        Err(errors) => panic!("{errors}"),
    };
    let best = (0..3).map(|_| {
        let start = Instant::now();
        let report = scenario.replay(1, Recording::new(false, false));
        assert!(report.passes(), "{:?}", report.failure);
        (start.elapsed(), report.cycles)
    });
    let Some((elapsed, cycles)) = best.min() else { return };
    let seconds = elapsed.as_secs_f64();
    println!(
        "1 h of virtual time, {cycles} cycles: {seconds:.2} s, {:.0} times as fast as reality",
        3600.0 / seconds
    );
}
