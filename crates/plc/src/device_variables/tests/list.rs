//! Which variables exist, where they are, and that a written value is read back.

use core::fmt::Write as _;

use nx_bus::{SlaveStatus, UnitHeader};
use nx_ect101::{IoEntry, ObjectIndex, SubIndex};
use proptest::prelude::*;

use super::*;
use crate::device_variables::*;
use crate::nx_bus_function::IoRefreshing;

/// The I/O map as a table.
fn table(io: &Io) -> String {
    let mut table = String::new();
    for (_, variable) in io.variables().iter() {
        let Variable { name, port, at, variable_type, access, place, .. } = variable;
        let port = port.as_deref().unwrap_or("-");
        let at = at.as_deref().unwrap_or("-");
        let (start, length, mask) = (place.start, place.length_bytes, place.mask());
        writeln!(
            table,
            "{name} | {port} | {at} | {variable_type} | {access:?} | {:?} {start}+{length} {mask:02X}",
            place.area
        )
        .expect("a String takes everything");
    }
    table
}

#[test]
fn the_factory_setting_has_the_manuals_io_map() {
    insta::assert_snapshot!(table(&io_of(&IoAllocation::factory())));
}

#[test]
fn the_mixed_example_has_the_manuals_io_map() {
    insta::assert_snapshot!(table(&io_of(&allocation([10, 10, 30], [10, 10, 30]))));
}

#[test]
fn names_and_at_specifications_of_the_manual_find_their_variables() {
    let io = io_of(&allocation([6, 2, 1], [6, 2, 1]));
    for (name, at) in [
        ("N1_UINTs_01_C_to_M", "IOBus://unit#1/UINTs 01 C to M"),
        ("N1_BYTES_02_M_to_C", "IOBus://unit#1/BYTES 02 M to C"),
        ("N1_UDINT_01_C_to_M", "IOBus://unit#1/UDINT 01 C to M"),
        (
            "N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid",
            "IOBus://unit#1/EtherCAT Slave Status/Data from EtherCAT Master to CPU Unit Valid",
        ),
        ("NXBus_N1_NX_Unit_I_O_Data_Active_Status", "IOBus://unit#1/NX Unit I/O Data Active Status"),
        ("NXBus_N1_NX_Unit_Error_Status", "IOBus://unit#1/NX Unit Error Status"),
    ] {
        let id = io.find(name).expect(name);
        assert_eq!(io.find(&name.to_uppercase()), Some(id));
        assert_eq!(io.find(&at.to_lowercase()), Some(id), "{at}");
    }
    for missing in ["N1_UINTs_07_M_to_C", "N2_UINTs_01_M_to_C", "N1", "", "IOBus://unit#2/UINTs 01 M to C"] {
        assert_eq!(io.find(missing), None, "{missing}");
    }
}

#[test]
fn an_entry_of_another_data_set_or_a_second_one_has_no_io_port() {
    let entry = |index, sub| IoEntry { index: ObjectIndex(index), sub: SubIndex(sub) };
    let mut allocation = IoAllocation::empty();
    let entries = vec![entry(0x6001, 1), entry(0x6000, 2), entry(0x6000, 2), entry(0x6000, 1)];
    allocation.allocate(Direction::MToC, DataSetKind::Uints, entries);
    let io = io_of(&allocation);
    let found = io.variables().iter().filter(|(_, variable)| variable.series.is_some());
    let found: Vec<_> = found.map(|(_, variable)| (variable.name.as_str(), variable.place.start)).collect();
    assert_eq!(found, [("N1_UINTs_02_M_to_C", 10), ("N1_UINTs_01_M_to_C", 70)]);
}

#[test]
fn elements_are_found_by_their_numbers() {
    let io = io_of(&IoAllocation::factory());
    let find = |text: &str| io.variables().find_target(text).map_err(|error| error.to_string());
    let id = io.find("N1_UINTs_01_M_to_C").expect("allocated");
    assert_eq!(find("n1_uints_01_m_to_c"), Ok(id.into()));
    assert_eq!(find("N1_UINTs_01_M_to_C[14]"), Ok(id.element(14)));
    assert_eq!(find("IOBus://unit#1/UINTs 01 M to C [ 3 ]"), Ok(id.element(3)));
    let column = "column 20: ";
    assert_eq!(
        find("N1_UINTs_01_M_to_C[15]"),
        Err(format!("{column}element 15 of an array of 15, counted from 0"))
    );
    assert_eq!(find("N1_UINTs_01_M_to_C[x]"), Err(format!("{column}not a number such as 12, -3 or 16#1F")));
    assert_eq!(find("N1_UINTs_09_M_to_C[0]"), Err("column 1: no variable has this name".into()));
    assert_eq!(find("N1_EtherCAT_Slave_Status[0]"), Err("column 26: the variable is not an array".into()));
}

#[test]
fn what_does_not_fit_is_refused_with_its_numbers() {
    let mut io = io_of(&IoAllocation::factory());
    let [input, output, flag] = ["N1_UINTs_01_M_to_C", "N1_UINTs_01_C_to_M", "N1_IN_Port_Link_ON"]
        .map(|name| io.find(name).expect(name));
    assert_eq!(io.write(input, &[0; 30]), Err(VariableError::NotWritable));
    let wrong = VariableError::WrongLength { length_bytes: 3, expected_bytes: 30 };
    assert_eq!(io.write(output, &[0; 3]), Err(wrong));
    let wrong = VariableError::WrongLength { length_bytes: 30, expected_bytes: 2 };
    assert_eq!(io.force(output.element(0), &[0; 30]), Err(wrong));
    let missing = VariableError::NoSuchElement { element: 15, elements: 15 };
    assert_eq!(io.read(output.element(15)), Err(missing));
    assert_eq!(io.read(flag.element(0)), Err(VariableError::NotAnArray));
    assert_eq!(io.force(flag, &[2]), Err(VariableError::NotABool { value: 2 }));
    let many = io_of(&allocation([40, 0, 0], [40, 0, 0]));
    let of_another = many.variables().iter().last().map(|(id, _)| id).expect("variables");
    assert_eq!(io.read(of_another), Err(VariableError::NoSuchVariable));
}

#[test]
fn a_value_is_valid_under_the_conditions_of_the_manuals_program() {
    let mut io = io_of(&IoAllocation::factory());
    let names =
        ["N1_UINTs_01_M_to_C", "N1_UINTs_01_C_to_M", "N1_EtherCAT_Slave_Status", "_NXB_UnitErrFlagTbl"];
    let mut seen = |m_to_c_valid, io_data_active, error| {
        let status = SlaveStatus { m_to_c_valid, ..SlaveStatus::default() }.bits();
        io.take_inputs(
            UnitHeader { status, io_data_active, error, messages_enabled: true, ..UnitHeader::default() },
            IoRefreshing::GoesOn,
            &[],
        );
        names.map(|name| io.validity(io.find(name).expect(name)).expect("a variable of this list"))
    };
    use Validity::{DataNotValid, IoDataNotActive, UnitError, Valid};
    assert_eq!(seen(true, true, false), [Valid, DataNotValid, Valid, Valid]);
    assert_eq!(seen(false, true, false), [DataNotValid, DataNotValid, Valid, Valid]);
    assert_eq!(seen(true, true, true), [UnitError, UnitError, UnitError, Valid]);
    assert_eq!(seen(true, false, true), [IoDataNotActive, IoDataNotActive, IoDataNotActive, Valid]);
}

#[test]
fn a_bit_of_the_status_and_the_word_are_one_memory() {
    let mut io = io_of(&IoAllocation::factory());
    let [word, bit] = ["N1_EtherCAT_Slave_Status", "N1_Data_from_EtherCAT_Master_to_CPU_Unit_Valid"]
        .map(|name| io.find(name).expect(name));
    io.force(bit, &[1]).expect("a bit");
    assert_eq!(io.read(word).expect("a word")[..], [0x02, 0x00]);
    assert!(io.status().m_to_c_valid);
    assert_eq!((io.is_forced(bit), io.is_forced(word)), (Ok(true), Ok(false)));
    io.force(word, &[0, 0]).expect("a word");
    assert_eq!((io.read(bit).expect("a bit")[..].to_vec(), io.is_forced(bit)), (vec![0], Ok(true)));
}

#[test]
fn the_system_tables_have_the_elements_of_the_unit() {
    let mut io = io_of(&IoAllocation::factory());
    let [active, errors] =
        ["_NXB_UnitMsgActiveTbl", "_NXB_UnitErrFlagTbl"].map(|name| io.find(name).expect(name));
    let table = |io: &Io, id: VariableId| io.read(id).expect("a table").to_vec();
    assert_eq!(
        table(&io, active),
        [&[1][..], &[0; 32]].concat(),
        "the NX Bus Function Module is always there"
    );
    io.take_inputs(
        UnitHeader { error: true, messages_enabled: true, ..UnitHeader::default() },
        IoRefreshing::GoesOn,
        &[],
    );
    assert_eq!(table(&io, active), [&[1, 1][..], &[0; 31]].concat());
    assert_eq!(table(&io, errors), [&[0, 1][..], &[0; 31]].concat());
    let mut beyond =
        Io::new(DeviceVariables::of(nx_ect101::variable_table("N1", 63, &IoAllocation::empty())));
    beyond.take_inputs(
        UnitHeader { error: true, messages_enabled: true, ..UnitHeader::default() },
        IoRefreshing::GoesOn,
        &[],
    );
    let errors = beyond.find("_NXB_UnitErrFlagTbl").expect("always there");
    assert_eq!(table(&beyond, errors), [0; 33], "units beyond 32 have no element");
}

fn counts() -> impl Strategy<Value = [u8; 3]> {
    (0..=40u8, 0..=10u8, 0..=32u8).prop_map(|(uints, bytes, udint)| [uints, bytes, udint])
}

proptest! {
    #[test]
    fn every_entry_has_one_variable_and_they_cover_the_images(m_to_c in counts(), c_to_m in counts()) {
        let io = io_of(&allocation(m_to_c, c_to_m));
        for (area, image_bytes) in [(Area::MToC, io.m_to_c().len()), (Area::CToM, io.c_to_m().len())] {
            let mut next = 0;
            for (_, variable) in io.variables().iter() {
                if variable.place.area == area {
                    prop_assert_eq!(variable.place.start, next, "no gap and no overlap");
                    prop_assert_eq!(variable.place.length_bytes, variable.variable_type.size_bytes());
                    next += variable.place.length_bytes;
                }
            }
            prop_assert_eq!(next, image_bytes);
        }
        let mut names: Vec<_> = io.variables().iter().map(|(_, variable)| &variable.name).collect();
        let count = names.len();
        names.sort();
        names.dedup();
        prop_assert_eq!(names.len(), count);
        for (id, variable) in io.variables().iter() {
            prop_assert_eq!(io.find(&variable.name), Some(id));
            prop_assert_eq!(variable.at.as_deref().map(|at| io.find(at)), variable.at.as_ref().map(|_| Some(id)));
        }
    }

    #[test]
    fn what_is_written_is_read(c_to_m in counts(), pick: prop::sample::Index, element: u16, fill: [u8; 30]) {
        let mut io = io_of(&allocation([0; 3], c_to_m));
        let outputs = io.variables().iter().filter(|(_, variable)| variable.access == VariableAccess::ReadWrite);
        let outputs: Vec<_> = outputs.map(|(id, variable)| (id, variable.variable_type)).collect();
        prop_assume!(!outputs.is_empty());
        let (id, variable_type) = *pick.get(&outputs);
        let target = variable_type.elements.map_or(id.into(), |elements| id.element(element % elements));
        for target in [id.into(), target] {
            let before = io.c_to_m().to_vec();
            let value = &fill[..io.type_of(target).expect("there").size_bytes()];
            io.write(target, value).expect("an output");
            prop_assert_eq!(&io.read(target).expect("there")[..], value);
            let changed = io.c_to_m().iter().zip(&before).filter(|(now, before)| now != before).count();
            prop_assert!(changed <= value.len(), "nothing else changes");
        }
    }
}
