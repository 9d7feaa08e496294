//! Generating inputs: a line that reaches some state, and frames that resemble those of a master.

use esc::REGISTERS;
use wire::{AlState, Command};

use super::step::{Datagram, Model, Step, frame};
use crate::bytes;
use crate::random::Random;

const STATES: [AlState; 4] = [AlState::Init, AlState::PreOp, AlState::SafeOp, AlState::Op];
/// Positions of mailboxes and process data in one of the models.
const AREAS: [u16; 8] = [0x1000, 0x1100, 0x103F, 0x113F, 0x1200, 0x13A0, 0x21B0, 0x0F80];

/// A line and the steps with it.
pub(super) fn steps(random: &mut Random) -> Vec<Step> {
    let units = random.between(1, 3);
    let mut steps = vec![Step::Line(models(units, random))];
    for unit in 0..units {
        if !random.once_in(6) {
            steps.push(Step::Bring(
                unit,
                *random.one_of(&[AlState::PreOp, AlState::SafeOp, AlState::Op, AlState::Op]),
            ));
        }
    }
    for _ in 0..random.between(1, 24) {
        steps.push(step(units, random));
    }
    steps
}

/// Units of one model, or of all.
fn models(units: usize, random: &mut Random) -> Vec<Model> {
    match random.below(4) {
        0 => vec![Model::Nx; units],
        1 => (0..units).map(|_| *random.one_of(&[Model::Nx, Model::Even, Model::Terminal])).collect(),
        _ => vec![Model::Even; units],
    }
}

fn step(units: usize, random: &mut Random) -> Step {
    match random.below(20) {
        0 => Step::Bring(random.below(units), *random.one_of(&STATES)),
        1..=5 => Step::Cycle(random.byte()),
        6 => Step::Raw(raw(units, random)),
        7 => Step::Far(chain(units, random)),
        8 => Step::Corrupt(random.below(units + 1), chain(units, random)),
        9 | 10 => Step::Wait(*random.one_of(&[0, 10, 500, 1_000, 1_000, 2_000, 20_000, 110_000])),
        11 if random.once_in(3) => Step::Cable(random.below(units + 1), random.once_in(2)),
        12 if random.once_in(3) => Step::Power(random.below(units), random.once_in(2)),
        _ => Step::Frame(chain(units, random)),
    }
}

/// A damaged frame, or bytes that are not a frame.
fn raw(units: usize, random: &mut Random) -> Vec<u8> {
    let mut bytes = match random.below(8) {
        0 => {
            let length = random.length(1_600);
            random.bytes(length)
        }
        1 => tagged(&frame(&chain(units, random))),
        2 => in_udp(&frame(&chain(units, random))),
        _ => frame(&chain(units, random)),
    };
    if !random.once_in(4) {
        bytes::damage(&mut bytes, random);
    }
    bytes.truncate(2_000);
    bytes
}

/// With a VLAN tag.
fn tagged(frame: &[u8]) -> Vec<u8> {
    [&frame[..12], &[0x81, 0x00, 0x00, 0x05], &frame[12..]].concat()
}

/// EtherCAT in UDP.
fn in_udp(frame: &[u8]) -> Vec<u8> {
    let payload = &frame[14..];
    let udp_bytes = (8 + payload.len() as u16).to_be_bytes();
    let ip_bytes = (28 + payload.len() as u16).to_be_bytes();
    let mut packet = frame[..12].to_vec();
    packet.extend([0x08, 0x00, 0x45, 0]);
    packet.extend(ip_bytes);
    packet.extend([0, 0, 0, 0, 64, 17, 0, 0, 127, 0, 0, 1, 127, 0, 0, 1, 0x88, 0xA4, 0x88, 0xA4]);
    packet.extend(udp_bytes);
    packet.extend([0x12, 0x34]);
    packet.extend(payload);
    packet
}

fn chain(units: usize, random: &mut Random) -> Vec<Datagram> {
    let count = *random.one_of(&[1, 1, 1, 2, 2, 3, 5, 15]);
    let mut chain: Vec<Datagram> = (0..count).map(|_| datagram(units, random)).collect();
    // Data too long for a frame are rarely useful.
    let mut room = if random.once_in(12) { 4_000 } else { 1_480_usize };
    chain.retain(|datagram| {
        let bytes = datagram.data.len() + 12;
        let fits = bytes <= room;
        room = room.saturating_sub(bytes);
        fits
    });
    if chain.is_empty() {
        chain.push(Datagram::new(Command::Brd, 0, 0x0130, vec![0, 0]));
    }
    chain
}

fn datagram(units: usize, random: &mut Random) -> Datagram {
    let command =
        if random.once_in(30) { Command::from_code(random.byte()) } else { *random.one_of(&Command::ALL) };
    let mut datagram = match command {
        Command::Lrd | Command::Lwr | Command::Lrw => {
            let length = random.length(1_400);
            Datagram::logical(command, logical_address(units, random), random.bytes(length))
        }
        command => physical(command, units, random),
    };
    datagram.circulating = random.once_in(20);
    if random.once_in(10) {
        datagram.counter = random.word();
    }
    datagram
}

fn logical_address(units: usize, random: &mut Random) -> u32 {
    let unit = 0x0001_0000 * (1 + random.below(units) as u32);
    match random.below(4) {
        0 => unit,
        1 => unit + 0x1000,
        2 => unit + random.below(0x1100) as u32,
        _ => random.number() as u32,
    }
}

fn physical(command: Command, units: usize, random: &mut Random) -> Datagram {
    let address = match command {
        Command::Aprd | Command::Apwr | Command::Aprw | Command::Armw => {
            (random.below(units + 1) as u16).wrapping_neg()
        }
        Command::Fprd | Command::Fpwr | Command::Fprw | Command::Frmw => {
            0x1001 + random.below(units + 1) as u16
        }
        _ => random.word(),
    };
    let address = if random.once_in(20) { random.word() } else { address };
    let (offset, data) = match random.below(9) {
        8 => mailbox(random),
        0 => al_control(random),
        1 => sync_manager(random),
        2 => fmmu(random),
        3 => process_data(random),
        4 => sii(random),
        5 => {
            let length = random.length(600);
            (random.word(), random.bytes(length))
        }
        _ => register(random),
    };
    Datagram::new(command, address, offset, data)
}

fn register(random: &mut Random) -> (u16, Vec<u8>) {
    let row = random.one_of(REGISTERS);
    let offset = row.offset + random.below(row.count.into()) as u16 * row.stride_bytes;
    let offset = if random.once_in(8) { offset.wrapping_sub(1) } else { offset };
    let length = if random.once_in(3) { random.length(64) } else { row.size_bytes.into() };
    (offset, random.bytes(length))
}

fn al_control(random: &mut Random) -> (u16, Vec<u8>) {
    let state = random.one_of(&STATES).bits();
    let control = match random.below(4) {
        0 => state | 0x10,
        1 => random.word(),
        _ => state,
    };
    (0x0120, control.to_le_bytes().to_vec())
}

fn sync_manager(random: &mut Random) -> (u16, Vec<u8>) {
    let number = random.below(5) as u16;
    let start = if random.once_in(4) { random.word() } else { *random.one_of(&AREAS) };
    let length = *random.one_of(&[0_u16, 1, 2, 63, 64, 65, 400, 1_200, 0xFFFF]);
    let control = *random.one_of(&[0x26, 0x22, 0x64, 0x20, 0x24, 0x00, 0xFF]);
    let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length.to_le_bytes());
    let settings = [s0, s1, l0, l1, control, random.byte(), random.below(4) as u8, random.byte()];
    let (from, to) = *random.one_of(&[(0, 8), (0, 8), (6, 7), (6, 8), (0, 4), (2, 4)]);
    (0x0800 + 8 * number + from as u16, settings[from..to].to_vec())
}

fn fmmu(random: &mut Random) -> (u16, Vec<u8>) {
    let number = random.below(4) as u16;
    let mut settings = [0; 16];
    settings[..4].copy_from_slice(&logical_address(2, random).to_le_bytes());
    settings[4..6].copy_from_slice(&(random.length(1_400) as u16).to_le_bytes());
    settings[6] = random.below(9) as u8;
    settings[7] = random.below(9) as u8;
    settings[8..10].copy_from_slice(&random.one_of(&AREAS).to_le_bytes());
    settings[10] = if random.once_in(3) { random.below(9) as u8 } else { 0 };
    settings[11] = random.below(4) as u8;
    settings[12] = u8::from(!random.once_in(5));
    (0x0600 + 16 * number, settings.to_vec())
}

/// Mailboxes and images, complete and in part.
fn process_data(random: &mut Random) -> (u16, Vec<u8>) {
    let start = *random.one_of(&AREAS);
    let shift = if random.once_in(2) { 0 } else { random.below(70) as u16 };
    let length = *random.one_of(&[1, 2, 16, 32, 63, 64, 64, 65, 400, 1_204]);
    (start + shift, random.bytes(length))
}

/// A CoE message that fills the mailbox of an NX-ECT101, a read of the other mailbox, or a request to repeat.
fn mailbox(random: &mut Random) -> (u16, Vec<u8>) {
    const MAILBOX_BYTES: usize = 400;
    match random.below(5) {
        0 | 1 => {
            let command = *random.one_of(&[0x40, 0x2F, 0x2B, 0x23, 0x21, 0x60, 0x00, 0x50, 0x31]);
            let [low, high] =
                random.one_of(&[0x1018_u16, 0x1C12, 0x1601, 0x10F3, 0x7000, 0x3001]).to_le_bytes();
            let service = *random.one_of(&[0x20, 0x20, 0x80]);
            let counter = random.below(8) as u8;
            let mut message = vec![10, 0, 0, 0, 0, 0x03 | counter << 4, 0, service, command, low, high];
            message.extend([random.below(5) as u8, random.byte(), random.byte(), 0, 0]);
            message.resize(MAILBOX_BYTES, 0);
            (0x1000, message)
        }
        2 | 3 => (0x1200, vec![0; MAILBOX_BYTES]),
        _ => (0x080E, vec![0x01 | (random.byte() & 0x02)]),
    }
}

/// The owner of the SII, its commands and its address.
fn sii(random: &mut Random) -> (u16, Vec<u8>) {
    let command = random.one_of(&[0x0100_u16, 0x0201, 0x0400, 0x0200, 0x0000]).to_le_bytes();
    match random.below(3) {
        0 => (0x0500, vec![random.below(4) as u8]),
        1 => (0x0502, [&command[..], &(random.below(200) as u32).to_le_bytes()].concat()),
        _ => (0x0502, [&command[..], &random.number().to_le_bytes(), &[0; 4]].concat()),
    }
}
