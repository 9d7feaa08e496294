//! Process data of units that have one direction of it, or none.

use scenario::Scenario;

/// The messages and remedies for a step; the line is a coupler, a terminal with outputs, one with inputs, and a unit with
/// both.
fn told(step: &str) -> Vec<String> {
    let text = format!(
        "title = \"t\"\nunits = [\n{{ model = \"digital\", name = \"K\" }},\n\
         {{ model = \"digital\", outputs = 12, name = \"O\" }},\n\
         {{ model = \"digital\", inputs = 8, name = \"I\" }},\n{{ model = \"nx-ect101\" }},\n]\n\
         steps = [{{ {step} }}]"
    );
    let read = Scenario::parse(&text, |name| Err(name.to_owned()));
    let errors = read.err();
    let errors = errors.iter().flat_map(|errors| errors.iter());
    errors.map(|error| format!("{} / {}", error.message, error.help)).collect()
}

#[test]
fn data_that_a_unit_does_not_have_are_never_valid() {
    let outputs = "unit 2 is of the model digital and has no data C to M, which are never valid / name the data that it has: \
                   `the data M to C of unit 2 is valid`";
    let inputs = "unit 3 is of the model digital and has no data M to C, which are never valid / name the data that it has: \
                  `the data C to M of unit 3 is valid`";
    let none = "unit 1 is of the model digital and has no data M to C, which are never valid / it has no process data";
    for (condition, message) in [
        ("the data of unit 2 is valid", outputs),
        ("the data of unit 2 is not valid", outputs),
        ("the data C to M of unit 2 is not valid", outputs),
        ("the data of unit 3 is valid", inputs),
        ("the data M to C of unit 3 is valid", inputs),
        ("the data of unit 1 is valid", none),
        ("the data of all units is not valid", none),
    ] {
        assert_eq!(told(&format!("expect = \"{condition}\"")), [message], "{condition}");
    }
    for condition in [
        "the data M to C of unit 2 is valid",
        "the data C to M of unit 3 is not valid",
        "the data of unit 4 is valid",
    ] {
        assert_eq!(told(&format!("expect = \"{condition}\"")), [""; 0], "{condition}");
    }
}

#[test]
fn bytes_that_a_unit_does_not_have_are_refused() {
    for (step, message) in [
        ("master = \"set output byte 2 of unit 2 to 01\"", "unit 2 has no output byte 2 / the last one is 1"),
        (
            "master = \"set the outputs of unit 2 to 01 02 03\"",
            "unit 2 has no output byte 2 / the last one is 1",
        ),
        (
            "master = \"set the outputs of unit 3 to 01\"",
            "unit 3 has no output byte 0 / it has no output bytes",
        ),
        ("cpu = \"set the inputs of unit 3 to 01 02\"", "unit 3 has no input byte 1 / the last one is 0"),
        ("expect = \"output byte 2 of unit 2 is 00\"", "unit 2 has no output byte 2 / the last one is 1"),
        ("expect = \"input byte 1 of unit 3 is 00\"", "unit 3 has no input byte 1 / the last one is 0"),
        (
            "expect = \"the inputs of unit 1 begin with 00\"",
            "unit 1 has no input byte 0 / it has no input bytes",
        ),
    ] {
        let told = told(step);
        assert_eq!(told.len(), 1, "{step} {told:?}");
        assert!(told[0].starts_with(message), "{step} {told:?}");
    }
    for step in [
        "master = \"set output byte 1 of unit 2 to 01\"",
        "cpu = \"set the inputs of unit 3 to 01\"",
        "expect = \"input byte 0 of unit 3 is 00\"",
        "master = \"set output byte 1199 of unit 4 to 01\"",
    ] {
        assert_eq!(told(step), [""; 0], "{step}");
    }
}
