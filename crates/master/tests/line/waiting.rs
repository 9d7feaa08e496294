//! Orders that wait for each other, or can never be sent: the master always has a next time at which it does something.

use master::{Failure, LostRead, Outcome};
use proptest::prelude::*;
use time::Duration;
use wire::{AlState, Command, Emergency, SdoTarget};

use crate::faults::{BadLine, Fate, fate};

const SERIAL: SdoTarget = SdoTarget::entry(0x1018, 4);
/// One byte more than a datagram can carry.
const TOO_LONG: u16 = 1_487;

fn line(fates: Vec<Fate>) -> BadLine {
    BadLine::new(fates, LostRead::AskAgain)
}

#[test]
fn a_datagram_waits_while_the_frame_of_a_search_is_lost() {
    let mut line = line(vec![Fate::LostOnItsWay, Fate::Passes, Fate::Passes, Fate::Passes]);
    let search = line.master.search(line.now);
    let datagram = line.master.datagram(Command::Brd, 0, 0x0000, &[0]);
    assert_eq!(line.complete(search).first(), Some(&(None, Ok(Outcome::Found(2)))));
    line.complete(datagram);
    assert!(!line.master.is_open(datagram));
}

#[test]
fn slaves_wait_while_a_second_search_is_under_way() {
    let mut line = line(vec![Fate::Passes, Fate::Passes, Fate::LostOnItsWay]);
    line.master.search(line.now);
    let second = line.master.search(line.now);
    line.complete(second);
    assert_eq!(line.master.slaves().len(), 2);
}

/// A search has found two slaves, and the first one's mailbox is longer than a datagram.
fn with_a_long_mailbox(change: impl Fn(&mut master::MailboxSettings)) -> BadLine {
    let mut line = line(vec![Fate::Passes]);
    let search = line.master.search(line.now);
    line.complete(search);
    change(line.master.settings_mut(0).and_then(|settings| settings.mailbox.as_mut()).expect("a mailbox"));
    line
}

#[test]
fn a_mailbox_longer_than_a_datagram_is_refused_and_delays_nobody() {
    let refused = Err(Failure::TooLong { length_bytes: TOO_LONG.into() });
    let changes: [fn(&mut master::MailboxSettings); 2] =
        [|mailbox| mailbox.out.length_bytes = TOO_LONG, |mailbox| mailbox.inward.length_bytes = TOO_LONG];
    for change in changes {
        let mut line = with_a_long_mailbox(change);
        let request = line.master.take_to(line.now, 1, AlState::PreOp);
        line.complete(request);
        let long = line.master.upload(line.now, 0, SERIAL);
        let short = line.master.upload(line.now, 1, SERIAL);
        let sent = line.slaves.frames.len();
        assert_eq!(line.complete(long), [(Some(0), refused.clone())]);
        assert!(matches!(line.complete(short)[..], [(Some(1), Ok(Outcome::Data(_)))]));
        let sent = line.slaves.frames[sent..].iter().flat_map(|frame| wire::datagrams(frame));
        assert_eq!(
            sent.filter(|datagram| datagram.header.address == 0x1001).count(),
            0,
            "no part of it is sent"
        );
    }
}

#[test]
fn a_mailbox_longer_than_a_datagram_is_not_read_for_emergencies() {
    let mut line = with_a_long_mailbox(|_| {});
    let request = line.master.take_all_to(line.now, AlState::PreOp);
    line.complete(request);
    let settings = line.master.settings_mut(0).expect("a slave");
    settings.mailbox.as_mut().expect("a mailbox").inward.length_bytes = TOO_LONG;
    let emergency = Emergency { code: 0xFF01, error_register: 0, manufacturer: [0; 5] };
    assert!(line.slaves.network.device_mut(0).expect("a unit").queue_emergency(emergency));
    line.run_for(Duration::from_millis(100));
    let request = line.master.upload(line.now, 1, SERIAL);
    assert!(matches!(line.complete(request)[..], [(Some(1), Ok(Outcome::Data(_)))]));
}

#[test]
fn accesses_and_registers_longer_than_a_datagram_are_refused() {
    let mut line = with_a_long_mailbox(|_| {});
    let refused = [(Some(0), Err(Failure::TooLong { length_bytes: TOO_LONG.into() }))];
    let read = line.master.read(line.now, 0, 0x1000, TOO_LONG);
    assert_eq!(line.complete(read), refused);
    let write = line.master.write(line.now, 0, 0x1000, &[0; TOO_LONG as usize]);
    assert_eq!(line.complete(write), refused);
    let settings = line.master.settings_mut(0).expect("a slave");
    let data = vec![0; usize::from(TOO_LONG)];
    settings.registers.push(master::RegisterSetting {
        transition: esi::Transition::Ip,
        offset: 0x1000,
        data,
    });
    let up = line.master.take_to(line.now, 0, AlState::PreOp);
    assert_eq!(line.complete(up), refused);
}

/// An order of the caller.
#[derive(Clone, Debug)]
enum Order {
    Search,
    Datagram,
    Read(u16),
    TakeAllTo(AlState),
    Upload,
    MailboxLength(u16),
    Exchange(u64),
}

fn order() -> impl Strategy<Value = Order> {
    let length = || prop_oneof![Just(1_u16), Just(256), Just(1_486), Just(TOO_LONG), Just(u16::MAX)];
    let state =
        prop_oneof![Just(AlState::Init), Just(AlState::PreOp), Just(AlState::SafeOp), Just(AlState::Op)];
    prop_oneof![
        2 => Just(Order::Search),
        2 => Just(Order::Datagram),
        1 => length().prop_map(Order::Read),
        2 => state.prop_map(Order::TakeAllTo),
        1 => Just(Order::Upload),
        1 => length().prop_map(Order::MailboxLength),
        1 => (1..5_000_u64).prop_map(Order::Exchange),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// [`BadLine`] checks it after every frame.
    #[test]
    fn a_master_that_sends_nothing_waits_for_a_later_time(
        fates in prop::collection::vec(fate(), 1..40),
        orders in prop::collection::vec((order(), 0..30_u64), 1..20),
    ) {
        let mut line = line(fates);
        // Orders in the middle of others: only times are judged here.
        line.is_deceived = true;
        let mut requests = Vec::new();
        for (order, pause_ms) in orders {
            let now = line.now;
            requests.extend(match order {
                Order::Search => Some(line.master.search(now)),
                Order::Datagram => Some(line.master.datagram(Command::Brd, 0, 0, &[0])),
                Order::Read(length_bytes) => Some(line.master.read(now, 0, 0x1000, length_bytes)),
                Order::TakeAllTo(state) => Some(line.master.take_all_to(now, state)),
                Order::Upload => Some(line.master.upload(now, 1, SERIAL)),
                Order::MailboxLength(length_bytes) => {
                    let mailbox = line.master.settings_mut(0).and_then(|settings| settings.mailbox.as_mut());
                    mailbox.into_iter().for_each(|mailbox| mailbox.inward.length_bytes = length_bytes);
                    None
                }
                Order::Exchange(period_us) => {
                    line.master.exchange(now, Duration::from_micros(period_us));
                    None
                }
            });
            line.run_for(Duration::from_millis(pause_ms));
        }
        for request in requests {
            line.complete(request);
        }
    }
}
