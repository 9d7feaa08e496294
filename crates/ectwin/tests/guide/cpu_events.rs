use ectwin::{Duration, Setup, Twin};

/// Reports a user-defined error, and then divides by zero: the scan ends there.
const WRONG: &str = "
    VAR Parts, Machines : INT; END_VAR
    IF Machines = 0 THEN SetAlarm(16#101, Parts); END_IF;
    Parts := Parts / Machines;
";

#[test]
fn the_cpu_unit_tells_what_goes_wrong_in_its_program() {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let mut twin = Twin::power_on([setup.structured_text(WRONG).unwrap()]);
    twin.run_for(Duration::from_millis(9));

    let mut unit = twin.unit(0);
    let events = unit.cpu().take_events().map(|record| (record.event.to_string(), record.count));
    let error = "user-defined error 16#101 (information 0, 0)".to_owned();
    let fault = "error in the program: line 4, column 5: division by zero".to_owned();
    assert_eq!(events.collect::<Vec<_>>(), [(error, 10), (fault, 10)]);
}
