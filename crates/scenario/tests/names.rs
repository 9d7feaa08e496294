//! Names of units: one unit of a line has each, where the name matters.

use scenario::Scenario;

const NAMED: &str = "model = \"nx-ect101\"\nname = \"K1\"\n";

fn messages(units: &[&str], step: &str) -> Vec<String> {
    let text = format!("title = \"t\"\nunits = [\n{}\n]\nsteps = [{{ {step} }}]", units.join(",\n"));
    let read = Scenario::parse(&text, |_| Ok(NAMED.to_owned()));
    read.err().iter().flat_map(|errors| errors.iter()).map(ToString::to_string).collect()
}

const QUIET: &str = "line = \"be quiet\"";
const UNNAMED: &str = "{ model = \"nx-ect101\" }";

#[test]
fn two_units_with_one_name_are_told_with_both() {
    let other = "{ model = \"nx-ect101\", name = \"N2\" }";
    for (units, message) in [
        (["\"a.toml\"", other, "\"a.toml\""], "line 5, column 1: units 1 and 3 are both named K1"),
        (
            ["\"a.toml\"", "{ model = \"digital\", inputs = 8, name = \"k1\" }", other],
            "line 4, column 1: units 1 and 2 are named K1 and k1, and upper and lower case are the same",
        ),
        (
            [UNNAMED, other, "{ model = \"nx-ect101\", name = \"N1\" }"],
            "line 5, column 1: units 1 and 3 are both named N1",
        ),
    ] {
        let told = messages(&units, QUIET);
        assert_eq!(told, [format!("{message}\n  each unit of a line needs another `name`")]);
    }
}

/// A line of units without names is right, until a step names a variable that several of them have.
#[test]
fn a_variable_of_several_units_is_told() {
    assert_eq!(messages(&[UNNAMED, UNNAMED], QUIET), [""; 0]);
    for step in [
        "cpu = \"force N1_UINTs_01_C_to_M[0] to 5\"",
        "cpu = \"release N1_UINTs_01_C_to_M\"",
        "expect = \"variable N1_UINTs_01_M_to_C is 00\"",
        "expect = \"variable N1_UINTs_01_M_to_C[0] has the value 0\"",
    ] {
        let told = messages(&[UNNAMED, "{ model = \"nx-ect101\", name = \"N2\" }", UNNAMED], step);
        assert_eq!(told.len(), 1, "{step} {told:?}");
        assert!(told[0].contains("units 1 and 3 both have the device variable N1_UINTs_01_"), "{told:?}");
        assert!(told[0].contains("give each unit of the line another `name`"), "{told:?}");
    }
}
