//! The map is complete, without duplicates, and fixed.

use std::collections::BTreeMap;

use nx_ect101::{DataSet, DataSetKind, Direction, IoAllocation};
use plc::{Area, BusUnit, ModbusAddress, Place, StatusWord, VariableAccess, VariableTable, VariableType};
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

/// A terminal of 16 outputs and 16 inputs, the inputs with places for forced values.
fn terminal() -> DeviceVariables {
    let channel = |name: &str, area, access, number: u8, forced: Option<u16>| Variable {
        name: format!("K1_{name}_{number}"),
        port: None,
        at: None,
        variable_type: VariableType::single(plc::Elementary::Bool),
        access,
        place: Place::bit(area, usize::from(number - 1)),
        series: None,
        modbus: Some(ModbusAddress { forced, ..ModbusAddress::at(1_000 + u16::from(number)) }),
        nx_object: None,
        pdo_entry: None,
    };
    let outputs =
        (1..=16).map(|number| channel("Output", Area::MToC, VariableAccess::ReadOnly, number, None));
    let inputs = (1..=16).map(|number| {
        channel("Input", Area::CToM, VariableAccess::ReadWrite, number, Some(5_000 + u16::from(number)))
    });
    let unit = BusUnit {
        device_name: "K1".into(),
        unit_number: 1,
        m_to_c_bytes: 2,
        c_to_m_bytes: 2,
        status: StatusWord::default(),
    };
    DeviceVariables::of(VariableTable::new(unit, outputs.chain(inputs).collect()))
}

#[test]
fn single_bits_are_discrete_inputs_and_coils_and_are_forced_by_registers_of_one_bit() {
    let variables = terminal();
    let map = ModbusMap::of(&variables);
    meanings(&variables);
    let bits = |table, first| map.bits(table, Addresses { first, quantity: 16 }).map(<[Bit]>::to_vec);
    let target = |name: &str| Target::from(variables.find(name).expect(name));
    let output = bits(Table::DiscreteInputs, 1_001).expect("16 outputs")[2];
    assert_eq!((output.target, output.tells), (target("K1_Output_3"), BitTells::Value(0)));
    let input = bits(Table::Coils, 1_001).expect("16 inputs")[15];
    assert_eq!((input.target, input.tells), (target("K1_Input_16"), BitTells::Value(0)));
    let forced = bits(Table::Coils, 5_001).expect("16 inputs")[0];
    assert_eq!((forced.target, forced.tells), (target("K1_Input_1"), BitTells::IsForced));
    let register = map.registers(Table::HoldingRegisters, Addresses::one(5_001)).expect("a register")[0];
    assert_eq!((register.greatest, register.length_bytes, register.writing), (1, 1, Writing::Forces));
}

/// The largest units of the models, by their files.
const LARGEST: [&str; 2] = [
    "model = \"digital\"\noutputs = 64\ninputs = 64\n",
    "model = \"nx-ect101\"\n[io_allocation]\nm_to_c = { uints = 40, bytes = 10, udint = 32 }\n\
     c_to_m = { uints = 40, bytes = 10, udint = 32 }\n",
];

/// The addresses of a model must not be those of the CPU Unit itself.
#[test]
fn no_address_of_any_model_has_two_meanings() {
    for text in LARGEST {
        let file = plant::UnitFile::parse(text).unwrap_or_else(|errors| panic!("{errors}"));
        let map = ModbusMap::of(file.variables());
        meanings(file.variables());
        assert_eq!(map.rows().len(), file.variables().iter().count(), "every variable has addresses");
    }
}
