//! Captures: files of blocks of every kind in either byte order, and damaged ones.
//!
//! The data read are not longer than the file, and reading them again after writing gives the same; the frames
//! of a master are replayed.

use capture::{Direction, NotACapture, Packet, PcapngWriter, packets, read_packets};
use scenario::{RecordedFrames, Recording, Scenario};
use time::Duration;
use wire::{Command, FrameBuilder};

use crate::bytes;
use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::random::Random;
use crate::real_files::Seeds;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "capture",
    extension: ".pcapng",
    seeds: || Seeds::of(&["tests/fuzz/capture", "tests/captures"], ".pcapng"),
    generate,
    check,
    limits: Limits {
        milliseconds: 4_000,
        milliseconds_per_kib: 50,
        memory_kib: 8 << 10,
        memory_per_byte: 1_024,
    },
    grains: &[Grain::Pairs, Grain::Bytes],
};

/// The scenario that replays a capture, and its duration.
const SCENARIO: &str = "title = \"a capture\"\ncapture = \"x.pcapng\"\nunits = [{ model = \"nx-ect101\", timing = \"fast\" }]\n\
    steps = [{ expect = \"the capture is replayed\", within = \"50ms\" }]\n";
const REPLAYED: Duration = Duration::from_millis(50);

fn check(input: &[u8]) -> Checked {
    let list = match packets(input) {
        Ok(packets) => packets,
        Err(NotACapture::NoSection) => return Ok("no capture"),
        Err(other) => return Err(format!("{other:?} before the first block")),
    };
    let mut read = Vec::new();
    let mut broken = None;
    for packet in list {
        match (packet, broken) {
            (_, Some(_)) => return Err("something follows a mistake".to_owned()),
            (Ok(packet), None) => read.push(packet),
            (Err(reason), None) => broken = Some(reason),
        }
    }
    let bytes: usize = read.iter().map(|packet| packet.frame.len()).sum();
    if bytes > input.len() || read.len() > input.len() / 16 {
        return Err(format!("{} packets with {bytes} bytes in {} bytes", read.len(), input.len()));
    }
    if let Some(NotACapture::Block { at } | NotACapture::Interface { at }) = broken
        && at >= input.len()
    {
        return Err(format!("a mistake at byte {at} of {}", input.len()));
    }
    if read_packets(input) != broken.map_or_else(|| Ok(read.clone()), Err) {
        return Err("all packets at once are others".to_owned());
    }
    written_again(&read)?;
    replayed(input, &read, broken.is_some())
}

/// A capture of the packets that have a direction contains them again.
fn written_again(read: &[Packet]) -> Result<(), String> {
    let told: Vec<&Packet> = read.iter().filter(|packet| packet.direction.is_some()).collect();
    let mut writer = PcapngWriter::new(Vec::new(), "fuzz").map_err(|error| error.to_string())?;
    for packet in &told {
        let direction = packet.direction.unwrap_or(Direction::Inbound);
        let written = writer.packet(packet.at_nanos, direction, &packet.frame, None);
        written.map_err(|error| error.to_string())?;
    }
    let bytes = writer.finish().map_err(|error| error.to_string())?;
    let again = read_packets(&bytes).map_err(|reason| format!("what is written is no capture: {reason}"))?;
    if again.iter().eq(told) { Ok(()) } else { Err("what is written is not what is read".to_owned()) }
}

/// A capture that can be replayed is replayed for a while.
fn replayed(input: &[u8], read: &[Packet], is_broken: bool) -> Checked {
    let frames = match RecordedFrames::read(input) {
        Ok(frames) => frames,
        Err(_) => return Ok(if is_broken { "broken" } else { "not replayable" }),
    };
    if is_broken {
        return Err("a broken capture is replayable".to_owned());
    }
    if frames.len() > read.len() || frames.answers() > frames.len() {
        return Err(format!("{} frames and {} answers of {}", frames.len(), frames.answers(), read.len()));
    }
    if frames.is_empty() {
        return Ok("no frames");
    }
    let mut scenario =
        Scenario::parse(SCENARIO, |_| Err(String::new())).map_err(|errors| errors.to_string())?;
    scenario.limit = REPLAYED;
    scenario.load_capture(input).map_err(|reason| reason.to_string())?;
    let report = scenario.replay(1, Recording::new(false, false));
    Ok(if report.passes() { "replayed" } else { "not to its end" })
}

fn generate(seeds: &Seeds, random: &mut Random) -> Vec<u8> {
    let mut bytes = if random.once_in(4) && !seeds.inputs.is_empty() {
        random.one_of(&seeds.inputs).clone()
    } else {
        file(random)
    };
    if !random.once_in(3) {
        bytes::damage(&mut bytes, random);
    }
    bytes
}

/// Blocks in one byte order.
struct File {
    bytes: Vec<u8>,
    big_endian: bool,
}

fn file(random: &mut Random) -> Vec<u8> {
    let mut file = File { bytes: Vec::new(), big_endian: random.once_in(4) };
    for _ in 0..random.between(1, 2) {
        file.section(random);
    }
    file.bytes
}

impl File {
    fn section(&mut self, random: &mut Random) {
        let magic = self.u32(0x1A2B_3C4D);
        let version = [self.u16(1), self.u16(0)].concat();
        self.block(0x0A0D_0D0A, &[&magic[..], &version, &[0xFF; 8]].concat());
        for _ in 0..random.between(0, 2) {
            self.interface(random);
        }
        let mut time = random.number() >> 20;
        for _ in 0..random.length(40) {
            time = time.wrapping_add(random.below(1_000_000) as u64);
            match random.below(8) {
                0 => {
                    let length = random.length(100) & !3;
                    let body = random.bytes(length);
                    self.block(*random.one_of(&[3, 4, 5, 6, 10, 0x8000_0001]), &body);
                }
                _ => self.packet(time, random),
            }
        }
    }

    fn interface(&mut self, random: &mut Random) {
        let link_type = if random.once_in(20) { random.word() } else { 1 };
        let mut body = [self.u16(link_type), self.u16(0), vec![0; 4]].concat();
        if !random.once_in(3) {
            body.extend(self.option(9, &[*random.one_of(&[0, 3, 6, 9, 0x80, 0x8A, 0xFF, 20, 64])]));
            body.extend(vec![0; 4]);
        }
        self.block(1, &body);
    }

    fn packet(&mut self, time: u64, random: &mut Random) {
        let frame = frame(random);
        let interface = if random.once_in(20) { random.number() as u32 } else { 0 };
        let length = frame.len() as u32;
        let mut body = [
            self.u32(interface),
            self.u32((time >> 32) as u32),
            self.u32(time as u32),
            self.u32(length),
            self.u32(length),
        ]
        .concat();
        body.extend(&frame);
        body.resize(body.len().next_multiple_of(4), 0);
        if !random.once_in(3) {
            let flags = self.u32(random.below(4) as u32);
            body.extend(self.option(2, &flags));
            body.extend(vec![0; 4]);
        }
        self.block(6, &body);
    }

    fn block(&mut self, kind: u32, body: &[u8]) {
        let length = self.u32(body.len() as u32 + 12);
        let kind = self.u32(kind);
        self.bytes.extend([&kind[..], &length, body, &length].concat());
    }

    fn option(&self, code: u16, value: &[u8]) -> Vec<u8> {
        let mut option = [&self.u16(code)[..], &self.u16(value.len() as u16), value].concat();
        option.resize(option.len().next_multiple_of(4), 0);
        option
    }

    fn u16(&self, value: u16) -> Vec<u8> {
        if self.big_endian { value.to_be_bytes().to_vec() } else { value.to_le_bytes().to_vec() }
    }

    fn u32(&self, value: u32) -> Vec<u8> {
        if self.big_endian { value.to_be_bytes().to_vec() } else { value.to_le_bytes().to_vec() }
    }
}

/// A frame of a master, or its answer, or any bytes.
fn frame(random: &mut Random) -> Vec<u8> {
    if random.once_in(6) {
        let length = random.length(200);
        return random.bytes(length);
    }
    let mut builder = FrameBuilder::new();
    for _ in 0..random.between(1, 3) {
        let command = *random.one_of(&Command::ALL);
        let offset =
            *random.one_of(&[0x0010, 0x0120, 0x0130, 0x0502, 0x0600, 0x0800, 0x0910, 0x1000, 0x13A0]);
        let length = random.length(64);
        builder = builder.physical(command, random.below(3) as u16, offset, &random.bytes(length));
    }
    let mut frame = builder.finish();
    if random.once_in(2) {
        frame[6] |= 2;
    }
    frame
}
