//! The bench: one unit, its CPU Unit, and single accesses of a master.

use device::{Network, Start, Unit};
use master::{
    Address, DirectAccess, Line, MailboxConduct, MailboxDialogue, SdoTransfer, Service, ServiceFailure,
    SyncManagerSettings,
};
use nx_ect101::{IoAllocation, NxEct101, UnitSettings, device_config, layout};
use plc::{CpuSettings, CpuUnit, DeviceVariables, Echo, Program};
use segment::FrameFate;
use time::{Duration, Instant};
use wire::SdoTarget;

pub(crate) const PRE_OP: u8 = 0x02;
pub(crate) const SAFE_OP: u8 = 0x04;
pub(crate) const OP: u8 = 0x08;

const UNIT: Address = Address::Position(0);
const MAILBOX_OUT: SyncManagerSettings =
    channel(0, layout::MAILBOX_RECEIVE_START, layout::MAILBOX_BYTES, layout::MAILBOX_RECEIVE_CONTROL);
const MAILBOX_IN: SyncManagerSettings =
    channel(1, layout::MAILBOX_SEND_START, layout::MAILBOX_BYTES, layout::MAILBOX_SEND_CONTROL);

const fn channel(number: u8, start: u16, length_bytes: u16, control: u8) -> SyncManagerSettings {
    SyncManagerSettings { number, start, length_bytes, control, activate: 1 }
}

/// The unit and its CPU Unit.
pub(crate) struct Rack {
    pub(crate) network: Network<NxEct101>,
    pub(crate) cpu: CpuUnit,
}

impl Line for Rack {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.network.frame(now, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        if self.cpu.deadline() <= now {
            self.cpu.cycle(now);
        }
        self.network.poll(now);
    }

    fn deadline(&self) -> Instant {
        self.network.deadline().min(self.cpu.deadline())
    }
}

/// A master that sends a frame every 100 µs, and the rack that it is connected to.
pub(crate) struct Bench {
    pub(crate) access: DirectAccess<Rack>,
    mailbox: MailboxConduct,
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
        let network = Network::power_on([(device_config(&settings), unit)], now);
        let cpu = CpuUnit::power_on(now, cpu, variables, cpu_end, Box::new(program));
        let mut access = DirectAccess::new(Rack { network, cpu }, now);
        access.pace = Duration::from_micros(100);
        Self { access, mailbox: MailboxConduct::NEW }
    }

    pub(crate) fn power_off(&mut self) {
        let now = self.access.now();
        self.access.line.network.power_off(0, now);
    }

    pub(crate) fn power_on_again(&mut self) {
        let now = self.access.now();
        self.access.line.network.restart(0, now, Start::PowerOn);
    }

    /// T_slave of the unit.
    pub(crate) fn refresh_period(&self) -> Duration {
        self.access.line.network.device(0).expect("a unit").unit().refresh_period().expect("a period")
    }

    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) {
        assert_eq!(self.access.write(UNIT, offset, data), 1, "write to {offset:#06X}");
    }

    pub(crate) fn read(&mut self, offset: u16, length_bytes: u16) -> Vec<u8> {
        self.access.read(UNIT, offset, length_bytes).0
    }

    fn set_sync_manager(&mut self, settings: SyncManagerSettings) {
        self.write(0x0800 + 8 * u16::from(settings.number), &settings.pack());
    }

    /// Requests a state; returns AL status and AL status code after it.
    pub(crate) fn request(&mut self, state: u8) -> (u8, u16) {
        self.write(0x0120, &[state, 0]);
        let status = self.read(0x0130, 6);
        (status[0], u16::from_le_bytes([status[4], status[5]]))
    }

    pub(crate) fn into_pre_op(mut self) -> Self {
        self.set_sync_manager(MAILBOX_OUT);
        self.set_sync_manager(MAILBOX_IN);
        assert_eq!(self.request(PRE_OP), (PRE_OP, 0));
        self
    }

    pub(crate) fn set_process_data(&mut self, outputs_bytes: u16, inputs_bytes: u16) {
        self.set_sync_manager(channel(2, layout::OUTPUTS_START, outputs_bytes, layout::OUTPUTS_CONTROL));
        self.set_sync_manager(channel(3, layout::INPUTS_START, inputs_bytes, layout::INPUTS_CONTROL));
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
        let sent = self.access.now();
        let written = self.sdo(SdoTransfer::download(SdoTarget::complete(index, 0), value));
        written.unwrap_or_else(|failure| panic!("{index:04X}: {failure}"));
        self.access.now().saturating_since(sent)
    }

    /// An SDO download, or the abort code.
    pub(crate) fn download(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), u32> {
        abort_code(self.sdo(SdoTransfer::download(SdoTarget::entry(index, sub), value))).map(drop)
    }

    /// An SDO upload, or the abort code.
    pub(crate) fn upload(&mut self, index: u16, sub: u8) -> Result<Vec<u8>, u32> {
        abort_code(self.sdo(SdoTransfer::upload(SdoTarget::entry(index, sub))))
    }

    fn sdo(&mut self, transfer: SdoTransfer) -> Result<Vec<u8>, ServiceFailure> {
        let mut dialogue = MailboxDialogue::new(MAILBOX_OUT, MAILBOX_IN, Service::Sdo(transfer));
        dialogue.begin(self.mailbox);
        assert!(self.access.execute(UNIT, &mut dialogue, Duration::from_millis(100)), "no response");
        self.mailbox = dialogue.conduct();
        dialogue.into_service().into_result()
    }

    /// Sends outputs for long enough that they return; returns the inputs after that.
    pub(crate) fn exchange(&mut self, outputs: &[u8], inputs_bytes: u16) -> Vec<u8> {
        for _ in 0..100 {
            self.write(layout::OUTPUTS_START, outputs);
        }
        self.read(layout::INPUTS_START, inputs_bytes)
    }
}

fn abort_code<T>(result: Result<T, ServiceFailure>) -> Result<T, u32> {
    result.map_err(|failure| match failure {
        ServiceFailure::Abort(code) => code.0,
        other => panic!("{other}"),
    })
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
