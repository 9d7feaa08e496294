//! The test environment: one unit in virtual time, and a master of frames that can do everything incorrectly.

use ectwin::{Duration, FrameFate, Io, Setup, Twin};
use nx_ect101::layout;
use wire::{Command, FrameBuilder, returned_datagrams};

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

/// An emergency message as the master receives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Emergency(pub(crate) [u8; 8]);

pub(crate) struct Stage {
    pub(crate) twin: Twin,
    pub(crate) emergencies: Vec<Emergency>,
    counter: u8,
}

impl Stage {
    /// A unit with this text in its file, whose CPU Unit does not change the data.
    pub(crate) fn power_on(unit_file: &str) -> Self {
        let setup = Setup::from_toml(&format!("model = \"nx-ect101\"\nstart_up = \"0ms\"\n{unit_file}"))
            .expect("a right file");
        let setup = setup.program(|_: &mut Io| {}).system_time_ns(SYSTEM_TIME_NS);
        let mut stage = Self { twin: Twin::power_on([setup]), emergencies: Vec::new(), counter: 0 };
        stage.run_for_ms(2);
        stage
    }

    pub(crate) fn run_for_ms(&mut self, milliseconds: u64) {
        self.twin.run_for(Duration::from_millis(milliseconds));
    }

    fn send(&mut self, command: Command, offset: u16, data: &[u8]) -> (Vec<u8>, u16) {
        self.twin.run_for(Duration::from_micros(100));
        let mut frame = FrameBuilder::new().physical(command, 0, offset, data).finish();
        assert_eq!(self.twin.frame(&mut frame), FrameFate::Returned);
        let returned = returned_datagrams(&frame).remove(0);
        (returned.data, returned.working_counter)
    }

    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) {
        assert_eq!(self.send(Command::Apwr, offset, data).1, 1, "write to {offset:#06X}");
    }

    pub(crate) fn read(&mut self, offset: u16, length_bytes: usize) -> Vec<u8> {
        self.send(Command::Aprd, offset, &vec![0; length_bytes]).0
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

    pub(crate) fn set_sync_manager(&mut self, number: u16, start: u16, length_bytes: u16, control: u8) {
        let ([s0, s1], [l0, l1]) = (start.to_le_bytes(), length_bytes.to_le_bytes());
        self.write(0x0800 + 8 * number + 6, &[0]);
        self.write(0x0800 + 8 * number, &[s0, s1, l0, l1, control, 0, 1, 0]);
    }

    pub(crate) fn set_mailboxes(&mut self) {
        let (receive, send) = (layout::MAILBOX_RECEIVE_START, layout::MAILBOX_SEND_START);
        self.set_sync_manager(0, receive, layout::MAILBOX_BYTES, layout::MAILBOX_RECEIVE_CONTROL);
        self.set_sync_manager(1, send, layout::MAILBOX_BYTES, layout::MAILBOX_SEND_CONTROL);
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
        self.read(layout::INPUTS_START, usize::from(INPUTS_BYTES))
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

    /// An expedited SDO download.
    pub(crate) fn download(&mut self, index: u16, sub: u8, value: &[u8]) -> Result<(), u32> {
        let command = 0x23 | (4 - value.len() as u8) << 2;
        let mut data = value.to_vec();
        data.resize(4, 0);
        let response = self.sdo(command, index, sub, &data);
        if response[8] == 0x80 { Err(little_endian(&response[12..16])) } else { Ok(()) }
    }

    /// An SDO upload.
    pub(crate) fn upload(&mut self, index: u16, sub: u8) -> Vec<u8> {
        let response = self.sdo(0x40, index, sub, &[0; 4]);
        assert_ne!(response[8], 0x80, "upload of {index:04X}:{sub:02X} {:02X?}", &response[12..16]);
        if response[8] & 2 != 0 {
            let length_bytes = 4 - usize::from(response[8] >> 2 & 3);
            return response[12..12 + length_bytes].to_vec();
        }
        let length_bytes = little_endian(&response[12..16]) as usize;
        response[16..16 + length_bytes].to_vec()
    }

    fn sdo(&mut self, command: u8, index: u16, sub: u8, data: &[u8]) -> Vec<u8> {
        self.counter = self.counter % 7 + 1;
        let ([l0, l1], [i0, i1]) = ((6 + data.len() as u16).to_le_bytes(), index.to_le_bytes());
        let mut message = vec![l0, l1, 0, 0, 0, self.counter << 4 | 3, 0, 0x20, command, i0, i1, sub];
        message.extend(data);
        message.resize(usize::from(layout::MAILBOX_BYTES), 0);
        self.write(layout::MAILBOX_RECEIVE_START, &message);
        loop {
            let message = self.receive().expect("a response within 50 ms");
            // CoE service 1 is an emergency, which `receive` has stored.
            if message[7] >> 4 != 1 {
                return message;
            }
        }
    }

    /// The next message in the mailbox, if there is one within 50 ms.
    fn receive(&mut self) -> Option<Vec<u8>> {
        for _ in 0..500 {
            if self.read(0x080D, 1)[0] & 0x08 != 0 {
                let message = self.read(layout::MAILBOX_SEND_START, usize::from(layout::MAILBOX_BYTES));
                if message[7] >> 4 == 1 {
                    self.emergencies.push(Emergency(message[8..16].try_into().expect("8 bytes")));
                }
                return Some(message);
            }
        }
        None
    }

    /// Reads the messages in the mailbox; returns the emergencies among them.
    pub(crate) fn take_emergencies(&mut self) -> Vec<Emergency> {
        while self.receive().is_some() {}
        std::mem::take(&mut self.emergencies)
    }

    /// Whether the state has a mailbox.
    pub(crate) fn has_mailbox(&mut self) -> bool {
        self.al().0 & 0x0F != INIT
    }

    /// Messages in the diagnosis history, the oldest first, as stored in the unit.
    pub(crate) fn history(&mut self) -> Vec<[u8; 24]> {
        self.twin.unit(0).error_log().history().map(|record| record.diagnosis_message()).collect()
    }
}

pub(crate) fn little_endian(value: &[u8]) -> u32 {
    value.iter().take(4).rev().fold(0, |number, &byte| number << 8 | u32::from(byte))
}
