//! What steps bring to a place of the line: the image of an EEPROM, and another unit.

use device::Start;
use plant::Powered;

use super::cpus::Cpu;
use super::{Watched, World, powered};
use crate::run::dice::dice_of_phases;

/// A byte of an EEPROM that has never been written.
pub(super) const ERASED: u8 = 0xFF;
/// The participants of the units that take the places of others begin here, so that their phases are their own.
const FIRST_REPLACEMENT: u64 = 1 << 32;

impl World {
    /// Replaces the EEPROM of a unit; the rest of it is as never written.
    pub(super) fn load_sii(&mut self, at: usize, file: &str) {
        let loaded = self.images.iter().find(|image| image.unit == at && image.file == file);
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
        let mut numbered = (FIRST_REPLACEMENT..).zip(&self.replacements);
        let found = numbered.find(|(_, new)| new.unit == at && new.file == file);
        let Some((participant, new)) = found else { return };
        let dice = dice_of_phases(self.seed, participant);
        let Powered { config, unit, cpu } = powered(&new.source, dice, self.now, self.calendar_ns);
        self.network.replace(at, config, unit, self.now);
        self.network.restart(at, self.now, Start::PowerOn);
        if let Some(place) = self.cpus.get_mut(at) {
            *place = Cpu::running(cpu);
        }
        if let Some(watched) = self.watched.get_mut(at) {
            *watched = Watched::default();
        }
        self.recording.tell(self.now, &format!("unit {}", at + 1), &format!("is replaced by {file}"));
    }
}
