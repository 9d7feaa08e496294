//! Data that differ between units of one model by their production: versions, lot, type (manual, A-6-4 and A-7-2).

use nx_bus::NxValue;
use wire::ObjectIndex;

/// Bytes of the texts of versions, padded with spaces.
const VERSION_BYTES: usize = 20;

/// The production data of one unit. Values that are left out have the default of the object tables.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UnitInformation {
    /// Device type, NX object 1000:03.
    pub device_type: Option<u32>,
    /// Unit version, NX object 1000:06.
    pub unit_version: Option<UnitVersion>,
    /// Lot number, NX object 1001:01: day, month and year of production from bit 24, 16 and 8 on.
    pub lot_number: Option<u32>,
    /// Hardware version, CoE object 1009 and NX object 1001:02.
    pub hardware_version: Option<VersionText>,
    /// Software version, CoE object 100A and NX object 1001:03.
    pub software_version: Option<VersionText>,
}

/// A unit version, such as 1.0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnitVersion {
    /// Before the point.
    pub integer: u8,
    /// After the point.
    pub fraction: u8,
}

/// A version as text, such as `V1.00`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VersionText([u8; VERSION_BYTES]);

impl UnitInformation {
    /// The value of an NX object of this unit; none if it has the default of the model.
    pub(crate) fn nx_value(&self, place: (u16, u8)) -> Option<NxValue> {
        let number = |number: Option<u32>| number.map(|number| number.to_le_bytes().into_iter().collect());
        let text = |text: Option<VersionText>| text.map(|text| text.0.into_iter().collect());
        match place {
            (0x1000, 3) => number(self.device_type),
            (0x1000, 6) => number(self.unit_version.map(UnitVersion::bits)),
            (0x1001, 1) => number(self.lot_number),
            (0x1001, 2) => text(self.hardware_version),
            (0x1001, 3) => text(self.software_version),
            _ => None,
        }
    }

    /// The CoE objects with a value of this unit.
    pub(crate) fn coe_values(&self) -> impl Iterator<Item = (ObjectIndex, &[u8])> {
        let versions = [(0x1009, &self.hardware_version), (0x100A, &self.software_version)];
        let own = versions.into_iter().filter_map(|(index, version)| Some((index, version.as_ref()?)));
        own.map(|(index, VersionText(bytes))| (ObjectIndex(index), bytes.as_slice()))
    }
}

impl UnitVersion {
    /// Reads two decimal numbers with a point between them, each 0 to 255.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let (integer, fraction) = text.split_once('.')?;
        let number =
            |digits: &str| digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok());
        Some(Self { integer: number(integer)??, fraction: number(fraction)?? })
    }

    /// Bits 24 to 31 and 16 to 23; the bits below are reserved.
    const fn bits(self) -> u32 {
        u32::from_be_bytes([self.integer, self.fraction, 0, 0])
    }
}

impl VersionText {
    /// Accepts 1 to 20 characters of printable ASCII.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let is_printable = text.bytes().all(|byte| byte == b' ' || byte.is_ascii_graphic());
        let mut bytes = [b' '; VERSION_BYTES];
        bytes
            .get_mut(..text.len())
            .filter(|_| is_printable && !text.is_empty())?
            .copy_from_slice(text.as_bytes());
        Some(Self(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_version_is_in_the_upper_half() {
        let bits = |text| UnitVersion::parse(text).map(UnitVersion::bits);
        assert_eq!(bits("1.0"), Some(0x0100_0000));
        assert_eq!(bits("2.10"), Some(0x020A_0000));
        assert_eq!(bits("255.255"), Some(0xFFFF_0000));
        for wrong in ["", "1", "1.", ".0", "1.0.0", "256.0", "-1.0", "+1.0", "V1.0", " 1.0"] {
            assert_eq!(bits(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_version_text_is_padded_with_spaces() {
        assert_eq!(VersionText::parse("V1.02").map(|text| text.0), Some(*b"V1.02               "));
        assert_eq!(
            VersionText::parse("V1.00 V2.00 V3.00 V4").map(|text| text.0),
            Some(*b"V1.00 V2.00 V3.00 V4")
        );
        for wrong in ["", "V1.00 V2.00 V3.00 V4.", "Vü", "V1\n"] {
            assert_eq!(VersionText::parse(wrong), None, "{wrong}");
        }
    }
}
