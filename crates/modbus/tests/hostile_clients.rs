//! Clients that send invalid frames, too much, too little, or nothing, and one that continues to work beside them.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "the other tests use more of it")]
mod bench;

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use bench::Bench;
use modbus::CONNECTIONS_MAX;
use plc::Io;
use proptest::prelude::*;
use tokio_modbus::client::{Reader, Writer};

/// A server that hangs is detected after this time.
const PATIENCE: Duration = Duration::from_secs(20);

fn nothing(_: &mut Io) {}

fn raw(bench: &Bench) -> TcpStream {
    let stream = TcpStream::connect(bench.address()).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream
}

/// A frame for unit 1 with this PDU.
fn frame(pdu: &[u8]) -> Vec<u8> {
    let length = u16::try_from(pdu.len() + 1).unwrap().to_be_bytes();
    [&[0xAB, 0xCD, 0, 0], &length[..], &[1], pdu].concat()
}

/// The PDU of the answer.
fn answer(stream: &mut TcpStream) -> Vec<u8> {
    let mut header = [0; 7];
    stream.read_exact(&mut header).unwrap();
    assert_eq!(header[..4], [0xAB, 0xCD, 0, 0]);
    let mut pdu = vec![0; usize::from(header[5]) - 1];
    stream.read_exact(&mut pdu).unwrap();
    pdu
}

/// Everything until the server closes the connection.
fn rest(mut stream: TcpStream) -> Vec<u8> {
    let mut octets = Vec::new();
    // A reset is an end too: the server has not read everything that arrived.
    let _ = stream.read_to_end(&mut octets);
    octets
}

#[test]
fn wrong_requests_are_answered_by_exceptions_and_the_connection_goes_on() {
    let bench = Bench::with(nothing);
    let mut client = raw(&bench);
    for (pdu, expected) in [
        (vec![0x03, 0, 0, 0x27, 0x10], vec![0x83, 3]),
        (vec![0x04, 0, 0, 0, 0], vec![0x84, 3]),
        (vec![0x0F, 0x27, 0x10, 0, 16, 1, 0xFF], vec![0x8F, 3]),
        (vec![0x10, 0, 0, 0x80, 0, 0], vec![0x90, 3]),
        (vec![0x10, 0, 0, 0, 1, 2, 0], vec![0x90, 3]),
        (vec![0x05, 0x27, 0x10, 0x12, 0x34], vec![0x85, 3]),
        (vec![0x2B, 0x0E, 1, 0], vec![0xAB, 1]),
        (vec![0x80], vec![0x80, 1]),
        (vec![0xFF; 253], vec![0xFF, 1]),
        (vec![0x03, 0, 0, 0, 1], vec![0x03, 2, 0, 0]),
    ] {
        client.write_all(&frame(&pdu)).unwrap();
        assert_eq!(answer(&mut client), expected, "{pdu:02x?}");
    }
}

#[test]
fn requests_that_come_together_or_in_pieces_are_answered_in_their_order() {
    let bench = Bench::with(nothing);
    let mut client = raw(&bench);
    let write = frame(&[0x06, 0, 5, 0x12, 0x34]);
    let read = frame(&[0x03, 0, 5, 0, 1]);
    client.write_all(&[write, read.clone()].concat()).unwrap();
    assert_eq!(answer(&mut client), [0x06, 0, 5, 0x12, 0x34]);
    assert_eq!(answer(&mut client), [0x03, 2, 0x12, 0x34]);
    for octet in &read {
        client.write_all(&[*octet]).unwrap();
    }
    assert_eq!(answer(&mut client), [0x03, 2, 0x12, 0x34]);
}

#[test]
fn what_is_no_modbus_frame_ends_the_connection() {
    let bench = Bench::with(nothing);
    for garbage in [
        b"GET / HTTP/1.1\r\n\r\n".to_vec(),
        vec![0, 1, 0, 0, 0xFF, 0xFF, 1, 3, 0, 0, 0, 1],
        vec![0, 1, 0, 0, 0, 0, 1, 3],
        vec![0, 1, 0, 0, 0, 1, 1, 3],
        vec![0, 1, 0, 0, 0, 255, 1, 3],
        vec![0, 1, 0, 9, 0, 6, 1, 3, 0, 0, 0, 1],
    ] {
        let mut client = raw(&bench);
        client.write_all(&garbage).unwrap();
        assert_eq!(rest(client), [], "{garbage:02x?}");
    }
}

#[test]
fn a_client_that_sends_half_a_frame_is_hung_up_on_and_delays_nobody() {
    let bench = Bench::with(nothing);
    let mut half = raw(&bench);
    half.write_all(&[0, 1, 0, 0, 0]).unwrap();
    bench.run(async |bench| {
        let mut client = bench.client(1).await;
        for value in 0..50 {
            client.write_single_register(0, value).await.unwrap().unwrap();
        }
        assert_eq!(rest(half), []);
        assert_eq!(client.read_holding_registers(0, 1).await.unwrap().unwrap(), [49]);
    });
}

/// Reads a register; whether there is an answer.
fn is_served(client: &mut TcpStream) -> bool {
    client.write_all(&frame(&[0x03, 0, 0, 0, 1])).is_ok()
        && client.read(&mut [0; 11]).is_ok_and(|octets| octets > 0)
}

#[test]
fn where_all_have_asked_one_client_more_takes_the_place_of_the_one_that_is_silent_longest() {
    let bench = Bench::with(nothing);
    let mut clients: Vec<_> = (0..CONNECTIONS_MAX).map(|_| raw(&bench)).collect();
    assert!(clients.iter_mut().all(is_served));
    // From now on the sixth client is silent, then the tenth.
    for silent in [5, 9] {
        assert!(clients.iter_mut().enumerate().all(|(at, client)| at == silent || is_served(client)));
        let mut one_more = raw(&bench);
        assert!(is_served(&mut one_more), "it is taken in");
        let closed = std::mem::replace(&mut clients[silent], one_more);
        assert_eq!(rest(closed), []);
        assert!(clients.iter_mut().all(is_served), "nobody else is closed");
    }
}

/// Number of connections that never send anything and arrive in one burst.
const MUTE: usize = 40;

#[test]
fn mute_clients_take_the_places_of_mute_clients_the_oldest_first() {
    let bench = Bench::with(nothing);
    let mut asked: Vec<_> = (0..3).map(|_| raw(&bench)).collect();
    assert!(asked.iter_mut().all(is_served));
    // Its request arrives with the burst, before the first silent connection.
    let mut asks = raw(&bench);
    asks.write_all(&frame(&[0x03, 0, 0, 0, 1])).unwrap();
    let mut mute: Vec<_> = (0..MUTE).map(|_| raw(&bench)).collect();
    assert_eq!(answer(&mut asks), [3, 2, 0, 0]);
    asked.push(asks);
    assert!(asked.iter_mut().all(is_served), "nobody who has asked is closed");
    let kept = mute.split_off(MUTE - (CONNECTIONS_MAX - asked.len()));
    for closed in mute {
        assert_eq!(rest(closed), []);
    }
    asked.extend(kept);
    assert!(asked.iter_mut().all(is_served), "the youngest are there, and may ask");
}

#[test]
fn half_a_request_and_garbage_are_no_request() {
    let bench = Bench::with(nothing);
    let mut clients: Vec<_> = (0..CONNECTIONS_MAX - 1).map(|_| raw(&bench)).collect();
    assert!(clients.iter_mut().all(is_served));
    let mut half = raw(&bench);
    half.write_all(&frame(&[0x03, 0, 0, 0, 1])[..8]).unwrap();
    clients.push(raw(&bench));
    assert_eq!(rest(half), []);
    assert!(clients.iter_mut().all(is_served));
}

#[test]
fn a_client_that_has_gone_leaves_its_place_and_nobody_is_closed() {
    let bench = Bench::with(nothing);
    let mut clients: Vec<_> = (0..CONNECTIONS_MAX).map(|_| raw(&bench)).collect();
    assert!(clients.iter_mut().all(is_served));
    let gone = clients.pop().unwrap();
    gone.shutdown(std::net::Shutdown::Write).unwrap();
    // The server closes its end: now it has detected the end.
    assert_eq!(rest(gone), []);
    clients.push(raw(&bench));
    assert!(clients.iter_mut().rev().all(is_served));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn after_any_octets_the_server_goes_on(
        octets in proptest::collection::vec(any::<u8>(), 0..600),
        pdus in proptest::collection::vec(proptest::collection::vec(any::<u8>(), 1..253), 0..8),
    ) {
        let bench = Bench::with(nothing);
        let mut client = raw(&bench);
        for pdu in &pdus {
            client.write_all(&frame(pdu)).unwrap();
            let answered = answer(&mut client);
            prop_assert_eq!(answered[0] & 0x7F, pdu[0] & 0x7F);
        }
        // The server may close the connection before it has received all of them.
        let _ = client.write_all(&octets);
        let mut client = raw(&bench);
        client.write_all(&frame(&[0x03, 0, 0, 0, 1])).unwrap();
        prop_assert_eq!(&answer(&mut client)[..2], &[3, 2]);
    }
}
