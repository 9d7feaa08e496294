//! The names of a variable: its own, and its AT specification.

/// The default name of a variable of an I/O port (manual, 6-1-2): the device name and the port's, with `_` for every
/// character that is not a letter or a digit.
#[must_use]
pub fn variable_name(device_name: &str, port: &str) -> String {
    let words = port.replace(|character: char| !character.is_ascii_alphanumeric(), "_");
    format!("{device_name}_{words}")
}

/// The AT specification of an I/O port of the unit with this NX Unit number (manual, 6-1-2). The port of a bit has the
/// port of its word before it: `EtherCAT Slave Status/IN Port Link ON`.
#[must_use]
pub fn at_specification(unit_number: u8, port: &str) -> String {
    format!("IOBus://unit#{unit_number}/{port}")
}
