//! The command with its log, and masters that send one datagram in a frame.

use std::fs::File;
use std::net::{SocketAddr, UdpSocket};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration as WallDuration;

use ectwin::Duration;
use ectwin::link::{FRAME_BUFFER_BYTES, FramePort};
use testbed::Process;

pub(crate) const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");
pub(crate) const APRD: u8 = 1;
pub(crate) const BRD: u8 = 7;
pub(crate) const LRW: u8 = 12;
/// Number of times that a master sends again, like real ones do.
const TRIES: usize = 10_000;

/// `ectwin -v run`, and its output.
pub(crate) struct Twin {
    process: Process,
    pub(crate) ready: String,
    log: PathBuf,
}

impl Twin {
    /// Starts the command with one unit; `name` is that of its log.
    pub(crate) fn start(name: &str, arguments: &[&str]) -> Self {
        let arguments: Vec<&str> = [UNIT].iter().chain(arguments).copied().collect();
        Self::start_units(name, &arguments)
    }

    pub(crate) fn start_units(name: &str, arguments: &[&str]) -> Self {
        let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.log"));
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.args(["-v", "run"]).args(arguments).env_remove("RUST_LOG");
        let mut process = Process::start(command.stderr(File::create(&log).unwrap()));
        let ready = process.wait_for_line("ready ").to_owned();
        Self { process, ready, log }
    }

    pub(crate) fn id(&self) -> u32 {
        self.process.id()
    }

    /// A field of the line `ready`.
    pub(crate) fn field(&self, name: &str) -> String {
        let field = self.ready.split(' ').find_map(|field| field.strip_prefix(name)?.strip_prefix('='));
        field.unwrap_or_else(|| panic!("`{}` has no {name}", self.ready)).to_owned()
    }

    /// The address of its UDP link.
    pub(crate) fn udp(&self) -> SocketAddr {
        self.field("link").strip_prefix("udp:").unwrap().parse().unwrap()
    }

    /// Waits until its log has these words, without a time limit.
    pub(crate) fn wait_for(&self, words: &str) {
        let has_words = |_| std::fs::read_to_string(&self.log).unwrap().contains(words);
        assert!((0..1_000_000).any(has_words), "`{words}` does not come");
    }

    /// Sends it a signal.
    pub(crate) fn signal(&self, name: &str) {
        let kill = format!("kill -{name} {}", self.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success(), "{kill}");
    }

    /// Ends it like a user does. Returns its log.
    pub(crate) fn end(mut self) -> String {
        self.process.interrupt();
        assert!(self.process.wait().success());
        std::fs::read_to_string(&self.log).unwrap()
    }
}

/// Number of occurrences of `words` in a log.
pub(crate) fn count(log: &str, words: &str) -> usize {
    log.matches(words).count()
}

/// The datagrams of an EtherCAT frame after its Ethernet header: one, with this address field.
pub(crate) fn datagram(command: u8, index: u8, address: [u8; 4], data: &[u8]) -> Vec<u8> {
    let mut bytes = (0x1000 | (12 + data.len()) as u16).to_le_bytes().to_vec();
    bytes.extend([command, index]);
    bytes.extend(address);
    bytes.extend((data.len() as u16).to_le_bytes());
    bytes.extend([0, 0]);
    bytes.extend(data);
    bytes.extend([0, 0]);
    bytes
}

/// The same in an Ethernet frame.
pub(crate) fn frame(command: u8, index: u8, address: [u8; 4], data: &[u8]) -> Vec<u8> {
    let mut frame = vec![0xFF; 6];
    frame.extend([0x10, 0, 0, 0, 0, 1, 0x88, 0xA4]);
    frame.extend(datagram(command, index, address, data));
    frame
}

/// A master at the other end of a cable.
pub(crate) struct Master {
    port: Box<dyn FramePort>,
    index: u8,
}

impl Master {
    pub(crate) fn at(interface: &str) -> Self {
        let port = ectwin::link::open(&format!("raw:{interface}").parse().unwrap()).unwrap();
        Self { port, index: 0 }
    }

    /// Sends a frame. Returns whether the interface accepted it.
    pub(crate) fn send(&mut self, frame: &[u8]) -> bool {
        self.port.send(frame).is_ok()
    }

    pub(crate) fn receive(&mut self, wait: Duration) -> Option<Vec<u8>> {
        let mut buffer = vec![0; FRAME_BUFFER_BYTES];
        let length = self.port.receive(&mut buffer, wait).unwrap()?;
        buffer.truncate(length);
        Some(buffer)
    }

    /// Reads a register of the first unit, repeatedly until it answers.
    pub(crate) fn read<const N: usize>(&mut self, offset: u16) -> [u8; N] {
        let [low, high] = offset.to_le_bytes();
        for _ in 0..TRIES {
            self.index = self.index.wrapping_add(1);
            self.send(&frame(APRD, self.index, [0, 0, low, high], &[0; N]));
            while let Some(answer) = self.receive(Duration::from_millis(5)) {
                if answer.get(17) == Some(&self.index) && answer[26 + N] == 1 {
                    return *answer[26..].first_chunk().unwrap();
                }
            }
        }
        panic!("no unit answers");
    }
}

/// Number of units that answer a master at this socket.
pub(crate) fn count_units(master: &UdpSocket, unit: SocketAddr) -> u8 {
    master.set_read_timeout(Some(WallDuration::from_secs(10))).unwrap();
    master.send_to(&datagram(BRD, 0, [0; 4], &[0, 0]), unit).unwrap();
    let mut answer = [0; FRAME_BUFFER_BYTES];
    let (length, sender) = master.recv_from(&mut answer).unwrap();
    assert_eq!((length, sender), (16, unit));
    answer[14]
}
