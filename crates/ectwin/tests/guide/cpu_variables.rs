use ectwin::{Duration, Setup, Twin, Validity};

#[test]
fn a_variable_is_found_by_its_name_or_its_at_specification() {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let mut twin = Twin::power_on([setup]);
    twin.run_for(Duration::from_millis(5));

    let unit = twin.unit(0);
    let io = unit.io();
    let speed = io.find("N1_UINTs_01_M_to_C").unwrap();
    assert_eq!(io.find("IOBus://unit#1/UINTs 01 M to C"), Some(speed));
    assert_eq!(io.type_of(speed).unwrap().to_string(), "ARRAY[0..14] OF UINT");

    // The master is not in OP: the value is available, but it must not be used for control.
    assert_eq!(io.read(speed).unwrap()[..], [0; 30]);
    assert_eq!(io.validity(speed), Ok(Validity::DataNotValid));
}
