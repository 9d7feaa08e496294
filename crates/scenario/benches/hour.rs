//! The duration of an hour of virtual time: one unit in OP, process data every 1 ms, CPU task of 1 ms; without
//! a user program, with the manual's A-3-3, and with A-4-4 plus A-4-3 in the master.
//!
//! `cargo bench -p ectwin-scenario --bench hour`
//!
//! `… --bench hour -- once A-3-3 3000` replays the first 3,000 ms of one of them once, to count its instructions: the
//! difference between two lengths is free of the start-up. docs/performance.md has the command.

use std::time::Instant;

use scenario::{Recording, Scenario};

const HOURS: [(&str, &str); 3] = [
    (
        "no program",
        r#"
title = "an hour in OP"
limit = "3601s"
steps = [
  { master = "take all units to OP" },
  { at = "END", expect = "unit 1 is in OP" },
]
"#,
    ),
    (
        "A-3-3",
        r#"
title = "an hour in OP"
limit = "3601s"
units = [{ model = "nx-ect101", cpu.program = "a-3-3.st" }]
steps = [
  { master = "take all units to OP" },
  { at = "END", expect = "unit 1 is in OP" },
]
"#,
    ),
    (
        "A-4-4, A-4-3 at the master",
        r#"
title = "an hour in OP"
limit = "3601s"
master = { program = "a-4-3.st" }
units = [{ model = "nx-ect101", io_allocation = { m_to_c = { uints = 6 }, c_to_m = { uints = 6, udint = 1 } }, cpu.program = "a-4-4.st" }]
steps = [
  { master = "let unit 1 map 0x1A03 as 6002:01" },
  { master = "let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1A03 1BFE" },
  { master = "take all units to OP" },
  { at = "END", expect = "program variable CPUUnit_RunMode of the master is TRUE" },
]
"#,
    ),
];

const PROGRAMS: [(&str, &str); 3] = [
    ("a-3-3.st", include_str!("../../../scenarios/programs/a-3-3.st")),
    ("a-4-3.st", include_str!("../../../scenarios/programs/a-4-3.st")),
    ("a-4-4.st", include_str!("../../../scenarios/programs/a-4-4.st")),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip_while(|argument| argument != "once").collect();
    if let [_, name, millis, ..] = arguments.as_slice() {
        return once(name, millis);
    }
    for (name, text) in HOURS {
        measure(name, &scenario(text, "3600s"));
    }
}

fn once(name: &str, millis: &str) {
    let named = HOURS.iter().find(|(known, _)| *known == name);
    let Some((_, text)) = named else {
        panic!("there is no {name}; there are {:?}", HOURS.map(|(name, _)| name))
    };
    let report = scenario(text, &format!("{millis}ms")).replay(1, Recording::new(false, false));
    assert!(report.passes(), "{:?}", report.failure);
}

/// The scenario with this end.
fn scenario(text: &str, end: &str) -> Scenario {
    let program = |path: &str| {
        let program = PROGRAMS.iter().find(|(known, _)| *known == path);
        program.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "no such program".to_owned())
    };
    match Scenario::parse(&text.replace("END", end), program) {
        Ok(scenario) => scenario,
        Err(errors) => panic!("{errors}"),
    }
}

fn measure(name: &str, scenario: &Scenario) {
    let best = (0..3).map(|_| {
        let start = Instant::now();
        let report = scenario.replay(1, Recording::new(false, false));
        assert!(report.passes(), "{:?}", report.failure);
        (start.elapsed(), report.cycles)
    });
    let Some((elapsed, cycles)) = best.min() else { return };
    let seconds = elapsed.as_secs_f64();
    println!(
        "{name}: 1 h of virtual time, {cycles} cycles: {seconds:.2} s, {:.0} times as fast as reality",
        3600.0 / seconds
    );
}
