//! The server uses the map of docs/user/modbus.md, and the command reports what it cannot serve.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::ops::RangeInclusive;
use std::path::Path;
use std::process::Command;

use ectwin::link::memory;
use ectwin::master::{Connected, Master};
use ectwin::modbus::{ModbusMap, Table};
use ectwin::unit_file::UnitFile;
use ectwin::{AlState, Duration, Setup, Twin};
use plc::{DeviceVariables, Series, Variable};

/// The maximum of each data set; the setting rules do not matter here.
const EVERYTHING: &str = "model = \"nx-ect101\"\n[io_allocation]\n\
    m_to_c = { uints = 40, bytes = 10, udint = 32 }\nc_to_m = { uints = 40, bytes = 10, udint = 32 }\n";

/// First words of a row of the page.
fn title(variables: &DeviceVariables, variable: &Variable) -> String {
    let name = variable.port.as_ref().unwrap_or(&variable.name);
    match variable.series {
        Some(Series { number, .. }) => name.replacen(&format!("{number:02}"), "nn", 1),
        None if variables.word_of(variable).is_some() => "EtherCAT Slave Status, bit n".to_owned(),
        None if variable.variable_type.elements.is_some() => format!("`{name}[n]`"),
        None => name.clone(),
    }
}

fn table(table: Table) -> &'static str {
    match table {
        Table::Coils => "coils",
        Table::DiscreteInputs => "discrete inputs",
        Table::InputRegisters => "input registers",
        Table::HoldingRegisters => "holding registers",
    }
}

fn shown(range: &RangeInclusive<u16>) -> String {
    if range.start() == range.end() {
        range.start().to_string()
    } else {
        format!("{} to {}", range.start(), range.end())
    }
}

fn widen(all: &mut Option<RangeInclusive<u16>>, more: RangeInclusive<u16>) {
    *all = Some(match all.take() {
        Some(all) => *all.start().min(more.start())..=*all.end().max(more.end()),
        None => more,
    });
}

#[test]
fn the_page_tells_every_place_of_the_map() {
    let file = UnitFile::parse(EVERYTHING).unwrap();
    let variables = DeviceVariables::of(file.variable_table());
    let map = ModbusMap::of(&variables);
    let mut rows: BTreeMap<(String, &str), [Option<RangeInclusive<u16>>; 2]> = BTreeMap::new();
    for row in map.rows() {
        let variable = variables.get(row.variable).unwrap();
        let title = title(&variables, variable);
        let [all, forced] = rows.entry((title, table(row.table))).or_default();
        widen(all, row.addresses.clone());
        if let Some(more) = row.forced.clone() {
            widen(forced, more);
        }
    }
    // The whole word, with its reserved bits.
    rows.insert(("EtherCAT Slave Status, bit n".to_owned(), "discrete inputs"), [Some(0..=15), None]);
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/user/modbus.md");
    let page = std::fs::read_to_string(page).unwrap();
    for ((title, table), [all, forced]) in &rows {
        let (start, end) = (format!("| {title} | {table} | "), {
            let forced = forced.as_ref().map(|forced| format!("{} ", shown(forced))).unwrap_or_default();
            format!(" | {} | {forced}|", shown(all.as_ref().unwrap()))
        });
        let stands = page.lines().any(|line| line.starts_with(&start) && line.ends_with(&end));
        assert!(stands, "docs/user/modbus.md lacks a row `{start}…{end}`");
    }
}

#[test]
fn each_unit_of_a_line_has_its_unit_identifier() {
    let setups = (0..3).map(|_| Setup::from_toml("model = \"nx-ect101\"").unwrap());
    let mut twin = Twin::power_on(setups);
    let modbus = twin.serve_modbus(TcpListener::bind("127.0.0.1:0").unwrap()).unwrap();
    let (_master, units) = memory::pair();
    let live = twin.serve(units).unwrap();
    let mut client = TcpStream::connect(modbus.address()).unwrap();
    for unit_identifier in 1..=3 {
        // Write Single Register: its own number to holding register 0 of each.
        let request = [0, 1, 0, 0, 0, 6, unit_identifier, 0x06, 0, 0, 0, unit_identifier];
        client.write_all(&request).unwrap();
        let mut answer = [0; 12];
        client.read_exact(&mut answer).unwrap();
        assert_eq!(answer, request);
    }
    let written: Vec<u8> = (0..3).map(|position| live.look(position, |unit| unit.io().c_to_m()[0])).collect();
    assert_eq!(written, [1, 2, 3]);
}

/// A unit file of the project.
fn unit_file(name: &str) -> String {
    format!("{}/../../units/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// The table and the first address of a variable, from `ectwin map --json`.
fn address(unit_file: &str, variable: &str) -> (String, u16) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    let output = command.args(["map", unit_file, "--json"]).output().unwrap();
    let map: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = map["variables"].as_array().unwrap();
    let row = rows.iter().find(|row| row["variable"] == variable).unwrap();
    let first = row["modbus_first"].as_u64().unwrap();
    (row["modbus_table"].as_str().unwrap().to_owned(), u16::try_from(first).unwrap())
}

/// Sends a request of function, address and value to a unit, and returns the answer after the unit identifier. Virtual
/// time advances until it is there.
fn ask(
    bench: &mut Connected<Twin>,
    client: &mut TcpStream,
    unit: u8,
    (function, address, value): (u8, u16, u16),
) -> Vec<u8> {
    let ([a0, a1], [v0, v1]) = (address.to_be_bytes(), value.to_be_bytes());
    client.write_all(&[0, 1, 0, 0, 0, 6, unit, function, a0, a1, v0, v1]).unwrap();
    std::thread::scope(|scope| {
        let answer = scope.spawn(|| {
            let mut header = [0; 7];
            client.read_exact(&mut header).unwrap();
            let mut body = vec![0; usize::from(header[5]) - 1];
            client.read_exact(&mut body).unwrap();
            body
        });
        while !answer.is_finished() {
            bench.run_for(Duration::from_millis(1));
        }
        answer.join().unwrap()
    })
}

#[test]
fn a_client_sets_inputs_and_reads_outputs_of_terminals_by_their_names() {
    const WRITE_COIL: u8 = 0x05;
    const READ_DISCRETE_INPUTS: u8 = 0x02;
    let files = ["digital-coupler", "digital-8-outputs", "digital-8-inputs"].map(unit_file);
    let setup = |file: &String| Setup::from_toml(&std::fs::read_to_string(file).unwrap()).unwrap();
    let mut twin = Twin::power_on(files.iter().map(setup));
    let modbus = twin.serve_modbus(TcpListener::bind("127.0.0.1:0").unwrap()).unwrap();
    let mut client = TcpStream::connect(modbus.address()).unwrap();
    let mut bench = twin.connect(Master::default());
    assert_eq!(bench.search(), Ok(3));
    bench.take_all_to(AlState::Op).unwrap();

    // The client sets input 1 of the third unit; the master reads it.
    let (table, input) = address(&files[2], "I1_Input_1");
    assert_eq!(table, "coil");
    assert_eq!(bench.master.inputs(2), [0]);
    let answer = ask(&mut bench, &mut client, 3, (WRITE_COIL, input, 0xFF00));
    assert_eq!(answer[0], WRITE_COIL);
    bench.run_for(Duration::from_millis(10));
    assert_eq!(bench.master.inputs(2), [1]);

    // The master sets output 2 of the second unit; the client reads outputs 1 to 3.
    let (table, output) = address(&files[1], "O1_Output_1");
    assert_eq!(table, "discrete_input");
    bench.master.outputs_mut(1)[0] = 0b010;
    bench.run_for(Duration::from_millis(10));
    let answer = ask(&mut bench, &mut client, 2, (READ_DISCRETE_INPUTS, output, 3));
    assert_eq!(answer, [READ_DISCRETE_INPUTS, 1, 0b010]);
}

#[test]
fn a_port_that_is_taken_ends_the_command_like_a_link_that_cannot_be_opened() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    // A link that can be opened: the port of another socket that has been closed.
    let link = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    command.args(["run", concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml")]);
    let output = command.args(["--link", &format!("udp:{link}"), "--modbus", &port]).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains(&format!("Modbus TCP cannot be served at 127.0.0.1:{port}")), "{told}");
    assert!(told.contains("help: another program uses this port"), "{told}");
}
