//! The bench: one unit, its CPU Unit, and a master of frames.

use device::{Network, Unit};
use nx_ect101::{IoAllocation, NxEct101, UnitSettings, device_config, layout};
use plc::{CpuSettings, CpuUnit, DeviceVariables, Echo, Program};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned, returned_datagrams};

pub(crate) const PRE_OP: u8 = 0x02;
pub(crate) const SAFE_OP: u8 = 0x04;
pub(crate) const OP: u8 = 0x08;

/// A master that sends a frame every 100 µs, and the line that it is connected to.
pub(crate) struct Bench {
    pub(crate) network: Network<NxEct101>,
    pub(crate) cpu: CpuUnit,
    pub(crate) now: Instant,
    counter: u8,
}

impl Bench {
    pub(crate) fn power_on(io_allocation: IoAllocation) -> Self {
        Self::with_program(io_allocation, CpuSettings::default(), Echo)
    }

    pub(crate) fn with_program(
        io_allocation: IoAllocation,
        cpu: CpuSettings,
        program: impl Program + Send + 'static,
    ) -> Self {
        let variables = DeviceVariables::of(nx_ect101::variable_table("N1", 1, &io_allocation));
        let settings = UnitSettings { io_allocation, ..UnitSettings::default() };
        let (unit, cpu_end) = NxEct101::power_on(&settings);
        let now = Instant::ZERO;
        Self {
            network: Network::power_on([(device_config(&settings), unit)], now),
            cpu: CpuUnit::power_on(now, cpu, variables, cpu_end, Box::new(program)),
            now,
            counter: 0,
        }
    }

    pub(crate) fn run_for(&mut self, duration: Duration) {
        self.run_to(self.now + duration);
    }

    pub(crate) fn run_to(&mut self, end: Instant) {
        loop {
            let next = self.network.deadline().min(self.cpu.deadline());
            if next > end {
                self.now = end;
                return;
            }
            self.now = next;
            if self.cpu.deadline() <= next {
                self.cpu.cycle(next);
            }
            self.network.poll(next);
        }
    }

    /// T_slave of the unit.
    pub(crate) fn refresh_period(&self) -> Duration {
        self.network.device(0).expect("a unit").unit().refresh_period().expect("a period")
    }

    fn send(&mut self, command: Command, offset: u16, data: &[u8]) -> Returned {
        self.run_for(Duration::from_micros(100));
        let mut frame = FrameBuilder::new().physical(command, 0, offset, data).finish();
        self.pass(&mut frame).remove(0)
    }

    /// Sends a frame at this time.
    pub(crate) fn pass(&mut self, frame: &mut [u8]) -> Vec<Returned> {
        self.network.frame(self.now, frame);
        self.network.poll(self.now);
        returned_datagrams(frame)
    }

    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) {
        assert_eq!(self.send(Command::Apwr, offset, data).working_counter, 1, "write to {offset:#06X}");
    }

    pub(crate) fn read(&mut self, offset: u16, length_bytes: usize) -> Vec<u8> {
        self.send(Command::Aprd, offset, &vec![0; length_bytes]).data
    }

    fn set_sync_manager(&mut self, number: u16, start: u16, length_bytes: u16, control: u8) {
        let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
        self.write(0x0800 + 8 * number, &[s0, s1, l0, l1, control, 0, 1, 0]);
    }

    /// Requests a state; returns AL status and AL status code after it.
    pub(crate) fn request(&mut self, state: u8) -> (u8, u16) {
        self.write(0x0120, &[state, 0]);
        let status = self.read(0x0130, 6);
        (status[0], u16::from_le_bytes([status[4], status[5]]))
    }

    pub(crate) fn into_pre_op(mut self) -> Self {
        let length_bytes = layout::MAILBOX_BYTES;
        self.set_sync_manager(
            0,
            layout::MAILBOX_RECEIVE_START,
            length_bytes,
            layout::MAILBOX_RECEIVE_CONTROL,
        );
        self.set_sync_manager(1, layout::MAILBOX_SEND_START, length_bytes, layout::MAILBOX_SEND_CONTROL);
        assert_eq!(self.request(PRE_OP), (PRE_OP, 0));
        self
    }

    pub(crate) fn set_process_data(&mut self, outputs_bytes: u16, inputs_bytes: u16) {
        self.set_sync_manager(2, layout::OUTPUTS_START, outputs_bytes, layout::OUTPUTS_CONTROL);
        self.set_sync_manager(3, layout::INPUTS_START, inputs_bytes, layout::INPUTS_CONTROL);
    }

    pub(crate) fn into_op(mut self, outputs_bytes: u16, inputs_bytes: u16) -> Self {
        self.set_process_data(outputs_bytes, inputs_bytes);
        assert_eq!(self.request(SAFE_OP), (SAFE_OP, 0));
        // OP waits for outputs.
        self.write(layout::OUTPUTS_START, &vec![0; usize::from(outputs_bytes)]);
        assert_eq!(self.request(OP), (OP, 0));
        self
    }

    /// An SDO download by complete access; returns the time until the response.
    pub(crate) fn download_complete(&mut self, index: u16, value: &[u8]) -> Duration {
        let sent = self.now;
        let length_bytes = (value.len() as u32).to_le_bytes();
        let response = self.sdo(0x31, index, 0, &[&length_bytes, value].concat());
        assert_eq!(response[8] & 0xE0, 0x60, "download response to {index:#06X}: {:02X?}", &response[8..16]);
        self.now.saturating_since(sent)
    }

    /// An SDO download of a value longer than 4 bytes.
    pub(crate) fn download(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), u32> {
        let length_bytes = (value.len() as u32).to_le_bytes();
        let response = self.sdo(0x21, index, sub, &[&length_bytes, value].concat());
        refusal(&response).map_or(Ok(()), Err)
    }

    /// An SDO upload of a value longer than 4 bytes.
    pub(crate) fn upload(&mut self, index: u16, sub: u8) -> Result<Vec<u8>, u32> {
        let response = self.sdo(0x40, index, sub, &[0; 4]);
        if let Some(code) = refusal(&response) {
            return Err(code);
        }
        let length_bytes = u32::from_le_bytes(response[12..16].try_into().expect("4 bytes"));
        Ok(response[16..16 + length_bytes as usize].to_vec())
    }

    /// One SDO request and the mailbox with its response.
    fn sdo(&mut self, command: u8, index: u16, sub: u8, data: &[u8]) -> Vec<u8> {
        let request = self.sdo_request(command, index, sub, data);
        self.write(layout::MAILBOX_RECEIVE_START, &request);
        let sent = self.now;
        while self.read(0x080D, 1)[0] & 0x08 == 0 {
            assert!(self.now.saturating_since(sent) < Duration::from_millis(100), "no response");
        }
        self.read(layout::MAILBOX_SEND_START, usize::from(layout::MAILBOX_BYTES))
    }

    /// The mailbox with an SDO request.
    pub(crate) fn sdo_request(&mut self, command: u8, index: u16, sub: u8, data: &[u8]) -> Vec<u8> {
        self.counter = self.counter % 7 + 1;
        let ([l0, l1], [i0, i1]) = ((6 + data.len() as u16).to_le_bytes(), index.to_le_bytes());
        let mut message = vec![l0, l1, 0, 0, 0, self.counter << 4 | 3, 0, 0x20, command, i0, i1, sub];
        message.extend(data);
        message.resize(usize::from(layout::MAILBOX_BYTES), 0);
        message
    }

    /// Sends outputs for long enough that they return; returns the inputs after that.
    pub(crate) fn exchange(&mut self, outputs: &[u8], inputs_bytes: usize) -> Vec<u8> {
        for _ in 0..100 {
            self.write(layout::OUTPUTS_START, outputs);
        }
        self.read(layout::INPUTS_START, inputs_bytes)
    }
}

/// The abort code of a response.
fn refusal(response: &[u8]) -> Option<u32> {
    let code = u32::from_le_bytes(response[12..16].try_into().expect("4 bytes"));
    (response[8] == 0x80).then_some(code)
}

/// The same numbers in every run (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (mixed ^ mixed >> 31) % limit
    }

    /// A time between two limits in µs, to the nanosecond.
    pub(crate) fn time(&mut self, from_us: u64, to_us: u64) -> Duration {
        Duration::from_nanos(from_us * 1000 + self.below((to_us - from_us) * 1000))
    }
}
