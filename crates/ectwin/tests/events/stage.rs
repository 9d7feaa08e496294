//! The test environment: one unit in virtual time, and single accesses of a master that can do everything incorrectly.

use ectwin::master::{
    Address, DirectAccess, MailboxConduct, MailboxDialogue, SdoTransfer, Service, ServiceFailure,
    SyncManagerSettings,
};
use ectwin::wire::{Emergency, SdoTarget};
use ectwin::{Duration, Io, Setup, Twin, UnitSide};
use nx_ect101::layout;

pub(crate) const INIT: u8 = 0x01;
pub(crate) const PRE_OP: u8 = 0x02;
pub(crate) const SAFE_OP: u8 = 0x04;
pub(crate) const OP: u8 = 0x08;
/// System time of the CPU Unit at power-on.
pub(crate) const SYSTEM_TIME_NS: u64 = 1_700_000_000_000_000_000;
/// Outputs and inputs of the factory setting, with Sysmac Error Status among the inputs.
pub(crate) const OUTPUTS_BYTES: u16 = 180;
pub(crate) const INPUTS_BYTES: u16 = 184;

const ALL_STATUS: [u16; 4] = [0x1A00, 0x1A01, 0x1BFE, 0x1BFF];

const UNIT: Address = Address::Position(0);
const MAILBOX_OUT: SyncManagerSettings =
    channel(0, layout::MAILBOX_RECEIVE_START, layout::MAILBOX_BYTES, layout::MAILBOX_RECEIVE_CONTROL);
const MAILBOX_IN: SyncManagerSettings =
    channel(1, layout::MAILBOX_SEND_START, layout::MAILBOX_BYTES, layout::MAILBOX_SEND_CONTROL);

const fn channel(number: u8, start: u16, length_bytes: u16, control: u8) -> SyncManagerSettings {
    SyncManagerSettings { number, start, length_bytes, control, activate: 1 }
}

pub(crate) struct Stage {
    pub(crate) access: DirectAccess<Twin>,
    /// The emergencies that the master has received.
    pub(crate) emergencies: Vec<Emergency>,
    mailbox: MailboxConduct,
}

impl Stage {
    /// A unit with this text in its file, whose CPU Unit does not change the data.
    pub(crate) fn power_on(unit_file: &str) -> Self {
        let setup = Setup::from_toml(&format!("model = \"nx-ect101\"\nstart_up = \"0ms\"\n{unit_file}"))
            .expect("a right file");
        let setup = setup.program(|_: &mut Io| {}).system_time_ns(SYSTEM_TIME_NS);
        let twin = Twin::power_on([setup]);
        let now = twin.now();
        let mut access = DirectAccess::new(twin, now);
        access.pace = Duration::from_micros(100);
        let mut stage = Self { access, emergencies: Vec::new(), mailbox: MailboxConduct::NEW };
        stage.run_for_ms(2);
        stage
    }

    pub(crate) fn unit(&mut self) -> UnitSide<'_> {
        self.access.line.unit(0)
    }

    pub(crate) fn run_for_ms(&mut self, milliseconds: u64) {
        self.access.run_for(Duration::from_millis(milliseconds));
    }

    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) {
        assert_eq!(self.access.write(UNIT, offset, data), 1, "write to {offset:#06X}");
    }

    pub(crate) fn read(&mut self, offset: u16, length_bytes: u16) -> Vec<u8> {
        self.access.read(UNIT, offset, length_bytes).0
    }

    /// AL status and AL status code as the master reads them.
    pub(crate) fn al(&mut self) -> (u8, u16) {
        let registers = self.read(0x0130, 6);
        (registers[0], u16::from_le_bytes([registers[4], registers[5]]))
    }

    /// Requests a state; returns AL status and its code after that.
    pub(crate) fn request(&mut self, state: u8) -> (u8, u16) {
        self.write(0x0120, &[state, 0]);
        self.run_for_ms(2);
        self.al()
    }

    pub(crate) fn set_sync_manager(&mut self, number: u8, start: u16, length_bytes: u16, control: u8) {
        self.set_channel(channel(number, start, length_bytes, control));
    }

    fn set_channel(&mut self, settings: SyncManagerSettings) {
        let registers = 0x0800 + 8 * u16::from(settings.number);
        self.write(registers + 6, &[0]);
        self.write(registers, &settings.pack());
    }

    pub(crate) fn set_mailboxes(&mut self) {
        self.set_channel(MAILBOX_OUT);
        self.set_channel(MAILBOX_IN);
    }

    pub(crate) fn set_process_data(&mut self, outputs_bytes: u16, inputs_bytes: u16) {
        self.set_sync_manager(2, layout::OUTPUTS_START, outputs_bytes, layout::OUTPUTS_CONTROL);
        self.set_sync_manager(3, layout::INPUTS_START, inputs_bytes, layout::INPUTS_CONTROL);
    }

    /// From any state to PRE-OP with the factory setting, every status in the inputs, and emergencies enabled.
    pub(crate) fn enter_pre_op(&mut self) {
        assert_eq!(self.request(INIT | 0x10), (INIT, 0));
        self.set_mailboxes();
        assert_eq!(self.request(PRE_OP), (PRE_OP, 0));
        self.assign(0x1C13, &ALL_STATUS);
        self.download(0x10F3, 5, &[1, 0]).expect("10F3:05");
        self.set_process_data(OUTPUTS_BYTES, INPUTS_BYTES);
    }

    /// From PRE-OP to OP.
    pub(crate) fn enter_op(&mut self) {
        assert_eq!(self.request(SAFE_OP), (SAFE_OP, 0));
        self.exchange(&[0; OUTPUTS_BYTES as usize]);
        assert_eq!(self.request(OP), (OP, 0));
        self.exchange(&[0; OUTPUTS_BYTES as usize]);
    }

    /// Writes outputs and runs a few cycles; returns the inputs after that.
    pub(crate) fn exchange(&mut self, outputs: &[u8]) -> Vec<u8> {
        for _ in 0..10 {
            self.write(layout::OUTPUTS_START, outputs);
            self.run_for_ms(1);
        }
        self.inputs()
    }

    pub(crate) fn inputs(&mut self) -> Vec<u8> {
        self.read(layout::INPUTS_START, INPUTS_BYTES)
    }

    pub(crate) fn assign(&mut self, index: u16, pdos: &[u16]) {
        self.download(index, 0, &[0]).expect("no PDOs");
        for (sub, pdo) in (1..).zip(pdos) {
            self.download(index, sub, &pdo.to_le_bytes()).expect("a PDO");
        }
        self.download(index, 0, &[pdos.len() as u8]).expect("their number");
    }

    pub(crate) fn map(&mut self, pdo: u16, entries: &[u32]) {
        self.download(pdo, 0, &[0]).expect("no entries");
        for (sub, entry) in (1..).zip(entries) {
            self.download(pdo, sub, &entry.to_le_bytes()).expect("an entry");
        }
        self.download(pdo, 0, &[entries.len() as u8]).expect("their number");
    }

    /// An SDO download, or the abort code.
    pub(crate) fn download(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), u32> {
        match self.sdo(SdoTransfer::download(SdoTarget::entry(index, sub), value)) {
            Ok(_) => Ok(()),
            Err(ServiceFailure::Abort(code)) => Err(code.0),
            Err(failure) => panic!("download of {index:04X}:{sub:02X}: {failure}"),
        }
    }

    pub(crate) fn upload(&mut self, index: u16, sub: u8) -> Vec<u8> {
        let value = self.sdo(SdoTransfer::upload(SdoTarget::entry(index, sub)));
        value.unwrap_or_else(|failure| panic!("upload of {index:04X}:{sub:02X}: {failure}"))
    }

    fn sdo(&mut self, transfer: SdoTransfer) -> Result<Vec<u8>, ServiceFailure> {
        self.service(Service::Sdo(transfer)).into_result()
    }

    /// Executes a mailbox service, and keeps the emergencies that are received meanwhile.
    fn service(&mut self, service: Service) -> Service {
        let mut dialogue = MailboxDialogue::new(MAILBOX_OUT, MAILBOX_IN, service);
        dialogue.begin(self.mailbox);
        let patience = Duration::from_millis(50);
        assert!(self.access.execute(UNIT, &mut dialogue, patience), "no response within {patience}");
        self.emergencies.extend(core::iter::from_fn(|| dialogue.take_emergency()));
        self.mailbox = dialogue.conduct();
        dialogue.into_service()
    }

    /// Reads the messages in the mailbox, until none has come for 20 ms; returns the emergencies among them.
    pub(crate) fn take_emergencies(&mut self) -> Vec<Emergency> {
        loop {
            let before = self.emergencies.len();
            self.run_for_ms(20);
            self.service(Service::Listen);
            if self.emergencies.len() == before {
                return std::mem::take(&mut self.emergencies);
            }
        }
    }

    /// Whether the state has a mailbox.
    pub(crate) fn has_mailbox(&mut self) -> bool {
        self.al().0 & 0x0F != INIT
    }

    /// Messages in the diagnosis history, the oldest first, as stored in the unit.
    pub(crate) fn history(&mut self) -> Vec<[u8; 24]> {
        self.unit().error_log().history().map(|record| record.diagnosis_message()).collect()
    }
}
