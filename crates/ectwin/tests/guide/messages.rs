use std::task::Poll;

use ectwin::{Duration, Io, NxCall, ObjectIndex, OperatingMode, Setup, SubIndex, Twin};

const FROM_MASTER: ObjectIndex = ObjectIndex(0x5000);
const TO_MASTER: ObjectIndex = ObjectIndex(0x5001);
const MESSAGE: SubIndex = SubIndex(1);

/// Sends the master its own message in upper case.
#[derive(Default)]
struct Shout {
    reading: Option<NxCall>,
}

impl ectwin::Program for Shout {
    fn scan(&mut self, io: &mut Io) {
        let status = io.status();
        // A scan never waits: a call is made in one, and the next ones check for its result.
        if let Some(call) = self.reading {
            let Poll::Ready(result) = io.nx_objects().take(call) else { return };
            self.reading = None;
            if let Ok(mut message) = result {
                message.make_ascii_uppercase();
                // The flag was seen before the message was read, and there is no other writer.
                let _ = io.nx_objects().write(TO_MASTER, MESSAGE, &message);
            }
        } else if status.sdo_enabled && status.new_message && status.ready_to_write_message {
            self.reading = io.nx_objects().read(FROM_MASTER, MESSAGE).ok();
        }
    }
}

const APRD: u8 = 1;
const APWR: u8 = 2;
const NOT_READY: u32 = 0x0800_0021;

/// One datagram of 400 bytes at most to the first unit. Returns its data as it came back.
fn datagram(twin: &mut Twin, command: u8, offset: u16, data: &[u8]) -> Vec<u8> {
    let length = data.len() as u16;
    let mut frame = [&[0xFF; 12][..], &[0x88, 0xA4], &(0x1000 | (12 + length)).to_le_bytes()].concat();
    frame.extend([command, 0, 0, 0]);
    frame.extend([offset.to_le_bytes(), length.to_le_bytes(), [0, 0]].concat());
    frame.extend(data);
    frame.extend([0, 0]);
    twin.frame(&mut frame);
    frame[26..26 + data.len()].to_vec()
}

/// One SDO request to subindex 1. Returns the response from its command byte on.
fn sdo(twin: &mut Twin, command: u8, index: u16, data: &[u8]) -> Vec<u8> {
    let length = (6 + data.len() as u16).to_le_bytes();
    // Mailbox header with type CoE, CoE header with service SDO request, SDO header.
    let mut mailbox =
        [&length[..], &[0, 0, 0, 3, 0, 0x20, command], &index.to_le_bytes(), &[1], data].concat();
    mailbox.resize(400, 0);
    datagram(twin, APWR, 0x1000, &mailbox);
    twin.run_for(Duration::from_millis(2));
    datagram(twin, APRD, 0x1200, &[0; 400])[8..].to_vec()
}

/// Writes 3001:01; the abort code of a refusal.
fn write_message(twin: &mut Twin, message: &[u8; 200]) -> Result<(), u32> {
    let response = sdo(twin, 0x21, 0x3001, &[&200_u32.to_le_bytes()[..], message].concat());
    let code = u32::from_le_bytes(response[4..8].try_into().unwrap());
    if response[0] == 0x80 { Err(code) } else { Ok(()) }
}

/// Reads 3000:01.
fn read_message(twin: &mut Twin) -> Vec<u8> {
    sdo(twin, 0x40, 0x3000, &[0; 4])[8..208].to_vec()
}

#[test]
fn a_message_goes_to_the_program_and_comes_back() {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap().program(Shout::default());
    let mut twin = Twin::power_on([setup]);
    // SyncManagers 0 and 1 as the ESI says, then PRE-OP: SDO communications begin.
    datagram(&mut twin, APWR, 0x0800, &[0x00, 0x10, 0x90, 0x01, 0x26, 0, 1, 0]);
    datagram(&mut twin, APWR, 0x0808, &[0x00, 0x12, 0x90, 0x01, 0x22, 0, 1, 0]);
    datagram(&mut twin, APWR, 0x0120, &[0x02, 0]);

    // The first one is accepted; the second one arrives before the stopped program has read it.
    twin.unit(0).cpu().set_mode(OperatingMode::Program);
    assert_eq!(write_message(&mut twin, &[b'a'; 200]), Ok(()));
    assert_eq!(write_message(&mut twin, &[b'b'; 200]), Err(NOT_READY));
    assert!(twin.unit(0).io().status().new_message);

    // Request, response and flags take a few task periods.
    twin.unit(0).cpu().set_mode(OperatingMode::Run);
    twin.run_for(Duration::from_millis(10));
    assert!(!twin.unit(0).io().status().new_message);
    assert!(!twin.unit(0).io().status().ready_to_write_message, "ours waits for the master");
    assert_eq!(read_message(&mut twin), [b'A'; 200]);

    twin.run_for(Duration::from_millis(2));
    assert!(twin.unit(0).io().status().ready_to_write_message);
    assert_eq!(write_message(&mut twin, &[b'b'; 200]), Ok(()));
}

/// The program in Structured Text in docs/user/structured-text.md.
fn program_of_the_page() -> &'static str {
    let page = include_str!("../../../../docs/user/structured-text.md");
    page.split("```st\n")
        .filter_map(|block| block.split("```").next())
        .find(|st| st.contains("NX_WriteObj;"))
        .unwrap()
}

#[test]
fn structured_text_sends_each_message_back() {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let mut twin = Twin::power_on([setup.structured_text(program_of_the_page()).unwrap()]);
    datagram(&mut twin, APWR, 0x0800, &[0x00, 0x10, 0x90, 0x01, 0x26, 0, 1, 0]);
    datagram(&mut twin, APWR, 0x0808, &[0x00, 0x12, 0x90, 0x01, 0x22, 0, 1, 0]);
    datagram(&mut twin, APWR, 0x0120, &[0x02, 0]);
    twin.run_for(Duration::from_millis(10));

    for letter in [b'a', b'b', b'c'] {
        assert_eq!(write_message(&mut twin, &[letter; 200]), Ok(()));
        twin.run_for(Duration::from_millis(20));
        assert_eq!(read_message(&mut twin), [letter; 200]);
        twin.run_for(Duration::from_millis(20));
    }
    assert_eq!(twin.unit(0).cpu().take_events().len(), 0, "nothing was refused");
}
