//! The description of a terminal: SII, ESI, registers.

use digital::{Channels, Ports, TerminalSettings, VENDOR_ID, description, device_config};
use esi::PortPhysics::{Mii, Unused};
use esi::SyncManagerType::{Inputs, Outputs};
use objects::ObjectTable;

use crate::bench::{Bench, terminal};

/// C022 to C037, for each number of outputs and inputs.
#[test]
fn every_sii_follows_the_rules_and_equals_its_description() {
    for outputs in 0..=Channels::MAX {
        for inputs in 0..=Channels::MAX {
            let settings = terminal(outputs, inputs);
            let image = device_config(&settings).sii_image;
            assert_eq!(esi::sii::lint(&image), [], "{outputs} outputs, {inputs} inputs");
            assert_eq!(esi::sii::compare(&image, &description(&settings)), []);
        }
    }
}

/// The layout of simple terminals in the field.
#[test]
fn outputs_come_first_and_what_is_left_out_takes_no_sync_manager() {
    let of = |outputs, inputs| {
        let described = description(&terminal(outputs, inputs)).sync_managers;
        described.iter().map(|sm| (sm.usage, sm.start, sm.default_bytes, sm.control)).collect::<Vec<_>>()
    };
    assert_eq!(of(0, 0), []);
    assert_eq!(of(8, 0), [(Outputs, 0x0F00, 1, 0x44)]);
    assert_eq!(of(0, 8), [(Inputs, 0x1000, 1, 0x00)]);
    assert_eq!(of(4, 12), [(Outputs, 0x0F00, 1, 0x44), (Inputs, 0x1000, 2, 0x00)]);
    assert_eq!(of(9, 64), [(Outputs, 0x1100, 2, 0x44), (Inputs, 0x1000, 8, 0x00)]);
}

#[test]
fn each_channel_is_an_object_in_a_pdo_of_its_own() {
    let description = description(&terminal(2, 64));
    let of = |pdo: &esi::Pdo| {
        let entry = &pdo.entries[0];
        (pdo.index.0, pdo.name.clone(), entry.index.0, entry.name.clone(), pdo.bit_length(), pdo.sync_manager)
    };
    let outputs: Vec<_> = description.rx_pdos.iter().map(of).collect();
    assert_eq!(
        outputs,
        [
            (0x1600, "Channel 1".into(), 0x7000, "Output".into(), 1, Some(0)),
            (0x1601, "Channel 2".into(), 0x7010, "Output".into(), 1, Some(0)),
        ]
    );
    let last = description.tx_pdos.last().map(of);
    assert_eq!(last, Some((0x1A3F, "Channel 64".into(), 0x63F0, "Input".into(), 1, Some(1))));
}

#[test]
fn masters_tell_terminals_apart() {
    let of = |outputs, inputs| {
        let description = description(&terminal(outputs, inputs));
        (description.order_code, description.name, description.product_code)
    };
    assert_eq!(of(0, 0), ("COUPLER".into(), "Coupler".into(), 0x0001_0000));
    assert_eq!(of(8, 0), ("DO8".into(), "8 digital outputs".into(), 0x0001_0800));
    assert_eq!(of(0, 1), ("DI1".into(), "1 digital input".into(), 0x0001_0001));
    assert_eq!(of(4, 4), ("DO4-DI4".into(), "4 digital outputs, 4 digital inputs".into(), 0x0001_0404));
}

#[test]
fn there_is_no_mailbox_and_a_master_sees_it() {
    let mut bench = Bench::of(&[terminal(8, 8)]);
    let image = bench.sii(0);
    assert_eq!(image[40..58], [0; 18], "no mailbox words");
    assert_eq!(image[16..20], VENDOR_ID.to_le_bytes());
    assert_eq!(bench.word(0, 0x0140), 0x0004, "digital I/O, no device emulation");
}

#[test]
fn serial_and_alias_are_in_the_sii() {
    let settings = TerminalSettings { serial: 77, alias: 0x0102, ..terminal(8, 0) };
    let mut bench = Bench::of(&[settings]);
    let image = bench.sii(0);
    assert_eq!((&image[28..32], &image[8..10]), (&[77, 0, 0, 0][..], &[0x02, 0x01][..]));
    assert_eq!(bench.word(0, 0x0012), 0x0102);
}

/// C029: the controller and the SII have the same ports.
#[test]
fn ports_are_in_registers_and_description() {
    for (count, descriptor, physics) in [
        (2, 0x0F, [Mii, Mii, Unused, Unused]),
        (3, 0x3F, [Mii, Mii, Mii, Unused]),
        (4, 0xFF, [Mii, Mii, Mii, Mii]),
    ] {
        let ports = Ports::new(count).expect("2 to 4");
        let settings = TerminalSettings { ports, ..terminal(0, 0) };
        assert_eq!(description(&settings).ports, physics);
        assert_eq!(Bench::of(&[settings]).read(0, 0x0007, 1), [descriptor]);
    }
    assert_eq!((Ports::new(1), Ports::new(5)), (None, None));
}

#[test]
fn the_esi_file_has_the_bits() {
    let xml = esi::xml(&description(&terminal(2, 0)), &ObjectTable::new(vec![]));
    let sm = "<Sm DefaultSize=\"1\" StartAddress=\"#x0F00\" ControlByte=\"#x44\" Enable=\"1\">Outputs</Sm>";
    assert!(xml.contains(sm), "{xml}");
    assert_eq!(xml.matches("<RxPdo ").count(), 2);
    assert!(!xml.contains("<Mailbox>"));
}
