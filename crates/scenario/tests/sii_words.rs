//! What a master reads of the EEPROM, at both ends of the address range.

use scenario::{Recording, Report, Scenario};

fn replay(address: &str) -> Report {
    let text = format!(
        "title = \"t\"\nsteps = [
            {{ never = \"the master has read SII word 0x0009 of unit 1\" }},
            {{ master = \"write register 0x0502 of unit 1 as 00 01 {address}\" }},
            {{ expect = \"the master has nothing to do\", within = \"1s\" }},
        ]\n"
    );
    let scenario = Scenario::parse(&text, |_| Err(String::new())).unwrap_or_else(|errors| panic!("{errors}"));
    scenario.replay(7, Recording::new(false, false))
}

#[test]
fn a_command_reads_two_words_and_behind_the_last_one_there_is_none() {
    assert_eq!(replay("FF FF FF FF").failure, None);
    assert_eq!(replay("0A 00 00 00").failure, None);
    assert!(replay("08 00 00 00").failure.is_some());
}
