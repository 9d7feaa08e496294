//! Scenario files: repetitions, and refusals, with their places and remedies.

use scenario::{Recording, Scenario};

fn errors(text: &str) -> String {
    match Scenario::parse(text, |path| Err(format!("{path} is not there"))) {
        Ok(_) => panic!("it was taken: {text}"),
        Err(errors) => errors.to_string(),
    }
}

fn step(step: &str) -> String {
    errors(&format!("title = \"t\"\nsteps = [\n  {step},\n]\n"))
}

#[test]
fn a_step_can_repeat_and_jitter_follows_the_seed() {
    let text = r#"
title = "resets, again and again"
steps = [
  { unit = "break IoCommunications of unit 1" },
  { after = "5ms", unit = "reset the errors of unit 1", repeat = 10, every = "10ms", jitter = "3ms" },
  { after = "1ms", expect = "unit 1 has recorded 80200000 11 times" },
]
"#;
    let scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    let trace = |seed| {
        let report = scenario.replay(seed, Recording::new(true, false));
        assert_eq!(report.failure, None);
        report.recording.trace().unwrap_or_default().to_owned()
    };
    assert_eq!(trace(1), trace(1));
    assert_ne!(trace(1), trace(2), "other moments");
}

#[test]
fn a_wrong_step_is_told_with_its_place_and_the_way_out() {
    let cases = [
        ("{ master = \"tke unit 1 to OP\" }", "line 3, column 14", "did you mean `take all units to OP`?"),
        ("{ master = \"take unit 2 to OP\" }", "line 3, column 14", "the line has 1 unit, counted from 1"),
        (
            "{ expect = \"unit 1 is in SAVE-OP\" }",
            "found `SAVE-OP`",
            "the sentence is `{units} is in {state}`",
        ),
        (
            "{ line = \"unplug cable 2\" }",
            "cable 2 does not exist",
            "the line has 1 unit, counted from 1; each cable has the number of the unit behind it",
        ),
        ("{ line = \"plug cable 2\" }", "cable 2 does not exist", "1 unit"),
        (
            "{ master = \"set output byte 65535 of unit 1 to 01\" }",
            "unit 1 has no output byte 65535",
            "the last one is 1199",
        ),
        (
            "{ master = \"set output byte 1199 of unit 1 to 01 02\" }",
            "unit 1 has no output byte 1200",
            "the last one is 1199",
        ),
        ("{ expect = \"input byte 1204 of unit 1 is 01\" }", "no input byte 1204", "the last one is 1203"),
        ("{ expect = \"output byte 180 of unit 1 is 01\" }", "no output byte 180", "the last one is 179"),
        ("{ line = \"lose the next 3\" }", "found the end", "lose {frames}"),
        ("{ at = \"20\", line = \"be quiet\" }", "not a duration", "units s, ms, us, ns"),
        (
            "{ at = \"5ms\", after = \"5ms\", line = \"be quiet\" }",
            "at most one of `at`, `after` and `when`",
            "",
        ),
        (
            "{ line = \"be quiet\", cpu = \"set unit 1 to RUN mode\" }",
            "this one has 2",
            "one of `master`, `unit`",
        ),
        ("{ expect = \"unit 1 is in OP\", until = \"x\" }", "not a valid sentence", "scenario-reference.md"),
        ("{ master = \"behave\", until = \"unit 1 is in OP\" }", "`until` to `expect` and `never`", ""),
        ("{ after = \"1ms\" }", "this one has none", ""),
        ("{ line = \"be quiet\", within = \"1ms\" }", "belong to `expect`", ""),
        ("{ expect = \"unit 1 is in OP\", within = \"1ms\", for = \"1ms\" }", "contradict", ""),
        (
            "{ line = \"be quiet\", repeat = 3 }",
            "`repeat` needs `every`",
            "such as `repeat = 3, every = \"100ms\"`",
        ),
        ("{ line = \"be quiet\", repeat = 0, every = \"1ms\" }", "1 to 10000 times", ""),
        (
            "{ line = \"be quiet\", repeat = 2, every = \"1ms\", jitter = \"2ms\" }",
            "more than the period",
            "",
        ),
        ("{ line = \"unplug cable 0\" }", "expected a cable, 1 for", "unplug cable {cable}"),
        ("{ line = \"corrupt the next 1 frames on cable 2\" }", "does not exist", "1 unit"),
        ("{ master = \"exchange process data every 0s\" }", "expected a time above 0", ""),
        ("{ master = \"use mailbox counter 8\" }", "from 0 to 7", ""),
        ("{ unit = \"turn the ID switch of unit 1 to 256\" }", "from 0 to 255", ""),
        ("{ master = \"let unit 1 map 0x11601 as 7000:01\" }", "from 0 to 65535", ""),
        ("{ expect = \"variable N2_UINTs_01_M_to_C is 01\" }", "no unit has the device variable", "named N1"),
        (
            "{ expect = \"variable N1_UINTs_07_M_to_C[0] is 01 00\" }",
            "no unit has the device variable N1_UINTs_07_M_to_C[0]",
            "`ectwin map` lists the variables of N1",
        ),
        (
            "{ never = \"variable N1_UINTs_01_M_to_C[0] is 01 00 00\" }",
            "3 bytes for N1_UINTs_01_M_to_C[0], which has 2",
            "N1_UINTs_01_M_to_C[0] is UINT",
        ),
        ("{ never = \"object 9999:01 of unit 1 is 00\" }", "no object 9999:01", "`ectwin list objects`"),
        (
            "{ never = \"object 2002:01 of unit 1 is 00 00\" }",
            "2 bytes for object 2002:01, which has 1",
            "all bytes",
        ),
        (
            "{ expect = \"variable N1_UINTs_01_M_to_C[15] has the value 1\" }",
            "N1_UINTs_01_M_to_C[15]: element 15 of an array of 15, counted from 0",
            "N1_UINTs_01_M_to_C is ARRAY[0..14] OF UINT",
        ),
        (
            "{ expect = \"variable N1_UINTs_01_M_to_C[0] has the value 65536\" }",
            "out of range of UINT",
            "is UINT",
        ),
        (
            "{ cpu = \"force N1_UINTs_01_C_to_M to 1\" }",
            "not a list of 15 elements",
            "is ARRAY[0..14] OF UINT",
        ),
        ("{ cpu = \"force N1_UINTs_01_C_to_M[0] to\" }", "expected a value", "force {variable} to {value}"),
        ("{ cpu = \"release N9_UINTs_01_C_to_M\" }", "no unit has the device variable", "named N1"),
        (
            "{ cpu = \"write N1_UINTs_01_M_to_C[0] as 1\" }",
            "cannot be written",
            "`force N1_UINTs_01_M_to_C[0]",
        ),
        ("{ cpu = \"load a.st into unit 2\" }", "unit 2 does not exist", "1 unit"),
        ("{ cpu = \"load a.st into unit 1\" }", "the program a.st cannot be read", ""),
        ("{ expect = \"program variable x of unit 1 is 1\" }", "unit 1 has no user program", "program = "),
        ("{ expect = \"program variable x of unit 2 is 1\" }", "unit 2 does not exist", "1 unit"),
        ("{ expect = \"program variable x of the master is 1\" }", "no user program", "master = {"),
        ("{ never = \"user-defined error 0 at the master\" }", "from 1 to 40000", ""),
        ("{ never = \"program error of unit 1 at 5:0\" }", "line and column, both from 1", ""),
        ("{ random = 3 }", "needs the time", "within = \"1s\""),
        ("{ expect = \"the capture is replayed\" }", "the scenario has no capture", "capture = "),
        ("{ never = \"at most 3 answers differ\" }", "the scenario has no capture", "capture = "),
        ("{ unit = { restrat = { units = 1 } } }", "unknown key `unit.restrat`", "did you mean `restart`?"),
        ("{ unit = { restart = { unit = 1 } } }", "unknown key `unit.restart.unit`", "did you mean `units`?"),
        (
            "{ unit = { restart = { units = 1 }, cycle_power = { units = 1 } } }",
            "is a table with 2 keys",
            "one key",
        ),
        ("{ unit = { restart = { units = 2 } } }", "does not exist", "1 unit"),
        ("{ line = { unplug = { cable = 0 } } }", "is integer `0`", "the number of a cable, from 1"),
        ("{ line = { unplug = { cable = 70000 } } }", "70000", "the number of a cable, from 1"),
        ("{ line = { unplug = { cable = -1 } } }", "-1", "the number of a cable, from 1"),
        ("{ line = { unplug = { cable = \"1\" } } }", "is \"1\"", "the number of a cable, from 1"),
        ("{ unit = 5 }", "a sentence, or a table with one key", ""),
        (
            "{ unit = { inject_fault = { units = 1, fault = \"No\" } } }",
            "expected a fault of a unit",
            "break",
        ),
        ("{ at = \"2h\", line = \"be quiet\" }", "not a duration", ""),
        ("{ at = \"61s\", line = \"be quiet\" }", "after the limit of 60s", "limit"),
        ("{ master = \"unplug cable 1\" }", "of another key", "this sentence belongs to `line`"),
        ("{ line = \"take unit 1 to OP\" }", "of another key", "this sentence belongs to `master`"),
        ("{ unit = \"stop I/O refreshing of unit 1\" }", "of another key", "this sentence belongs to `cpu`"),
        ("{ cpu = \"restart unit 1\" }", "of another key", "this sentence belongs to `unit`"),
        (
            "{ line = \"unit 1 is in OP\" }",
            "of another key",
            "belongs to `expect`, `never`, `when`, `until` or `while`",
        ),
        ("{ expect = \"take unit 1 to OP\" }", "of another key", "this sentence belongs to `master`"),
        (
            "{ expect = \"unit 1 has error 85000000\" }",
            "expected `recorded`, `the`, `no`, `new` or `one`, found `error`",
            "`{units} has the error {event}`",
        ),
        ("{ expect = \"unit 1 records 85000000\" }", "found `records`", "`{units} has recorded {event}`"),
        ("{ master = \"make tea for everyone\" }", "not a valid sentence", "scenario-reference.md"),
        ("{ expect = \"unit 1 has recorded 85000001\" }", "one of `ectwin list events`", "85000000"),
        ("{ lines = \"be quiet\" }", "unknown key `lines`", "did you mean `line`?"),
    ];
    are_told(&cases);
}

/// Steps that are refused, each with a part of its message and of its way out.
fn are_told(cases: &[(&str, &str, &str)]) {
    for (text, message, help) in cases {
        let errors = step(text);
        assert!(errors.contains(message) && errors.contains(help), "{text}\n{errors}");
    }
}

/// A count or a time of 0 that does nothing, and an expectation that always holds, are mistakes.
#[test]
fn what_does_nothing_and_what_cannot_fail_is_told() {
    are_told(&[
        ("{ expect = \"0 cycles are done\" }", "0 cycles are done at the beginning too", "a number from 1"),
        (
            "{ never = { cycles = { at_least = 0 } } }",
            "0 cycles are done at the beginning too",
            "a number from 1",
        ),
        (
            "{ line = \"lose the next 0 frames\" }",
            "0 frames get the fault",
            "a number from 1, such as `the next 3 frames`",
        ),
        (
            "{ line = { disturb = { fault = \"lose\", frames = { choice = { next = 0 } } } } }",
            "0 frames get the fault",
            "a number from 1, such as `the next 3 frames`",
        ),
        (
            "{ line = { disturb = { fault = \"lose\", frames = { choice = { behind = { skip = 3, count = 0 } } } } } }",
            "0 frames get the fault",
            "a number from 1, such as `the next 3 frames`",
        ),
        (
            "{ line = \"delay all frames by 0ms\" }",
            "expected a time above 0",
            "delay {frames} {way} by {delay} {lasting} {called}",
        ),
        (
            "{ line = \"cut all frames to 13 bytes\" }",
            "expected a length from 14 to 1513 bytes",
            "cut {frames} {direction} to",
        ),
        (
            "{ line = \"cut all frames to 1514 bytes\" }",
            "expected a length from 14 to 1513 bytes",
            "cut {frames} {direction} to",
        ),
        (
            "{ cpu = \"let the system time of unit 1 jump by 0s\" }",
            "expected a time above 0",
            "jump by {period}",
        ),
        ("{ unit = \"keep the SII of unit 1 busy for 0s\" }", "expected a time above 0", "busy for {pause}"),
        ("{ line = \"be quiet\", repeat = 2, every = \"0ms\" }", "a period of 0", "every = "),
        ("{ expect = \"unit 1 is in 0x05\" }", "expected INIT, PRE-OP, SAFE-OP, OP or BOOT", "is in {state}"),
        (
            "{ master = \"take unit 1 to 0x05\" }",
            "expected INIT, PRE-OP, SAFE-OP, OP or BOOT",
            "take {units}",
        ),
    ]);
}

/// The limits are those of the keys of the unit file.
#[test]
fn a_conduct_that_no_slave_has_is_told() {
    let time = "expected a time, \"0ms\" to \"60s\", found `61000ms`";
    let code = "expected an AL status code, 0x0001 to 0xFFFF, found `0x0000`";
    are_told(&[
        ("{ unit = \"let every transition of unit 1 take 61000ms\" }", time, "take {time}"),
        ("{ unit = \"let transition IP of unit 1 take 61000ms\" }", time, "take {time}"),
        ("{ unit = \"let each SII command of unit 1 take 61000ms\" }", time, "take {time}"),
        ("{ unit = \"let the SDOs of unit 1 take 61000ms\" }", time, "take {time}"),
        (
            "{ unit = \"keep the SII of unit 1 busy for 61000ms\" }",
            "above 0 and at most 60s",
            "busy for {pause}",
        ),
        (
            "{ unit = { conduct = { units = 1, conduct = { every_transition = { time = \"100s\" } } } } }",
            "expected a time, \"0ms\" to \"60s\", found `100s`",
            "take {time}",
        ),
        (
            "{ unit = \"let unit 1 refuse OP with AL status code 0x0000\" }",
            code,
            "with AL status code {code}",
        ),
        ("{ expect = \"unit 1 is in OP with AL status code 0x0000\" }", code, "with AL status code {code}"),
        (
            "{ unit = \"let unit 1 refuse 0x05 with AL status code 0x0024\" }",
            "expected INIT, PRE-OP, SAFE-OP, OP or BOOT, found `0x05`",
            "refuse {state}",
        ),
    ]);
    let longest = "title = \"t\"\nsteps = [{ unit = \"let every transition of unit 1 take 60s\" }]";
    assert!(Scenario::parse(longest, |_| Err(String::new())).is_ok());
}

#[test]
fn a_program_that_a_unit_does_not_have_is_told() {
    for condition in [
        "no program error of unit 1",
        "program error of unit 1",
        "no task overrun of unit 1",
        "task overrun of unit 1",
        "no user-defined error at unit 1",
        "user-defined error 16#101 at unit 1",
        "user-defined error 16#101 0 times at unit 1",
        "program variable x of unit 1 is 1",
    ] {
        for key in ["expect", "never", "line = \"be quiet\", when"] {
            let none = step(&format!("{{ {key} = \"{condition}\" }}"));
            assert!(none.contains("unit 1 has no user program"), "{condition}\n{none}");
            assert!(none.contains("give it one: `cpu = { program"), "{condition}\n{none}");
        }
        let builtin = errors(&format!(
            "title = \"t\"\nunits = [{{ model = \"nx-ect101\", cpu.program = \"builtin:copy\" }}]\n\
             steps = [\n{{ expect = \"{condition}\" }}\n]"
        ));
        assert!(
            builtin.contains("the program builtin:copy of unit 1 has no errors and no variables"),
            "{builtin}"
        );
    }
}

#[test]
fn a_limit_of_0_and_empty_lists_are_told() {
    let with = |head: &str, steps: &str| errors(&format!("title = \"t\"\n{head}\nsteps = [{steps}]"));
    let quiet = "{ line = \"be quiet\" }";
    let limit = with("limit = \"0ms\"", quiet);
    assert!(
        limit.contains("line 2, column 9: a limit of 0") && limit.contains("such as `limit = "),
        "{limit}"
    );
    let units = with("units = []", quiet);
    assert!(units.contains("line 2, column 9: `units` is an empty list"), "{units}");
    assert!(units.contains("leave `units` out for one unit at its factory setting"), "{units}");
    let steps = with("", "");
    assert!(
        steps.contains("line 3, column 9: `steps` is an empty list") && steps.contains("`steps = ["),
        "{steps}"
    );
}

#[test]
fn a_sentence_has_a_greatest_length() {
    let of = |length: usize| step(&format!("{{ expect = \"{}\" }}", "x".repeat(length)));
    assert!(of(65_536).contains("is not a valid sentence here"));
    let long = of(65_537);
    assert!(long.contains("a sentence of 65537 bytes, and at most 65536 are read"), "{long}");
    assert!(of(4_000_000).contains("a sentence of 4000000 bytes, and at most 65536 are read"));
}

#[test]
fn the_phase_of_the_cycle_is_less_than_the_cycle() {
    let steps = "steps = [{ line = \"be quiet\" }]";
    let file = |phase: &str| format!("title = \"t\"\ncycle = \"2ms\"\ncycle_phase = \"{phase}\"\n{steps}");
    let wrong = errors(&file("2ms"));
    for part in ["line 3, column 15", "a phase of 2ms is beyond the cycle of 2ms", "less than `cycle`"] {
        assert!(wrong.contains(part), "{part}:\n{wrong}");
    }
    assert!(Scenario::parse(&file("1999us"), |_| Err(String::new())).is_ok());
}

#[test]
fn everything_that_is_wrong_is_told_at_once() {
    let errors = errors(
        "title = \"t\"\nunits = [\"a.toml\", { model = \"nx-ect102\" }]\nsteps = [\n\
         { at = \"9ms\", line = \"be quiet\" },\n{ at = \"5ms\", line = \"be loud\" },\n{ at = \"5ms\", line = \"be quiet\" },\n]",
    );
    for part in [
        "line 2, column 10",
        "a.toml is not there",
        "nx-ect102",
        "line 5",
        "found `loud`",
        "line 6",
        "is before the previous step",
    ] {
        assert!(errors.contains(part), "{part}:\n{errors}");
    }
}

#[test]
fn every_part_of_a_file_tells_all_its_mistakes_in_the_order_of_the_file() {
    let text = r#"foo = 1
bar = 2
title = 3
seeed = 3
limit = "soon"
steps = [
  { expct = "x", at = 5 },
  { unit = "restrat unit 1" },
  { unit = { restrat = { units = 1 } }, whn = "x" },
  { expect = { object = { unit = 0, entry = "1018", valu = "01" } }, within = "5" },
  7,
  { line = "be quiet", repeat = 2 },
]
[master]
programm = "m.st"
[[units]]
model = "nx-ect101"
seriel = 5
cpu = { mod = "run", task_period = "1.1ms" }
[[units]]
name = "N2"
[[units]]
file = "a.toml"
serial = 5
"#;
    let expected = "\
line 1, column 1: unknown key `foo`
  expected `title`, `seed`, `limit`, `cycle`, `cycle_phase`, `calendar`, `capture`, `master`, `units`, `steps`, `with` or `use`
line 2, column 1: unknown key `bar`
line 3, column 9: `title` is an integer
  expected a text
line 4, column 1: unknown key `seeed`
  did you mean `seed`?
line 5, column 9: `soon`: not a duration: a number and one of the units s, ms, us, ns, such as \"1.5ms\"
line 7, column 5: unknown key `expct`
  expected `at`, `after`, `when`, `master`, `unit`, `cpu`, `line`, `expect`, `never`, `within`, `for`, `until`, `while`, `repeat`, `every`, \
`jitter`, `random`, `steps` or `together`; did you mean `expect`?
line 7, column 23: `at` is an integer
  expected a duration such as \"5ms\"
line 8, column 12: `restrat unit 1` is not a valid sentence here
  did you mean `restart unit 1`?
line 9, column 14: unknown key `unit.restrat`
  expected `restart`, `cycle_power`, `power_off`, `power_on`, `reset_errors`, `clear_event_log`, `set_id_switch`, \
`invert_sii_word`, `erase_sii`, `load_sii`, `replace`, `conduct`, `inject_fault` or `remove_fault`; did you mean `restart`?
line 9, column 41: unknown key `whn`
  did you mean `when`?
line 10, column 34: `expect.object.unit` is integer `0`
  expected the number of a unit, from 1, or its name
line 10, column 45: `1018`: expected an entry of an object such as 10F3:05
line 10, column 53: unknown key `expect.object.valu`
  expected `unit`, `entry` or `value`; did you mean `value`?
line 10, column 79: `5`: not a duration: a number and one of the units s, ms, us, ns, such as \"5ms\"
line 11, column 3: `steps[4]` is an integer
  expected a table
line 12, column 3: `repeat` needs `every`, the time from one to the next
  such as `repeat = 2, every = \"100ms\"`
line 14, column 1: `master.program` is missing
  expected the user program of the master
line 15, column 1: unknown key `master.programm`
  expected `program`, `device_names` or `task_period`; did you mean `program`?
line 18, column 1: unknown key `seriel`
  expected `model`, ";
    let told = errors(text);
    let first = told.get(..expected.len()).unwrap_or_default();
    assert_eq!(first, expected, "{told}");
    for rest in ["did you mean `serial`?", "line 19, column 9: unknown key `cpu.mod`", "\nand 4 more"] {
        assert!(told.contains(rest), "{rest}\n{told}");
    }
}

#[test]
fn of_many_mistakes_the_first_twenty_are_told_and_the_number_of_the_others() {
    let keys: String = (0..20_000).map(|at| format!("key_{at} = 1\n")).collect();
    let steps = "{ expct = \"x\" },".repeat(20_000);
    let errors = errors(&format!("{keys}title = \"t\"\nsteps = [{steps}]"));
    assert_eq!(errors.matches("unknown key `key_").count(), 20);
    assert!(errors.ends_with("\nand 39980 more"), "{errors}");
}

#[test]
fn until_holds_as_long_as_it_takes() {
    let verdict = |expectation: &str| {
        let text = format!(
            "title = \"t\"\nlimit = \"1s\"\nsteps = [\n{{ master = \"take all units to OP\" }},\n{expectation}\n]"
        );
        let scenario = Scenario::parse(&text, |_| Err(String::new())).map_err(|errors| errors.to_string())?;
        let failure = scenario.replay(1, Recording::new(false, false)).failure;
        failure.map_or(Ok(()), |failure| Err(failure.to_string()))
    };
    assert_eq!(verdict("{ expect = \"unit 1 has no error\", until = \"unit 1 is in OP\" }"), Ok(()));
    assert_eq!(verdict("{ never = \"unit 1 has recorded 85000000\", until = \"unit 1 is in OP\" }"), Ok(()));
    let early = verdict("{ never = \"unit 1 is in PRE-OP\", until = \"unit 1 is in OP\" }");
    assert!(
        early
            .as_ref()
            .is_err_and(|failure| failure.contains("it holds, and `never` expects that it does not")),
        "{early:?}"
    );
    let vain = verdict("{ expect = \"unit 1 has no error\", until = \"unit 1 has recorded 85000000\" }");
    assert!(vain.as_ref().is_err_and(|failure| failure.contains("is not true before the limit")), "{vain:?}");
}

/// An expectation that is never checked would always be fulfilled.
#[test]
fn what_has_to_hold_for_a_time_has_to_hold_at_once() {
    for span in ["1ns", "1ms"] {
        let text = format!(
            "title = \"t\"\nsteps = [\n{{ master = \"take unit 1 to OP\" }},\n\
             {{ expect = \"unit 1 is in OP\", for = \"{span}\" }}\n]"
        );
        let scenario =
            Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
        let failure = scenario.replay(1, Recording::new(false, false)).failure;
        assert!(failure.is_some_and(|failure| failure.line == 4), "{span}");
    }
}

#[test]
fn a_unit_without_power_is_in_no_state() {
    let text =
        "title = \"t\"\nsteps = [\n{ unit = \"power off unit 1\" },\n{ expect = \"unit 1 is in INIT\" }\n]";
    let scenario = Scenario::parse(text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    let failure = scenario.replay(1, Recording::new(false, false)).failure;
    assert_eq!(failure.map(|failure| failure.seen).as_deref(), Some("unit 1 has no power"));
}

#[test]
fn nothing_goes_on_behind_the_limit() {
    for step in [
        "{ expect = \"unit 1 is in INIT\", for = \"9000000000s\" }",
        "{ line = \"be quiet\", repeat = 10000, every = \"1s\" }",
        "{ when = \"unit 1 is in INIT\", expect = \"unit 1 is in OP\", within = \"9000000000s\" }",
    ] {
        let text = format!("title = \"t\"\nlimit = \"2s\"\nsteps = [\n{step}\n]");
        let scenario =
            Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
        let failure = scenario.replay(1, Recording::new(false, false)).failure;
        assert!(failure.is_some_and(|failure| failure.seen.contains("limit")), "{step}");
    }
}

#[test]
fn a_cycle_that_never_ends_is_refused() {
    assert!(
        errors("title = \"t\"\ncycle = \"0s\"\nsteps = [{ line = \"be quiet\" }]")
            .contains("a cycle of 0 never ends")
    );
}

#[test]
fn a_program_that_is_not_there_is_refused() {
    let text = "title = \"t\"\nunits = [{ model = \"nx-ect101\", cpu = { program = \"echo.st\" } }]\nsteps = [{ line = \"be quiet\" }]";
    let errors = errors(text);
    assert!(errors.contains("echo.st is not there") && errors.contains("builtin:copy"), "{errors}");
}
