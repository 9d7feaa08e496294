//! A line with one digital unit: 8 inputs, 8 outputs, no mailbox. It proves that `device` and the crates below
//! it are independent of the NX unit, and it is small enough to test every state.

use device::{
    Action, Buffers, Check, DataDirection, DataLength, DeviceConfig, Exchange, Network, ProcessDataConfig,
    SmIndex, Start, Unit,
};
use std::collections::VecDeque;

use time::{Duration, Instant};
use wire::{AlState, AlStatusCode, Command, FrameBuilder, Returned, returned_datagrams};

pub(crate) const OUTPUTS_START: u16 = 0x1000;
pub(crate) const INPUTS_START: u16 = 0x1100;

/// Eight inputs that the test sets, eight outputs that it checks.
#[derive(Debug, Default)]
pub(crate) struct Digital8 {
    pub(crate) inputs: u8,
    pub(crate) outputs: Option<u8>,
    pub(crate) without_outputs: bool,
    pub(crate) without_inputs: bool,
    pub(crate) states: Vec<AlState>,
    /// Its pending actions for the stack, in order.
    pub(crate) actions: VecDeque<Action>,
    /// The code for the master after each kind of restart.
    pub(crate) restarted: Option<Start>,
    /// The codes that the stack has reported.
    pub(crate) told: Vec<AlStatusCode>,
}

impl Unit for Digital8 {
    fn mapped_bytes(&self, sync_manager: SmIndex) -> u16 {
        let is_left_out =
            if sync_manager == SmIndex::OUTPUTS { self.without_outputs } else { self.without_inputs };
        u16::from(!is_left_out)
    }

    fn entered(&mut self, _now: Instant, state: AlState) {
        self.states.push(state);
    }

    fn check_transition(
        &mut self,
        _now: Instant,
        _check: Check,
        found: &[AlStatusCode],
    ) -> Result<(), AlStatusCode> {
        self.told.extend(found);
        found.first().map_or(Ok(()), |&code| Err(code))
    }

    fn al_error(&mut self, _now: Instant, code: AlStatusCode) -> AlStatusCode {
        self.told.push(code);
        code
    }

    fn take_action(&mut self) -> Option<Action> {
        self.actions.pop_front()
    }

    fn restart(&mut self, _now: Instant, start: Start, _sii_image: &mut [u8]) -> Option<AlStatusCode> {
        self.restarted = Some(start);
        (start == Start::Restart).then_some(AlStatusCode(0x0060))
    }

    fn refresh_period(&self) -> Option<Duration> {
        Some(Duration::from_millis(1))
    }

    fn refresh(&mut self, _now: Instant, exchange: Exchange<'_>) {
        self.outputs = exchange.outputs.and_then(|outputs| outputs.first().copied());
        exchange.inputs.fill(self.inputs);
    }

    fn explicit_device_id(&self) -> Option<u16> {
        Some(5)
    }
}

/// A minimal EEPROM: the header with its checksum.
pub(crate) fn sii_image() -> Vec<u8> {
    let mut image = vec![0; 128];
    image[14] = wire::sii_checksum(&[0; 14]);
    image
}

pub(crate) fn config() -> DeviceConfig {
    let length = DataLength::Mapped { max_bytes: 1 };
    DeviceConfig {
        sii_image: sii_image(),
        process_data: [
            process_data(2, DataDirection::Outputs, OUTPUTS_START, length),
            process_data(3, DataDirection::Inputs, INPUTS_START, length),
        ]
        .into_iter()
        .collect(),
        ..DeviceConfig::default()
    }
}

/// A SyncManager with process data and three buffers.
pub(crate) fn process_data(
    sync_manager: u8,
    direction: DataDirection,
    start: u16,
    length: DataLength,
) -> ProcessDataConfig {
    let sync_manager = SmIndex(sync_manager);
    ProcessDataConfig { sync_manager, direction, start, length, buffers: Buffers::Three }
}

pub(crate) struct Bench<U = Digital8> {
    pub(crate) network: Network<U>,
    pub(crate) now: Instant,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self::with(config())
    }

    pub(crate) fn with(config: DeviceConfig) -> Self {
        Self::of([(config, Digital8::default())])
    }

    /// A bench whose unit has been brought to `state` like a master does it.
    pub(crate) fn in_state(state: AlState) -> Self {
        let mut bench = Self::new();
        bench.bring_to(state);
        bench
    }

    pub(crate) fn bring_to(&mut self, state: AlState) {
        for step in [AlState::PreOp, AlState::SafeOp, AlState::Op] {
            if state == AlState::Init {
                return;
            }
            if step == AlState::SafeOp {
                self.set_process_data();
            }
            self.request(step.bits());
            assert_eq!(self.status(), (step.bits(), 0));
            if step == state {
                return;
            }
        }
    }

    pub(crate) fn set_process_data(&mut self) {
        self.write(0x0810, &[0x00, 0x10, 1, 0, 0x64, 0, 1, 0]);
        self.write(0x0818, &[0x00, 0x11, 1, 0, 0x20, 0, 1, 0]);
        self.write(0x0600, &[0, 0, 0, 0, 1, 0, 0, 7, 0x00, 0x10, 0, 2, 1, 0, 0, 0]);
        self.write(0x0610, &[0, 0, 0, 0, 1, 0, 0, 7, 0x00, 0x11, 0, 1, 1, 0, 0, 0]);
    }

    /// One LRW of one byte: the returned data, and the working counter.
    pub(crate) fn cycle(&mut self, outputs: u8) -> (u8, u16) {
        let returned = self.exchange(FrameBuilder::new().logical(Command::Lrw, 0, &[outputs]));
        (returned.data[0], returned.working_counter)
    }
}

impl<U: Unit> Bench<U> {
    pub(crate) fn of(line: impl IntoIterator<Item = (DeviceConfig, U)>) -> Self {
        let now = Instant::ZERO;
        Self { network: Network::power_on(line, now), now }
    }

    pub(crate) fn unit(&mut self) -> &mut U {
        let Some(device) = self.network.device_mut(0) else { panic!("there is a unit") };
        device.unit_mut()
    }

    pub(crate) fn exchange(&mut self, frame: FrameBuilder) -> Returned {
        let mut frame = frame.finish();
        self.network.frame(self.now, &mut frame);
        self.network.poll(self.now);
        returned_datagrams(&frame).remove(0)
    }

    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) -> u16 {
        self.exchange(FrameBuilder::new().physical(Command::Bwr, 0, offset, data)).working_counter
    }

    pub(crate) fn read(&mut self, offset: u16, length_bytes: usize) -> Vec<u8> {
        let data = vec![0; length_bytes];
        self.exchange(FrameBuilder::new().physical(Command::Brd, 0, offset, &data)).data
    }

    pub(crate) fn word(&mut self, offset: u16) -> u16 {
        let bytes = self.read(offset, 2);
        u16::from_le_bytes([bytes[0], bytes[1]])
    }

    /// Writes AL control.
    pub(crate) fn request(&mut self, al_control: u16) {
        self.write(0x0120, &al_control.to_le_bytes());
    }

    /// AL status and AL status code.
    pub(crate) fn status(&mut self) -> (u16, u16) {
        (self.word(0x0130), self.word(0x0134))
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
