//! The logical address space: a place for each area of process data of each slave.

use super::exchange::Grouping;
use crate::channels::FmmuSettings;
use crate::settings::{Direction, ProcessDataArea, SlaveSettings};

/// The place of an area of process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) slave: usize,
    pub(crate) direction: Direction,
    /// The first bit, counted from the first logical byte.
    pub(crate) start: usize,
    /// Number of mapped bits: those of the area, rounded up to whole bytes if there are eight or more.
    pub(crate) bits: usize,
    /// The first bit in the outputs or inputs of its slave.
    pub(crate) image_start: usize,
    fmmu: u8,
    physical_start: u16,
}

impl Place {
    /// The bit after the last one.
    pub(crate) const fn end(&self) -> usize {
        self.start + self.bits
    }

    /// The FMMU that maps it, if the logical address space begins at this address.
    fn fmmu(&self, origin: u32) -> FmmuSettings {
        let (first, last) = (self.start / 8, (self.end() - 1) / 8);
        FmmuSettings {
            number: self.fmmu,
            logical_start: origin.wrapping_add(first as u32),
            length_bytes: (last - first + 1) as u16,
            logical_start_bit: (self.start % 8) as u8,
            logical_stop_bit: ((self.end() - 1) % 8) as u8,
            physical_start: self.physical_start,
            physical_start_bit: 0,
            kind: self.direction.fmmu_kind(),
            activate: 1,
        }
    }
}

/// All places.
#[derive(Debug, Default)]
pub(crate) struct Layout {
    places: Vec<Place>,
    end: usize,
}

impl Layout {
    pub(crate) fn places(&self) -> &[Place] {
        &self.places
    }

    /// Whether a slave has its places, and its process data have not changed since.
    pub(crate) fn holds(&self, slave: usize, settings: &SlaveSettings) -> bool {
        let mut wanted = Self { places: Vec::new(), end: 0 };
        wanted.place(slave, settings, Direction::Outputs);
        wanted.place(slave, settings, Direction::Inputs);
        let of_slave = self.places.iter().filter(|place| place.slave == slave);
        let unplaced = |place: &Place| Place { start: 0, ..*place };
        of_slave.map(unplaced).eq(wanted.places.iter().map(unplaced))
    }

    /// Places the process data of these slaves after the existing places.
    pub(crate) fn place_all(&mut self, slaves: &[(usize, &SlaveSettings)], grouping: Grouping) {
        match grouping {
            Grouping::Filled => self.place_group(slaves),
            Grouping::EachSlave => slaves.chunks(1).for_each(|slave| self.place_group(slave)),
        }
    }

    /// Outputs of all of them, then inputs of all.
    fn place_group(&mut self, slaves: &[(usize, &SlaveSettings)]) {
        for direction in [Direction::Outputs, Direction::Inputs] {
            for (slave, settings) in slaves {
                self.place(*slave, settings, direction);
            }
            self.end = self.end.next_multiple_of(8);
        }
    }

    /// Removes the places of a slave. The places after them are unchanged.
    pub(crate) fn remove(&mut self, slave: usize) {
        self.places.retain(|place| place.slave != slave);
        if self.places.is_empty() {
            self.end = 0;
        }
    }

    /// Fewer than eight bits directly follow others of the same kind; all other areas begin at a new byte.
    fn place(&mut self, slave: usize, settings: &SlaveSettings, direction: Direction) {
        let mut image_start = 0;
        for area in settings.areas(direction).filter(|area| area.bits > 0) {
            let bits = mapped_bits(area, settings.bytewise_fmmus);
            if bits >= 8 {
                self.end = self.end.next_multiple_of(8);
            }
            let (fmmu, physical_start) = (area.fmmu, area.sync_manager.start);
            self.places.push(Place {
                slave,
                direction,
                start: self.end,
                bits,
                image_start,
                fmmu,
                physical_start,
            });
            self.end += bits;
            image_start += bits.next_multiple_of(8);
        }
    }

    /// The FMMUs of a slave.
    pub(crate) fn fmmus(&self, slave: usize, origin: u32) -> impl Iterator<Item = FmmuSettings> {
        self.places.iter().filter(move |place| place.slave == slave).map(move |place| place.fmmu(origin))
    }
}

const fn mapped_bits(area: &ProcessDataArea, bytewise: bool) -> usize {
    let bits = area.bits as usize;
    if bits < 8 && !bytewise { bits } else { bits.next_multiple_of(8) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::channels::SyncManagerSettings;

    fn settings(areas: &[(Direction, u32)]) -> SlaveSettings {
        let area = |(number, &(direction, bits)): (u8, &(Direction, u32))| ProcessDataArea {
            direction,
            bits,
            sync_manager: SyncManagerSettings { number, start: 0x1000, ..SyncManagerSettings::default() },
            fmmu: number,
        };
        SlaveSettings { process_data: (0..).zip(areas).map(area).collect(), ..SlaveSettings::default() }
    }

    fn starts(layout: &Layout) -> Vec<(usize, usize, usize)> {
        layout.places().iter().map(|place| (place.slave, place.start, place.bits)).collect()
    }

    use Direction::{Inputs, Outputs};

    #[test]
    fn bits_of_several_slaves_share_a_byte_and_bytes_begin_with_one() {
        let (four, eight, twelve) =
            (settings(&[(Outputs, 4)]), settings(&[(Outputs, 8)]), settings(&[(Inputs, 12)]));
        let mut layout = Layout::default();
        layout.place_all(&[(0, &four), (1, &four), (2, &eight), (3, &four), (4, &twelve)], Grouping::Filled);
        assert_eq!(starts(&layout), [(0, 0, 4), (1, 4, 4), (2, 8, 8), (3, 16, 4), (4, 24, 16)]);
        let fmmus: Vec<_> = layout.fmmus(1, 0x1_0000).collect();
        let [fmmu] = fmmus[..] else { panic!("one FMMU") };
        assert_eq!((fmmu.logical_start, fmmu.length_bytes, fmmu.kind), (0x1_0000, 1, 2));
        assert_eq!((fmmu.logical_start_bit, fmmu.logical_stop_bit, fmmu.physical_start_bit), (4, 7, 0));
    }

    #[test]
    fn bits_may_go_over_the_end_of_a_byte() {
        let five = settings(&[(Inputs, 5)]);
        let mut layout = Layout::default();
        layout.place_all(&[(0, &five), (1, &five)], Grouping::Filled);
        let fmmu = layout.fmmus(1, 0).next().expect("an FMMU");
        assert_eq!((fmmu.logical_start, fmmu.length_bytes), (0, 2));
        assert_eq!((fmmu.logical_start_bit, fmmu.logical_stop_bit), (5, 1));
    }

    #[test]
    fn outputs_of_all_come_before_inputs_of_all_and_never_share_a_byte_with_them() {
        let both = settings(&[(Outputs, 3), (Inputs, 3)]);
        let mut layout = Layout::default();
        layout.place_all(&[(0, &both), (1, &both)], Grouping::Filled);
        assert_eq!(starts(&layout), [(0, 0, 3), (1, 3, 3), (0, 8, 3), (1, 11, 3)]);
        let mut layout = Layout::default();
        layout.place_all(&[(0, &both), (1, &both)], Grouping::EachSlave);
        assert_eq!(starts(&layout), [(0, 0, 3), (0, 8, 3), (1, 16, 3), (1, 24, 3)]);
    }

    #[test]
    fn a_slave_that_changes_goes_behind_the_others() {
        let (old, new) = (settings(&[(Outputs, 16)]), settings(&[(Outputs, 24)]));
        let mut layout = Layout::default();
        layout.place_all(&[(0, &old), (1, &old)], Grouping::Filled);
        assert!(layout.holds(0, &old) && !layout.holds(0, &new) && !layout.holds(2, &old));
        layout.remove(0);
        layout.place_all(&[(0, &new)], Grouping::Filled);
        assert_eq!(starts(&layout), [(1, 16, 16), (0, 32, 24)]);
        assert!(layout.holds(0, &new));
    }

    #[test]
    fn two_areas_of_a_slave_lie_behind_each_other_in_its_image() {
        let mut layout = Layout::default();
        layout.place_all(&[(0, &settings(&[(Inputs, 4), (Inputs, 16), (Outputs, 0)]))], Grouping::Filled);
        let images: Vec<_> = layout.places().iter().map(|place| place.image_start).collect();
        assert_eq!(images, [0, 8]);
    }
}
