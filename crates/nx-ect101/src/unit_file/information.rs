//! The keys of what differs between units by their production.

use toml::de::DeValue;

use super::error::Problem;
use super::reader::{Reader, Section};
use super::values;
use crate::unit_information::{UnitInformation, UnitVersion, VersionText};

pub(super) fn information(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> UnitInformation {
    let value = |located: Option<super::Located<u32>>| located.map(|located| located.value);
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
    parsed(place, value, "a version, \"1.0\" to \"255.255\"", UnitVersion::parse)
}

fn version(place: &str, value: &DeValue<'_>) -> Result<VersionText, Problem> {
    parsed(place, value, "1 to 20 characters of printable ASCII, such as \"V1.00\"", VersionText::parse)
}

fn parsed<T>(
    place: &str,
    value: &DeValue<'_>,
    expected: &str,
    parse: fn(&str) -> Option<T>,
) -> Result<T, Problem> {
    let text = values::text(place, value, expected)?;
    parse(text).ok_or_else(|| Problem::new(format!("`{place}` is \"{}\"", user_file::shown(text)), expected))
}
