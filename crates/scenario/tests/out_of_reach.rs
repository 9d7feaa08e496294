//! Frames, messages, images and units that steps bring, the power of the CPU Rack and the calendar: what is refused, and what
//! a replay shows.

use scenario::{Files, Recording, Scenario, Wanted};

/// `long.bin` is longer than any EEPROM, `lint.bin` has findings, `other.toml` is a unit.
struct Given;

impl Files for Given {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        if path == "other.toml" {
            Ok("model = \"digital\"\ninputs = 8".into())
        } else {
            Err(format!("no {path}"))
        }
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        match path {
            "long.bin" => Ok(vec![0; 1 << 20]),
            "lint.bin" => Ok(vec![0; 128]),
            other => Err(format!("no {other}")),
        }
    }
}

fn parse(head: &str, steps: &[&str]) -> Result<Scenario, Vec<String>> {
    let steps: Vec<String> = steps.iter().map(|step| format!("{{ {step} }}")).collect();
    let text = format!("title = \"t\"\n{head}\nsteps = [{}]\n", steps.join(",\n"));
    Scenario::parse_with(&text, &mut Given)
        .map_err(|errors| errors.iter().map(|error| format!("{} / {}", error.message, error.help)).collect())
}

fn mistake(step: &str) -> String {
    match parse("", &[step]) {
        Ok(_) => panic!("{step} is read"),
        Err(mistakes) => mistakes.join("; "),
    }
}

/// The trace of a replay that passes.
fn trace(head: &str, steps: &[&str]) -> String {
    let scenario = parse(head, steps).unwrap_or_else(|mistakes| panic!("{mistakes:?}"));
    let report = scenario.replay(1, Recording::new(true, false));
    if let Some(failure) = report.failure {
        panic!("`{}`: {}\n{}", failure.text, failure.seen, report.recording.trace().unwrap_or_default());
    }
    report.recording.trace().unwrap_or_default().to_owned()
}

#[test]
fn what_cannot_be_sent_or_loaded_is_refused() {
    for (step, message, help) in [
        (
            "expect = \"the master has received emergency 0xFF20 from unit 1 with data 00 00\"",
            "2 bytes of data, and an emergency has 5",
            "after the error register",
        ),
        ("master = \"send the frame 01 02\"", "a frame of 2 bytes", "14 to 1514 bytes"),
        (
            "master = \"read 2 bytes from register 0xFFFF of unit 1\"",
            "2 bytes from register 0xFFFF on",
            "the ESC ends at 0xFFFF",
        ),
        (
            "unit = \"load no.bin into the SII of unit 1\"",
            "the SII image no.bin cannot be read: no no.bin",
            "",
        ),
        (
            "unit = \"load long.bin into the SII of unit 1\"",
            "long.bin has 1048576 bytes, and the EEPROM of unit 1 has",
            "at most as long as the EEPROM",
        ),
        (
            "unit = \"load lint.bin into the SII of unit 1\"",
            "lint.bin: ",
            "`load lint.bin as it is into the SII of unit 1` loads it nevertheless",
        ),
        ("unit = \"replace unit 1 by no.toml\"", "the unit file no.toml cannot be read: no no.toml", ""),
        ("unit = \"replace unit 2 by other.toml\"", "unit 2 does not exist", "1 unit"),
    ] {
        let found = mistake(step);
        let (found_message, found_help) = found.split_once(" / ").unwrap_or_default();
        assert!(found_message.starts_with(message) && found_help.contains(help), "{step}: {found}");
    }
    let long = format!("master = \"send unit 1 the mailbox message{}\"", " 00".repeat(401));
    assert!(mistake(&long).starts_with("401 bytes for a mailbox of 400"), "{}", mistake(&long));
}

/// A terminal has no logs and no mailbox, so that a condition on them would always hold, or never.
#[test]
fn reports_that_a_unit_cannot_make_are_refused() {
    let terminal = "units = [{ model = \"digital\", inputs = 8 }]";
    for (condition, message) in [
        ("the access event log of unit 1 is empty", "unit 1 is of the model digital, which has no event log"),
        ("unit 1 has 1 diagnosis messages", "unit 1 is of the model digital, which has no event log"),
        (
            "diagnosis message 1 of unit 1 without its time begins with 00",
            "unit 1 is of the model digital, which has no diagnosis history",
        ),
        ("no emergency of all units is lost", "unit 1 is of the model digital, which has no mailbox"),
        (
            "the master has received emergency 0xFF20 from unit 1",
            "unit 1 is of the model digital, which has no mailbox",
        ),
        (
            "the master has received emergency 0xFF20",
            "no unit of this scenario has an event with the emergency error code 0xFF20",
        ),
    ] {
        let refused = parse(terminal, &[&format!("never = \"{condition}\"")]).err().unwrap_or_default();
        assert!(refused.first().is_some_and(|found| found.starts_with(message)), "{condition}: {refused:?}");
    }
}

#[test]
fn a_calendar_that_is_none_is_refused_at_its_place() {
    let refused = |text: &str| match parse(&format!("calendar = {text}"), &["line = \"be quiet\""]) {
        Ok(_) => panic!("{text} is read"),
        Err(mistakes) => mistakes.join("; "),
    };
    let found = refused("\"2026-02-30T00:00:00\"");
    assert!(found.contains("date and time from 1970 to 2078 such as 2026-01-01T00:00:00"), "{found}");
    assert!(refused("5").contains("date and time such as"), "{}", refused("5"));
}

#[test]
fn the_system_time_begins_at_the_calendar() {
    let steps = [
        "master = \"take unit 1 to PRE-OP\"",
        "expect = \"unit 1 is in PRE-OP\", within = \"1s\"",
        "master = \"read SDO 10F8:00 of unit 1\"",
        "expect = \"the last SDO was taken\", within = \"1s\"",
    ];
    for (head, start_ns) in [
        ("calendar = \"2030-06-01T12:00:00\"", 1_906_545_600_000_000_000_u64),
        ("", 1_767_225_600_000_000_000),
    ] {
        let trace = trace(head, &steps);
        let (_, answer) =
            trace.split_once("SDO upload 10F8:00 of unit 1 gives ").unwrap_or_else(|| panic!("{trace}"));
        let bytes =
            answer.split_whitespace().take(8).map(|byte| u8::from_str_radix(byte, 16).unwrap_or_default());
        let time_ns = u64::from_le_bytes(bytes.collect::<Vec<_>>().try_into().unwrap_or_default());
        assert!((start_ns..start_ns + 1_000_000_000).contains(&time_ns), "{head}: {time_ns}");
    }
}

/// The master takes the unit at this place for the old one, and later steps are checked with the new one.
#[test]
fn a_unit_that_takes_the_place_of_another_is_the_one_of_later_steps() {
    let units = "units = [{ model = \"nx-ect101\" }, { model = \"nx-ect101\", name = \"N2\" }]";
    let swap = "unit = \"replace unit 2 by other.toml\"";
    let log = "expect = \"unit 2 is in INIT\"";
    let no_event = "expect = \"unit 2 has recorded 85000000\"";
    assert!(parse(units, &[no_event, swap, log]).is_ok());
    let refused = parse(units, &[swap, no_event]).err().unwrap_or_default();
    assert!(
        refused[0].starts_with("unit 2 is of the model digital, which has no event 85000000"),
        "{refused:?}"
    );

    let trace = trace(
        units,
        &[
            "master = \"take all units to OP\"",
            "expect = \"all units are in OP\", within = \"1s\"",
            swap,
            "expect = \"unit 2 is in INIT\"",
            "expect = \"unit 1 is in OP\"",
            "master = \"take unit 2 to OP\"",
            "expect = \"the master has given up\", within = \"20s\"",
        ],
    );
    assert!(trace.contains("unit 2    is replaced by other.toml"), "{trace}");
}

/// The NX bus has room for eight messages.
#[test]
fn the_load_of_nx_messages_causes_an_error_that_ends_with_a_reset() {
    trace(
        "",
        &[
            "cpu = \"send 8 NX messages to unit 1\"",
            "after = \"20ms\", expect = \"unit 1 has recorded nothing\"",
            "cpu = \"send 9 NX messages to unit 1\"",
            "expect = \"unit 1 has the error 80220000\", within = \"5ms\"",
            "after = \"1s\", expect = \"unit 1 has the error 80220000\"",
            "unit = \"reset the errors of unit 1\"",
            "expect = \"unit 1 has no error\"",
            "after = \"1s\", expect = \"unit 1 has recorded 80220000 1 times\"",
        ],
    );
    let found = mistake("cpu = \"send 0 NX messages to unit 1\"");
    assert!(found.starts_with("0 messages do nothing"), "{found}");
    let refused =
        parse("units = [{ model = \"digital\", inputs = 8 }]", &["cpu = \"send 9 NX messages to unit 1\""]);
    let refused = refused.err().unwrap_or_default();
    assert!(refused[0].starts_with("unit 1 is of the model digital, which has no NX objects"), "{refused:?}");
}

/// Manual, 8-2-2: what fails without an event shows only at the indicators.
#[test]
fn outages_have_no_event_and_end_with_a_start_without_their_cause() {
    for (outage, err) in [("Hardware", "lit"), ("CpuUnit", "not_lit")] {
        let [broken, repaired] =
            ["break", "repair"].map(|verb| format!("unit = \"{verb} {outage} of unit 1\""));
        let err = format!("expect = \"ERR of unit 1 is {err}\"");
        trace(
            "",
            &[
                "master = \"take unit 1 to OP\"",
                "expect = \"unit 1 is in OP\", within = \"1s\"",
                &broken,
                "after = \"5ms\", expect = \"unit 1 is in INIT\"",
                "expect = \"RUN of unit 1 is not_lit\"",
                &err,
                "expect = \"TS red of unit 1 is lit\"",
                "expect = \"TS green of unit 1 is not_lit\"",
                "expect = \"the I/O data of unit 1 is not active\", within = \"5ms\"",
                "expect = \"the CPU Unit of unit 1 sees an error\"",
                &repaired,
                "after = \"1s\", expect = \"TS red of unit 1 is lit\"",
                "unit = \"cycle the power of unit 1\"",
                "after = \"500ms\", expect = \"TS green of unit 1 is lit\"",
                "master = \"take unit 1 to OP\"",
                "expect = \"unit 1 is in OP\", within = \"2s\"",
                "expect = \"unit 1 has recorded nothing\"",
            ],
        );
    }
}

#[test]
fn a_cpu_unit_without_power_obeys_nothing() {
    let trace = trace(
        "",
        &[
            "steps = [{ cpu = \"power on the CPU Rack of unit 1\" }]",
            "cpu = \"power off the CPU Rack of unit 1\"",
            "cpu = \"set unit 1 to PROGRAM mode\"",
            "cpu = \"write N1_UINTs_01_C_to_M[0] as 5\"",
            "expect = \"variable N1_UINTs_01_C_to_M[0] has the value 0\"",
            "cpu = \"power on the CPU Rack of unit 1\"",
            "expect = \"the I/O data of unit 1 is active\", within = \"1s\"",
            "cpu = \"write N1_UINTs_01_C_to_M[0] as 5\"",
            "expect = \"variable N1_UINTs_01_C_to_M[0] has the value 5\"",
        ],
    );
    assert_eq!(trace.matches("cpu 1     has no power: the order has no effect").count(), 2, "{trace}");
    assert_eq!(trace.matches("cpu 1     has power: the order has no effect").count(), 1, "{trace}");
}
