//! A segment and the slaves on its ESCs: frames in, frames out, deadlines.

use core::ops::Range;

use esc::Esc;
use segment::{FrameFate, Segment};
use time::Instant;

use crate::agenda::Agenda;
use crate::config::DeviceConfig;
use crate::device::Device;
use crate::unit::{Start, Unit};

/// A line of slaves behind a master, driven by the caller: no clock, no thread.
///
/// [`Network::frame`] answers a frame and does nothing else; [`Network::poll`] lets the slaves react. Call it
/// after each frame and whenever [`Network::deadline`] is reached.
#[derive(Debug)]
pub struct Network<U> {
    segment: Segment,
    devices: Vec<Device<U>>,
    agenda: Agenda,
    /// Whether a cable is plugged in: the one before the device with its number; the last one is at the far end.
    cables: Vec<bool>,
    /// Whether the medium to the master has a carrier: cable 0, at the master's end.
    carrier: bool,
}

impl<U: Unit> Network<U> {
    /// Powers on a line of units at `now`, starting with the one next to the master.
    #[must_use]
    pub fn power_on(units: impl IntoIterator<Item = (DeviceConfig, U)>, now: Instant) -> Self {
        let powered = units.into_iter().map(|(config, unit)| Device::power_on(config, unit, now));
        let (devices, escs): (Vec<_>, Vec<_>) = powered.unzip();
        let mut cables = vec![true; devices.len()];
        cables.push(false);
        let agenda = Agenda::all(devices.len());
        Self { segment: Segment::new(escs), devices, agenda, cables, carrier: true }
    }

    /// A frame arrives from the master; it is answered in place.
    #[inline]
    pub fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.segment.frame(now, frame)
    }

    /// A frame arrives from the master and gets a bit error on the cable of this number.
    pub fn corrupted_frame(&mut self, now: Instant, frame: &mut [u8], cable: usize) -> FrameFate {
        self.segment.corrupted_frame(now, frame, cable)
    }

    /// Whether a frame from the master gets to the cable of this number.
    #[must_use]
    pub fn reaches_cable(&mut self, cable: usize) -> bool {
        self.segment.reaches_cable(cable)
    }

    /// A frame that has come to the first of two cables goes to the second one; false: it does not get there, and
    /// nothing has happened.
    pub fn frame_between(&mut self, now: Instant, frame: &mut [u8], cables: Range<usize>) -> bool {
        self.segment.frame_between(now, frame, cables)
    }

    /// A frame that has come to a cable goes on from there.
    pub fn frame_from_cable(&mut self, now: Instant, frame: &mut [u8], cable: usize) -> FrameFate {
        self.segment.frame_from_cable(now, frame, cable)
    }

    /// A frame that has come to the first of two cables gets a bit error on the second one: the slaves behind that
    /// count an error.
    pub fn corrupted_frame_between(&mut self, now: Instant, frame: &mut [u8], cables: Range<usize>) {
        self.segment.corrupted_frame_between(now, frame, cables);
    }

    /// A frame on its way back has a bit error on this cable: the slaves before it count an error.
    pub fn count_bit_error_on_the_way_back(&mut self, cable: usize) {
        self.segment.count_bit_error_on_the_way_back(cable);
    }

    /// A frame arrives from the master's second port, at the far end.
    pub fn frame_at_far_end(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.segment.frame_at_far_end(now, frame)
    }

    /// Lets every slave react that has pending work. The other slaves are not looked at and cost nothing.
    pub fn poll(&mut self, now: Instant) {
        let mut reset = false;
        self.agenda.gather(&mut self.segment);
        let mut from = 0;
        while let Some(position) = self.agenda.next_to_look_at(from, now) {
            from = position + 1;
            let device = self.devices.get_mut(position);
            let (Some(device), Some(esc)) = (device, self.segment.esc_mut(position)) else { continue };
            if esc.take_sii_written() {
                self.agenda.has_changed(position);
            }
            let is_due = device.deadline().min(esc.deadline()) <= now;
            if is_due || device.is_called(esc) {
                reset |= esc.asks_for_reset();
                device.poll(esc, now);
                self.agenda.has_changed(position);
            }
            self.agenda.looked_at(position, device.deadline().min(esc.deadline()), device.is_called(esc));
        }
        if reset {
            self.segment.follow_changed_ports();
        }
    }

    /// The latest time at which [`Network::poll`] must be called.
    #[must_use]
    pub fn deadline(&self) -> Instant {
        let (known, touched) = (self.agenda.first(), self.segment.touched());
        // Asked again and again between two frames, when there is nothing to look at.
        if self.agenda.is_looked_through() && touched.is_empty() {
            return known;
        }
        let to_look_at = self.agenda.to_look_at().chain(touched.iter());
        to_look_at.map(|position| self.deadline_of(position)).fold(known, Instant::min)
    }

    fn deadline_of(&self, position: usize) -> Instant {
        match (self.devices.get(position), self.segment.esc(position)) {
            (Some(device), Some(esc)) => device.deadline().min(esc.deadline()),
            _ => Instant::NEVER,
        }
    }

    /// Takes the next slave that may be another than when it was taken last: it has reacted, the master has written its
    /// EEPROM, it was started or switched off, or was lent. At first that is every slave.
    pub fn take_changed(&mut self) -> Option<(usize, &mut Device<U>, &Esc)> {
        let position = self.agenda.take_changed()?;
        Some((position, self.devices.get_mut(position)?, self.segment.esc(position)?))
    }

    /// Number of slaves.
    #[must_use]
    pub fn len(&self) -> usize {
        self.devices.len()
    }

    /// Whether there are no slaves.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.devices.is_empty()
    }

    /// The slave at a position, counted from the master.
    #[must_use]
    pub fn device(&self, position: usize) -> Option<&Device<U>> {
        self.devices.get(position)
    }

    /// The slave at a position, for its application.
    #[must_use]
    pub fn device_mut(&mut self, position: usize) -> Option<&mut Device<U>> {
        self.agenda.is_lent(position);
        self.devices.get_mut(position)
    }

    /// Mutable access to a slave and its ESC together.
    #[must_use]
    pub fn slave_mut(&mut self, position: usize) -> Option<(&mut Device<U>, &mut Esc)> {
        self.agenda.is_lent(position);
        Some((self.devices.get_mut(position)?, self.segment.esc_mut(position)?))
    }

    /// The ESC at a position.
    #[must_use]
    pub fn esc(&self, position: usize) -> Option<&Esc> {
        self.segment.esc(position)
    }

    /// The line, for reading.
    #[must_use]
    pub const fn segment(&self) -> &Segment {
        &self.segment
    }

    /// Plugs or pulls a cable: the one before the slave at `number`, or the one at the far end. It carries
    /// frames while both its ends have power.
    pub fn set_cable(&mut self, number: usize, plugged: bool) {
        if let Some(cable) = self.cables.get_mut(number) {
            *cable = plugged;
            self.connect(number);
        }
    }

    /// The medium to the master has lost its carrier, or has it again: as if the first cable were pulled at its
    /// other end. A cable that is pulled at this end remains pulled.
    pub fn set_carrier(&mut self, present: bool) {
        self.carrier = present;
        self.connect(0);
    }

    /// Switches one slave's power off: no frame passes it until [`Network::restart`] with [`Start::PowerOn`]. A
    /// position without a slave has no effect.
    pub fn power_off(&mut self, position: usize, now: Instant) {
        self.agenda.is_lent(position);
        if let Some(device) = self.devices.get_mut(position) {
            device.power_off(now);
            self.connect(position);
            self.connect(position + 1);
        }
    }

    /// Another slave takes the place of one: the cables of the old one are unplugged, the new one is powered on at `now`, and
    /// the cables are plugged in where they were. A position without a slave has no effect.
    pub fn replace(&mut self, position: usize, config: DeviceConfig, unit: U, now: Instant) {
        self.power_off(position, now);
        if let (Some(old), Some(old_esc)) = (self.devices.get_mut(position), self.segment.esc_mut(position)) {
            (*old, *old_esc) = Device::power_on(config, unit, now);
            self.segment.follow_changed_ports();
            self.connect(position);
            self.connect(position + 1);
        }
    }

    fn connect(&mut self, cable: usize) {
        let has_power = |end: Option<usize>| {
            end.and_then(|end| self.devices.get(end)).is_none_or(|device| !device.is_off())
        };
        let carries = self.cables.get(cable).is_some_and(|&plugged| plugged)
            && (cable > 0 || self.carrier)
            && has_power(Some(cable))
            && has_power(cable.checked_sub(1));
        self.segment.set_cable(cable, carries);
        // Its ends show another link.
        let ends = [Some(cable), cable.checked_sub(1)].into_iter().flatten();
        ends.filter(|end| *end < self.devices.len()).for_each(|end| self.agenda.has_changed(end));
    }

    /// Restarts one slave; a position without a slave has no effect, nor has any start but [`Start::PowerOn`] of a
    /// slave without power.
    pub fn restart(&mut self, position: usize, now: Instant, start: Start) {
        self.agenda.is_lent(position);
        if let (Some(device), Some(esc)) = (self.devices.get_mut(position), self.segment.esc_mut(position)) {
            let was_off = device.is_off();
            device.restart(esc, now, start);
            self.segment.follow_changed_ports();
            if was_off && !device.is_off() {
                self.connect(position);
                self.connect(position + 1);
            }
        }
    }
}
