//! User programs in scenarios: read with all their mistakes, synchronous with the exchange, the same in each run.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Report, Scenario, ScenarioBuilder};
use time::Duration;

const A_4_3: &str = include_str!("../../../scenarios/programs/a-4-3.st");
const A_4_4: &str = include_str!("../../../scenarios/programs/a-4-4.st");

/// A unit with a UDINT to the master, and the program `unit.st`.
const UNIT: &str = "model = \"nx-ect101\"\nio_allocation.m_to_c.uints = 6\nio_allocation.c_to_m.uints = 6\n\
                    io_allocation.c_to_m.udint = 1\ncpu.program = \"unit.st\"\n";

fn with_udint(title: &str, unit_file: &str) -> ScenarioBuilder {
    let scenario = ScenarioBuilder::new(title).unit(unit_file);
    let scenario = scenario.master("let unit 1 map 0x1A03 as 6002:01");
    scenario.master("let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1A03 1BFE")
}

fn read(name: &str, files: &[(&str, &str)]) -> Result<String, String> {
    let file = files.iter().find(|(known, _)| *known == name);
    file.map(|(_, text)| (*text).to_owned()).ok_or_else(|| "no such file".to_owned())
}

fn errors(text: &str, files: &[(&str, &str)]) -> Vec<String> {
    match Scenario::parse(text, |name| read(name, files)) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.iter().map(|error| format!("{} / {}", error.message, error.help)).collect(),
    }
}

#[test]
fn all_that_is_wrong_with_a_program_is_told_with_its_place() {
    let wrong = "N1_UINTs_01_C_to_N[0] := 1;\nN1_UINTs_01_M_to_C[0] := 2;\n";
    // Names in steps are not checked while the units are wrong.
    let text = "title = \"t\"\nunits = [\"units/a.toml\"]\nsteps = [{ cpu = \"release all of unit 1\" }]";
    let unit = "model = \"nx-ect101\"\n[cpu]\nprogram = \"wrong.st\"\n";
    let errors = errors(text, &[("units/a.toml", unit), ("units/wrong.st", wrong)]);
    assert_eq!(
        errors,
        [
            "units/wrong.st:1:1: there is no variable `N1_UINTs_01_C_to_N` / did you mean `N1_UINTs_01_C_to_M`?",
            "units/wrong.st:2:1: this cannot be written: it comes from the unit / ",
        ]
    );
}

#[test]
fn another_program_than_that_of_the_unit_file_is_seen_from_the_scenario() {
    let text = "title = \"t\"\nunits = [{ file = \"units/a.toml\", program = \"own.st\" }]\n\
                steps = [{ expect = \"program variable x of unit 1 is 5\" }]";
    let unit = "model = \"nx-ect101\"\n[cpu]\nprogram = \"wrong.st\"\n";
    assert_eq!(errors(text, &[("units/a.toml", unit), ("own.st", "VAR x : INT; END_VAR x := 5;")]), [""; 0]);
}

#[test]
fn a_condition_takes_the_constants_of_structured_text() {
    let program = "VAR i : INT := 5; u : UINT := 255; b : BOOL; r : REAL := 1.5; a : ARRAY[0..2] OF INT := [1, 2, 3]; END_VAR";
    let file = |condition: &str| {
        format!(
            "title = \"t\"\nunits = [{{ file = \"a.toml\", program = \"p.st\" }}]\n\
             steps = [{{ at = \"10ms\", expect = \"program variable {condition}\" }}]"
        )
    };
    let files: &[(&str, &str)] = &[("a.toml", "model = \"nx-ect101\"\n"), ("p.st", program)];
    for condition in [
        "i of unit 1 is INT#5",
        "u of unit 1 is 16#FF",
        "b of unit 1 is 0",
        "r of unit 1 is REAL#1.5",
        "a of unit 1 is [1,2,3]",
    ] {
        let scenario = Scenario::parse(&file(condition), |path| read(path, files)).expect("right");
        assert_eq!(scenario.replay(1, Recording::new(false, false)).failure, None, "{condition}");
    }
    for condition in
        ["i of unit 1 is DINT#5", "u of unit 1 is -1", "a of unit 1 is [1, 2]", "b of unit 1 is 2"]
    {
        let errors = errors(&file(condition), files);
        assert!(errors.len() == 1 && errors[0].contains("is not a value of"), "{condition}: {errors:?}");
    }
}

#[test]
fn the_masters_program_is_checked_against_the_entries_that_the_steps_map() {
    let text = |steps: &str, master: &str| {
        format!("title = \"t\"\nmaster = {{ {master} }}\nsteps = [{{ line = \"be quiet\" }}, {steps}]")
    };
    let reads = |program: &str, steps: &str, master: &str| errors(&text(steps, master), &[("m.st", program)]);
    let udint = "VAR x : UDINT; END_VAR x := E001_UDINT_01_C_to_M;";
    let mapped = "{ master = \"let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1A03\" }";
    assert_eq!(reads(udint, mapped, "program = \"m.st\""), [""; 0]);
    assert_eq!(
        reads(udint, "", "program = \"m.st\"")[0].split(" / ").next(),
        Some("m.st:1:29: there is no variable `E001_UDINT_01_C_to_M`")
    );
    let master = "program = \"m.st\", device_names = [\"ECT\"]";
    assert_eq!(reads("ECT_UINTs_01_M_to_C[0] := ECT_UINTs_06_C_to_M[14];", "", master), [""; 0]);
    let written = "E001_UINTs_01_C_to_M[0] := 1;";
    assert!(reads(written, "", "program = \"m.st\"")[0].contains("cannot be written"));
}

#[test]
fn what_is_wrong_with_the_master_is_told() {
    for (master, message) in [
        ("program = \"no.st\"", "the program no.st cannot be read: no such file"),
        ("program = \"m.st\", device_names = [\"E 1\"]", "`E 1` is not a device name"),
        ("program = \"m.st\", device_names = [\"A\", \"B\"]", "2 device names for 1 units"),
        ("program = \"m.st\", task_period = \"0ms\"", "no CPU Unit has a task period of 0s"),
        ("program = \"m.st\", task_period = \"1.3ms\"", "no CPU Unit has a task period of 1.3ms"),
        ("program = \"m.st\", task_period = \"33ms\"", "no CPU Unit has a task period of 33ms"),
        ("device_names = []", "`master.program` is missing"),
        ("program = \"m.st\", period = \"1ms\"", "unknown key `master.period`"),
    ] {
        let errors = errors(
            &format!("title = \"t\"\nmaster = {{ {master} }}\nsteps = [{{ line = \"be quiet\" }}]"),
            &[("m.st", ";")],
        );
        assert!(errors.len() == 1 && errors[0].contains(message), "{message}: {errors:?}");
    }
}

/// The time until the alarm, with PROGRAM mode this time after OP.
fn until_the_alarm(task_period_us: u64, mode_after_us: u64) -> Duration {
    let unit = format!("{UNIT}cpu.task_period = \"{task_period_us}us\"\n");
    let scenario = with_udint("A-4", &unit).program("unit.st", A_4_4).program("master.st", A_4_3);
    let scenario = scenario.master_program("master.st").never("program error of the master");
    let scenario = scenario
        .master("take unit 1 to OP")
        .when("unit 1 is in OP")
        .expect("no user-defined error at the master");
    let from = Duration::from_millis(150);
    let scenario = scenario.at(from).expect("program variable CPUUnit_RunMode of the master is TRUE");
    let mode_at = from + Duration::from_micros(mode_after_us);
    let scenario = scenario.at(mode_at).cpu("set unit 1 to PROGRAM mode");
    let scenario = scenario.expect("no user-defined error at the master").within(Duration::from_millis(100));
    let scenario = scenario.expect("user-defined error 16#101 at the master");
    let scenario = scenario.expect("program variable CPUUnit_RunMode of the master is FALSE");
    let report = scenario.finish().expect("a right scenario").replay(1, Recording::new(false, false));
    assert_eq!(report.failure, None);
    Duration::from_nanos(report.lasted.as_nanos() - mode_at.as_nanos())
}

/// I/O response time at most (manual, 7-9-1), without transmission: T_master + 3·T_slave + 2·T_cpu.
fn response_us(task_period_us: u64) -> u64 {
    1_000 + 3 * 1_000 + 2 * task_period_us
}

#[test]
fn program_mode_is_detected_within_20_ms_and_the_response_time_whatever_the_phases() {
    // A pulse that is shorter than the period of refresh and master could be missed between two of their reads.
    for task_period_us in [1_000, 2_000, 4_000] {
        // The pulse is high in every other task period; the master's timer runs in steps of its cycle.
        let least = Duration::from_micros(20_000 - 2 * task_period_us);
        let most = Duration::from_micros(20_000 + response_us(task_period_us) + 1_000);
        for mode_after_us in (0..8_000).step_by(370) {
            let passed = until_the_alarm(task_period_us, mode_after_us);
            assert!(
                (least..=most).contains(&passed),
                "{passed} with {task_period_us} us, {mode_after_us} us"
            );
        }
    }
}

/// A program that never ends, together with a master that counts.
fn endless() -> Report {
    let scenario = with_udint("endless", &format!("{UNIT}cpu.statement_budget = 2000\n"))
        .program(
            "unit.st",
            "VAR n : UDINT; END_VAR n := n + 1; N1_UDINT_01_C_to_M := n; WHILE TRUE DO ; END_WHILE;",
        )
        .program(
            "master.st",
            "VAR last : UDINT; news : UINT; END_VAR\n\
            IF E001_UDINT_01_C_to_M <> last THEN news := news + 1; last := E001_UDINT_01_C_to_M; END_IF;\n\
            E001_UINTs_01_M_to_C[0] := news;",
        )
        .master_program("master.st")
        .master("take unit 1 to OP")
        .within(Duration::from_millis(300))
        .expect("unit 1 is in OP")
        .expect("task overrun of unit 1")
        .after(Duration::from_millis(500))
        .expect("unit 1 is in OP")
        .expect("no task overrun of the master")
        .expect("the working counter of unit 1 is 3")
        .expect("no program error of unit 1");
    scenario.finish().expect("a right scenario").replay(1, Recording::new(true, true))
}

#[test]
fn a_program_without_end_does_not_stop_the_exchange_and_is_told_once() {
    let (first, second) = (endless(), endless());
    assert_eq!(first.failure, None, "{}", first.recording.trace().unwrap_or_default());
    assert!(first.cycles >= 500, "{}", first.cycles);
    let trace = first.recording.trace().unwrap_or_default();
    assert_eq!(trace.matches("task overrun: a scan had used up its 2000 statements").count(), 1, "{trace}");
    assert_eq!(first.recording.trace(), second.recording.trace());
    assert_eq!(first.recording.into_capture(), second.recording.into_capture());
}

#[test]
fn a_master_without_nx_bus_refuses_nx_objects() {
    let program = "VAR_GLOBAL unit : _sNXUNIT_ID; object : _sNXOBJ_ACCESS; END_VAR\n\
        PROGRAM Main VAR read : NX_ReadObj; value : ARRAY[0..1] OF BYTE; END_VAR\n\
        read(Execute := TRUE, UnitProxy := unit, Obj := object, TimeOut := 0, ReadDat := value); END_PROGRAM";
    let scenario =
        ScenarioBuilder::new("no NX bus").program("master.st", program).master_program("master.st");
    let scenario =
        scenario.within(Duration::from_millis(5)).expect("program variable read.Error of the master is TRUE");
    let scenario = scenario.expect("program variable read.ErrorID of the master is 16#400");
    let report = scenario.finish().expect("a right scenario").replay(1, Recording::new(false, false));
    assert_eq!(report.failure, None);
}

#[test]
fn a_master_without_nx_bus_refuses_to_reset_one() {
    let program = "PROGRAM Main VAR reset : ResetNXBError; END_VAR reset(Execute := TRUE); END_PROGRAM";
    let scenario =
        ScenarioBuilder::new("no NX bus").program("master.st", program).master_program("master.st");
    let scenario = scenario.within(Duration::from_millis(5));
    let scenario = scenario.expect("program variable reset.Error of the master is TRUE");
    let scenario = scenario.expect("program variable reset.ErrorID of the master is 16#400");
    let report = scenario.finish().expect("a right scenario").replay(1, Recording::new(false, false));
    assert_eq!(report.failure, None);
}

const COUNTING: &str = "VAR RETAIN runs : UINT; END_VAR VAR began : BOOL; scans : UDINT; here, mailbox : BOOL; END_VAR\n\
    IF NOT began THEN began := TRUE; runs := runs + 1; END_IF;\n\
    scans := scans + 1;\n\
    here := _EC_PDSlavTbl[2]; mailbox := _EC_MBXSlavTbl[2];\n\
    Far_UINTs_06_M_to_C[14] := Near_UINTs_06_C_to_M[14] + 1;";

/// Two units, the first of which sends 41, and a master that scans every 4 ms.
fn two_units(steps: &str) -> Report {
    let text = format!(
        "title = \"two units\"\nmaster = {{ program = \"m.st\", device_names = [\"Near\", \"Far\"], \
         task_period = \"4ms\" }}\nunits = [{{ model = \"nx-ect101\", cpu.program = \"u.st\" }}, \
         {{ model = \"nx-ect101\", name = \"N2\", serial = 2, id_switch = 2 }}]\nsteps = [{steps}]"
    );
    let files = |name: &str| match name {
        "m.st" => Ok(COUNTING.to_owned()),
        "u.st" => Ok("N1_UINTs_06_C_to_M[14] := 41;".to_owned()),
        other => Err(format!("no {other}")),
    };
    let scenario = Scenario::parse(&text, files).unwrap_or_else(|errors| panic!("{errors}"));
    let report = scenario.replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
    report
}

#[test]
fn what_the_master_writes_goes_to_the_unit_that_it_names() {
    two_units(
        "{ master = \"take all units to OP\" },\n\
         { expect = \"all units are in OP\", within = \"300ms\" },\n\
         { expect = \"variable N2_UINTs_06_M_to_C[14] has the value 42\", within = \"10ms\" },\n\
         { expect = \"variable N1_UINTs_06_M_to_C[14] has the value 0\" }",
    );
}

/// The mistakes of a line with these units, whose master has this program.
fn errors_of_line(units: &str, program: &str) -> Vec<String> {
    let text = format!(
        "title = \"t\"\nmaster = {{ program = \"m.st\" }}\nunits = [\n{units}]\nsteps = [{{ line = \"be quiet\" }}]"
    );
    errors(&text, &[("m.st", program)])
}

#[test]
fn the_node_address_of_a_unit_is_its_id_and_not_its_place() {
    let reads = "VAR here, bit : BOOL; END_VAR\n\
        here := _EC_PDSlavTbl[5]; E007_UINTs_01_M_to_C[0] := E005_UINTs_01_C_to_M[0];";
    let units = "{ model = \"nx-ect101\", id_switch = 0, alias = 7 },\n\
        { model = \"nx-ect101\", name = \"N2\", serial = 2, id_switch = 5 },\n";
    assert_eq!(errors_of_line(units, reads), [""; 0]);
    let by_place = errors_of_line(units, "E001_UINTs_01_M_to_C[0] := 1;");
    assert!(by_place[0].contains("there is no variable `E001_UINTs_01_M_to_C`"), "{by_place:?}");
    let text = format!(
        "title = \"t\"\nmaster = {{ program = \"m.st\" }}\nunits = [\n{units}]\nsteps = [\n\
         {{ master = \"take unit 2 to OP\" }},\n\
         {{ expect = \"program variable here of the master is TRUE\", within = \"300ms\" }},\n\
         {{ expect = \"program variable _EC_PDSlavTbl[2] of the master is FALSE\" }},\n\
         {{ expect = \"program variable _EC_MBXSlavTbl[7] of the master is FALSE\" }},\n\
         {{ master = \"take unit 1 to PRE-OP\" }},\n\
         {{ expect = \"program variable _EC_MBXSlavTbl[7] of the master is TRUE\", within = \"300ms\" }},\n\
         {{ expect = \"program variable _EC_MBXSlavTbl[1] of the master is FALSE\" }}]"
    );
    let scenario = Scenario::parse(&text, |_| Ok(format!("{reads} bit := _EC_MBXSlavTbl[7];")));
    let report = scenario.unwrap_or_else(|errors| panic!("{errors}")).replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

/// The seed draws the phase within the period that runs, which a CONFIGURATION sets.
#[test]
fn the_phase_of_a_task_is_within_its_interval() {
    let program = "CONFIGURATION C TASK Fast(INTERVAL := T#2ms, PRIORITY := 1); PROGRAM P WITH Fast : Count;\n\
        END_CONFIGURATION\nPROGRAM Count VAR n : INT; END_VAR n := n + 1; END_PROGRAM";
    let text = "title = \"t\"\nunits = [{ model = \"nx-ect101\", cpu = { program = \"p.st\", task_period = \"32ms\" } }]\n\
        steps = [{ at = \"40ms\", expect = \"program variable P.n of unit 1 is 20\" }]";
    let scenario =
        Scenario::parse(text, |_| Ok(program.to_owned())).unwrap_or_else(|errors| panic!("{errors}"));
    for seed in 1..=20 {
        assert_eq!(scenario.replay(seed, Recording::new(false, false)).failure, None, "seed {seed}");
    }
}

/// A terminal has no ID switch: its node address is its station alias.
#[test]
fn a_terminal_has_its_alias_as_the_node_address() {
    let line = |keys: &str| {
        format!("{{ model = \"nx-ect101\" }},\n{{ model = \"digital\", outputs = 12{keys} }},\n")
    };
    let refused = |keys: &str| errors_of_line(&line(keys), ";");
    let way_out = "`alias = 2`: each unit needs a different node address if the master has a program";
    assert_eq!(
        refused(""),
        [format!("unit 2 has no alias: the master's program needs it as the node address / {way_out}")]
    );
    assert_eq!(
        refused(", alias = 193"),
        [format!("unit 2 has the alias 193: a node address is 1 to 192 / {way_out}")]
    );
    assert_eq!(refused(", alias = 1"), [format!("units 1 and 2 both have the node address 1 / {way_out}")]);
    let text = format!(
        "title = \"t\"\nmaster = {{ program = \"m.st\" }}\nunits = [\n{}]\nsteps = [\n\
         {{ master = \"take unit 2 to OP\" }},\n\
         {{ expect = \"program variable here of the master is TRUE\", within = \"300ms\" }}]",
        line(", alias = 7")
    );
    let program = "VAR here : BOOL; END_VAR here := _EC_PDSlavTbl[7];";
    let scenario = Scenario::parse(&text, |_| Ok(program.to_owned()));
    let report = scenario.unwrap_or_else(|errors| panic!("{errors}")).replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

#[test]
fn missing_equal_and_too_large_ids_are_mistakes_when_the_master_has_a_program() {
    let unit = |keys: &str| format!("{{ model = \"nx-ect101\"{keys} }},\n");
    let two = |first: &str, second: &str| errors_of_line(&(unit(first) + &unit(second)), ";");
    assert_eq!(
        two("", ", id_switch = 1"),
        [
            "units 1 and 2 both have the node address 1 / `id_switch = 2`, or `id_switch = 0` and `alias = 2`: each \
             unit needs a different node address if the master has a program"
        ]
    );
    assert!(two("", ", id_switch = 0")[0].starts_with("unit 2 has no ID: the master's program needs it"));
    assert!(
        two("", ", id_switch = 0xC1")[0].starts_with("unit 2 has the ID 193: a node address is 1 to 192")
    );
    assert_eq!(two("", ", id_switch = 192"), [""; 0]);
    assert_eq!(two(", id_switch = 3, alias = 9", ", id_switch = 9"), [""; 0], "the switch counts");
    let text =
        format!("title = \"t\"\nunits = [{}{}]\nsteps = [{{ line = \"be quiet\" }}]", unit(""), unit(""));
    assert_eq!(errors(&text, &[]), [""; 0], "without a program nobody asks for the node address");
}

#[test]
fn a_wrong_id_is_told_at_its_unit() {
    let text = "title = \"t\"\nmaster = { program = \"m.st\" }\nunits = [\n\
        { model = \"nx-ect101\" },\n{ model = \"nx-ect101\", serial = 2 },\n]\nsteps = [{ line = \"be quiet\" }]";
    let errors = Scenario::parse(text, |_| Ok(";".to_owned())).unwrap_err();
    assert_eq!(errors.iter().map(|error| error.line()).collect::<Vec<_>>(), [Some(5)]);
}

#[test]
fn the_master_sees_the_bits_of_sysmac_error_status_as_ports() {
    let program = "VAR port AT ECAT://node#1/Sysmac Error Status/Observation : BOOL;\n\
        observation, minor_fault : BOOL; END_VAR\n\
        observation := port; minor_fault := E001_Minor_Fault;";
    let text = |expectation: &str, levels: &str| {
        format!(
            "title = \"t\"\nmaster = {{ program = \"m.st\" }}\n\
             units = [{{ model = \"nx-ect101\", io_allocation.m_to_c.uints = 4, io_allocation.c_to_m.uints = 6{levels} }}]\n\
             steps = [\n{{ master = \"let unit 1 assign to 0x1C13 the PDOs 1A00 1A01 1BFE 1BFF\" }},\n\
             {{ master = \"take unit 1 to OP\" }},\n{expectation}]"
        )
    };
    let seen = |observation: &str, minor_fault: &str| {
        format!(
            "{{ expect = \"unit 1 is in OP\", within = \"300ms\" }},\n\
             {{ after = \"10ms\", expect = \"program variable observation of the master is {observation}\" }},\n\
             {{ expect = \"program variable minor_fault of the master is {minor_fault}\" }}"
        )
    };
    let observation = ", event_levels = { 39170000 = \"observation\" }";
    for (levels, expectation) in [("", seen("FALSE", "TRUE")), (observation, seen("TRUE", "FALSE"))] {
        let scenario = Scenario::parse(&text(&expectation, levels), |_| Ok(program.to_owned()));
        let report =
            scenario.unwrap_or_else(|errors| panic!("{errors}")).replay(1, Recording::new(true, false));
        assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
    }
}

#[test]
fn a_task_period_of_its_own_is_kept_whatever_the_exchange_does() {
    two_units(
        "{ at = \"99ms\", expect = \"program variable scans of the master is 25\" },\n\
         { master = \"take all units to OP\" },\n\
         { at = \"299ms\", expect = \"program variable scans of the master is 75\" },\n\
         { master = \"stop process data\" },\n\
         { at = \"399ms\", expect = \"program variable scans of the master is 100\" }",
    );
}

#[test]
fn the_tables_follow_the_states_that_the_master_sees() {
    two_units(
        "{ at = \"10ms\", expect = \"program variable mailbox of the master is FALSE\" },\n\
         { master = \"take all units to PRE-OP\" },\n\
         { expect = \"program variable mailbox of the master is TRUE\", within = \"50ms\" },\n\
         { master = \"take all units to SAFE-OP\" },\n\
         { expect = \"unit 2 is in SAFE-OP\", within = \"50ms\" },\n\
         { expect = \"program variable here of the master is FALSE\", for = \"20ms\" },\n\
         { master = \"take all units to OP\" },\n\
         { expect = \"program variable here of the master is TRUE\", within = \"50ms\" },\n\
         { line = \"unplug cable 2\" },\n\
         { expect = \"program variable here of the master is FALSE\", within = \"8ms\" },\n\
         { expect = \"program variable mailbox of the master is FALSE\" },\n\
         { expect = \"program variable _EC_PDSlavTbl[2] of the master is FALSE\" }",
    );
}

#[test]
fn a_slave_whose_answers_arrive_damaged_is_missing_in_the_tables() {
    two_units(
        "{ master = \"take all units to PRE-OP\" },\n\
         { expect = \"program variable mailbox of the master is TRUE\", within = \"300ms\" },\n\
         { line = \"cut all frames on the way back to 20 bytes\" },\n\
         { expect = \"program variable mailbox of the master is FALSE\", within = \"12ms\" }",
    );
}

#[test]
fn a_master_that_restarts_begins_its_program_anew_and_keeps_what_is_retained() {
    two_units(
        "{ at = \"99ms\", expect = \"program variable runs of the master is 1\" },\n\
         { master = \"restart\" },\n\
         { after = \"9ms\", expect = \"program variable runs of the master is 2\" },\n\
         { expect = \"program variable scans of the master is 3\" }",
    );
}

#[test]
fn user_defined_errors_of_a_cpu_unit_stand_until_they_are_reset() {
    let program = "VAR n : UINT; END_VAR n := n + 1;\n\
        IF n = 5 OR n = 20 THEN SetAlarm(16#2A, n); END_IF; IF n = 10 THEN ResetAlarm(0); END_IF;";
    let scenario = ScenarioBuilder::new("alarms").unit("model = \"nx-ect101\"\ncpu.program = \"u.st\"\n");
    let report = scenario
        .program("u.st", program)
        .expect("no user-defined error at unit 1")
        .within(Duration::from_millis(5))
        .expect("user-defined error 16#2A at unit 1")
        .within(Duration::from_millis(6))
        .expect("no user-defined error at unit 1")
        .within(Duration::from_millis(11))
        .expect("user-defined error 42 2 times at unit 1")
        .finish()
        .expect("a right scenario")
        .replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

#[test]
fn a_program_without_end_at_the_master_does_not_stop_the_exchange_either() {
    let report = ScenarioBuilder::new("endless at the master")
        .program("m.st", "WHILE TRUE DO ; END_WHILE;")
        .master_program("m.st")
        .master("take unit 1 to OP")
        .within(Duration::from_millis(20))
        .expect("unit 1 is in OP")
        .expect("task overrun of the master")
        .after(Duration::from_millis(5))
        .expect("the working counter of unit 1 is 3")
        .finish()
        .expect("a right scenario")
        .replay(1, Recording::new(true, false));
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

/// One mistake is one message: names and addresses of units that cannot be read are not checked.
#[test]
fn wrong_units_give_no_mistakes_of_the_master() {
    let master = "master = { program = \"m.st\", device_names = [\"A\", \"A\", \"1\"] }";
    for (units, message) in [
        ("[{ model = \"nx-ect102\" }]", "nx-ect102"),
        ("[\"no.toml\"]", "no such file"),
        ("7", "`units` is an integer"),
    ] {
        let text = format!("title = \"t\"\n{master}\nunits = {units}\nsteps = [{{ line = \"be quiet\" }}]");
        let errors = errors(&text, &[("m.st", "E001_UINTs_01_M_to_C[0] := 1;")]);
        assert!(errors.len() == 1 && errors[0].contains(message), "{message}: {errors:?}");
    }
}
