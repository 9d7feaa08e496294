//! What steps bring to a place of the line: the image of an EEPROM, and another unit.

use device::Start;
use plant::Powered;

use super::Bench;

/// A byte of an EEPROM that has never been written.
pub(super) const ERASED: u8 = 0xFF;

impl Bench<'_> {
    /// Replaces the EEPROM of a unit; the rest of it is as never written.
    pub(super) fn load_sii(&mut self, at: usize, file: &str) {
        let loaded = self.brought.images.iter().find(|image| image.unit == at && image.file == file);
        let Some(image) = loaded.map(|loaded| loaded.image.clone()) else { return };
        if let Some((_, esc)) = self.network.slave_mut(at) {
            let room = esc.sii_image_mut();
            room.fill(ERASED);
            for (byte, new) in room.iter_mut().zip(image) {
                *byte = new;
            }
        }
    }

    /// Another unit takes the place of one, with its own CPU Unit, and starts.
    pub(super) fn replace(&mut self, at: usize, file: &str) {
        let mut numbered = self.brought.replacements.iter().enumerate();
        let Some((number, new)) = numbered.find(|(_, new)| new.unit == at && new.file == file) else {
            return;
        };
        let Powered { config, unit, cpu } = self.supply.power(number, &new.source, self.now);
        self.network.replace(at, config, unit, self.now);
        self.network.restart(at, self.now, Start::PowerOn);
        if let Some(place) = self.cpus.get_mut(at) {
            *place = cpu;
        }
        if let Some(records) = self.records.get_mut(at) {
            records.begin_anew();
        }
        self.notes.tell(self.now, &format!("unit {}", at + 1), &format!("is replaced by {file}"));
    }
}
