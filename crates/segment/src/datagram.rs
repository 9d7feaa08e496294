//! One datagram along a line of ESCs: who is meant, what is read and written, what counts.

use esc::{Access, Esc};
use time::{Duration, Instant};
use wire::{Command, Datagram};

/// Passes a datagram through the processing unit of each ESC, the first one at `now`, each next one a hop
/// later (reference 1.4, 1.5).
#[inline]
pub(crate) fn pass(escs: &mut [Esc], datagram: &mut Datagram<'_>, now: Instant, hop: Duration) {
    let command = datagram.header.command;
    if matches!(command, Command::Other(_)) {
        return;
    }
    if command.is_logical() {
        pass_logical(escs, datagram, now, hop);
    } else {
        pass_physical(escs, datagram, command, now, hop);
    }
    datagram.header.events |= escs.iter().fold(0, |events, esc| events | esc.masked_events());
}

#[inline]
fn pass_logical(escs: &mut [Esc], datagram: &mut Datagram<'_>, now: Instant, hop: Duration) {
    let address = datagram.header.logical_address();
    let data = &mut *datagram.data;
    let mut count = 0u16;
    let mut arrival = now;
    for esc in escs {
        let increment = match datagram.header.command {
            Command::Lrd => u16::from(esc.logical_read(address, data, arrival)),
            Command::Lwr => u16::from(esc.logical_write(address, data)),
            _ => read_write_increment(esc.logical_read_write(address, data, arrival)),
        };
        count = count.wrapping_add(increment);
        arrival += hop;
    }
    datagram.working_counter = datagram.working_counter.wrapping_add(count);
}

#[inline]
fn pass_physical(
    escs: &mut [Esc],
    datagram: &mut Datagram<'_>,
    command: Command,
    now: Instant,
    hop: Duration,
) {
    let address = datagram.header.address;
    let offset = datagram.header.offset;
    let data = &mut *datagram.data;
    let passed = escs.len() as u16;
    let mut count = 0u16;
    let mut arrival = now;
    for (position, esc) in (0u16..).zip(escs) {
        let here = address.wrapping_add(position) == 0;
        let increment = match command {
            Command::Brd => u16::from(esc.read_or(offset, data, arrival)),
            Command::Bwr => u16::from(esc.write(offset, data)),
            Command::Brw => read_write_increment(esc.read_or_write(offset, data, arrival)),
            Command::Aprd if here => u16::from(esc.read(offset, data, arrival)),
            Command::Apwr if here => u16::from(esc.write(offset, data)),
            Command::Aprw if here => read_write_increment(esc.read_write(offset, data, arrival)),
            Command::Fprd if esc.answers_to(address) => u16::from(esc.read(offset, data, arrival)),
            Command::Fpwr if esc.answers_to(address) => u16::from(esc.write(offset, data)),
            Command::Fprw if esc.answers_to(address) => {
                read_write_increment(esc.read_write(offset, data, arrival))
            }
            Command::Armw if here => u16::from(esc.read(offset, data, arrival)),
            Command::Frmw if esc.answers_to(address) => u16::from(esc.read(offset, data, arrival)),
            Command::Armw | Command::Frmw => u16::from(esc.write(offset, data)),
            _ => 0,
        };
        count = count.wrapping_add(increment);
        arrival += hop;
    }
    if command.increments_position() {
        datagram.header.address = address.wrapping_add(passed);
    }
    datagram.working_counter = datagram.working_counter.wrapping_add(count);
}

/// A successful read counts 1, a successful write 2, both 3.
const fn read_write_increment(access: Access) -> u16 {
    access.read as u16 + 2 * access.written as u16
}
