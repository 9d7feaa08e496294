//! ethercrab takes units to OP and gets its values back: in memory, over UDP, over a raw link.

#![cfg(feature = "ethercrab")]
#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod patient_master;

use std::net::UdpSocket;
use std::thread;
use std::time::Duration;

use ectwin::plant::line::LineOrder;
use ectwin::scenario::words::Spoken;
use ectwin::{AlState, EthercrabPort, Io, Live, Setup, Twin};
use ethercrab::PduLoop;
use ethercrab::std::ethercat_now;
use link::{FRAME_BUFFER_BYTES, FramePort};
use patient_master::FRAME_DATA_BYTES;
use testbed::{add_veth_pair, in_network_namespace};

const UNIT: &str = "model = \"nx-ect101\"\n[cpu]\nprogram = \"builtin:copy\"";
const OUTPUTS_BYTES: usize = 180;
const INPUTS_BYTES: usize = 183;
/// The start of the data of 0x1A01 in the inputs: after the status in 0x1A00.
const STATUS_BYTES: usize = 2;
const CYCLES: u16 = 300;

fn units(count: usize) -> Twin {
    Twin::power_on((0..count).map(|_| Setup::from_toml(UNIT).unwrap()))
}

/// The expected working counter of the LRWs of one cycle: the logical memory has all inputs, then all outputs.
/// A unit whose data are in two frames counts in both.
fn working_counter(units: usize) -> u16 {
    let areas = [(1, INPUTS_BYTES), (2, OUTPUTS_BYTES)];
    let (mut start, mut counter) = (0, 0);
    for (weight, length_bytes) in areas.into_iter().flat_map(|area| vec![area; units]) {
        let end = start + length_bytes;
        let frames = (end - 1) / FRAME_DATA_BYTES - start / FRAME_DATA_BYTES + 1;
        counter += weight * u16::try_from(frames).unwrap();
        start = end;
    }
    counter
}

/// Takes `units` to OP, sends a different pattern to each in each cycle, and expects the newest ones back.
async fn exchange(pdu_loop: PduLoop<'static>, units: u16) {
    let master = patient_master::master(pdu_loop, 10);
    let group = master.init_single_group::<16, 4096>(ethercat_now).await.unwrap();
    assert_eq!(group.len(), usize::from(units));
    let group = patient_master::into_op(group, &master).await;
    let mut ticks = tokio::time::interval(Duration::from_millis(1));
    let expected = working_counter(usize::from(units));
    let mut newest = vec![0; usize::from(units)];
    for cycle in 1..=CYCLES {
        ticks.tick().await;
        for (place, unit) in (1..).zip(group.iter(&master)) {
            assert_eq!((unit.outputs_raw().len(), unit.inputs_raw().len()), (OUTPUTS_BYTES, INPUTS_BYTES));
            unit.outputs_raw_mut()
                .chunks_exact_mut(2)
                .for_each(|word| word.copy_from_slice(&(place * 1000 + cycle).to_le_bytes()));
        }
        assert_eq!(group.tx_rx(&master).await.unwrap().working_counter, expected, "cycle {cycle}");
        for ((place, unit), newest) in (1..).zip(group.iter(&master)).zip(&mut newest) {
            let inputs = unit.inputs_raw();
            let mut words = inputs[STATUS_BYTES..][..OUTPUTS_BYTES].chunks_exact(2);
            let word = u16::from_le_bytes(words.next().unwrap().try_into().unwrap());
            assert!(
                words.all(|other| other == word.to_le_bytes()),
                "unit {place}: a torn image in cycle {cycle}"
            );
            let back = word.saturating_sub(place * 1000);
            assert!(
                (*newest..=cycle).contains(&back),
                "unit {place}: {back} after {newest} in cycle {cycle}"
            );
            *newest = back;
        }
    }
    assert!(newest.iter().all(|back| *back > 0), "{newest:?}");
    let _ = group.into_safe_op(&master).await.unwrap();
}

#[tokio::test]
async fn eight_units_in_memory() {
    let (tx, rx, pdu_loop) = patient_master::frames();
    let live = units(8).serve_ethercrab(tx, rx).unwrap();
    exchange(pdu_loop, 8).await;
    assert!((0..8).all(|position| live.look(position, |unit| unit.state()) == AlState::SafeOp));
    assert!(live.stop().unwrap().frames > u64::from(CYCLES));
}

#[tokio::test]
async fn a_test_sets_inputs_and_sees_outputs_at_the_units_side() {
    let (tx, rx, pdu_loop) = patient_master::frames();
    // No copy program: the inputs are what the test sets.
    let setup = Setup::from_toml(UNIT).unwrap().program(|_: &mut Io| {}).fast();
    let live = Twin::power_on([setup]).serve_ethercrab(tx, rx).unwrap();
    live.look(0, |unit| unit.io_mut().set_uints(1, [0x1234; 15]));

    let master = patient_master::master(pdu_loop, 10);
    let group = master.init_single_group::<2, 512>(ethercat_now).await.unwrap();
    assert_eq!(live.look(0, |unit| unit.state()), AlState::PreOp);
    let group = patient_master::into_op(group, &master).await;
    group.subdevice(&master, 0).unwrap().outputs_raw_mut()[..2].copy_from_slice(&[0x78, 0x56]);

    let mut ticks = tokio::time::interval(Duration::from_millis(1));
    let exchanged = |live: &Live| live.look(0, |unit| unit.io().uints(1).unwrap()[0]) == 0x5678;
    for _ in 0..1000 {
        ticks.tick().await;
        group.tx_rx(&master).await.unwrap();
        let inputs = group.subdevice(&master, 0).unwrap().inputs_raw().to_vec();
        if exchanged(&live) && inputs[STATUS_BYTES..][..30] == [0x34, 0x12].repeat(15) {
            return;
        }
    }
    panic!("the values did not arrive within 1000 cycles");
}

/// A master with a UDP socket: ethercrab's frames without their Ethernet header.
fn carry_over_udp(mut port: EthercrabPort<'_>, socket: &UdpSocket) {
    let mut buffer = [0; FRAME_BUFFER_BYTES];
    loop {
        let wait = time::Duration::from_millis(100);
        match port.receive(&mut buffer, wait) {
            Ok(None) => {}
            Ok(Some(length)) => {
                socket.send(&buffer[14..length]).unwrap();
                let answered = socket.recv(&mut buffer[14..]).unwrap();
                // As if the first slave had marked it: the unit's mark is not sent through the socket.
                buffer[6] |= 0x02;
                port.send(&buffer[..14 + answered]).unwrap();
            }
            Err(_) => return,
        }
    }
}

#[tokio::test]
async fn a_unit_over_udp() {
    let (tx, rx, pdu_loop) = patient_master::frames();
    let address = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let live = units(1).serve(link::open(&link::LinkSpec::Udp(address)).unwrap()).unwrap();
    let socket = UdpSocket::bind("127.0.0.1:0").unwrap();
    socket.connect(address).unwrap();
    thread::spawn(move || carry_over_udp(EthercrabPort::new(tx, rx), &socket));
    exchange(pdu_loop, 1).await;
    drop(live);
}

/// Lets a master carry out this with two units at the other end of a cable.
fn over_a_raw_link(test: &str, carry_out: impl AsyncFnOnce(PduLoop<'static>, &Live)) {
    in_network_namespace(test, || {
        add_veth_pair("veth0", "veth1");
        let (tx, rx, pdu_loop) = patient_master::frames();
        let live = units(2).serve(link::open(&"raw:veth1".parse().unwrap()).unwrap()).unwrap();
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(async {
            let frames = ethercrab::std::tx_rx_task("veth0", tx, rx).unwrap();
            tokio::select! {
                ended = frames => panic!("the master's link ended: {:?}", ended.is_ok()),
                () = carry_out(pdu_loop, &live) => {}
            }
        });
        live.stop().unwrap();
    });
}

#[test]
fn two_units_over_a_raw_link() {
    over_a_raw_link("two_units_over_a_raw_link", async |pdu_loop, _| exchange(pdu_loop, 2).await);
}

#[test]
fn a_master_on_a_raw_link_meets_faults_of_frames() {
    over_a_raw_link("a_master_on_a_raw_link_meets_faults_of_frames", meet_faults);
}

/// Takes two units to OP; then three cycles meet each fault, and the next one meets none.
async fn meet_faults(pdu_loop: PduLoop<'static>, live: &Live) {
    let master = patient_master::master(pdu_loop, 10);
    let group = master.init_single_group::<16, 4096>(ethercat_now).await.unwrap();
    let group = patient_master::into_op(group, &master).await;
    let expected = working_counter(2);
    for (sentence, counter) in [
        ("lower the working counter of the next 3 process data frames by 2", expected - 2),
        ("delay the next 3 process data frames by 5ms", expected),
        ("delay the next 3 process data frames on the way back by 5ms", expected),
    ] {
        live.line_order(&LineOrder::from_sentence(sentence).unwrap()).unwrap();
        for cycle in 1..=3 {
            let seen = group.tx_rx(&master).await.unwrap().working_counter;
            assert_eq!(seen, counter, "{sentence}: cycle {cycle}");
        }
        assert_eq!(live.faults(), [], "{sentence}: three frames have met it");
        let seen = group.tx_rx(&master).await.unwrap().working_counter;
        assert_eq!(seen, expected, "after: {sentence}");
    }
    let _ = group.into_safe_op(&master).await.unwrap();
}
