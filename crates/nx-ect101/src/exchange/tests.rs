//! The exchange plan with its two images.

use coe_kit::exchange::ByteCopy;
use coe_kit::pdo::PdoObjects;
use proptest::prelude::*;
use wire::{ObjectIndex, SubIndex};

use super::*;
use crate::allocation::tests::symmetric;
use crate::allocation::{IoAllocation, IoEntry};
use crate::data_sets::{Assignment, DataSetKind};
use crate::pdo_settings::tests::set;
use crate::tables::object_table;

fn plan(mapping: &PdoObjects, allocation: &IoAllocation) -> ExchangePlan {
    let mut plan = ExchangePlan::empty();
    plan.rebuild(
        &PdoSettings::of_objects(mapping),
        &allocation.layout(Direction::MToC),
        &allocation.layout(Direction::CToM),
    );
    plan
}

fn factory() -> PdoObjects {
    PdoObjects::of_table(&object_table())
}

fn assign(mapping: &mut PdoObjects, direction: Direction, pdos: &[u32]) {
    set(mapping, Assignment::of(direction).object.0, pdos).expect("assignable");
}

#[test]
fn the_factory_setting_is_one_copy_each_way() {
    let plan = plan(&factory(), &IoAllocation::factory());
    assert_eq!(plan.m_to_c.copies(), [ByteCopy { from: 0, to: 0, length_bytes: 180 }]);
    assert_eq!(plan.c_to_m.copies(), [ByteCopy { from: 0, to: 2, length_bytes: 180 }]);
    assert_eq!(plan.status.len(), 6);
}

#[test]
fn only_what_both_sides_have_is_exchanged() {
    let fewer_on_the_cpu_side = plan(&factory(), &symmetric([2, 4, 0]));
    assert_eq!(fewer_on_the_cpu_side.m_to_c.copies(), [ByteCopy { from: 0, to: 0, length_bytes: 60 }]);
    let other_data_set_on_the_cpu_side = plan(&factory(), &symmetric([0, 2, 0]));
    assert_eq!(other_data_set_on_the_cpu_side.m_to_c.copies(), []);
}

#[test]
fn data_sets_meet_whatever_the_order_of_the_pdos() {
    let mut mapping = factory();
    assign(&mut mapping, Direction::MToC, &[0x1603, 0x1601]);
    let plan = plan(&mapping, &symmetric([6, 0, 4]));
    let udint = ByteCopy { from: 0, to: 180, length_bytes: 16 };
    assert_eq!(plan.m_to_c.copies(), [udint, ByteCopy { from: 16, to: 0, length_bytes: 180 }]);
}

#[test]
fn status_lies_where_its_pdos_are() {
    let mut mapping = factory();
    assign(&mut mapping, Direction::CToM, &[0x1BFF, 0x1A00, 0x1BFE]);
    let status = StatusToMaster { new_messages: true, sysmac_error: 0x30, ..StatusToMaster::default() };
    let mut inputs = [0; 4];
    plan(&mapping, &IoAllocation::factory()).put_status(status, &mut inputs);
    assert_eq!(inputs, [0x30, 0x10, 0x00, 0x01]);
}

/// Any elements that a master can write, right or wrong.
fn any_mapping() -> impl Strategy<Value = PdoObjects> {
    let subs = |max| prop::collection::vec(1..=max, 0..=usize::from(max));
    let pdo = || {
        let all = [0x1601, 0x1602, 0x1603, 0x1A00, 0x1A01, 0x1A02, 0x1A03, 0x1BFE, 0x1BFF];
        prop::sample::select(all.to_vec())
    };
    let rx = prop::collection::vec(pdo(), 0..=3);
    let tx = prop::collection::vec(pdo(), 0..=6);
    (subs(40u8), subs(10u8), subs(32u8), rx, tx, any::<bool>()).prop_map(
        |(uints, bytes, udints, rx, tx, bit)| {
            let mut mapping = factory();
            let kinds = [(0x00F0, uints), (0x0001_0050, bytes), (0x0002_0020, udints)];
            for ((base, subs), number) in kinds.into_iter().zip(1..) {
                for (pdo, area) in [(0x1600 + number, 0x7000_0000u32), (0x1A00 + number, 0x6000_0000)] {
                    let mut elements: Vec<u32> =
                        subs.iter().map(|&sub| area | base | u32::from(sub) << 8).collect();
                    match elements.first_mut() {
                        Some(first) if bit => *first = 0x6003_0101,
                        _ => {}
                    }
                    set(&mut mapping, pdo, &elements).expect("mappable");
                }
            }
            assign(&mut mapping, Direction::MToC, &rx);
            assign(&mut mapping, Direction::CToM, &tx);
            mapping
        },
    )
}

/// Any entries that a unit file can allocate, correct or not.
fn any_allocation() -> impl Strategy<Value = IoAllocation> {
    let entries = prop::collection::vec((0x6000..=0x6002u16, 1..=40u8), 0..40);
    prop::collection::vec(entries, 6).prop_map(|sets| {
        let mut allocation = IoAllocation::empty();
        let places = [Direction::MToC, Direction::CToM]
            .into_iter()
            .flat_map(|direction| DataSetKind::ALL.map(|kind| (direction, kind)));
        for ((direction, kind), entries) in places.zip(sets) {
            let area = if direction == Direction::CToM { 0x1000 } else { 0 };
            let entry = |(index, sub)| IoEntry { index: ObjectIndex(index + area), sub: SubIndex(sub) };
            allocation.allocate(direction, kind, entries.into_iter().map(entry).collect());
        }
        allocation
    })
}

proptest! {
    #[test]
    fn a_plan_never_leaves_either_image(mapping in any_mapping(), allocation in any_allocation()) {
        let plan = plan(&mapping, &allocation);
        let (outputs, inputs) = (mapping.size_bytes(Direction::MToC.assignment()), mapping.size_bytes(Direction::CToM.assignment()));
        let (m_to_c, c_to_m) = (allocation.layout(Direction::MToC), allocation.layout(Direction::CToM));
        for copy in plan.m_to_c.copies() {
            prop_assert!(copy.from + copy.length_bytes <= outputs);
            prop_assert!(copy.to + copy.length_bytes <= m_to_c.size_bytes());
        }
        for copy in plan.c_to_m.copies() {
            prop_assert!(copy.from + copy.length_bytes <= c_to_m.size_bytes());
            prop_assert!(copy.to + copy.length_bytes <= inputs);
        }
        for field in &plan.status {
            prop_assert!(field.bit_offset < inputs * 8);
        }
    }

    #[test]
    fn a_plan_is_no_larger_than_the_room_made_at_power_on(mapping in any_mapping()) {
        let plan = plan(&mapping, &symmetric([40, 10, 32]));
        prop_assert!(plan.m_to_c.copies().len().max(plan.c_to_m.copies().len()).max(plan.status.len()) <= MAX_ENTRIES);
    }
}
