//! Unit files: keys and values of every kind, and damaged real ones.
//!
//! Refused text has places of mistakes; an accepted unit is powered on, runs for its first milliseconds, and is
//! checked as by `ectwin check`.

use device::Device;
use digital::{BitImages, Terminal};
use ectwin::{Duration, Instant, Setup, SetupError, Twin};
use nx_ect101::Configuration;
use user_file::{FileErrors, MISTAKES_MAX};

use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::mistakes::{check_number, check_place, check_words};
use crate::random::Random;
use crate::real_files::Seeds;
use crate::text::{damaged, number};

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "unit-file",
    extension: ".toml",
    seeds: || Seeds::of(&["tests/fuzz/unit-file", "units", "tests/masters/units"], ".toml"),
    generate: |seeds, random| generate(seeds, random).into_bytes(),
    check,
    limits: Limits {
        milliseconds: 2_000,
        milliseconds_per_kib: 50,
        memory_kib: 16 << 10,
        memory_per_byte: 1_024,
    },
    grains: &[Grain::Lines, Grain::Words, Grain::Bytes],
};

/// How long an accepted unit runs.
const RUN: Duration = Duration::from_millis(20);

fn check(input: &[u8]) -> Checked {
    let Ok(text) = std::str::from_utf8(input) else { return Ok("no text") };
    let accepted = terminal(text)?;
    let setup = match Setup::from_toml(text) {
        Ok(setup) => setup,
        Err(SetupError::UnitFile(errors)) => {
            check_errors(text, &errors)?;
            return Ok(if accepted { "accepted" } else { "refused" });
        }
        // The text has no folder that could contain a program.
        Err(
            SetupError::ProgramUnreadable { span: Some(span), .. }
            | SetupError::Builtin { span: Some(span), .. },
        ) => {
            return text.get(span).map(|_| "program elsewhere").ok_or("a program without a place".to_owned());
        }
        Err(error) => return Err(format!("{error:?}")),
    };
    if let Some(file) = setup.file().section().as_model::<nx_ect101::unit_file::UnitFile>() {
        let _findings = Configuration::from_unit_file(file).check();
    }
    let _variables = setup.device_variables();
    let mut twin = Twin::power_on([setup]);
    twin.run_for(RUN);
    let mut frame = [0xFF; 60];
    frame[12..30].copy_from_slice(&[0x88, 0xA4, 14, 0x10, 7, 0, 0, 0, 0x30, 1, 2, 0, 0, 0, 0, 0, 0, 0]);
    twin.frame(&mut frame);
    if frame[28..30] == [1, 0] { Ok("accepted") } else { Err("the unit does not answer".to_owned()) }
}

fn check_errors(text: &str, errors: &FileErrors) -> Result<(), String> {
    check_number(errors.iter().count(), MISTAKES_MAX)?;
    for error in errors.iter() {
        check_place(text, &error.span, error.line, error.column)?;
        check_words(&error.words())?;
    }
    Ok(())
}

/// The same text as the unit file of a terminal: returns whether it is powered on.
fn terminal(text: &str) -> Result<bool, String> {
    let settings = match digital::UnitFile::parse(text) {
        Ok(file) => file.settings,
        Err(errors) => return check_errors(text, &errors).map(|()| false),
    };
    let config = digital::device_config(&settings);
    config.validate().map_err(|error| error.to_string())?;
    let unit = Terminal::power_on(&settings, BitImages::default());
    let (mut device, mut esc) = Device::power_on(config, unit, Instant::ZERO);
    let (mut now, end) = (Instant::ZERO, Instant::ZERO + RUN);
    while now < end {
        device.poll(&mut esc, now);
        let next = device.deadline().min(esc.deadline()).min(end);
        if next <= now {
            return Err("the terminal wants to be polled again at the same moment".to_owned());
        }
        now = next;
    }
    Ok(true)
}

/// Keys of every section.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "model", "name", "unit_number", "serial", "id_switch", "alias", "device_type", "unit_version", "lot_number",
    "hardware_version", "software_version", "timing", "start_up", "refresh_phase", "outputs_before_op", "blank_sii",
    "times", "refuse", "storage", "io_allocation", "pdo", "event_levels", "cpu", "behaviour", "loopback", "hold", "ramp", "sine", "square", "random", "counter", "csv", "period", "every", "m_to_c", "c_to_m", "uints", "bytes",
    "udint", "assign", "mapping", "rx", "tx", "1601", "1A01", "transitions", "sii", "mailbox", "PS", "SO", "init",
    "pre_op", "safe_op", "op", "acknowledge", "inputs", "outputs", "ports", "\"digital\"", "task_period",
    "task_phase", "mode", "fail_soft", "program", "statement_budget", "\"nx-ect101\"", "\"exact\"", "\"fast\"",
    "\"run\"", "\"required\"", "\"not-required\"", "\"builtin:copy\"", "\"1ms\"", "\"125us\"", "\"60s\"", "true",
    "false", "\"39160000\"", "\"observation\"", "\"6000:01\"", "[]", "{}", "inf", "nan", "1979-05-27T07:32:00Z",
];

fn generate(seeds: &Seeds, random: &mut Random) -> String {
    let text = if random.once_in(2) && !seeds.texts.is_empty() {
        random.one_of(&seeds.texts).clone()
    } else {
        file(random)
    };
    if random.once_in(3) { text } else { damaged(&text, WORDS, &seeds.texts, random) }
}

/// A key, and the text after it.
type Key = (&'static str, fn(&mut Random) -> String);

/// Those of every model.
const KEYS: &[Key] = &[
    ("name", |random| quoted(random.text_of(&["N1", "Unit_2", "", "a b", "_x", "ä", "N__1"]))),
    ("serial", number),
    ("alias", number),
    ("timing", |random| quoted(random.text_of(&["exact", "fast", "slow"]))),
    ("start_up", duration),
    ("refresh_phase", duration),
    ("outputs_before_op", |random| quoted(random.text_of(&["required", "not-required", "never"]))),
    ("blank_sii", |random| random.once_in(2).to_string()),
    ("times.transitions", |random| {
        let each = format!("{{ PS = {}, IP = {} }}", duration(random), duration(random));
        if random.once_in(2) { duration(random) } else { each }
    }),
    ("times.sii", duration),
    ("times.mailbox", duration),
    ("refuse.safe_op", number),
    ("refuse.acknowledge", |random| random.once_in(2).to_string()),
];

/// Those of the NX-ECT101.
const NX_KEYS: &[Key] = &[
    ("unit_number", |random| random.between(0, 40).to_string()),
    ("id_switch", |random| format!("0x{:02X}", random.byte())),
    ("device_type", number),
    ("unit_version", |random| quoted(random.text_of(&["1.0", "1.13", "", "x", "255.255", "1.0.0"]))),
    ("lot_number", number),
    ("hardware_version", |random| {
        quoted(random.text_of(&["V1.00", "", "12345678901234567890", "123456789012345678901"]))
    }),
    ("io_allocation.m_to_c.uints", entries),
    ("io_allocation.m_to_c.bytes", entries),
    ("io_allocation.m_to_c.udint", entries),
    ("io_allocation.c_to_m.uints", entries),
    ("io_allocation.c_to_m.bytes", entries),
    ("io_allocation.c_to_m.udint", entries),
    ("pdo.assign.rx", indexes),
    ("pdo.assign.tx", indexes),
    ("pdo.mapping.1601", entries),
    ("pdo.mapping.1a02", entries),
    ("pdo.mapping.1A03", entries),
    ("event_levels.\"39160000\"", |random| quoted(random.text_of(&["observation", "minor_fault", "fault"]))),
    ("cpu.task_period", duration),
    ("cpu.task_phase", duration),
    ("cpu.mode", |random| quoted(random.text_of(&["run", "program", "stop"]))),
    ("cpu.fail_soft", |random| random.once_in(2).to_string()),
    ("cpu.statement_budget", number),
    ("cpu.program", |random| {
        quoted(random.text_of(&["builtin:copy", "builtin:messages", "builtin:pulse", "builtin:", "a.st", ""]))
    }),
];

/// Those of a terminal.
const DIGITAL_KEYS: &[Key] = &[
    ("inputs", |random| random.between(0, 70).to_string()),
    ("outputs", |random| random.between(0, 70).to_string()),
    ("ports", |random| random.between(1, 5).to_string()),
    ("mailbox", |random| random.once_in(4).to_string()),
];

/// A file with some keys in any order.
fn file(random: &mut Random) -> String {
    let (model, own) =
        *random.one_of(&[("nx-ect101", NX_KEYS), ("nx-ect101", NX_KEYS), ("digital", DIGITAL_KEYS)]);
    let mut lines = vec![format!("model = {}", quoted(model))];
    for _ in 0..random.between(0, 12) {
        let keys = if random.once_in(3) { KEYS } else { own };
        let (key, value) = random.one_of(keys);
        let at = random.below(lines.len() + 1);
        lines.insert(at, format!("{key} = {}", value(random)));
    }
    lines.join("\n") + "\n"
}

fn quoted(text: &str) -> String {
    format!("\"{text}\"")
}

fn duration(random: &mut Random) -> String {
    let unit = random.text_of(&["us", "us", "ms", "ms", "s", "ns", ""]);
    let number = *random.one_of(&[0, 1, 2, 5, 32, 33, 125, 250, 500, 60_000, 9_000_000_000_u64]);
    format!("\"{number}{unit}\"")
}

/// A number of entries, or a list of them.
fn entries(random: &mut Random) -> String {
    if random.once_in(2) {
        return random.between(0, 60).to_string();
    }
    let count = *random.one_of(&[0, 1, 2, 6, 40, 260]);
    let index = *random.one_of(&[0x6000, 0x6001, 0x6002, 0x7000, 0x7001, 0x7002, 0x6003]);
    let first = random.between(0, 4);
    let list: Vec<String> = (first..first + count)
        .map(|sub| {
            let index = if random.once_in(30) { random.word() } else { index };
            format!("\"{index:04X}:{:02X}\"", sub & 0xFF)
        })
        .collect();
    format!("[{}]", list.join(", "))
}

fn indexes(random: &mut Random) -> String {
    let list: Vec<String> = (0..random.below(7))
        .map(|_| {
            let known = *random.one_of(&[0x1601, 0x1602, 0x1603, 0x1A00, 0x1A01, 0x1A02, 0x1BFE, 0x1BFF]);
            format!("0x{:04X}", if random.once_in(10) { random.word() } else { known })
        })
        .collect();
    format!("[{}]", list.join(", "))
}
