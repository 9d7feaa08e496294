//! The steps of an input and their notation.
//!
//! ```text
//! line even terminal          the units: nx, even or terminal
//! bring 0 op                  a master takes unit 0 there: init, preop, safeop or op
//! cycle 5A                    every unit gets whole outputs of this byte, and its inputs are read
//! frame FPWR 1001 0120 0200; BRD 0000 0130 0000
//! raw FFFFFFFFFFFF…           a frame byte by byte
//! far BRD 0000 0130 0000      from the far end of the line
//! corrupt 1 BRD 0000 0130 00  with a bit error in front of unit 1
//! wait 1500                   microseconds
//! cable 1 out, cable 1 in     pulled and plugged
//! power 0 off, power 0 on
//! ```
//!
//! A datagram has a mnemonic or the code of its command, ADP, ADO, and data in hexadecimal digits, those of equal bytes as
//! `5Ax1200`; then `circulating` and `counter=FFFF`, if it is not 0.

use std::fmt;
use std::str::FromStr;

use wire::{AlState, Command, DatagramHeader, ETHERTYPE_ETHERCAT};

use crate::hex::{Hex, hex};

/// A step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Step {
    Line(Vec<Model>),
    Bring(usize, AlState),
    Cycle(u8),
    Frame(Vec<Datagram>),
    Raw(Vec<u8>),
    Far(Vec<Datagram>),
    Corrupt(usize, Vec<Datagram>),
    Wait(u64),
    Cable(usize, bool),
    Power(usize, bool),
}

/// The kind of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Model {
    /// An NX-ECT101.
    Nx,
    /// 64 bytes of outputs and of inputs, all of them equal, without mailbox.
    Even,
    /// A terminal of 16 inputs and 12 outputs, without processor.
    Terminal,
}

/// A datagram of a master.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Datagram {
    pub(super) command: Command,
    pub(super) address: u16,
    pub(super) offset: u16,
    pub(super) data: Vec<u8>,
    pub(super) circulating: bool,
    pub(super) counter: u16,
}

impl Datagram {
    /// One that no slave has changed.
    pub(super) const fn new(command: Command, address: u16, offset: u16, data: Vec<u8>) -> Self {
        Self { command, address, offset, data, circulating: false, counter: 0 }
    }

    /// One with a logical address.
    pub(super) const fn logical(command: Command, address: u32, data: Vec<u8>) -> Self {
        Self::new(command, address as u16, (address >> 16) as u16, data)
    }
}

/// The frame with these datagrams, of at least the minimum length of Ethernet.
pub(super) fn frame(datagrams: &[Datagram]) -> Vec<u8> {
    const LEAST_BYTES: usize = 60;
    let mut bytes = [&[0xFF; 6][..], &[0x10; 6], &ETHERTYPE_ETHERCAT.to_be_bytes(), &[0; 2]].concat();
    for (place, datagram) in datagrams.iter().enumerate() {
        let header = DatagramHeader {
            command: datagram.command,
            index: place as u8,
            address: datagram.address,
            offset: datagram.offset,
            length_bytes: (datagram.data.len() & 0x07FF) as u16,
            reserved: 0,
            circulating: datagram.circulating,
            more_follow: place + 1 < datagrams.len(),
            events: 0,
        };
        bytes.extend(header.pack());
        bytes.extend(&datagram.data);
        bytes.extend(datagram.counter.to_le_bytes());
    }
    let header = ((bytes.len() - 16) & 0x07FF) as u16 | 1 << 12;
    bytes[14..16].copy_from_slice(&header.to_le_bytes());
    bytes.resize(bytes.len().max(LEAST_BYTES), 0);
    bytes
}

const MODELS: [(&str, Model); 3] = [("nx", Model::Nx), ("even", Model::Even), ("terminal", Model::Terminal)];
const STATES: [(&str, AlState); 4] =
    [("init", AlState::Init), ("preop", AlState::PreOp), ("safeop", AlState::SafeOp), ("op", AlState::Op)];

impl fmt::Display for Step {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let either = |first, word, other| if first { word } else { other };
        match self {
            Self::Line(models) => {
                formatter.write_str("line")?;
                models.iter().try_for_each(|model| {
                    let name = MODELS.iter().find(|(_, known)| known == model).map_or("", |(name, _)| name);
                    write!(formatter, " {name}")
                })
            }
            Self::Bring(unit, state) => {
                let name = STATES.iter().find(|(_, known)| known == state).map_or("init", |(name, _)| name);
                write!(formatter, "bring {unit} {name}")
            }
            Self::Cycle(byte) => write!(formatter, "cycle {byte:02X}"),
            Self::Frame(datagrams) => write!(formatter, "frame {}", Chain(datagrams)),
            Self::Raw(bytes) => write!(formatter, "raw {}", Hex(bytes)),
            Self::Far(datagrams) => write!(formatter, "far {}", Chain(datagrams)),
            Self::Corrupt(unit, datagrams) => write!(formatter, "corrupt {unit} {}", Chain(datagrams)),
            Self::Wait(micros) => write!(formatter, "wait {micros}"),
            Self::Cable(cable, plugged) => {
                write!(formatter, "cable {cable} {}", either(*plugged, "in", "out"))
            }
            Self::Power(unit, on) => write!(formatter, "power {unit} {}", either(*on, "on", "off")),
        }
    }
}

/// Datagrams with semicolons between them.
struct Chain<'a>(&'a [Datagram]);

impl fmt::Display for Chain<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, datagram) in self.0.iter().enumerate() {
            let Datagram { command, address, offset, data, circulating, counter } = datagram;
            formatter.write_str(if place > 0 { "; " } else { "" })?;
            match command {
                Command::Other(code) => write!(formatter, "{code:02X}")?,
                command => write!(formatter, "{}", format!("{command:?}").to_uppercase())?,
            }
            write!(formatter, " {address:04X} {offset:04X}")?;
            if !data.is_empty() {
                write!(formatter, " {}", Hex(data))?;
            }
            if *circulating {
                formatter.write_str(" circulating")?;
            }
            if *counter != 0 {
                write!(formatter, " counter={counter:04X}")?;
            }
        }
        Ok(())
    }
}

/// A line that is not a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NoStep;

impl FromStr for Step {
    type Err = NoStep;

    fn from_str(line: &str) -> Result<Self, NoStep> {
        read(line.trim()).ok_or(NoStep)
    }
}

fn read(line: &str) -> Option<Step> {
    let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
    let (first, second) = rest.split_once(' ').unwrap_or((rest, ""));
    Some(match word {
        "line" => {
            let model = |word| MODELS.iter().find(|(name, _)| *name == word).map(|(_, model)| *model);
            let models = rest.split(' ').map(model);
            Step::Line(models.collect::<Option<Vec<_>>>()?)
        }
        "bring" => Step::Bring(first.parse().ok()?, STATES.iter().find(|(name, _)| *name == second)?.1),
        "cycle" => Step::Cycle(u8::from_str_radix(first, 16).ok()?),
        "frame" => Step::Frame(chain(rest)?),
        "raw" => Step::Raw(hex(rest)?),
        "far" => Step::Far(chain(rest)?),
        "corrupt" => Step::Corrupt(first.parse().ok()?, chain(second)?),
        "wait" => Step::Wait(first.parse().ok()?),
        "cable" => Step::Cable(first.parse().ok()?, either(second, "in", "out")?),
        "power" => Step::Power(first.parse().ok()?, either(second, "on", "off")?),
        _ => return None,
    })
}

fn either(word: &str, yes: &str, no: &str) -> Option<bool> {
    (word == yes).then_some(true).or((word == no).then_some(false))
}

fn chain(text: &str) -> Option<Vec<Datagram>> {
    text.split(';').map(|part| datagram(part.trim())).collect()
}

fn datagram(text: &str) -> Option<Datagram> {
    let mut words = text.split(' ').peekable();
    let command = command(words.next()?)?;
    let mut word = || u16::from_str_radix(words.next()?, 16).ok();
    let (address, offset) = (word()?, word()?);
    let mut datagram = Datagram::new(command, address, offset, Vec::new());
    for word in words {
        if word == "circulating" {
            datagram.circulating = true;
        } else if let Some(counter) = word.strip_prefix("counter=") {
            datagram.counter = u16::from_str_radix(counter, 16).ok()?;
        } else {
            datagram.data = hex(word)?;
        }
    }
    Some(datagram)
}

fn command(word: &str) -> Option<Command> {
    let named = Command::ALL.into_iter().find(|command| format!("{command:?}").to_uppercase() == word);
    named.or_else(|| u8::from_str_radix(word, 16).ok().map(Command::from_code))
}
