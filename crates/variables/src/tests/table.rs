//! A terminal and a unit with words: what is found, where it lies, what fits.

use iec_types::Elementary;

use crate::*;

fn variable(name: &str, variable_type: VariableType, place: Place) -> Variable {
    Variable {
        name: variable_name("K1", name),
        port: Some(name.to_owned()),
        at: Some(at_specification(1, name)),
        variable_type,
        access: VariableAccess::ReadOnly,
        place,
        series: None,
        modbus: None,
        nx_object: None,
        pdo_entry: None,
    }
}

/// A terminal of 12 outputs and 12 inputs, with a status word of which one bit is a variable, and an array.
fn terminal() -> VariableTable {
    let (bool, word) = (VariableType::single(Elementary::Bool), VariableType::single(Elementary::Word));
    let channel = |name: &str, area, number: u8| {
        let place = Place::bit(area, usize::from(number - 1));
        let series = Some(Series { name: "Channel", number });
        Variable { series, ..variable(&format!("{name} {number}"), bool, place) }
    };
    let outputs = (1..=12).map(|number| channel("Output", Area::MToC, number));
    let inputs = (1..=12).map(|number| {
        let access = VariableAccess::ReadWrite;
        Variable { access, ..channel("Input", Area::CToM, number) }
    });
    let others = [
        variable("Status", word, Place::whole(Area::Status, 0, STATUS_BYTES)),
        variable("Power On", bool, Place::bit(Area::Status, 9)),
        variable("Table", VariableType::array(Elementary::Uint, 3), Place::whole(Area::CpuUnit, 4, 6)),
    ];
    let status = StatusWord { m_to_c_valid: 0b110, c_to_m_valid: 0 };
    let unit = BusUnit { device_name: "K1".into(), unit_number: 1, m_to_c_bytes: 2, c_to_m_bytes: 2, status };
    VariableTable::new(unit, outputs.chain(inputs).chain(others).collect())
}

fn id(table: &VariableTable, name: &str) -> VariableId {
    table.find(name).unwrap_or_else(|| panic!("{name}"))
}

#[test]
fn variables_are_found_by_name_and_at_specification_in_whatever_case() {
    let table = terminal();
    let output = id(&table, "k1_output_12");
    assert_eq!(table.find("iobus://UNIT#1/Output 12"), Some(output));
    assert_eq!(table.get(output).map(|variable| variable.name.as_str()), Some("K1_Output_12"));
    assert_eq!((table.find("K1_Output_13"), table.find("")), (None, None));
}

#[test]
fn a_bit_lies_in_its_byte_and_an_element_behind_the_one_before() {
    let table = terminal();
    let place =
        |target: Target| table.place(target).map(|place| (place.start, place.length_bytes, place.mask()));
    assert_eq!(place(id(&table, "K1_Output_1").into()), Ok((0, 1, 0x01)));
    assert_eq!(place(id(&table, "K1_Input_12").into()), Ok((1, 1, 0x08)));
    let array = id(&table, "K1_Table");
    assert_eq!((place(array.into()), place(array.element(2))), (Ok((4, 6, 0xFF)), Ok((8, 2, 0xFF))));
    assert_eq!(place(array.element(3)), Err(VariableError::NoSuchElement { element: 3, elements: 3 }));
    assert_eq!(place(id(&table, "K1_Status").element(0)), Err(VariableError::NotAnArray));
    assert_eq!(place(VariableId(99).into()), Err(VariableError::NoSuchVariable));
}

#[test]
fn elements_are_found_by_their_numbers() {
    let table = terminal();
    let array = id(&table, "K1_Table");
    let find = |text: &str| table.find_target(text).map_err(|error| error.to_string());
    assert_eq!((find("K1_Table"), find("K1_Table [ 2 ]")), (Ok(array.into()), Ok(array.element(2))));
    assert_eq!(find("K1_Table[3]"), Err("column 10: element 3 of an array of 3, counted from 0".into()));
    assert_eq!(find("K1_Table[x]"), Err("column 10: not a number such as 12, -3 or 16#1F".into()));
    assert_eq!(find("K1_Chair[0]"), Err("column 1: no variable has this name".into()));
    assert_eq!(find("K1_Status[0]"), Err("column 11: the variable is not an array".into()));
}

#[test]
fn only_what_fits_is_written_and_only_where_a_program_writes() {
    let table = terminal();
    let [input, output, array] = ["K1_Input_1", "K1_Output_1", "K1_Table"].map(|name| id(&table, name));
    assert!(table.writable(input.into(), &[1]).is_ok() && table.fitting(output.into(), &[0]).is_ok());
    assert_eq!(table.writable(output.into(), &[1]), Err(VariableError::NotWritable));
    assert_eq!(table.writable(input.into(), &[2]), Err(VariableError::NotABool { value: 2 }));
    let wrong = VariableError::WrongLength { length_bytes: 6, expected_bytes: 2 };
    assert_eq!(table.fitting(array.element(0), &[0; 6]), Err(wrong));
    assert_eq!(table.type_of(array.element(0)), Ok(VariableType::single(Elementary::Uint)));
}

#[test]
fn the_entries_of_a_series_are_there_in_both_directions() {
    let table = terminal();
    let name =
        |area, number| table.entry(area, "Channel", number).map(|(_, variable)| variable.name.as_str());
    assert_eq!((name(Area::MToC, 7), name(Area::CToM, 7)), (Some("K1_Output_7"), Some("K1_Input_7")));
    assert_eq!((name(Area::MToC, 0), name(Area::Status, 7)), (None, None));
    assert_eq!(table.entry(Area::MToC, "UINTs", 7), None);
}

#[test]
fn a_bit_of_a_word_knows_its_word() {
    let table = terminal();
    let word_of = |name: &str| {
        let part = table.get(id(&table, name)).expect("of this table");
        table.word_of(part).map(|word| word.name.as_str())
    };
    assert_eq!(word_of("K1_Power_On"), Some("K1_Status"));
    assert_eq!((word_of("K1_Status"), word_of("K1_Output_1")), (None, None));
}

#[test]
fn data_is_valid_by_the_bits_of_its_own_direction() {
    let status = terminal().unit().status;
    let allowed =
        |word| [Area::MToC, Area::CToM, Area::Status, Area::CpuUnit].map(|area| status.allows(area, word));
    assert_eq!(allowed(0b010), [false, true, true, true], "both bits are needed");
    assert_eq!(allowed(0b110), [true; 4]);
}

#[test]
fn one_bit_goes_in_and_comes_out_and_bytes_stay_as_they_are() {
    let (bit, whole) = (Place::bit(Area::MToC, 11), Place::whole(Area::MToC, 1, 1));
    assert_eq!((bit.to_memory(1), bit.to_memory(0), bit.to_value(0xF7), bit.to_value(0x08)), (0x08, 0, 0, 1));
    assert_eq!((whole.to_memory(0xA5), whole.to_value(0x5A)), (0xA5, 0x5A));
    assert_eq!((bit.bit_number(), whole.bit_number()), (Some(11), None));
    assert!(whole.contains(bit) && !bit.contains(whole) && !Place::whole(Area::CToM, 1, 1).contains(bit));
}
