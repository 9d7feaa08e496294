//! The keys for data that differ between units by their production.

use user_file::{DeValue, Located, Problem, Reader, Section, values};

use crate::unit_information::{UnitInformation, UnitVersion, VersionText};

pub(super) fn information(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> UnitInformation {
    let value = |located: Option<Located<u32>>| located.map(|located| located.value);
    UnitInformation {
        device_type: value(reader.value(file, "device_type", number)),
        unit_version: reader.value(file, "unit_version", unit_version).map(|located| located.value),
        lot_number: value(reader.value(file, "lot_number", number)),
        hardware_version: reader.value(file, "hardware_version", version).map(|located| located.value),
        software_version: reader.value(file, "software_version", version).map(|located| located.value),
    }
}

fn number(place: &str, value: &DeValue<'_>) -> Result<u32, Problem> {
    values::integer(place, value, 0..=u32::MAX.into(), "0 to 4294967295")
}

fn unit_version(place: &str, value: &DeValue<'_>) -> Result<UnitVersion, Problem> {
    values::parsed(place, value, "a version, \"0.0\" to \"255.255\"", UnitVersion::parse)
}

fn version(place: &str, value: &DeValue<'_>) -> Result<VersionText, Problem> {
    values::parsed(
        place,
        value,
        "1 to 20 characters of printable ASCII, such as \"V1.00\"",
        VersionText::parse,
    )
}
