use std::task::Poll;

use ectwin::master::{Connected, Failure, Master, ServiceFailure};
use ectwin::wire::{SdoAbort, SdoTarget};
use ectwin::{AlState, Duration, Io, NxCall, ObjectIndex, OperatingMode, Setup, SubIndex, Twin};

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

const WRITE_MESSAGE: SdoTarget = SdoTarget::entry(0x3001, 1);
const READ_MESSAGE: SdoTarget = SdoTarget::entry(0x3000, 1);
const NOT_READY: Failure = Failure::Mailbox(ServiceFailure::Abort(SdoAbort(0x0800_0021)));

/// A master and a unit in PRE-OP, where SDO communications begin.
fn in_pre_op(setup: Setup) -> Connected<Twin> {
    let mut bench = Twin::power_on([setup]).connect(Master::default());
    bench.search().unwrap();
    bench.take_to(0, AlState::PreOp).unwrap();
    bench
}

#[test]
fn a_message_goes_to_the_program_and_comes_back() {
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap();
    let mut bench = in_pre_op(setup.program(Shout::default()));

    // The first one is accepted; the second one arrives before the stopped program has read it.
    bench.line.unit(0).cpu().set_mode(OperatingMode::Program);
    assert_eq!(bench.download(0, WRITE_MESSAGE, &[b'a'; 200]), Ok(()));
    assert_eq!(bench.download(0, WRITE_MESSAGE, &[b'b'; 200]), Err(NOT_READY));
    assert!(bench.line.unit(0).io().status().new_message);

    // Request, response and flags take a few task periods.
    bench.line.unit(0).cpu().set_mode(OperatingMode::Run);
    bench.run_for(Duration::from_millis(10));
    assert!(!bench.line.unit(0).io().status().new_message);
    assert!(!bench.line.unit(0).io().status().ready_to_write_message, "ours waits for the master");
    assert_eq!(bench.upload(0, READ_MESSAGE), Ok(vec![b'A'; 200]));

    bench.run_for(Duration::from_millis(2));
    assert!(bench.line.unit(0).io().status().ready_to_write_message);
    assert_eq!(bench.download(0, WRITE_MESSAGE, &[b'b'; 200]), Ok(()));
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
    let mut bench = in_pre_op(setup.structured_text(program_of_the_page()).unwrap());
    bench.run_for(Duration::from_millis(10));

    for letter in [b'a', b'b', b'c'] {
        assert_eq!(bench.download(0, WRITE_MESSAGE, &[letter; 200]), Ok(()));
        bench.run_for(Duration::from_millis(20));
        assert_eq!(bench.upload(0, READ_MESSAGE), Ok(vec![letter; 200]));
        bench.run_for(Duration::from_millis(20));
    }
    assert_eq!(bench.line.unit(0).cpu().take_events().len(), 0, "nothing was refused");
}
