use time::Duration;
use user_file::{FileErrors, Wanted, read_toml};
use variables::{Area, BusUnit, Place, StatusWord, Variable, VariableAccess, VariableTable, VariableType};

use super::super::section::Does;
use super::super::signal::Signal;
use super::super::table::BEHAVIOURS;
use super::*;
use crate::Elementary;

/// A unit K1 with two bits in each direction, an analog value and an array to the master.
pub(in crate::behaviour) fn variables() -> DeviceVariables {
    let variable = |name: &str, variable_type, access, place| Variable {
        name: name.into(),
        at: None,
        port: None,
        variable_type,
        access,
        place,
        series: None,
        modbus: None,
        nx_object: None,
        pdo_entry: None,
    };
    let (bit, int) = (VariableType::single(Elementary::Bool), VariableType::single(Elementary::Int));
    let (set, read) = (VariableAccess::ReadWrite, VariableAccess::ReadOnly);
    let rows = vec![
        variable("K1_Output_1", bit, read, Place::bit(Area::MToC, 0)),
        variable("K1_Output_2", bit, read, Place::bit(Area::MToC, 1)),
        variable("K1_Input_1", bit, set, Place::bit(Area::CToM, 0)),
        variable("K1_Input_2", bit, set, Place::bit(Area::CToM, 1)),
        variable("K1_Channel_1_Level", int, set, Place::whole(Area::CToM, 1, 2)),
        variable("K1_Raw", VariableType::array(Elementary::Uint, 2), set, Place::whole(Area::CToM, 3, 4)),
        variable("K1_Copy", VariableType::array(Elementary::Uint, 2), set, Place::whole(Area::CToM, 15, 4)),
        variable("K1_Delay", VariableType::single(Elementary::Time), set, Place::whole(Area::CToM, 7, 8)),
    ];
    let unit = BusUnit {
        device_name: "K1".into(),
        unit_number: 1,
        m_to_c_bytes: 1,
        c_to_m_bytes: 19,
        status: StatusWord::default(),
    };
    DeviceVariables::of(VariableTable::new(unit, rows))
}

pub(in crate::behaviour) fn parse(text: &str) -> Result<BehaviourSection, FileErrors> {
    read_toml(text, Wanted::UnitFile, |reader, file| {
        reader.only(file, &BEHAVIOUR_KEYS);
        Some(BehaviourSection::read(reader, file, &variables()))
    })
}

#[test]
fn each_example_of_the_table_is_read() {
    for row in BEHAVIOURS {
        let name = if row.example.contains("true }") || row.name == "square" { "Input_1" } else { "Raw[1]" };
        let text = format!("[behaviour]\n\"{name}\" = {}", row.example);
        let text = if row.name == "random" { text.replace("Raw[1]", "Input_1") } else { text };
        let section = parse(&text).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
        assert_eq!(section.behaviours.len(), 1, "{text}");
        assert_eq!(section.is_random(), row.name == "random", "{text}");
    }
}

#[test]
fn a_variable_has_its_name_with_or_without_the_unit_and_as_the_device_has_it() {
    for name in ["K1_Channel_1_Level", "Channel_1_Level", "Channel 1.Level", "channel 1 level"] {
        let section = parse(&format!("behaviour.\"{name}\" = {{ hold = -5 }}"));
        let section = section.unwrap_or_else(|errors| panic!("{name}: {errors}"));
        assert_eq!(section.behaviours[0].does, Does::Signal(Signal::Hold { value: -5.0 }));
    }
}

#[test]
fn limits_that_are_left_out_are_those_of_a_bit_or_of_the_type() {
    let does =
        |text: &str| parse(text).unwrap_or_else(|errors| panic!("{errors}")).behaviours[0].does.clone();
    let ms = Duration::from_millis(100);
    assert_eq!(
        does("behaviour.Input_1.square.period = \"100ms\""),
        Does::Signal(Signal::Square { low: 0.0, high: 1.0, period: ms, duty_percent: 50.0 })
    );
    assert_eq!(
        does("behaviour.Channel_1_Level.counter = { every = \"100ms\", step = 3 }"),
        Does::Signal(Signal::Counter { from: 0.0, to: 32_767.0, step: 3.0, every: ms })
    );
}

#[test]
fn what_is_wrong_is_refused_with_its_place() {
    let wrong = [
        "behaviour.Input_3 = { hold = true }",
        "behaviour.Output_1 = { hold = true }",
        "behaviour.Raw = { hold = 1 }",
        "behaviour.Delay = { hold = 1 }",
        "behaviour.Input_1 = true",
        "behaviour.Input_1 = {}",
        "behaviour.Input_1 = { holds = true }",
        "behaviour.Input_1 = { hold = true, random = { every = \"1s\" } }",
        "behaviour.Input_1 = { hold = 2 }",
        "behaviour.Input_1 = { hold = \"on\" }",
        "behaviour.Input_1 = { square = \"2s\" }",
        "behaviour.Input_1 = { square = { period = \"2s\", duty = 101 } }",
        "behaviour.Input_1 = { square = { duty = \"half\" } }",
        "behaviour.Input_1 = { random = { every = \"0s\" } }",
        "behaviour.Channel_1_Level = { ramp = { period = \"1s\" } }",
        "behaviour.Channel_1_Level = { sine = { low = 3, high = 2, period = \"1s\" } }",
        "behaviour.Channel_1_Level = { sine = { low = -32769, high = nan, period = \"1s\" } }",
        "behaviour.Channel_1_Level = { counter = { every = \"1s\", step = 0 } }",
        "behaviour.Channel_1_Level = { counter = { every = \"1s\", to = 9, step = -1 } }",
        "behaviour.Channel_1_Level = { csv = { column = 0, repeat = 1 } }",
        "behaviour.Input_1 = { hold = true }\nbehaviour.K1_Input_1 = { hold = false }",
        "behaviour.Input_1 = { hold = true }\nloopback.Input_1 = \"Output_1\"",
        "behaviour.\"Raw[2]\" = { hold = true }",
        "behaviour.\"Rav[1]\" = { hold = true }",
        "behaviour.\"Raw[1]\" = { hold = 1 }\nloopback.Raw = \"Raw\"",
        "loopback.Input_1 = \"Input_1\"",
        "loopback.Input_1 = \"Input_2\"\nloopback.Input_2 = \"Input_1\"",
        "loopback.Input_1 = \"Output_3\"",
        "loopback.Input_1 = 3",
        "loopback.Channel_1_Level = \"Output_1\"",
        "loopback.Output_1 = \"Output_2\"",
        "loopback = \"all\"",
        "behaviour = 1",
    ];
    let refused = wrong.map(|text| match parse(text) {
        Ok(section) => panic!("{text}: {section:?}"),
        Err(errors) => format!("{text}:\n{}", errors.in_file("unit.toml")),
    });
    insta::assert_snapshot!(refused.join("\n"));
}
