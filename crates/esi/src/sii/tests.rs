use proptest::prelude::*;

use super::*;
use crate::tests::small_device;
use crate::{DeviceDescription, FmmuUsage, PortPhysics};

/// Words 0 to 6 of a drive with its stored checksum, and the `ConfigData` of a published ESI sample.
const VECTORS: [([u8; 14], u8); 2] = [
    ([0x05, 0x06, 0x0B, 0x0E, 0x64, 0, 0, 0, 0, 0, 0, 0, 0, 0], 0x40),
    ([0x05, 0x0E, 0x03, 0x06, 0x10, 0x27, 0, 0, 0, 0, 0, 0, 0, 0], 0xD7),
];

#[test]
fn the_checksum_is_that_of_the_field() {
    for (configuration, crc) in VECTORS {
        assert_eq!(checksum(&configuration), crc);
    }
}

#[test]
fn an_image_has_the_size_of_the_eeprom_and_no_finding() {
    let description = small_device();
    let image = image(&description);
    assert_eq!(image.len(), 2048);
    assert_eq!(lint(&image), []);
    assert_eq!(compare(&image, &description), []);
}

/// C027: FMMUs and SyncManagers exist only for data.
#[test]
fn a_device_without_data_needs_no_fmmu_and_no_sync_manager() {
    let empty = DeviceDescription { mailbox: None, fmmus: vec![], sync_managers: vec![], ..small_device() };
    let missing = lint(&image(&empty)).into_iter().map(|finding| finding.place).collect::<Vec<_>>();
    assert!(missing.contains(&"category 40 (FMMU)".into()), "{missing:?}");
    let coupler = DeviceDescription { rx_pdos: vec![], tx_pdos: vec![], ..empty };
    assert_eq!(lint(&image(&coupler)), []);
}

#[test]
fn an_image_reads_back() {
    let description = small_device();
    let contents = parse(&image(&description)).unwrap();
    let header = &contents.header;
    assert_eq!((header.vendor_id, header.product_code, header.revision), (0x83, 0x1234, 0x10000));
    assert_eq!((header.size_word, header.size_bytes(), header.version), (0x000F, 2048, 1));
    assert_eq!(header.station_alias(), 0x0102);
    assert_eq!(header.receive, description.mailbox.as_ref().unwrap().receive);
    let general = contents.general.as_ref().unwrap();
    assert_eq!(contents.string(general.order_code), Some("MINI-1"));
    assert_eq!(contents.string(general.name), Some("Small device"));
    assert_eq!(
        general.ports,
        [PortPhysics::Mii, PortPhysics::Ebus, PortPhysics::Unused, PortPhysics::Unused]
    );
    assert_eq!(
        contents.fmmus,
        [FmmuUsage::Outputs, FmmuUsage::Inputs, FmmuUsage::MailboxState, FmmuUsage::Unused]
    );
    let bits: Vec<u32> = contents
        .tx_pdos
        .iter()
        .map(|pdo| pdo.entries.iter().map(|entry| u32::from(entry.bit_length)).sum())
        .collect();
    assert_eq!(bits, [16, 8]);
    assert_eq!(contents.tx_pdos.iter().map(|pdo| pdo.sync_manager).collect::<Vec<_>>(), [Some(3), None]);
    assert_eq!(contents.rx_pdos[0].entries[0].data_type, wire::DataType::UNSIGNED16);
}

#[test]
fn categories_stand_in_the_order_of_the_field() {
    let contents = parse(&image(&small_device())).unwrap();
    let categories: Vec<(u16, usize)> =
        contents.categories.iter().map(|category| (category.number, category.length_bytes)).collect();
    assert_eq!(categories.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [10, 30, 40, 41, 50, 51]);
    assert_eq!(categories[1].1, 32);
}

#[test]
fn what_does_not_fit_is_refused_with_place_value_and_limit() {
    let mut description = small_device();
    description.eeprom_bytes = 256;
    let error = try_image(&description).unwrap_err();
    insta::assert_snapshot!(error, @"EEPROM size: contents take 344 bytes, limit 256");
    description.eeprom_bytes = 2000;
    let error = try_image(&description).unwrap_err();
    insta::assert_snapshot!(error, @"EEPROM size: 2000 bytes, expected 128 to 8388608 in steps of 128");
    description.eeprom_bytes = 2048;
    description.name = "x".repeat(256);
    let error = try_image(&description).unwrap_err();
    insta::assert_snapshot!(error, @"SII string `xxxxxxxxxxxxxxxxxxxx...`: 256 bytes, limit 255");
}

#[test]
fn lint_names_place_value_and_expectation() {
    let mut image = image(&small_device());
    image[14] ^= 0xFF;
    image[124] = 0x07;
    image[48] = 0x34;
    image[57] = 0x80;
    let findings: Vec<String> = lint(&image).iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(findings.join("\n"), @"
    checksum in word 7: 0x0007, expected 0x00F8 (C022)
    size in word 0x3E: 1024 bytes (word 0x0007), expected 2048 bytes (C025)
    mailbox protocols in word 0x1C: undefined bits 0x8000, expected 0 there (C024)
    receive mailbox in words 0x18 and 0x19: 0x1034, 128 bytes, expected 0x1000, 128 bytes as in category 41 (C036)
    ");
}

/// A controller does not load such an image.
#[test]
fn the_high_byte_of_the_checksum_is_looked_at() {
    let mut image = image(&small_device());
    image[15] = 1;
    assert_eq!(lint(&image).iter().map(|finding| finding.check).collect::<Vec<_>>(), ["C022"]);
}

#[test]
fn compare_names_what_differs() {
    let mut description = small_device();
    let image = image(&description);
    description.revision = 0x20000;
    description.esc_configuration[0] = 0;
    description.fmmus.pop();
    description.tx_pdos[1].entries[0].bit_length = 16;
    let findings: Vec<String> = compare(&image, &description).iter().map(ToString::to_string).collect();
    insta::assert_snapshot!(findings.join("\n"), @"
    revision number: 0x10000, expected 0x20000 (C023)
    words 0 to 6: 800E00CC8813FF00020100000000, expected 000000CC8813FF00020100000000 (C026)
    FMMU category: differs, expected as in the description (C027)
    TxPDO 0x1A01: not assigned, 6000:02 8 bits, expected not assigned, 6000:02 16 bits (C027)
    ");
}

#[test]
fn a_blank_eeprom_is_empty_of_categories() {
    let blank = [0xFF; 2048];
    assert_eq!(parse(&blank).unwrap().categories, []);
    assert!(lint(&blank).iter().any(|finding| finding.check == "C022"));
}

/// The image of the description of an image is that image: there is one writer.
#[test]
fn an_image_is_made_again_from_its_description() {
    let mut description = small_device();
    for mailbox in [description.mailbox.clone(), None] {
        description.mailbox = mailbox;
        let image = image(&description);
        assert_eq!(try_image(&parse(&image).unwrap().description()), Ok(image));
    }
}

#[test]
fn a_description_has_what_the_image_has() {
    let description = small_device();
    let read = parse(&image(&description)).unwrap().description();
    assert_eq!(read.vendor.id, description.vendor.id);
    assert_eq!(read.group.group_type, description.group.group_type);
    assert_eq!((&read.order_code, &read.name), (&description.order_code, &description.name));
    assert_eq!(read.mailbox, description.mailbox);
    assert_eq!((&read.rx_pdos, &read.tx_pdos), (&description.rx_pdos, &description.tx_pdos));
    assert_eq!(read.fmmus, description.fmmus);
    assert_eq!(read.esc_configuration, description.esc_configuration);
}

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..2048)) {
        let _ = parse(&bytes);
        let _ = lint(&bytes);
        let _ = compare(&bytes, &small_device());
    }

    #[test]
    fn any_damage_to_an_image_is_read_or_refused(
        damage in proptest::collection::vec((0usize..512, any::<u8>()), 0..8),
        length in 0usize..=2048,
    ) {
        let mut image = image(&small_device());
        for (at, value) in damage {
            image[at] = value;
        }
        image.truncate(length);
        let _ = parse(&image).map(|contents| contents.description());
        let _ = lint(&image);
    }

    #[test]
    fn identity_and_configuration_survive(words in any::<[u16; 4]>(), numbers in any::<[u32; 4]>(), alias: u16) {
        let mut description = small_device();
        description.esc_configuration = words;
        description.station_alias = alias;
        description.vendor.id = numbers[0];
        (description.product_code, description.revision, description.serial) = (numbers[1], numbers[2], numbers[3]);
        let image = image(&description);
        let header = parse(&image).unwrap().header;
        prop_assert_eq!([header.vendor_id, header.product_code, header.revision, header.serial], numbers);
        prop_assert_eq!(header.station_alias(), alias);
        prop_assert_eq!(lint(&image), vec![]);
    }
}
