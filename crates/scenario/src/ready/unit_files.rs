//! Files that steps bring to a unit: the image of an EEPROM, and a unit that takes its place.

use super::maker::Maker;
use super::problem::Part;
use crate::model::UnitOrder;
use crate::run::{Replacement, SiiImage};

impl Maker<'_> {
    /// Reads the file of an order.
    pub(super) fn unit_files(&mut self, order: &UnitOrder, part: Part) -> Option<()> {
        if let UnitOrder::LoadSii { unit, file, as_it_is } = order {
            let image = self.sii_image(unit.position(), file, *as_it_is, part)?;
            self.images.push(SiiImage { unit: unit.position(), file: file.clone(), image });
        } else if let UnitOrder::Replace { unit, file } = order {
            let at = unit.position();
            let source = self.unit_file(part, file, None)?;
            // Later steps speak of the new unit.
            *self.units.get_mut(at)? = source.clone();
            *self.variables.get_mut(at)? = source.file.variables().clone();
            self.replacements.push(Replacement { unit: at, file: file.clone(), source });
        }
        Some(())
    }

    fn sii_image(&mut self, unit: usize, file: &str, as_it_is: bool, part: Part) -> Option<Vec<u8>> {
        let room = self.units.get(unit)?.known_device().description.eeprom_bytes as usize;
        let image = match self.files.bytes(file) {
            Ok(image) => image,
            Err(reason) => {
                self.refuse(part, format!("the SII image {file} cannot be read: {reason}"), "");
                return None;
            }
        };
        if image.is_empty() || image.len() > room || image.len() % 2 != 0 {
            let message =
                format!("{file} has {} bytes, and the EEPROM of unit {} has {room}", image.len(), unit + 1);
            self.refuse(part, message, "an image is at most as long as the EEPROM, in words of two bytes");
            return None;
        }
        let findings = esi::sii::lint(&image);
        match findings.first() {
            Some(first) if !as_it_is => {
                let more = findings.len() - 1;
                let others = if more == 0 { String::new() } else { format!(", and {more} more findings") };
                let help =
                    format!("`load {file} as it is into the SII of unit {}` loads it nevertheless", unit + 1);
                self.refuse(part, format!("{file}: {first}{others}"), help);
                None
            }
            _ => Some(image),
        }
    }
}
