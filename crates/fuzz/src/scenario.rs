//! Scenario files: sentences of every kind, and damaged real ones.
//!
//! Refused text has places of mistakes; accepted text is replayed for a while, and two replays are equal.

use scenario::words::{CONDITIONS, CPU, LINE, MASTER, Sentence, UNIT};
use scenario::{ErrorPlace, Recording, Scenario};
use time::Duration;
use user_file::MISTAKES_MAX;

use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::mistakes::{check_number, check_place, check_words};
use crate::random::Random;
use crate::real_files::Seeds;
use crate::text::damaged;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "scenario",
    extension: ".toml",
    seeds: || Seeds::of(&["tests/fuzz/scenario", "scenarios", "tests/cases"], ".toml"),
    generate: |seeds, random| generate(seeds, random).into_bytes(),
    check,
    limits: Limits {
        milliseconds: 10_000,
        milliseconds_per_kib: 100,
        memory_kib: 64 << 10,
        memory_per_byte: 4_096,
    },
    grains: &[Grain::Lines, Grain::Words, Grain::Bytes],
};

/// How long an accepted scenario is replayed, the maximum number of periods, and the maximum number of units.
const REPLAYED: Duration = Duration::from_millis(50);
const PERIODS_MAX: u64 = 500;
const UNITS_MAX: usize = 4;

/// The contents of a program file: it ends soon in every scenario.
const PROGRAM: &str = "VAR n : UINT; flag : BOOL; kept : ARRAY[0..3] OF INT; END_VAR\nn := n + 1;\nflag := NOT flag;\n\
    IF n MOD 10 = 0 THEN kept[n MOD 4] := kept[n MOD 4] + 1; END_IF;\n";

fn check(input: &[u8]) -> Checked {
    let Ok(text) = std::str::from_utf8(input) else { return Ok("no text") };
    let mut scenario = match Scenario::parse(text, file) {
        Ok(scenario) => scenario,
        Err(errors) => {
            check_number(errors.iter().count(), MISTAKES_MAX)?;
            for error in errors.iter() {
                let ErrorPlace::Text { line, column, span } = &error.place else {
                    return Err(format!("a mistake of a file without a place: {error}"));
                };
                check_place(text, span, *line, *column)?;
                check_words(&error.message)?;
            }
            return Ok("refused");
        }
    };
    if scenario.units.len() > UNITS_MAX {
        return Ok("too many units");
    }
    let periods = Duration::from_nanos(scenario.cycle.as_nanos().saturating_mul(PERIODS_MAX));
    scenario.limit = scenario.limit.min(REPLAYED).min(periods);
    let replay = || scenario.replay(scenario.seed, Recording::new(true, true));
    let report = replay();
    if let Some(failure) = &report.failure
        && (failure.line == 0 || failure.line > text.lines().count())
    {
        return Err(format!("a failure in line {} of {}", failure.line, text.lines().count()));
    }
    let again = replay();
    if report.recording.trace() != again.recording.trace() || report.failure != again.failure {
        return Err("a second replay goes another way".to_owned());
    }
    Ok(if report.passes() { "passed" } else { "failed" })
}

/// The files that scenarios refer to: the same text for all programs, and a unit for the others.
fn file(path: &str) -> Result<String, String> {
    match path.rsplit_once('.') {
        Some((_, "st")) => Ok(PROGRAM.to_owned()),
        Some((_, "toml")) if path.contains("messages") => {
            Ok("model = \"nx-ect101\"\ncpu.program = \"builtin:messages\"".to_owned())
        }
        Some((_, "toml")) => {
            Ok("model = \"nx-ect101\"\ntiming = \"fast\"\ncpu.program = \"builtin:copy\"".to_owned())
        }
        _ => Err("there is no such file".to_owned()),
    }
}

/// Keys, and words of sentences.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "title", "seed", "limit", "cycle", "cycle_phase", "calendar", "capture", "master", "units", "steps", "at", "after", "when",
    "unit", "cpu", "line", "expect", "never", "within", "for", "until", "repeat", "every", "jitter", "random", "together", "while",
    "\"10ms\"", "\"0ms\"", "\"1us\"", "\"5m\"", "\"1 000ms\"", "all", "units", "INIT", "PRE-OP", "SAFE-OP", "OP", "1",
    "2", "3", "0x0020", "85000000", "6000:01", "the", "next", "frames", "%", "not", "is", "are", "has", "program",
];

fn generate(seeds: &Seeds, random: &mut Random) -> String {
    let text = if random.once_in(2) && !seeds.texts.is_empty() {
        random.one_of(&seeds.texts).clone()
    } else {
        any_file(random)
    };
    if random.once_in(3) { text } else { damaged(&text, WORDS, &seeds.texts, random) }
}

/// A file of steps with sentences of the tables, some with a word replaced.
fn any_file(random: &mut Random) -> String {
    let units: Vec<String> = (0..random.between(0, 3)).map(|_| unit(random)).collect();
    let mut text = format!("title = \"a fuzzer\"\nseed = {}\n", random.below(1_000));
    if !units.is_empty() {
        text.push_str(&format!("units = [{}]\n", units.join(", ")));
    }
    if random.once_in(6) {
        text.push_str("master = { program = \"programs/a-3-3.st\" }\n");
    }
    if random.once_in(6) {
        text.push_str(&format!(
            "cycle = \"{}\"\n",
            random.text_of(&["250us", "1ms", "4ms", "100ms", "0ms", "1ns"])
        ));
    }
    text.push_str("steps = [\n");
    if !random.once_in(4) {
        text.push_str("  { master = \"take all units to OP\" },\n");
    }
    for _ in 0..random.between(1, 10) {
        let entry = entry(random, 0);
        text.push_str(&format!("  {{ {entry} }},\n"));
    }
    text + "]\n"
}

/// How deep the groups of a file are in each other.
const GROUPS_MAX: usize = 3;

/// A step, or a group of some.
fn entry(random: &mut Random, depth: usize) -> String {
    if depth == GROUPS_MAX || !random.once_in(6) {
        return step(random);
    }
    let mut list = || {
        let entries = (0..random.between(1, 3)).map(|_| format!("{{ {} }}", entry(random, depth + 1)));
        entries.collect::<Vec<_>>().join(", ")
    };
    let (first, second) = (list(), list());
    match random.below(4) {
        0 => format!("steps = [{first}]"),
        1 => format!(
            "{}repeat = {}, every = \"{}\", steps = [{first}]",
            moment(random),
            random.one_of(&[1, 2, 10, 10_000]),
            time(random)
        ),
        2 => format!("{}together = [[{first}], [{second}]]", moment(random)),
        _ => format!(
            "for.unit = {}, steps = [{}]",
            random.text_of(&["[1, 2]", "[3]", "{ from = 1, to = 3 }"]),
            first.replace("unit 1", "unit {unit}")
        ),
    }
}

fn unit(random: &mut Random) -> String {
    (*random.one_of(&[
        "{ model = \"nx-ect101\" }",
        "{ model = \"nx-ect101\", timing = \"fast\" }",
        "{ model = \"nx-ect101\", name = \"N2\", id_switch = 2, unit_number = 2 }",
        "{ model = \"nx-ect101\", name = \"N3\", id_switch = 3, cpu = { program = \"builtin:copy\" } }",
        "\"../../units/nx-ect101.toml\"",
        "{ file = \"../../units/nx-ect101-messages.toml\", program = \"programs/a-4-3.st\" }",
    ]))
    .to_owned()
}

/// When a step or a group is due.
fn moment(random: &mut Random) -> String {
    match random.below(6) {
        0 => format!("at = \"{}\", ", time(random)),
        1 => format!("after = \"{}\", ", time(random)),
        2 => format!("when = \"{}\", ", sentence(CONDITIONS, random)),
        3 => format!("after = \"{}\", jitter = \"{}\", ", time(random), time(random)),
        _ => String::new(),
    }
}

fn step(random: &mut Random) -> String {
    let moment = moment(random);
    let order = match random.below(8) {
        0 | 1 => format!("master = \"{}\"", sentence(MASTER, random)),
        2 => format!("unit = \"{}\"", sentence(UNIT, random)),
        3 => format!("cpu = \"{}\"", sentence(CPU, random)),
        4 => format!("line = \"{}{}\"", sentence(LINE, random), ends_of_fault(random)),
        5 => format!("expect = \"{}\", within = \"{}\"", sentence(CONDITIONS, random), time(random)),
        6 => format!("never = \"{}\"", sentence(CONDITIONS, random)),
        _ => format!(
            "expect = \"{}\", until = \"{}\"",
            sentence(CONDITIONS, random),
            sentence(CONDITIONS, random)
        ),
    };
    let again = if random.once_in(10) {
        format!(", repeat = {}", random.one_of(&[0, 2, 10, 1_000_000]))
    } else {
        String::new()
    };
    format!("{moment}{order}{again}")
}

fn time(random: &mut Random) -> String {
    (random.text_of(&["0ms", "1us", "1ms", "2ms", "5ms", "10ms", "20ms", "45ms", "100ms", "1s", "3h"]))
        .to_owned()
}

/// What a fault of frames can end with.
fn ends_of_fault(random: &mut Random) -> String {
    let ends =
        ["", "", " on the way back", " on cable 2", " for 20ms", " called storm", " for 1ms called storm"];
    (random.text_of(&ends)).to_owned()
}

/// An example of a table, sometimes with a word replaced.
fn sentence<T>(table: &[Sentence<T>], random: &mut Random) -> String {
    let example = random.one_of(table).example;
    if !random.once_in(4) {
        return example.to_owned();
    }
    let stranger = random.one_of(table).example;
    let mut words: Vec<&str> = example.split(' ').collect();
    let others: Vec<&str> = stranger.split(' ').collect();
    let at = random.below(words.len());
    words[at] = others[random.below(others.len())];
    words.join(" ")
}
