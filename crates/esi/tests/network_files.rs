//! Network files (ENI) are read as they are meant, and what is wrong with one is found.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::collections::BTreeSet;
use std::path::Path;

use esi::file::{Attachment, EsiFile, NetworkFile};
use esi::lint::rules::RULES;

fn machine() -> String {
    let units = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units");
    std::fs::read_to_string(units.join("eni/machine.xml")).unwrap()
}

fn read(text: &str) -> NetworkFile {
    NetworkFile::read(text.as_bytes()).unwrap()
}

/// The findings of the machine with the first occurrence of `before` replaced.
fn codes_with(before: &str, after: &str) -> Vec<&'static str> {
    let machine = machine();
    assert!(machine.contains(before), "{before}");
    read(&machine.replacen(before, after, 1))
        .findings
        .list()
        .iter()
        .map(|finding| finding.rule.code)
        .collect()
}

#[test]
fn the_slaves_of_a_machine_are_as_the_file_says() {
    let machine = read(&machine());
    assert_eq!(machine.findings.list(), []);
    assert_eq!((machine.slaves.len(), machine.cycle_time_us), (20, Some(1_000)));
    for (place, slave) in machine.slaves.iter().enumerate() {
        assert_eq!(slave.position.map(usize::from), Some(place), "{}", slave.name);
        assert_eq!(slave.station_address.map(usize::from), Some(1_001 + place), "{}", slave.name);
        assert_eq!(slave.commands.len(), 4, "{}", slave.name);
        assert!(slave.commands.iter().all(|command| command.working_counter == Some(1)), "{}", slave.name);
        assert_eq!(slave.commands.iter().filter(|command| command.at_beginning).count(), 1, "{}", slave.name);
    }
    let drive = machine.slaves.last().unwrap();
    assert_eq!(drive.identification.map(|id| (id.value, id.register)), Some((7, Some(0x0012))));
    assert!(drive.mailbox.as_ref().unwrap().protocols.contains(esi::MailboxProtocols::COE));
}

/// Each slave is a device of `units/esi`: identity, process data and mailbox agree.
#[test]
fn the_slaves_of_a_machine_are_devices_of_the_esi_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/esi");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| std::fs::read(entry.unwrap().path()).unwrap());
    let devices: Vec<_> = files
        .filter_map(|bytes| EsiFile::read(&bytes, &|_| None).ok())
        .flat_map(|file| file.devices)
        .map(|device| device.description())
        .collect();
    for slave in read(&machine()).slaves {
        let identity = (slave.vendor_id, slave.product_code, slave.revision);
        let same = |device: &&esi::DeviceDescription| {
            (Some(device.vendor.id), Some(device.product_code), Some(device.revision)) == identity
        };
        let pdos: Vec<_> = slave.pdos().map(|pdo| pdo.index.index).collect();
        let is_it = |device: &esi::DeviceDescription| {
            device.rx_pdos.iter().chain(&device.tx_pdos).map(|pdo| pdo.index).eq(pdos.iter().copied())
                && slave.mailbox.is_some() == device.mailbox.is_some()
        };
        assert!(devices.iter().filter(same).any(is_it), "{}", slave.name);
    }
}

#[test]
fn a_slave_is_connected_to_the_port_that_the_file_names_else_to_the_one_before() {
    let text = machine();
    let network = read(&text);
    assert_eq!(network.attachment(0), None);
    assert_eq!(network.attachment(14), Some(Attachment { slave: 13, port: Some(1) }));
    assert_eq!(network.attachment(15), Some(Attachment { slave: 0, port: Some(2) }));
    assert_eq!(network.attachment(20), None);
    let line = read(&text.replace("PreviousPort", "Ignored"));
    assert_eq!(line.attachment(15), Some(Attachment { slave: 14, port: None }));
}

#[test]
fn notations_of_other_tools_are_read() {
    for (before, after) in [
        ("<AutoIncAddr>65535</AutoIncAddr>", "<AutoIncAddr>-1</AutoIncAddr>"),
        ("<VendorId>3966763008</VendorId>", "<VendorId>-328204288</VendorId>"),
        ("<VendorId>3966763008</VendorId>", "<VendorId>#xEC700000</VendorId>"),
    ] {
        let machine = machine();
        assert!(machine.contains(before), "{before}");
        let changed = read(&machine.replacen(before, after, 1));
        assert_eq!(changed.findings.list(), [], "{after}");
        assert_eq!(identities(&changed), identities(&read(&machine)), "{after}");
    }
    let machine = machine().replace("<Recv>", "<Receive>").replace("</Recv>", "</Receive>");
    assert_eq!(read(&machine).findings.list(), []);
}

fn identities(network: &NetworkFile) -> Vec<(Option<u32>, Option<u16>)> {
    network.slaves.iter().map(|slave| (slave.vendor_id, slave.position)).collect()
}

/// A change of the machine, and the rules that it breaks.
const CHANGES: &[(&str, &str, &[&str])] = &[
    ("<VendorId>3966763008</VendorId>", "", &["N102"]),
    ("<PhysAddr>1020</PhysAddr>", "<PhysAddr>1019</PhysAddr>", &["N103"]),
    ("<PhysAddr>1020</PhysAddr>", "<PhysAddr>0</PhysAddr>", &["N103"]),
    ("<AutoIncAddr>65535</AutoIncAddr>", "<AutoIncAddr>65530</AutoIncAddr>", &["N104"]),
    ("<PhysAddr>1001</PhysAddr>\n      </PreviousPort>", "<PhysAddr>9</PhysAddr></PreviousPort>", &["N201"]),
    ("<Port>C</Port>", "<Port>E</Port>", &["N202"]),
    ("<Port>C</Port>", "<Port>B</Port>", &["N203"]),
    ("<Cmd>5</Cmd>", "", &["N301"]),
    ("<Ccs>1</Ccs>", "<Ccs>1</Ccs><Index/>", &["N301", "E102"]),
    ("<DefaultSize>1</DefaultSize>", "<DefaultSize>3</DefaultSize>", &["N304"]),
    ("<Pdo>", "<Pdo>1</Pdo><Pdo>", &["N303"]),
    ("<Transition>PS</Transition>", "<Transition>PX</Transition>", &["E502"]),
];

#[test]
fn a_change_breaks_its_rule() {
    for (before, after, codes) in CHANGES {
        assert_eq!(codes_with(before, after), *codes, "{before} -> {after}");
    }
}

#[test]
fn every_rule_of_networks_has_a_file_that_breaks_it() {
    // Those that take more than one change have tests of their own.
    let elsewhere = ["N101", "N105", "N302"];
    let of_changes = CHANGES.iter().flat_map(|(_, _, codes)| *codes).copied();
    let broken: BTreeSet<&str> = of_changes.chain(elsewhere).filter(|code| code.starts_with('N')).collect();
    let rules = RULES.iter().map(|rule| rule.code).filter(|code| code.starts_with('N'));
    assert_eq!(broken, rules.collect());
}

/// Together with the rules of devices these are all.
#[test]
fn a_rule_is_about_devices_or_about_networks() {
    assert!(RULES.iter().all(|rule| rule.code.starts_with(['E', 'N'])));
}

#[test]
fn two_slaves_are_not_known_by_the_same_number_and_a_mailbox_has_two_areas() {
    let number = "<Identification Value=\"7\"><Ado>18</Ado></Identification><PhysAddr>1001</PhysAddr>";
    assert_eq!(codes_with("<PhysAddr>1001</PhysAddr>", number), ["N105"]);
    let machine = machine().replacen("<Recv>", "<Lost>", 1).replacen("</Recv>", "</Lost>", 1);
    let findings = read(&machine).findings;
    assert_eq!(findings.list().iter().map(|finding| finding.rule.code).collect::<Vec<_>>(), ["N302"]);
}

#[test]
fn a_file_of_another_kind_is_named() {
    let error = NetworkFile::read(b"<EtherCATInfo/>").unwrap_err();
    assert_eq!(error.to_string(), "the root element is `EtherCATInfo`, expected `EtherCATConfig`");
    assert_eq!(read("<EtherCATConfig/>").slaves, []);
}

#[test]
fn a_network_of_too_many_slaves_keeps_the_first_ones() {
    let slaves = "<Slave        />".repeat(NetworkFile::SLAVES_MAX + 1);
    let network = read(&format!("<EtherCATConfig><Config>{slaves}</Config></EtherCATConfig>"));
    assert_eq!(network.slaves.len(), NetworkFile::SLAVES_MAX);
    assert!(network.findings.list().iter().any(|finding| finding.rule.code == "N101"));
}
