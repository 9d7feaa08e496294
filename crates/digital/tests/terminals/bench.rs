//! A line of terminals, and single accesses of a master that uses only their SII.

use device::{Network, Unit};
use digital::{BitImages, Channels, Terminal, TerminalSettings, device_config};
use master::{Address, DirectAccess, FmmuSettings, Line, SlaveSettings};
use segment::FrameFate;
use time::Instant;
use wire::{Command, FrameBuilder};

pub(crate) fn channels(count: u8) -> Channels {
    Channels::new(count).expect("0 to 64 channels")
}

pub(crate) fn terminal(outputs: u8, inputs: u8) -> TerminalSettings {
    TerminalSettings { outputs: channels(outputs), inputs: channels(inputs), ..TerminalSettings::default() }
}

pub(crate) struct Terminals<U> {
    pub(crate) network: Network<U>,
}

impl<U: Unit> Line for Terminals<U> {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.network.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.network.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.network.deadline()
    }
}

pub(crate) struct Bench<U> {
    pub(crate) access: DirectAccess<Terminals<U>>,
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
        self.access.line.network.device_mut(position).expect("a terminal").unit_mut().wiring_mut()
    }
}

impl<U: Unit> Bench<U> {
    pub(crate) fn around(network: Network<U>) -> Self {
        Self { access: DirectAccess::new(Terminals { network }, Instant::ZERO) }
    }

    pub(crate) fn write(&mut self, position: u16, offset: u16, data: &[u8]) -> u16 {
        self.access.write(Address::Position(position), offset, data)
    }

    pub(crate) fn read(&mut self, position: u16, offset: u16, length_bytes: u16) -> Vec<u8> {
        let (data, working_counter) = self.access.read(Address::Position(position), offset, length_bytes);
        assert_eq!(working_counter, 1, "{offset:#06X}");
        data
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
        self.access.write(Address::All, 0x0120, &al_control.to_le_bytes());
    }

    /// One LRW from logical address 0.
    pub(crate) fn cycle(&mut self, data: &[u8]) -> (Vec<u8>, u16) {
        let mut frame = FrameBuilder::new().logical(Command::Lrw, 0, data).finish();
        let returned = self.access.pass(&mut frame).remove(0);
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
        let contents = esi::sii::parse(&self.sii(position)).expect("a readable SII");
        let mut at_bit = first_bit;
        for area in SlaveSettings::from_sii(&contents).process_data {
            let sync_manager = area.sync_manager;
            let registers = 0x0800 + 8 * u16::from(sync_manager.number);
            assert_eq!(self.write(position, registers, &sync_manager.pack()), 1);
            let last_bit = at_bit + area.bits - 1;
            let fmmu = FmmuSettings {
                number: area.fmmu,
                logical_start: at_bit / 8,
                length_bytes: u16::try_from(last_bit / 8 - at_bit / 8 + 1).expect("at most 9 bytes"),
                logical_start_bit: (at_bit % 8) as u8,
                logical_stop_bit: (last_bit % 8) as u8,
                physical_start: sync_manager.start,
                physical_start_bit: 0,
                kind: area.direction.fmmu_kind(),
                activate: 1,
            };
            assert_eq!(self.write(position, 0x0600 + 16 * u16::from(fmmu.number), &fmmu.pack()), 1);
            at_bit = last_bit + 1;
        }
        at_bit
    }
}
