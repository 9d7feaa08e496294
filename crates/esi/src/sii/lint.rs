//! The findings of a conformance test in an EEPROM image.

use core::fmt;

use super::contents::{Header, SiiContents};
use super::layout::{self, category};
use super::{SiiError, checksum, parse};
use crate::{DeviceDescription, MailboxArea, MailboxProtocols, Pdo, PdoEntry, PortPhysics, SyncManagerType};

/// One defect of an image: a fact with its numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The statement that it violates: C022 to C037 of the conformance list.
    pub check: &'static str,
    /// The place.
    pub place: String,
    /// The value found.
    pub found: String,
    /// The expected value.
    pub expected: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { check, place, found, expected } = self;
        write!(formatter, "{place}: {found}, expected {expected} ({check})")
    }
}

/// Findings from the image alone, empty if there are none.
#[must_use]
pub fn lint(image: &[u8]) -> Vec<Finding> {
    let contents = match parse(image) {
        Ok(contents) => contents,
        Err(error) => return vec![unreadable(error)],
    };
    let mut findings = Vec::new();
    check_header(&contents.header, image.len(), &mut findings);
    check_categories(&contents, &mut findings);
    check_mailbox(&contents, &mut findings);
    check_general(&contents, &mut findings);
    check_pdos(&contents, &mut findings);
    findings
}

/// Findings in which the image differs from the image of `description`: identity, mailbox, sizes, categories. Texts are
/// compared, not their numbers; what only names a text differs without effect on a master.
#[must_use]
pub fn compare(image: &[u8], description: &DeviceDescription) -> Vec<Finding> {
    let (actual, expected) = match (parse(image), super::try_image(description)) {
        (Ok(actual), Ok(expected)) => (actual, parse(&expected).unwrap_or_default()),
        (Err(error), _) => return vec![unreadable(error)],
        (_, Err(error)) => return vec![finding("C027", "description", error, "one that fits".into())],
    };
    let mut findings = Vec::new();
    compare_headers(&actual.header, &expected.header, &mut findings);
    let mut same = |check, place: &str, equal: bool| {
        if !equal {
            findings.push(finding(check, place, "differs", "as in the description".into()));
        }
    };
    let (actual, expected) = (actual.description(), expected.description());
    same("C027", "general category", general(&actual) == general(&expected));
    same("C027", "FMMU category", actual.fmmus == expected.fmmus);
    same("C027", "SyncM category", actual.sync_managers == expected.sync_managers);
    compare_pdos("TxPDO", &actual.tx_pdos, &expected.tx_pdos, &mut findings);
    compare_pdos("RxPDO", &actual.rx_pdos, &expected.rx_pdos, &mut findings);
    findings
}

/// What category 30 says of a device.
fn general(description: &DeviceDescription) -> impl PartialEq {
    (
        [description.order_code.clone(), description.name.clone(), description.group.group_type.clone()],
        (description.ports, description.general_flags, description.identification_offset),
        (description.ebus_current_ma, description.mailbox.as_ref().map(|mailbox| mailbox.coe_details)),
    )
}

/// Each PDO that differs, is missing, or is there in addition.
fn compare_pdos(kind: &str, actual: &[Pdo], expected: &[Pdo], findings: &mut Vec<Finding>) {
    let of = |pdos: &'_ [Pdo], index| pdos.iter().find(|pdo| pdo.index == index).map(outline);
    let known = expected.iter().map(|pdo| pdo.index);
    let added = actual.iter().map(|pdo| pdo.index).filter(|index| of(expected, *index).is_none());
    for index in known.chain(added) {
        let [found, wanted] = [actual, expected].map(|pdos| of(pdos, index));
        if found != wanted {
            let place = format!("{kind} {index}");
            let [found, wanted] = [found, wanted].map(|outline| outline.unwrap_or_else(|| "missing".into()));
            findings.push(finding("C027", &place, found, wanted));
        }
    }
}

/// A PDO as a master sees it.
fn outline(pdo: &Pdo) -> String {
    let entry = |entry: &PdoEntry| format!("{:04X}:{} {} bits", entry.index.0, entry.sub, entry.bit_length);
    let entries: Vec<String> = pdo.entries.iter().map(entry).collect();
    let place =
        pdo.sync_manager.map_or_else(|| "not assigned".into(), |number| format!("SyncManager {number}"));
    format!("{place}, {}", if entries.is_empty() { "empty".into() } else { entries.join(", ") })
}

fn compare_headers(actual: &Header, expected: &Header, findings: &mut Vec<Finding>) {
    let rows = [
        ("C023", "vendor ID", actual.vendor_id, expected.vendor_id),
        ("C023", "product code", actual.product_code, expected.product_code),
        ("C023", "revision number", actual.revision, expected.revision),
        ("C024", "mailbox protocols", actual.protocols.bits().into(), expected.protocols.bits().into()),
        ("C025", "size word", actual.size_word.into(), expected.size_word.into()),
    ];
    for (check, place, found, wanted) in rows {
        if found != wanted {
            findings.push(finding(check, place, format!("{found:#X}"), format!("{wanted:#X}")));
        }
    }
    if actual.configuration != expected.configuration {
        let (found, wanted) = (hex(&actual.configuration), hex(&expected.configuration));
        findings.push(finding("C026", "words 0 to 6", found, wanted));
    }
}

fn check_header(header: &Header, length_bytes: usize, findings: &mut Vec<Finding>) {
    let right = u16::from(checksum(&header.configuration));
    if header.checksum != right {
        let found = format!("{:#06X}", header.checksum);
        findings.push(finding("C022", "checksum in word 7", found, format!("{right:#06X}")));
    }
    if usize::try_from(header.size_bytes()) != Ok(length_bytes) {
        let found = format!("{} bytes (word {:#06X})", header.size_bytes(), header.size_word);
        findings.push(finding("C025", "size in word 0x3E", found, format!("{length_bytes} bytes")));
    }
    if header.version != layout::CURRENT_VERSION {
        findings.push(finding(
            "C025",
            "version in word 0x3F",
            header.version,
            layout::CURRENT_VERSION.to_string(),
        ));
    }
    let areas = [header.bootstrap_receive, header.bootstrap_send];
    let told = areas.iter().filter(|area| **area != MailboxArea::default()).count();
    let usable = areas.iter().filter(|area| area.start != 0 && area.length_bytes != 0).count();
    if told != 0 && usable != 2 {
        let found = format!("{:?} and {:?}", areas[0], areas[1]);
        findings.push(finding(
            "C037",
            "BOOT mailbox in words 0x14 to 0x17",
            found,
            "both areas or none".into(),
        ));
    }
}

fn check_categories(contents: &SiiContents, findings: &mut Vec<Finding>) {
    // A coupler has no process data, and no SyncManagers or FMMUs for process data.
    let has_data = contents.carries_data();
    let needed = [
        (category::STRINGS, "category 10 (strings)", true),
        (category::GENERAL, "category 30 (general)", true),
        (category::FMMU, "category 40 (FMMU)", has_data),
        (category::SYNC_MANAGER, "category 41 (SyncM)", has_data),
    ];
    for (number, place, is_needed) in needed {
        if is_needed && !contents.has_category(number) {
            findings.push(finding("C027", place, "missing", "one".into()));
        }
    }
    for category in &contents.categories {
        let (step, place) = match category.number {
            category::GENERAL => (layout::GENERAL_BYTES, "length of category 30"),
            category::SYNC_MANAGER => (layout::SYNC_MANAGER_BYTES, "length of category 41"),
            _ => continue,
        };
        let exact = category.number != category::GENERAL || category.length_bytes == step;
        if !exact || category.length_bytes % step != 0 {
            let found = format!("{} bytes", category.length_bytes);
            let kind = if category.number == category::GENERAL { "exactly" } else { "a multiple of" };
            findings.push(finding("C035", place, found, format!("{kind} {step} bytes")));
        }
    }
}

fn check_mailbox(contents: &SiiContents, findings: &mut Vec<Finding>) {
    let header = &contents.header;
    let unknown = header.protocols.bits() & !MailboxProtocols::all().bits();
    if unknown != 0 {
        let found = format!("undefined bits {unknown:#06X}");
        findings.push(finding("C024", "mailbox protocols in word 0x1C", found, "0 there".into()));
    }
    let pairs = [
        (SyncManagerType::MailboxOut, header.receive, "receive mailbox in words 0x18 and 0x19"),
        (SyncManagerType::MailboxIn, header.send, "send mailbox in words 0x1A and 0x1B"),
    ];
    for (usage, area, place) in pairs {
        let sync_manager = contents.sync_managers.iter().find(|candidate| candidate.usage == usage);
        let (start, length) = sync_manager.map_or((0, 0), |found| (found.start, found.length_bytes));
        if (area.start, area.length_bytes) != (start, length) {
            let found = format!("{:#06X}, {} bytes", area.start, area.length_bytes);
            let expected = format!("{start:#06X}, {length} bytes as in category 41");
            findings.push(finding("C036", place, found, expected));
        }
    }
}

fn check_general(contents: &SiiContents, findings: &mut Vec<Finding>) {
    let Some(general) = &contents.general else { return };
    let bits = [
        ("CoE details in category 30", general.coe_details.bits() & !crate::CoeDetails::all().bits()),
        ("flags in category 30", general.flags.bits() & !crate::GeneralFlags::all().bits()),
    ];
    for (place, unknown) in bits {
        if unknown != 0 {
            findings.push(finding("C027", place, format!("undefined bits {unknown:#04X}"), "0 there".into()));
        }
    }
    for (port, physics) in general.ports.iter().enumerate() {
        if let PortPhysics::Other(code) = physics {
            let place = format!("port {port} in category 30");
            findings.push(finding("C029", &place, code, "0, 1, 3 or 4".into()));
        }
    }
    for number in [general.group, general.image, general.order_code, general.name] {
        check_text(contents, number, "category 30", findings);
    }
}

fn check_pdos(contents: &SiiContents, findings: &mut Vec<Finding>) {
    for pdo in contents.tx_pdos.iter().chain(&contents.rx_pdos) {
        let place = format!("PDO {}", pdo.index);
        let count = contents.sync_managers.len();
        if let Some(number) = pdo.sync_manager.filter(|number| usize::from(*number) >= count) {
            let found = format!("SyncManager {number}");
            findings.push(finding("C027", &place, found, format!("one of the {count} in category 41")));
        }
        for number in pdo.entries.iter().map(|entry| entry.name).chain([pdo.name]) {
            check_text(contents, number, &place, findings);
        }
    }
}

fn check_text(contents: &SiiContents, number: u8, place: &str, findings: &mut Vec<Finding>) {
    if contents.string(number).is_none() {
        let expected = format!("0 to {}", contents.strings.len());
        findings.push(finding("C035", place, format!("text number {number}"), expected));
    }
}

fn unreadable(error: SiiError) -> Finding {
    finding("C035", "image", error, "an image whose lengths agree".into())
}

fn finding(check: &'static str, place: &str, found: impl fmt::Display, expected: String) -> Finding {
    Finding { check, place: place.into(), found: found.to_string(), expected }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}
