//! Mapping and assignment objects, written correctly and incorrectly.

use wire::{SdoAbort, SubIndex};

use super::*;
use crate::tables::object_table;
use crate::verdict::Configuration;

const INPUTS: ObjectIndex = ObjectIndex(0x1C13);

fn objects() -> PdoObjects {
    PdoObjects::of_table(&object_table())
}

fn write(mapping: &mut PdoObjects, index: u16, sub: u8, number: u32) -> Result<(), SdoAbort> {
    mapping.write(&object_table(), ObjectIndex(index), SubIndex(sub), &number.to_le_bytes())
}

/// Clears, writes elements, sets the count: as masters do it without complete access.
pub(crate) fn set(mapping: &mut PdoObjects, index: u16, elements: &[u32]) -> Result<(), SdoAbort> {
    write(mapping, index, 0, 0)?;
    for (sub, &element) in (1..).zip(elements) {
        write(mapping, index, sub, element)?;
    }
    write(mapping, index, 0, elements.len() as u32)
}

fn sizes(mapping: &PdoObjects) -> (usize, usize) {
    (mapping.size_bytes(Direction::MToC.assignment()), mapping.size_bytes(Direction::CToM.assignment()))
}

/// The entries 1 to `count` of the object `base`.
fn entries(base: u32, count: u32) -> Vec<u32> {
    (1..=count).map(|sub| base | sub << 8).collect()
}

#[test]
fn the_factory_setting_maps_180_and_183_bytes() {
    assert_eq!(sizes(&objects()), (180, 183));
}

#[test]
fn the_manuals_examples_have_the_manuals_sizes() {
    let mut mapping = objects();
    set(&mut mapping, 0x1601, &entries(0x7000_00F0, 40)).expect("40 entries");
    set(&mut mapping, 0x1A01, &entries(0x6000_00F0, 40)).expect("40 entries");
    assert_eq!(sizes(&mapping), (1200, 1203), "UINT arrays at maximum");

    for (index, base, count) in [
        (0x1601, 0x7000_00F0, 10),
        (0x1602, 0x7001_0050, 10),
        (0x1603, 0x7002_0020, 30),
        (0x1A01, 0x6000_00F0, 10),
    ] {
        set(&mut mapping, index, &entries(base, count)).expect("fits");
    }
    set(&mut mapping, 0x1A02, &entries(0x6001_0050, 10)).expect("fits");
    set(&mut mapping, 0x1A03, &entries(0x6002_0020, 30)).expect("fits");
    set(&mut mapping, 0x1C12, &[0x1601, 0x1602, 0x1603]).expect("fits");
    set(&mut mapping, 0x1C13, &[0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1BFE, 0x1BFF]).expect("fits");
    assert_eq!(sizes(&mapping), (520, 524), "UINT, BYTE and UDINT");
}

#[test]
fn the_operation_example_has_196_and_199_bytes() {
    let mut mapping = objects();
    set(&mut mapping, 0x1C12, &[0x1601, 0x1603]).expect("fits");
    set(&mut mapping, 0x1C13, &[0x1A00, 0x1A01, 0x1A03, 0x1BFE]).expect("fits");
    assert_eq!(sizes(&mapping), (196, 199));
}

#[test]
fn an_element_is_refused_while_subindex_0_is_not_0() {
    let mut mapping = objects();
    assert_eq!(write(&mut mapping, 0x1601, 1, 0x7000_01F0), Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED));
    assert_eq!(write(&mut mapping, 0x1C13, 1, 0x1A00), Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED));
}

#[test]
fn what_cannot_be_mapped_is_refused() {
    let mut mapping = objects();
    write(&mut mapping, 0x1601, 0, 0).expect("cleared");
    let missing = 0x7000_29F0;
    let not_mappable = 0x1018_0120;
    let other_length = 0x7000_0110;
    let count = 0x7000_0008;
    let padding = 0x0000_0008;
    for element in [missing, not_mappable, other_length, count, padding] {
        assert_eq!(write(&mut mapping, 0x1601, 1, element), Err(SdoAbort::NOT_MAPPABLE), "{element:08X}");
    }
    write(&mut mapping, 0x1C12, 0, 0).expect("cleared");
    for element in [0x1600, 0x1604, 0x1018, 0x7000, 0x1C13, 0x1601_0000] {
        assert_eq!(write(&mut mapping, 0x1C12, 1, element), Err(SdoAbort::NOT_MAPPABLE), "{element:04X}");
    }
}

#[test]
fn an_entry_of_another_data_set_is_left_to_the_rules() {
    let mut mapping = objects();
    set(&mut mapping, 0x1601, &[0x7001_0150, 0, 0x7000_01F0]).expect("all exist and can be mapped");
    set(&mut mapping, 0x1A01, &[0x6003_0101, 0x10F3_0401, 0x2002_0108]).expect("all exist and can be mapped");
    assert_eq!(sizes(&mapping), (40, 2 + 2 + 1));
}

#[test]
fn an_entry_of_the_other_direction_is_left_to_the_rules() {
    let mut mapping = objects();
    set(&mut mapping, 0x1601, &[0x6000_01F0, 0x6003_0101, 0x10F3_0401]).expect("all exist and can be mapped");
    set(&mut mapping, 0x1A01, &[0x7002_0120]).expect("exists and can be mapped");
    assert_eq!(sizes(&mapping), (31, 2 + 4 + 1), "240 + 1 + 1 bits there, 32 bits here");
    let wrong_length = 0x6000_0110;
    write(&mut mapping, 0x1601, 0, 0).expect("cleared");
    assert_eq!(write(&mut mapping, 0x1601, 1, wrong_length), Err(SdoAbort::NOT_MAPPABLE));
}

#[test]
fn a_pdo_of_the_other_direction_is_left_to_the_rules() {
    let mut mapping = objects();
    set(&mut mapping, 0x1C12, &[0x1601, 0x1A00, 0x1BFF]).expect("all are PDOs");
    set(&mut mapping, 0x1C13, &[0x1A00, 0x1601, 0x1602, 0x1603]).expect("all are PDOs");
    let outputs: Vec<ObjectIndex> = mapping.assigned(Direction::MToC.assignment()).collect();
    assert_eq!(outputs, [0x1601, 0x1A00, 0x1BFF].map(ObjectIndex));
    assert_eq!(sizes(&mapping), (180 + 2 + 1, 2 + 180 + 20 + 16));
}

/// Events of the rules that `object` violates with these elements, with the factory setting for all others.
fn events(object: u16, elements: &[u32]) -> Vec<String> {
    let mut mapping = objects();
    set(&mut mapping, object, elements).expect("all exist and can be mapped");
    let configuration = Configuration { pdo: PdoSettings::of_objects(&mapping), ..Configuration::factory() };
    let verdict = configuration.check();
    assert_eq!(verdict.plan.copies(Direction::MToC).copies(), [], "nothing is exchanged");
    verdict.findings.iter().map(|finding| finding.event.to_string()).collect()
}

#[test]
fn what_goes_the_other_way_raises_the_event_of_its_rule() {
    assert_eq!(events(0x1C12, &[0x1601, 0x1A00]), ["350A0000"], "a TxPDO besides the RxPDO");
    assert_eq!(events(0x1C12, &[0x1A00]), ["350A0000"], "a TxPDO in place of the RxPDO");
    assert_eq!(events(0x1C13, &[0x1A00, 0x1A01, 0x1601]), ["35090000"], "an RxPDO besides the TxPDOs");
    assert_eq!(events(0x1601, &[0x6000_01F0]), ["391E0000"], "an input");
    assert_eq!(events(0x1A01, &[0x7000_01F0]), ["391F0000"], "an output");
}

#[test]
fn what_the_largest_assignment_carries_still_has_a_length_of_16_bits() {
    let mut mapping = objects();
    set(&mut mapping, 0x1601, &entries(0x7000_00F0, 40)).expect("40 entries");
    set(&mut mapping, 0x1A01, &entries(0x6000_00F0, 40)).expect("40 entries");
    set(&mut mapping, 0x1C12, &[0x1601, 0x1A01, 0x1601]).expect("all are PDOs");
    set(&mut mapping, 0x1C13, &[0x1601, 0x1A01, 0x1601, 0x1A01, 0x1601, 0x1A01]).expect("all are PDOs");
    assert_eq!(sizes(&mapping), (3 * 1200, 6 * 1200));
}

#[test]
fn a_count_beyond_the_elements_is_refused() {
    let mut mapping = objects();
    for (index, count) in [(0x1601, 41), (0x1602, 11), (0x1603, 33), (0x1C12, 4), (0x1C13, 7), (0x1601, 256)]
    {
        assert_eq!(write(&mut mapping, index, 0, count), Err(SdoAbort::PDO_LENGTH_EXCEEDED), "{index:04X}");
    }
    assert_eq!(sizes(&mapping), (180, 183));
}

#[test]
fn elements_read_back_beyond_the_count_too() {
    let mapping = objects();
    let mut value = [0; 4];
    mapping.read(ObjectIndex(0x1601), SubIndex(40), &mut value).expect("exists");
    assert_eq!(value, 0x7000_28F0_u32.to_le_bytes());
    let mut count = [0];
    mapping.read(INPUTS, SubIndex::ZERO, &mut count).expect("exists");
    assert_eq!(count, [3]);
}

#[test]
fn an_entry_is_mapped_as_long_as_its_pdo_is_assigned_and_counts_it() {
    let mut mapping = objects();
    let mapped = |mapping: &PdoObjects, index, sub| mapping.is_mapped(ObjectIndex(index), SubIndex(sub));
    assert!(mapped(&mapping, 0x7000, 6) && !mapped(&mapping, 0x7000, 7) && !mapped(&mapping, 0x7000, 0));
    assert!(!mapped(&mapping, 0x7001, 1) && mapped(&mapping, 0x6003, 1));
    set(&mut mapping, 0x1C12, &[]).expect("no RxPDO");
    assert!(!mapped(&mapping, 0x7000, 6));
    set(&mut mapping, 0x1C13, &[0x1601]).expect("a PDO");
    assert!(mapped(&mapping, 0x7000, 6) && !mapped(&mapping, 0x6000, 1), "wrong as it is, it carries them");
}

#[test]
fn the_factory_setting_has_the_manuals_sizes() {
    let settings = factory();
    let sizes = |direction| (size_bytes(&settings, direction), data_bytes(&settings, direction));
    assert_eq!((sizes(Direction::MToC), sizes(Direction::CToM)), ((180, 180), (183, 180)));
    let inputs = settings.assignment(Direction::CToM.assignment());
    assert_eq!(inputs, [0x1A00, 0x1A01, 0x1BFE].map(ObjectIndex));
}

#[test]
fn an_entry_has_the_length_of_its_object() {
    let at = |index, sub| entry_at(EntryAddress { index: ObjectIndex(index), sub: SubIndex(sub) });
    assert_eq!(at(0x7000, 0x29).bit_length, 240, "beyond the highest subindex");
    assert_eq!((at(0x6003, 1).bit_length, at(0x5555, 1).bit_length), (1, 0));
    assert!(at(0, 0).is_empty() && !at(0x5555, 1).is_empty());
}
