//! A CPU Unit whose thread hangs or ends: the frames are answered, and the unit reports it (80200000).

#![cfg(feature = "ethercrab")]
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "no unit is taken to OP here")]
mod patient_master;

use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use ectwin::{Io, Live, Setup, Twin};
use ethercrab::std::ethercat_now;

/// Sysmac Error Status with a minor fault, object 2002:01.
const MINOR_FAULT: u8 = 0x20;

fn serve(program: impl FnMut(&mut Io) + Send + 'static) -> (Live, ethercrab::PduLoop<'static>) {
    let (tx, rx, pdu_loop) = patient_master::frames();
    let setup = Setup::from_toml("model = \"nx-ect101\"").unwrap().program(program);
    (Twin::power_on([setup]).serve_ethercrab(tx, rx).unwrap(), pdu_loop)
}

/// Waits for the error: the test ends by its own limit if there is none.
async fn expect_minor_fault(pdu_loop: ethercrab::PduLoop<'static>, meanwhile: impl FnOnce()) {
    let master = patient_master::master(pdu_loop, 10);
    let group = master.init_single_group::<2, 512>(ethercat_now).await.unwrap();
    let unit = group.subdevice(&master, 0).unwrap();
    assert_eq!(unit.sdo_read::<u8>(0x2002, 1).await.unwrap(), 0);
    meanwhile();
    let mut looks = tokio::time::interval(Duration::from_millis(10));
    while unit.sdo_read::<u8>(0x2002, 1).await.unwrap() != MINOR_FAULT {
        looks.tick().await;
    }
    let error: [u8; 12] = unit.sdo_read(0x2004, 1).await.unwrap();
    assert_eq!(error[..4], 0x8020_0000_u32.to_le_bytes());
}

/// Runs until a message is sent, then waits without end, until the sender is dropped.
fn hangs_on_request(requests: &Receiver<()>) {
    if requests.try_recv().is_ok() {
        let _gone = requests.recv();
    }
}

#[tokio::test]
async fn a_program_that_never_returns_is_noticed_by_the_unit() {
    let (sender, requests) = channel();
    let (live, pdu_loop) = serve(move |_: &mut Io| hangs_on_request(&requests));
    expect_minor_fault(pdu_loop, || sender.send(()).unwrap()).await;
    drop(sender);
    live.stop().unwrap();
}

#[tokio::test]
async fn a_program_that_ends_its_thread_is_noticed_by_the_unit_and_reported_at_the_end() {
    let (sender, requests) = channel::<()>();
    let (live, pdu_loop) =
        serve(move |_: &mut Io| assert!(requests.try_recv().is_err(), "it was told to end"));
    expect_minor_fault(pdu_loop, || sender.send(()).unwrap()).await;
    let error = live.stop().unwrap_err();
    assert!(error.to_string().contains("panicked"), "{error}");
}
