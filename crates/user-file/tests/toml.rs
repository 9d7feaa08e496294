//! A TOML file is read key by key; a mistake has a place, the expected contents, and the nearest name.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use time::Duration;
use user_file::{FileErrors, Located, Reader, Section, Wanted, read_toml, values};
use wire::{EntryAddress, ObjectIndex, SubIndex};

/// A file that belongs to no existing model.
#[derive(Debug, PartialEq)]
struct Terminal {
    name: Located<String>,
    inputs: Option<Located<u8>>,
    pace: Option<Located<Duration>>,
    entries: Vec<EntryAddress>,
    is_red: bool,
}

fn terminal(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Terminal> {
    reader.only(file, &["name", "inputs", "wiring"]);
    let name = reader.value(file, "name", values::identifier);
    let inputs =
        reader.value(file, "inputs", |place, value| values::integer(place, value, 1..=64, "1 to 64 bits"));
    let mut terminal = Terminal { name: name?, inputs, pace: None, entries: Vec::new(), is_red: false };
    let Some(wiring) = reader.section(file, "wiring") else { return Some(terminal) };
    reader.only(&wiring, &["pace", "entries", "colour"]);
    let up_to_a_second = |pace| pace <= Duration::from_secs(1);
    terminal.pace = reader.value(&wiring, "pace", |place, value| {
        values::duration(place, value, up_to_a_second, "a time, up to \"1s\"")
    });
    if let Some(list) = wiring.get("entries") {
        let entries = reader.array(&wiring.place_of("entries"), list, values::entry_address);
        terminal.entries = entries.into_iter().map(|entry| entry.value).collect();
    }
    let colours = [("red", true), ("blue", false)];
    let colour = reader.value(&wiring, "colour", |place, value| values::choice(place, value, &colours));
    terminal.is_red = colour.is_some_and(|colour| colour.value);
    Some(terminal)
}

fn read(text: &str) -> Result<Terminal, FileErrors> {
    read_toml(text, Wanted::UnitFile, terminal)
}

fn refusal(text: &str) -> String {
    read(text).expect_err("something is wrong").to_string()
}

const IDENTIFIER: &str =
    "an identifier: letters, digits and single underscores, no digit first, 127 characters at most";

#[test]
fn values_know_where_they_are() {
    let text = "name = \"K1\"\ninputs = 0x08\n[wiring]\npace = \"1.5ms\"\nentries = [\"6000:0A\"]\ncolour = \"red\"\n";
    let terminal = read(text).expect("nothing is wrong");
    assert_eq!(terminal.name, Located::at(7..11, "K1".to_owned()));
    assert_eq!(terminal.inputs, Some(Located::at(21..25, 8)));
    assert_eq!(terminal.pace.map(|pace| pace.value), Some(Duration::from_micros(1_500)));
    let entry = EntryAddress { index: ObjectIndex(0x6000), sub: SubIndex(0x0A) };
    assert_eq!((terminal.entries.as_slice(), terminal.is_red), (&[entry][..], true));
    assert_eq!(entry.to_string(), "6000:0A");
}

#[test]
fn everything_that_is_wrong_is_told_in_the_order_of_the_file() {
    let text = "wirng = 1\nname = \"K1\"\ninputs = 65\n[wiring]\npace = \"2s\"\nentries = [\"6000:01\", \"6000\"]\n\
                colour = \"reed\"\n";
    let expected = "\
1:1: unknown key `wirng`, expected `name`, `inputs` or `wiring`; did you mean `wiring`?
3:10: `inputs` is 65, expected 1 to 64 bits
5:8: `wiring.pace` is \"2s\", expected a time, up to \"1s\"
6:23: `wiring.entries[1]` is \"6000\", expected an entry, four and two hexadecimal digits: \"6000:01\"
7:10: `wiring.colour` is \"reed\", expected \"red\" or \"blue\"; did you mean `red`?";
    assert_eq!(refusal(text), expected);
}

#[test]
fn a_value_of_another_type_or_form_is_named() {
    assert_eq!(refusal("name = 3"), format!("1:8: `name` is an integer, expected {IDENTIFIER}"));
    assert_eq!(refusal("name = \"1st\""), format!("1:8: `name` is \"1st\", expected {IDENTIFIER}"));
    assert_eq!(refusal("name = \"K1\"\nwiring = []"), "2:10: `wiring` is an array, expected a table");
    let inputs = "2:10: `inputs` is a string, expected an integer, 1 to 64 bits";
    assert_eq!(refusal("name = \"K1\"\ninputs = \"8\""), inputs);
}

#[test]
fn of_a_text_that_is_no_toml_or_another_file_nothing_else_is_said() {
    assert!(
        refusal("name = \nwires = 3").starts_with("1:8: not TOML: "),
        "{}",
        refusal("name = \nwires = 3")
    );
    assert!(refusal("<EtherCATInfo>").contains("this is an ESI file"), "{}", refusal("<EtherCATInfo>"));
}

#[test]
fn a_message_is_short_however_long_the_key_that_it_names() {
    let text = format!("{} = 1", "key".repeat(5_000));
    let errors = read_toml(&text, Wanted::UnitFile, |reader, file| {
        for (key, value) in file.entries() {
            reader.read(&file.place_of(key.value), value, values::truth);
        }
        None::<()>
    });
    let words = errors.expect_err("a number is no truth").to_string();
    assert!(words.len() < 1_000, "{words}");
    assert!(
        words.starts_with("1:15004: `keykey") && words.ends_with("` is an integer, expected true or false"),
        "{words}"
    );
}
