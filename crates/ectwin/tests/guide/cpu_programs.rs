use ectwin::{Duration, OperatingMode, Setup, Twin};

/// Counts its scans from power-on of the CPU Unit on, and sends the count to the master.
const COUNTER: &str = "
    VAR RETAIN Scans : UINT; END_VAR
    Scans := Scans + 1;
    N1_UINTs_01_C_to_M[0] := Scans;
";

fn counting() -> Twin {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    Twin::power_on([setup.structured_text(COUNTER).unwrap()])
}

#[test]
fn the_count_goes_on_after_program_mode() {
    let mut twin = counting();
    twin.run_for(Duration::from_millis(9));
    let scans = |twin: &mut Twin| twin.unit(0).cpu().program_variable("Scans");
    assert_eq!(scans(&mut twin).as_deref(), Some("10"), "one at power-on, and one each millisecond");

    twin.unit(0).cpu().set_mode(OperatingMode::Program);
    twin.run_for(Duration::from_millis(5));
    twin.unit(0).cpu().set_mode(OperatingMode::Run);
    twin.run_for(Duration::from_millis(1));
    assert_eq!(scans(&mut twin).as_deref(), Some("11"), "RETAIN");
}

#[test]
fn a_forced_value_stays_whatever_the_program_writes() {
    let mut twin = counting();
    let mut unit = twin.unit(0);
    let answer = unit.io().find("N1_UINTs_01_C_to_M").unwrap().element(0);
    unit.io_mut().force(answer, &[7, 0]).unwrap();

    twin.run_for(Duration::from_millis(10));
    assert_eq!(twin.unit(0).io().read(answer).unwrap()[..], [7, 0]);

    twin.unit(0).io_mut().release(answer).unwrap();
    twin.run_for(Duration::from_millis(10));
    assert_eq!(twin.unit(0).io().read(answer).unwrap()[..], [21, 0]);
}
