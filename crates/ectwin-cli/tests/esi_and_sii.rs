//! The contents of the exported ESI and SII, compared with each other and with the registers: the first checks
//! of a configurator and a conformance test. Every unit file of the repository is a case.

#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test ends where something is not as it should be"
)]

use std::path::{Path, PathBuf};
use std::process::Command;

use ectwin::Twin;
use roxmltree::{Document, Node};
use wire::{FrameBuilder, returned_datagrams};

/// One unit: both files, and the first ten registers.
struct Unit {
    esi: String,
    sii: Vec<u8>,
    registers: Vec<u8>,
}

fn units() -> Vec<Unit> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units");
    let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
    let units: Vec<Unit> =
        files.filter(|file| file.extension().is_some_and(|kind| kind == "toml")).map(unit).collect();
    assert!(!units.is_empty());
    units
}

fn unit(file: PathBuf) -> Unit {
    let export = |command: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_ectwin")).arg(command).arg(&file).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    let mut twin = Twin::from_toml(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let mut frame = FrameBuilder::new().physical(wire::Command::Aprd, 0, 0x0000, &[0; 10]).finish();
    twin.frame(&mut frame);
    Unit {
        esi: String::from_utf8(export("esi")).unwrap(),
        sii: export("sii"),
        registers: returned_datagrams(&frame).remove(0).data,
    }
}

impl Unit {
    fn word(&self, address: usize) -> u16 {
        u16::from_le_bytes([self.sii[2 * address], self.sii[2 * address + 1]])
    }

    fn double_word(&self, address: usize) -> u32 {
        u32::from(self.word(address)) | (u32::from(self.word(address + 1)) << 16)
    }

    /// The categories, by number and content; the end must be 0xFFFF.
    fn categories(&self) -> Vec<(u16, &[u8])> {
        let (mut categories, mut at) = (Vec::new(), 0x40);
        while self.word(at) != 0xFFFF {
            let end = at + 2 + usize::from(self.word(at + 1));
            categories.push((self.word(at), &self.sii[2 * (at + 2)..2 * end]));
            at = end;
        }
        categories
    }

    fn category(&self, number: u16) -> &[u8] {
        self.categories().into_iter().find(|(each, _)| *each == number).expect("the category exists").1
    }

    /// The rows of a category; none if it is missing.
    fn rows(&self, number: u16) -> &[u8] {
        self.categories().into_iter().find(|(each, _)| *each == number).map_or(&[], |(_, rows)| rows)
    }

    fn string(&self, number: u8) -> String {
        let mut strings = &self.category(10)[1..];
        for _ in 1..number {
            strings = &strings[1 + usize::from(strings[0])..];
        }
        String::from_utf8(strings[1..=usize::from(strings[0])].to_vec()).unwrap()
    }
}

fn find<'a>(node: Node<'a, 'a>, name: &str) -> Node<'a, 'a> {
    node.descendants().find(|each| each.has_tag_name(name)).unwrap_or_else(|| panic!("no {name}"))
}

/// The element with the protocols; another element with this name, in Info, has time-outs.
fn mailbox<'a>(device: Node<'a, 'a>) -> Option<Node<'a, 'a>> {
    device.children().find(|node| node.has_tag_name("Mailbox"))
}

fn text<'a>(node: Node<'a, 'a>, name: &str) -> &'a str {
    find(node, name).text().unwrap_or_default()
}

fn number(text: &str) -> u32 {
    text.strip_prefix("#x").map_or_else(|| text.parse(), |hex| u32::from_str_radix(hex, 16)).unwrap()
}

fn attribute(node: Node<'_, '_>, name: &str) -> u32 {
    node.attribute(name).map(number).unwrap_or_else(|| panic!("no {name}"))
}

fn with_each(check: impl Fn(&Unit, Node<'_, '_>)) {
    for unit in units() {
        let document = Document::parse(&unit.esi).unwrap();
        check(&unit, find(document.root(), "Device"));
    }
}

/// Checks the units with a mailbox, and those without one; there are both.
fn with_each_kind(with: impl Fn(&Unit, Node<'_, '_>, Node<'_, '_>), without: impl Fn(&Unit, Node<'_, '_>)) {
    let mut counts = [0, 0];
    for unit in units() {
        let document = Document::parse(&unit.esi).unwrap();
        let device = find(document.root(), "Device");
        let has_mailbox = mailbox(device).map(|mailbox| with(&unit, device, mailbox)).is_some();
        if !has_mailbox {
            without(&unit, device);
        }
        counts[usize::from(has_mailbox)] += 1;
    }
    assert!(counts.iter().all(|&count| count > 0), "{counts:?}");
}

/// CRC-8 of reference 4.2, bit by bit.
fn crc8(bytes: &[u8]) -> u8 {
    bytes.iter().fold(0xFF, |crc, byte| {
        (0..8).fold(crc ^ byte, |crc, _| if crc & 0x80 == 0 { crc << 1 } else { (crc << 1) ^ 0x07 })
    })
}

/// C022
#[test]
fn word_7_is_the_checksum_of_the_words_before_it() {
    with_each(|unit, _| assert_eq!(unit.word(7), u16::from(crc8(&unit.sii[..14]))));
}

/// C023
#[test]
fn identity_is_the_same_in_both_files() {
    with_each(|unit, device| {
        let kind = find(device, "Type");
        let vendor = number(text(device.document().root_element(), "Id"));
        let esi = [vendor, attribute(kind, "ProductCode"), attribute(kind, "RevisionNo")];
        if mailbox(device).is_some() {
            assert_eq!(esi, [0x83, 0x17C, 0x10000], "the NX-ECT101");
        }
        assert_eq!([0x08, 0x0A, 0x0C].map(|address| unit.double_word(address)), esi);
    });
}

/// C024: CoE and nothing else, or no mailbox.
#[test]
fn protocols_are_those_of_the_mailbox_element() {
    let bits = [("AoE", 1), ("EoE", 2), ("CoE", 4), ("FoE", 8), ("SoE", 16), ("VoE", 32)];
    with_each_kind(
        |unit, _, mailbox| {
            let has = |name: &str| mailbox.children().any(|child| child.has_tag_name(name));
            let named = bits.iter().filter(|(name, _)| has(name));
            assert_eq!(named.map(|(_, bit)| bit).sum::<u16>(), unit.word(0x1C));
            assert_eq!(unit.word(0x1C), 4);
        },
        |unit, _| assert_eq!(unit.word(0x1C), 0),
    );
}

/// C025
#[test]
fn the_size_word_is_byte_size() {
    with_each(|unit, device| {
        let size_bytes = (u32::from(unit.word(0x3E)) + 1) * 128;
        assert_eq!(number(text(device, "ByteSize")), size_bytes);
        assert_eq!(unit.sii.len(), size_bytes as usize);
    });
}

/// C026
#[test]
fn words_0_to_6_are_config_data() {
    with_each(|unit, device| {
        let hex: String = unit.sii[..14].iter().map(|byte| format!("{byte:02X}")).collect();
        assert_eq!(text(device, "ConfigData").to_uppercase(), hex);
    });
}

/// C027: FMMU usages, SyncManagers, and the texts and CoE details of General.
#[test]
fn categories_agree_with_the_elements() {
    with_each(|unit, device| {
        let usage = |node: Node<'_, '_>| match node.text() {
            Some("Outputs") => 1,
            Some("Inputs") => 2,
            Some("MBoxState") => 3,
            other => panic!("{other:?}"),
        };
        let usages: Vec<u8> = device.children().filter(|node| node.has_tag_name("Fmmu")).map(usage).collect();
        assert_eq!(unit.rows(40)[..usages.len()], usages);
        let managers: Vec<_> = device.children().filter(|node| node.has_tag_name("Sm")).collect();
        assert_eq!(unit.rows(41).len(), 8 * managers.len());
        for (row, node) in unit.rows(41).chunks(8).zip(managers) {
            let word = |at: usize| u32::from(u16::from_le_bytes([row[at], row[at + 1]]));
            let found = [word(0), word(2), u32::from(row[4]), u32::from(row[6] & 1)];
            let names = ["StartAddress", "DefaultSize", "ControlByte", "Enable"];
            assert_eq!(found, names.map(|name| attribute(node, name)));
        }
        let general = unit.category(30);
        assert_eq!(general.len(), 32);
        assert_eq!(unit.string(general[2]), find(device, "Type").text().unwrap());
        if mailbox(device).is_none() {
            assert_eq!(general[5], 0, "no CoE without a mailbox");
            return;
        }
        let attributes = ["SdoInfo", "PdoAssign", "PdoConfig", "PdoUpload", "CompleteAccess"];
        let coe = find(device, "CoE");
        let set = |name: &str| u8::from(matches!(coe.attribute(name), Some("1" | "true")));
        let details = attributes.iter().enumerate().map(|(bit, name)| set(name) << (bit + 1)).sum::<u8>();
        assert_eq!(general[5], details | 1, "SDOs, and what the attributes say");
    });
}

/// C028
#[test]
fn the_controller_has_as_many_fmmus_and_sync_managers_as_the_esi_asks_for() {
    with_each(|unit, device| {
        let count = |name: &str| device.children().filter(|node| node.has_tag_name(name)).count();
        assert!(count("Fmmu") <= usize::from(unit.registers[4]));
        assert!(count("Sm") <= usize::from(unit.registers[5]));
        let has_process_data = count("RxPdo") + count("TxPdo") > 0;
        assert_eq!([count("Fmmu") > 0, count("Sm") > 0], [has_process_data; 2], "a coupler has none");
    });
}

/// C029: Y is MII (3), K is EBUS (2), and a port that is not listed does not exist (0).
#[test]
fn physics_are_the_port_descriptor() {
    with_each(|unit, device| {
        let code = |letter: char| match letter {
            'Y' => 3,
            'K' => 2,
            ' ' => 0,
            other => panic!("{other}"),
        };
        let ports = device.attribute("Physics").unwrap().chars().map(code);
        let descriptor = ports.enumerate().map(|(port, code)| code << (2 * port)).sum::<u8>();
        assert_eq!(descriptor, unit.registers[7]);
    });
}

/// C030
#[test]
fn the_esi_has_what_a_configurator_needs() {
    with_each(|_, device| {
        assert!(!text(device, "Name").is_empty());
        let groups = find(device.document().root(), "Groups");
        assert!(groups.descendants().any(|node| node.text() == Some(text(device, "GroupType"))));
        assert!(attribute(find(device, "Type"), "RevisionNo") > 0);
        let data_link_layer = mailbox(device).map(|mailbox| mailbox.attribute("DataLinkLayer"));
        assert!(matches!(data_link_layer, None | Some(Some("1" | "true"))));
    });
}

/// C035: the walk over the categories reaches the end, and finds them in the usual order.
#[test]
fn categories_end_where_their_lengths_say() {
    with_each(|unit, device| {
        let numbers: Vec<u16> = unit.categories().iter().map(|(number, _)| *number).collect();
        let elements = [(40, "Fmmu"), (41, "Sm"), (50, "TxPdo"), (51, "RxPdo")];
        let has = |name: &str| device.children().any(|node| node.has_tag_name(name));
        let of_elements = elements.into_iter().filter(|(_, name)| has(name)).map(|(number, _)| number);
        assert_eq!(numbers, [10, 30].into_iter().chain(of_elements).collect::<Vec<_>>());
        let strings = unit.category(10);
        assert!((1..=strings[0]).all(|number| !unit.string(number).is_empty()));
    });
}

/// C036
#[test]
fn mailbox_words_are_the_first_sync_managers() {
    let of_mailbox = |unit: &Unit| [0x18, 0x19, 0x1A, 0x1B].map(|address| unit.word(address));
    let with = |unit: &Unit, _: Node<'_, '_>, _: Node<'_, '_>| {
        let rows: Vec<u16> = unit.category(41)[..16]
            .chunks(8)
            .flat_map(|row| [u16::from_le_bytes([row[0], row[1]]), u16::from_le_bytes([row[2], row[3]])])
            .collect();
        assert_eq!(of_mailbox(unit).to_vec(), rows);
        assert_eq!(unit.category(41)[7], 1, "mailbox out");
        assert_eq!(unit.category(41)[15], 2, "mailbox in");
    };
    with_each_kind(with, |unit, _| assert_eq!(of_mailbox(unit), [0; 4]));
}

/// C037: no model has BOOT.
#[test]
fn without_boot_the_boot_words_are_0() {
    with_each(|unit, _| assert_eq!([0x14, 0x15, 0x16, 0x17].map(|address| unit.word(address)), [0; 4]));
}
