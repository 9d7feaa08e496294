//! The map is complete, without duplicates, and fixed.

use std::collections::BTreeMap;

use nx_ect101::{DataSet, DataSetKind, Direction, IoAllocation};
use proptest::prelude::*;

use super::*;

/// Entries of the three data sets M to C, then C to M.
fn variables(counts: [[u8; 3]; 2]) -> DeviceVariables {
    let mut allocation = IoAllocation::empty();
    for (direction, counts) in Direction::ALL.into_iter().zip(counts) {
        for (kind, count) in DataSetKind::ALL.into_iter().zip(counts) {
            allocation.select(direction, kind, count);
        }
    }
    DeviceVariables::of(nx_ect101::variable_table("N1", 1, &allocation))
}

fn most() -> [[u8; 3]; 2] {
    Direction::ALL.map(|direction| DataSetKind::ALL.map(|kind| DataSet::of(direction, kind).max_count))
}

fn counts() -> impl Strategy<Value = [[u8; 3]; 2]> {
    most().map(|counts| counts.map(|most| 0..=most))
}

/// The meaning of each address of the map, by name.
fn meanings(variables: &DeviceVariables) -> BTreeMap<(&'static str, u16), String> {
    let map = ModbusMap::of(variables);
    let name = |target: Target| {
        let name = &variables.get(target.variable).expect("of this list").name;
        format!("{name}[{:?}]", target.element)
    };
    let mut meanings = BTreeMap::new();
    let mut add = |table: Table, address, meaning: String| {
        let before = meanings.insert((table.id(), address), meaning);
        assert_eq!(before, None, "two meanings of {} {address}", table.id());
    };
    for (table, registers) in
        [(Table::InputRegisters, &map.input_registers), (Table::HoldingRegisters, &map.holding_registers)]
    {
        for register in registers {
            let Register { target, start, writing, .. } = *register;
            add(table, register.address, format!("{} {start} {writing:?}", name(target)));
        }
    }
    for (table, bits) in [(Table::DiscreteInputs, &map.discrete_inputs), (Table::Coils, &map.coils)] {
        for bit in bits {
            add(table, bit.address, format!("{} {:?}", name(bit.target), bit.tells));
        }
    }
    meanings
}

fn addresses(range: &core::ops::RangeInclusive<u16>) -> Addresses {
    Addresses { first: *range.start(), quantity: range.end() - range.start() + 1 }
}

proptest! {
    #[test]
    fn every_variable_has_addresses_and_no_address_two_meanings(counts in counts()) {
        let variables = variables(counts);
        let map = ModbusMap::of(&variables);
        meanings(&variables);
        let named: Vec<_> = map.rows().iter().map(|row| row.variable).collect();
        prop_assert_eq!(named, variables.iter().map(|(id, _)| id).collect::<Vec<_>>());
        for row in map.rows() {
            let whole = addresses(&row.addresses);
            let is_there = match row.table {
                Table::Coils | Table::DiscreteInputs => map.bits(row.table, whole).is_ok(),
                Table::InputRegisters | Table::HoldingRegisters => map.registers(row.table, whole).is_ok(),
            };
            prop_assert!(is_there, "{:?}", row);
            if let Some(forced) = &row.forced {
                prop_assert!(map.registers(Table::HoldingRegisters, addresses(forced)).is_ok());
                prop_assert!(map.bits(Table::Coils, addresses(forced)).is_ok());
            }
        }
    }

    #[test]
    fn another_allocation_moves_nothing(counts in counts()) {
        let all = meanings(&variables(most()));
        for (place, meaning) in meanings(&variables(counts)) {
            prop_assert_eq!(all.get(&place), Some(&meaning));
        }
    }

    #[test]
    fn a_range_is_found_if_all_of_it_is_there(counts in counts(), first in 0..2_200_u16, quantity in 1..=125_u16) {
        let map = ModbusMap::of(&variables(counts));
        let expected: Vec<_> = map
            .input_registers
            .iter()
            .copied()
            .filter(|register| (first..first + quantity).contains(&register.address))
            .collect();
        let found = map.registers(Table::InputRegisters, Addresses { first, quantity });
        if expected.len() == usize::from(quantity) {
            prop_assert_eq!(found, Ok(expected.as_slice()));
        } else {
            prop_assert_eq!(found, Err(Exception::IllegalDataAddress));
        }
    }
}

#[test]
fn the_last_address_of_all_is_asked_for_without_harm() {
    let map = ModbusMap::of(&variables(most()));
    for quantity in [1, 2, 125] {
        let found = map.registers(Table::HoldingRegisters, Addresses { first: u16::MAX, quantity });
        assert_eq!(found, Err(Exception::IllegalDataAddress));
    }
}

#[test]
fn the_largest_data_set_is_forced_in_one_task_period() {
    let map = ModbusMap::of(&variables(most()));
    let coils = map.bits(Table::Coils, Addresses { first: 10_000, quantity: 600 });
    assert!(coils.is_ok_and(|coils| coils.len() <= plc::outside::CHANGES_MAX));
}

#[test]
fn the_places_are_those_of_the_page() {
    let variables = variables(most());
    let map = ModbusMap::of(&variables);
    let row = |name: &str| {
        let id = variables.find(name).expect(name);
        let row = map.rows().iter().find(|row| row.variable == id).expect(name);
        (row.table, row.addresses.clone(), row.forced.clone())
    };
    let (input, holding) = (Table::InputRegisters, Table::HoldingRegisters);
    assert_eq!(row("N1_UINTs_01_M_to_C"), (input, 0..=14, Some(20_000..=20_014)));
    assert_eq!(row("N1_UINTs_40_C_to_M"), (holding, 585..=599, Some(10_585..=10_599)));
    assert_eq!(row("N1_BYTES_10_C_to_M"), (holding, 1090..=1099, Some(11_090..=11_099)));
    assert_eq!(row("N1_UDINT_32_M_to_C"), (input, 2062..=2063, Some(22_062..=22_063)));
    assert_eq!(row("N1_EtherCAT_Slave_Status"), (input, 3000..=3000, None));
    let bits = Table::DiscreteInputs;
    assert_eq!(row("N1_Ready_to_Write_Message_Data_to_EtherCAT_Master"), (bits, 9..=9, None));
    assert_eq!(row("NXBus_N1_NX_Unit_Error_Status"), (bits, 17..=17, None));
    assert_eq!(row("_NXB_UnitErrFlagTbl"), (bits, 200..=232, None));
}
