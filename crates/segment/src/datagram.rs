//! One datagram along a line of ESCs: which ESC is addressed, what is read and written, what counts.

use esc::{Access, Esc};
use time::{Duration, Instant};
use wire::{Command, Datagram};

/// Passes a datagram through the processing unit of each ESC, the first one at `now`, each next one a hop later
/// (reference 1.4, 1.5). Returns whether an ESC waits for the end of the frame.
#[inline]
pub(crate) fn pass(escs: &mut [Esc], datagram: &mut Datagram<'_>, now: Instant, hop: Duration) -> bool {
    let passed = Passed { events: 0, count: 0, waits: false, arrival: now, hop };
    let passed = match datagram.header.command {
        Command::Other(_) => return false,
        Command::Lrd | Command::Lwr | Command::Lrw => pass_logical(escs, datagram, passed),
        command => pass_physical(escs, datagram, command, passed),
    };
    datagram.header.events |= passed.events;
    datagram.working_counter = datagram.working_counter.wrapping_add(passed.count);
    passed.waits
}

/// The sums along the line.
struct Passed {
    events: u16,
    count: u16,
    waits: bool,
    arrival: Instant,
    hop: Duration,
}

impl Passed {
    /// To the next ESC.
    #[inline]
    fn by(&mut self, esc: &Esc, increment: u16) {
        self.count = self.count.wrapping_add(increment);
        self.events |= esc.masked_events();
        self.waits |= esc.awaits_end_of_frame();
        self.arrival += self.hop;
    }
}

#[inline]
fn pass_logical(escs: &mut [Esc], datagram: &mut Datagram<'_>, mut passed: Passed) -> Passed {
    let address = datagram.header.logical_address();
    let data = &mut *datagram.data;
    for esc in escs {
        let increment = match datagram.header.command {
            Command::Lrd => u16::from(esc.logical_read(address, data, passed.arrival)),
            Command::Lwr => u16::from(esc.logical_write(address, data, passed.arrival)),
            _ => read_write_increment(esc.logical_read_write(address, data, passed.arrival)),
        };
        passed.by(esc, increment);
    }
    passed
}

#[inline]
fn pass_physical(
    escs: &mut [Esc],
    datagram: &mut Datagram<'_>,
    command: Command,
    mut passed: Passed,
) -> Passed {
    let address = datagram.header.address;
    let offset = datagram.header.offset;
    let data = &mut *datagram.data;
    if command.increments_position() {
        datagram.header.address = address.wrapping_add(escs.len() as u16);
    }
    for (position, esc) in (0u16..).zip(escs) {
        let here = address.wrapping_add(position) == 0;
        let arrival = passed.arrival;
        let increment = match command {
            Command::Brd => u16::from(esc.read_or(offset, data, arrival)),
            Command::Bwr => u16::from(esc.write(offset, data, arrival)),
            Command::Brw => read_write_increment(esc.read_or_write(offset, data, arrival)),
            Command::Aprd if here => u16::from(esc.read(offset, data, arrival)),
            Command::Apwr if here => u16::from(esc.write(offset, data, arrival)),
            Command::Aprw if here => read_write_increment(esc.read_write(offset, data, arrival)),
            Command::Fprd if esc.answers_to(address) => u16::from(esc.read(offset, data, arrival)),
            Command::Fpwr if esc.answers_to(address) => u16::from(esc.write(offset, data, arrival)),
            Command::Fprw if esc.answers_to(address) => {
                read_write_increment(esc.read_write(offset, data, arrival))
            }
            Command::Armw if here => u16::from(esc.read(offset, data, arrival)),
            Command::Frmw if esc.answers_to(address) => u16::from(esc.read(offset, data, arrival)),
            Command::Armw | Command::Frmw => u16::from(esc.write(offset, data, arrival)),
            _ => 0,
        };
        passed.by(esc, increment);
    }
    passed
}

/// A successful read counts 1, a successful write 2, both 3.
const fn read_write_increment(access: Access) -> u16 {
    access.read as u16 + 2 * access.written as u16
}
