//! The search: the number of slaves, and their identities.

use crate::bench::{connected, connected_with};
use esc::SiiTiming;
use master::{Address, Addressing, Failure, Habits, Master, Outcome, SiiFailure};
use time::{Duration, Instant};
use wire::{AlState, Command};

const VENDOR: u32 = 0x83;
const PRODUCT: u32 = 0x17C;

#[test]
fn a_line_without_slaves_answers_nothing() {
    assert_eq!(connected(0).search(), Err(Failure::NoAnswer));
}

#[test]
fn every_slave_is_identified_by_its_sii() {
    for count in [1, 2, 25] {
        let mut bench = connected(count);
        assert_eq!(bench.search(), Ok(count));
        for (position, slave) in bench.master.slaves().iter().enumerate() {
            assert_eq!(slave.address(), Address::Station(0x1001 + position as u16));
            assert_eq!((slave.information().fmmus, slave.information().sync_managers), (8, 8));
            assert_eq!(slave.dl_status().open_ports(), if position + 1 == count { 1 } else { 2 });
            assert_eq!(slave.al_report().status.state, AlState::Init);
            let sii = slave.sii().expect("an SII");
            assert_eq!((sii.header.vendor_id, sii.header.product_code), (VENDOR, PRODUCT));
            assert_eq!(sii.sync_managers.len(), 4);
            assert!(!sii.rx_pdos.is_empty() && !sii.tx_pdos.is_empty());
            assert!(sii.general.is_some() && !sii.strings.is_empty());
        }
    }
}

/// Skipped parts are not read; everything else equals the image.
#[test]
fn what_was_read_is_what_the_image_holds() {
    let mut bench = connected(1);
    bench.search().expect("one slave");
    let image = bench.line.network.esc(0).expect("an ESC").sii_image().to_vec();
    let whole = esi::sii::parse(&image).expect("a good image");
    assert_eq!(bench.master.slaves()[0].sii(), Some(&whole));
}

#[test]
fn a_slow_sii_is_waited_for() {
    let busy =
        |time| connected_with(Master::default(), 2, move |_, config| config.esc.sii = SiiTiming::Busy(time));
    let mut bench = busy(Duration::from_millis(3));
    assert_eq!(bench.search(), Ok(2));
    assert!(bench.now() > Instant::ZERO + Duration::from_millis(3 * 50), "many reads of 3 ms");
    let mut bench = busy(Duration::from_secs(10));
    assert_eq!(bench.search(), Err(Failure::SiiBusy));
}

#[test]
fn a_blank_sii_has_no_categories_and_a_broken_one_is_refused() {
    let with = |image: Vec<u8>| {
        let mut bench = connected_with(Master::default(), 1, |_, config| config.sii_image = image.clone());
        let result = bench.search();
        (result, bench.master.slaves()[0].sii().cloned())
    };
    let (result, blank) = with(vec![0xFF; 2048]);
    let blank = blank.expect("contents");
    assert_eq!((result, blank.header.vendor_id, blank.categories.len()), (Ok(1), u32::MAX, 0));
    // The size word is 128 bytes, and the first category is after them.
    let (result, zeros) = with(vec![0; 2048]);
    let failure = SiiFailure::TooLong { category_at: 0x40, end: 0x40 };
    assert_eq!((result, zeros), (Err(Failure::Sii(failure)), None));
    let mut cut = vec![0; 2048];
    cut[124] = 0x0F;
    cut[128..132].copy_from_slice(&[50, 0, 4, 0]);
    cut[134] = 200;
    cut[140..142].copy_from_slice(&[0xFF, 0xFF]);
    assert!(matches!(with(cut).0, Err(Failure::Sii(SiiFailure::Malformed(_)))));
}

#[test]
fn slaves_that_the_search_has_left_keep_no_address() {
    let mut bench = connected(3);
    bench.search().expect("three slaves");
    bench.line.network.set_cable(1, false);
    assert_eq!(bench.search(), Ok(1));
    assert_eq!(bench.master.slaves().len(), 1);
    bench.line.network.set_cable(1, true);
    assert_eq!(bench.search(), Ok(3));
}

#[test]
fn a_master_may_go_by_position() {
    let habits = Habits { addressing: Addressing::Position, ..Habits::default() };
    let mut bench = connected_with(Master::new(habits), 2, |_, _| {});
    assert_eq!(bench.search(), Ok(2));
    assert_eq!(bench.master.slaves()[1].address(), Address::Position(1));
    assert_eq!(bench.read(1, 0x0010, 2), Ok(vec![0, 0]), "nobody has set a station address");
}

#[test]
fn a_datagram_of_ones_own_is_sent_once_and_comes_back_as_it_is() {
    let mut bench = connected(3);
    let request = bench.master.datagram(Command::Brd, 0, 0x0130, &[0; 2]);
    let results = bench.complete(request);
    assert_eq!(results, [(None, Ok(Outcome::Datagram { working_counter: 3, data: vec![1, 0] }))]);
    let request = bench.master.datagram(Command::Lrw, 0, 0, &[0; 1_487]);
    assert_eq!(bench.complete(request), [(None, Err(Failure::TooLong { length_bytes: 1_487 }))]);
}

#[test]
fn registers_are_read_and_written_one_by_one() {
    let mut bench = connected(2);
    bench.search().expect("two slaves");
    bench.write(1, 0x0400, &[0x34, 0x12]).expect("writable");
    assert_eq!(bench.read(1, 0x0400, 2), Ok(vec![0x34, 0x12]));
    assert_eq!(bench.read(0, 0x0400, 2), Ok(vec![0xC2, 0x09]));
    assert_eq!(bench.write(1, 0x0110, &[0; 2]), Err(Failure::NoAnswer), "a register that nobody may write");
    assert_eq!(bench.read(2, 0x0400, 2), Err(Failure::NoSlave));
}
