//! A line of terminals, and the operations of a master that uses only their SII.

use device::{Network, SmIndex, Unit};
use digital::{BitImages, Channels, Terminal, TerminalSettings, device_config};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned, returned_datagrams};

pub(crate) fn channels(count: u8) -> Channels {
    Channels::new(count).expect("0 to 64 channels")
}

pub(crate) fn terminal(outputs: u8, inputs: u8) -> TerminalSettings {
    TerminalSettings { outputs: channels(outputs), inputs: channels(inputs), ..TerminalSettings::default() }
}

pub(crate) struct Bench<U> {
    pub(crate) network: Network<U>,
    pub(crate) now: Instant,
    stations: u16,
}

impl Bench<Terminal<BitImages>> {
    pub(crate) fn of(settings: &[TerminalSettings]) -> Self {
        let powered = settings
            .iter()
            .map(|settings| (device_config(settings), Terminal::power_on(settings, BitImages::default())));
        Self::around(Network::power_on(powered, Instant::ZERO))
    }

    /// One terminal that a master has taken to OP; its outputs are at logical address 0, its inputs follow.
    pub(crate) fn in_op(settings: &TerminalSettings) -> Self {
        let mut bench = Self::of(core::slice::from_ref(settings));
        bench.set_up(0, 0);
        for state in [2, 4, 8] {
            bench.request(0, state);
            assert_eq!(bench.status(0), (state, 0));
        }
        bench
    }

    pub(crate) fn wiring(&mut self, position: usize) -> &mut BitImages {
        self.network.device_mut(position).expect("a terminal").unit_mut().wiring_mut()
    }
}

impl<U: Unit> Bench<U> {
    pub(crate) fn around(network: Network<U>) -> Self {
        let stations = u16::try_from(network.len()).expect("a short line");
        let mut bench = Self { network, now: Instant::ZERO, stations };
        for position in 0..stations {
            let address = (0x1000 + position).to_le_bytes();
            let frame =
                FrameBuilder::new().physical(Command::Apwr, position.wrapping_neg(), 0x0010, &address);
            assert_eq!(bench.exchange(frame).working_counter, 1);
        }
        bench
    }

    pub(crate) fn exchange(&mut self, frame: FrameBuilder) -> Returned {
        let mut frame = frame.finish();
        self.network.frame(self.now, &mut frame);
        self.network.poll(self.now);
        returned_datagrams(&frame).remove(0)
    }

    pub(crate) fn write(&mut self, position: u16, offset: u16, data: &[u8]) -> u16 {
        let frame = FrameBuilder::new().physical(Command::Fpwr, 0x1000 + position, offset, data);
        self.exchange(frame).working_counter
    }

    pub(crate) fn read(&mut self, position: u16, offset: u16, length_bytes: usize) -> Vec<u8> {
        let frame =
            FrameBuilder::new().physical(Command::Fprd, 0x1000 + position, offset, &vec![0; length_bytes]);
        let returned = self.exchange(frame);
        assert_eq!(returned.working_counter, 1, "{offset:#06X}");
        returned.data
    }

    pub(crate) fn word(&mut self, position: u16, offset: u16) -> u16 {
        let bytes = self.read(position, offset, 2);
        u16::from_le_bytes([bytes[0], bytes[1]])
    }

    /// AL status and AL status code.
    pub(crate) fn status(&mut self, position: u16) -> (u16, u16) {
        (self.word(position, 0x0130), self.word(position, 0x0134))
    }

    pub(crate) fn request(&mut self, position: u16, al_control: u16) {
        self.write(position, 0x0120, &al_control.to_le_bytes());
    }

    pub(crate) fn request_all(&mut self, al_control: u16) {
        (0..self.stations).for_each(|position| self.request(position, al_control));
    }

    /// One LRW from logical address 0.
    pub(crate) fn cycle(&mut self, data: &[u8]) -> (Vec<u8>, u16) {
        let returned = self.exchange(FrameBuilder::new().logical(Command::Lrw, 0, data));
        (returned.data, returned.working_counter)
    }

    /// The SII as the master reads it, four bytes at a time.
    pub(crate) fn sii(&mut self, position: u16) -> Vec<u8> {
        let mut image: Vec<u8> = Vec::new();
        while image.len() < 4_096 {
            let address = u32::try_from(image.len() / 2).expect("a small EEPROM");
            let [a, b, c, d] = address.to_le_bytes();
            self.write(position, 0x0502, &[0x00, 0x01, a, b, c, d]);
            image.extend(self.read(position, 0x0508, 4));
        }
        image
    }

    /// Sets SyncManagers and FMMUs from the SII, with the bits of the terminal from `first_bit` of the logical
    /// addresses on. Returns the bit after them.
    pub(crate) fn set_up(&mut self, position: u16, first_bit: u32) -> u32 {
        let image = self.sii(position);
        let contents = esi::sii::parse(&image).expect("a readable SII");
        let mut at_bit = first_bit;
        for (index, sync_manager) in (0u8..).map(SmIndex).zip(&contents.sync_managers) {
            let [start, length] = [sync_manager.start, sync_manager.length_bytes].map(u16::to_le_bytes);
            let settings =
                [start[0], start[1], length[0], length[1], sync_manager.control, 0, sync_manager.enable, 0];
            assert_eq!(self.write(position, 0x0800 + 8 * u16::from(index.0), &settings), 1);
            let pdos = contents.rx_pdos.iter().chain(&contents.tx_pdos);
            let of_this = pdos.filter(|pdo| pdo.sync_manager == Some(index.0));
            let entries = of_this.flat_map(|pdo| &pdo.entries);
            let bits = entries.map(|entry| u32::from(entry.bit_length)).sum::<u32>();
            let writes = sync_manager.usage == esi::SyncManagerType::Outputs;
            self.set_fmmu(position, u16::from(index.0), at_bit, bits, sync_manager.start, writes);
            at_bit += bits;
        }
        at_bit
    }

    fn set_fmmu(&mut self, position: u16, n: u16, at_bit: u32, bits: u32, start: u16, writes: bool) {
        let last_bit = at_bit + bits - 1;
        let length_bytes = last_bit / 8 - at_bit / 8 + 1;
        let mut fmmu = [0; 16];
        fmmu[..4].copy_from_slice(&(at_bit / 8).to_le_bytes());
        fmmu[4] = u8::try_from(length_bytes).expect("at most 9 bytes");
        fmmu[6] = (at_bit % 8) as u8;
        fmmu[7] = (last_bit % 8) as u8;
        fmmu[8..10].copy_from_slice(&start.to_le_bytes());
        fmmu[11] = if writes { 2 } else { 1 };
        fmmu[12] = 1;
        assert_eq!(self.write(position, 0x0600 + 16 * n, &fmmu), 1);
    }

    /// Advances the time, with a poll at every deadline.
    pub(crate) fn run_for(&mut self, duration: Duration) {
        let end = self.now + duration;
        while self.network.deadline() <= end {
            self.now = self.network.deadline().max(self.now);
            self.network.poll(self.now);
        }
        self.now = end;
    }
}
