//! Any bytes are read or refused with a place, in memory of a limited multiple of the file.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::path::Path;

use esi::file::{DeviceElement, EsiFile, ReadError};
use esi::lint::finding::Findings;
use proptest::prelude::*;

/// Memory for each byte of a file as vendors write them.
const BYTES_PER_BYTE_MAX: u64 = 20;
/// The same for a file of nothing but tags: the vector of their nodes is there three times while it grows, of which the
/// system gives memory to one only.
const BYTES_PER_BYTE_OF_TAGS_MAX: u64 = 32;
/// What is limited in number, whatever the length of the file: a vector of 10,000 devices as it grows, 1,000 findings.
const LIMITED_IN_NUMBER_BYTES: u64 = 25_000 * size_of::<DeviceElement>() as u64 + 1_000_000;

/// A file as `Devices` of an ESI file, with other elements before them.
fn file(descriptions: &str) -> Vec<u8> {
    let head = "<EtherCATInfo><Vendor><Id>1</Id></Vendor><Descriptions>";
    format!("{head}{descriptions}</Descriptions></EtherCATInfo>").into_bytes()
}

fn devices(device: &str, count: usize) -> Vec<u8> {
    file(&format!("<Devices>{}</Devices>", device.repeat(count)))
}

fn own(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/esi").join(name)).unwrap()
}

/// A file of the project with all its devices many times.
fn many(name: &str, count: usize) -> Vec<u8> {
    let text = String::from_utf8(own(name)).unwrap();
    let (before, rest) = text.split_once("<Devices>").unwrap();
    let (inside, after) = rest.split_once("</Devices>").unwrap();
    format!("{before}<Devices>{}</Devices>{after}", inside.repeat(count)).into_bytes()
}

/// The same without blanks between elements.
fn compact(bytes: Vec<u8>) -> Vec<u8> {
    let text = String::from_utf8(bytes).unwrap();
    text.lines().map(str::trim).collect::<String>().into_bytes()
}

/// Files that a tree, a model or a table of objects can make long.
fn long_files() -> Vec<(&'static str, Vec<u8>)> {
    let of_type = |count: usize| {
        let objects: String = (0x1000..0x1000 + count)
            .map(|index| format!("<Object><Index>#x{index:X}</Index><Type>A</Type></Object>"))
            .collect();
        let types = "<DataType><Name>E</Name><BaseType>BOOL</BaseType><ArrayInfo><LBound>1</LBound><Elements>255</Elements></ArrayInfo></DataType><DataType><Name>A</Name><SubItem><SubIdx>0</SubIdx><Type>USINT</Type><BitSize>8</BitSize></SubItem><SubItem><Type>E</Type><BitSize>255</BitSize></SubItem></DataType>";
        format!(
            "<Device><Profile><Dictionary><DataTypes>{types}</DataTypes><Objects>{objects}</Objects></Dictionary></Profile></Device>"
        )
    };
    let command = |count: usize| {
        let transitions = "<Transition>PS</Transition>".repeat(count);
        let data = "00".repeat(20 * count);
        format!(
            "<Device><Mailbox><CoE><InitCmd>{transitions}<Index>1</Index><Data>{data}</Data></InitCmd></CoE></Mailbox></Device>"
        )
    };
    vec![
        ("encoders", many("encoder.xml", 40)),
        ("encoders without blanks", compact(many("encoder.xml", 40))),
        ("terminals without blanks", compact(many("digital-terminals.xml", 40))),
        ("empty devices", devices("<Device/>", 9_000)),
        ("empty elements", devices("<a/>", 50_000)),
        ("attributes", devices("<a b=\"\" c=\"\" d=\"\" e=\"\"/>", 20_000)),
        ("empty FMMUs", devices(&format!("<Device>{}</Device>", "<Fmmu/>".repeat(50_000)), 1)),
        ("empty SyncManagers", devices(&format!("<Device>{}</Device>", "<Sm/>".repeat(50_000)), 1)),
        (
            "empty modules",
            file(&format!(
                "<Modules>{}</Modules>",
                "<Module><Type ModuleIdent=\"1\"/></Module>".repeat(9_000)
            )),
        ),
        ("wrong numbers", devices("<Device><Fmmu Sm=\"x\"/></Device>", 9_000)),
        ("arrays of 255", devices(&of_type(2_000), 1)),
        ("transitions of long data", devices(&command(5_000), 1)),
        ("lines", devices("\n", 200_000)),
        ("a text", devices(&"x".repeat(200_000), 1)),
        ("depth", devices(&format!("{}{}", "<a>".repeat(20_000), "</a>".repeat(20_000)), 1)),
    ]
}

#[test]
fn memory_is_bounded_by_the_length_of_the_file() {
    let mut beyond = Vec::new();
    for (name, bytes) in long_files() {
        let mut read = None;
        let used = allocation_counter::measure(|| read = Some(EsiFile::read(&bytes, &|_| None)));
        let is_limited = ["empty devices", "wrong numbers"].contains(&name);
        let limited = if is_limited { LIMITED_IN_NUMBER_BYTES } else { 0 };
        let factor = used.bytes_max.saturating_sub(limited) / bytes.len() as u64;
        println!(
            "{name}: {} bytes, {factor} times as much memory, read: {}",
            bytes.len(),
            read.unwrap().is_ok()
        );
        let max = if name == "depth" { BYTES_PER_BYTE_OF_TAGS_MAX } else { BYTES_PER_BYTE_MAX };
        if factor > max {
            beyond.push((name, factor));
        }
    }
    assert_eq!(beyond, []);
}

#[test]
fn findings_are_limited_in_number() {
    let file = EsiFile::read(&devices("<Device><Fmmu Sm=\"x\"/></Device>", 9_000), &|_| None).unwrap();
    assert_eq!(file.findings.list().len(), Findings::MAX);
    assert!(file.findings.omitted() > 9_000, "{}", file.findings.omitted());
}

#[test]
fn what_is_no_esi_file_is_refused_with_place_and_way_out() {
    let dtd = "<!DOCTYPE a [<!ENTITY b \"&c;&c;\"><!ENTITY c \"cccc\">]><EtherCATInfo>&b;</EtherCATInfo>";
    let told = |text: &str| match EsiFile::read(text.as_bytes(), &|_| None) {
        Ok(_) => "read".to_owned(),
        Err(error) => {
            let place = error.place().map(|place| place.to_string());
            format!("{}: {error}", place.unwrap_or_default())
        }
    };
    for (text, message) in [
        ("", "1:1: the file is not well-formed XML: there is no element"),
        ("model = \"esi\"", "1:1: the file is not well-formed XML: unknown token"),
        (dtd, "1:1: the file is not well-formed XML: a document type declaration is not accepted"),
        ("<EtherCATInfo>\n <a>", "2:5: the file is not well-formed XML: the file ends too early"),
        ("<EtherCATInfo>\n<a></b>", "2:4: the file is not well-formed XML: `</b>` where `</a>` is expected"),
        (
            "<EtherCATInfo>&b;</EtherCATInfo>",
            "1:15: the file is not well-formed XML: unknown entity reference 'b'",
        ),
        ("<EtherCATConfig/>", "1:1: the root element is `EtherCATConfig`, expected `EtherCATInfo`"),
    ] {
        assert_eq!(told(text), message, "{text}");
    }
    let long = vec![b' '; ReadError::LENGTH_BYTES_MAX + 1];
    assert!(matches!(EsiFile::read(&long, &|_| None), Err(ReadError::TooLong { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_damage_is_read_or_refused_with_a_place(
        name in proptest::sample::select(vec!["encoder.xml", "modular.xml", "drive.xml", "digital-terminals.xml", "valves.xml"]),
        damage in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 0..6),
        (cut, length) in any::<(proptest::sample::Index, u8)>(),
        (copied, to) in any::<(proptest::sample::Index, proptest::sample::Index)>(),
    ) {
        let mut bytes = own(name);
        for (at, value) in damage {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let cut = cut.index(bytes.len());
        bytes.drain(cut..(cut + usize::from(length)).min(bytes.len()));
        let copied = copied.index(bytes.len());
        let piece = bytes[copied..(copied + 300).min(bytes.len())].to_vec();
        let to = to.index(bytes.len());
        bytes.splice(to..to, piece);
        match EsiFile::read(&bytes, &|_| None) {
            Ok(file) => for device in &file.devices {
                let _ = (device.description(), device.objects());
            },
            Err(ReadError::NotXml { place, reason }) => {
                prop_assert!(place.line > 0 && place.column > 0 && !reason.is_empty());
            }
            Err(_) => {}
        }
    }

    #[test]
    fn any_values_are_read(
        name in proptest::sample::select(vec!["encoder.xml", "modular.xml", "analog-inputs.xml"]),
        value in "(#x)?[0-9A-Fa-f-]{0,12}",
        at in any::<proptest::sample::Index>(),
    ) {
        let text = String::from_utf8(own(name)).unwrap();
        let places: Vec<usize> = text.match_indices(['>', '"']).map(|(at, _)| at + 1).collect();
        let start = places[at.index(places.len())];
        let end = text[start..].find(['<', '"', '>']).map_or(start, |length| start + length);
        let changed = format!("{}{value}{}", &text[..start], &text[end..]);
        if let Ok(file) = EsiFile::read(changed.as_bytes(), &|_| None) {
            for device in &file.devices {
                let _ = (device.description(), device.objects());
            }
        }
    }
}
