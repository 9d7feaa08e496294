//! Too few file descriptors: a message at the start, and no panic at any number of them; later, connected
//! clients are still served.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream, UdpSocket};
use std::path::Path;
use std::time::Duration;

use rustix::process::{Pid, Resource, Rlimit, prlimit};
use started::{Started, folder_of, free_link};
use wire::{Command, FrameBuilder};

const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");
/// With fewer, even the program's libraries cannot be loaded.
const FEWEST: u32 = 4;
const MOST: u32 = 64;
/// A server that does not answer is detected after this time.
const PATIENCE: Duration = Duration::from_secs(20);

/// Reads a register; returns whether there is an answer.
fn is_served(client: &mut TcpStream) -> bool {
    let request = [0, 1, 0, 0, 0, 6, 1, 0x03, 0, 0, 0, 1];
    client.set_read_timeout(Some(PATIENCE)).unwrap();
    client.write_all(&request).is_ok() && client.read_exact(&mut [0; 11]).is_ok()
}

/// The memory files of units are claimed last: for no number of descriptors is the unit file reported as the cause.
#[test]
fn at_any_number_of_descriptors_a_unit_with_a_memory_file_starts_or_says_why_not() {
    let folder = folder_of("memory");
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\nstorage = \"unit.nvm\"\n").unwrap();
    let link = free_link();
    let arguments = ["run", "unit.toml", "--link", &link, "--modbus", "127.0.0.1:0"];
    let first_ready = (FEWEST..MOST).find_map(|descriptors| {
        let started = Started::new(&folder, &format!("ulimit -n {descriptors};"), &arguments);
        let ended = match started.try_ready() {
            Ok(ready) => return Some(ready),
            Err(ended) => ended,
        };
        assert_eq!(ended.code, Some(3), "{descriptors}: {}", ended.stderr);
        assert!(ended.stderr.contains("help: allow this process more open files"), "{}", ended.stderr);
        None
    });
    assert_eq!(first_ready.unwrap().interrupt().code, Some(0));
}

#[test]
fn at_any_number_of_descriptors_there_is_a_message_or_a_server_that_goes_on() {
    let modbus = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let link = free_link();
    let arguments = ["run", UNIT, "--link", &link, "--modbus", &modbus];
    let first_ready = (FEWEST..MOST).find_map(|descriptors| {
        let started = Started::new(Path::new("."), &format!("ulimit -n {descriptors};"), &arguments);
        let ended = match started.try_ready() {
            Ok(ready) => return Some(ready),
            Err(ended) => ended,
        };
        assert_eq!(ended.code, Some(3), "{descriptors}: {}", ended.stderr);
        assert!(ended.stderr.contains("help: allow this process more open files"), "{}", ended.stderr);
        None
    });
    let mut server = first_ready.unwrap();
    // Few are left: some clients are admitted, and each further one replaces one without a request.
    let mut working = TcpStream::connect(&modbus).unwrap();
    assert!(is_served(&mut working));
    let mute: Vec<TcpStream> = (0..30).map(|_| TcpStream::connect(&modbus).unwrap()).collect();
    let told = server.wait_for("too few open files for the next Modbus client");
    assert!(told.contains("without a request so far, was closed"), "{told}");
    let mut next = TcpStream::connect(&modbus).unwrap();
    assert!(is_served(&mut next), "mute clients take the place of a working one");
    assert!(is_served(&mut working), "whoever is connected is served");
    drop((mute, next));
    let mut last = TcpStream::connect(&modbus).unwrap();
    assert!(is_served(&mut last) && is_served(&mut working), "there is room again");
    let ended = server.interrupt();
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(ended.stderr.matches("too few open files").count() <= 3, "a line a second: {}", ended.stderr);
    assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);
}

/// A master's write of a word of the EEPROM, as an EtherCAT datagram in UDP.
fn eeprom_write() -> Vec<u8> {
    const ETHERNET_HEADER_BYTES: usize = 14;
    let write = [0x01, 0x02, 0xF0, 0x03, 0, 0, 0xFE, 0xCA];
    let frame = FrameBuilder::new().physical(Command::Apwr, 0, 0x0502, &write).finish();
    frame[ETHERNET_HEADER_BYTES..].to_vec()
}

#[test]
fn a_change_is_stored_while_clients_use_all_other_descriptors() {
    let folder = folder_of("exhausted");
    let unit = "model = \"nx-ect101\"\nstart_up = \"0ms\"\nstorage = \"N1.nvm\"\n";
    fs::write(folder.join("unit.toml"), unit).unwrap();
    let link = free_link();
    let modbus = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let arguments = ["run", "unit.toml", "--link", &link, "--modbus", &modbus];
    let first_ready = (FEWEST..MOST).find_map(|descriptors| {
        Started::new(&folder, &format!("ulimit -n {descriptors};"), &arguments).try_ready().ok()
    });
    let mut server = first_ready.unwrap();
    let mute: Vec<TcpStream> = (0..30).map(|_| TcpStream::connect(&modbus).unwrap()).collect();
    server.wait_for("too few open files for the next Modbus client");
    let master = UdpSocket::bind("127.0.0.1:0").unwrap();
    master.set_read_timeout(Some(PATIENCE)).unwrap();
    master.send_to(&eeprom_write(), link.trim_start_matches("udp:")).unwrap();
    master.recv(&mut [0; 1500]).unwrap();
    let ended = server.interrupt();
    drop(mute);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(!ended.stderr.contains("not stored"), "{}", ended.stderr);
    let stored = fs::read(folder.join("N1.nvm")).unwrap();
    assert!(stored.windows(2).any(|word| word == [0xFE, 0xCA]), "the word of the EEPROM");
}

/// The units have run: it is no failure of the start.
#[test]
fn changes_that_were_lost_for_want_of_descriptors_end_with_2() {
    let folder = folder_of("lost");
    let unit = "model = \"nx-ect101\"\nstart_up = \"0ms\"\nstorage = \"N1.nvm\"\n";
    fs::write(folder.join("unit.toml"), unit).unwrap();
    let link = free_link();
    let mut started = Started::new(&folder, "", &["run", "unit.toml", "--link", &link]).ready();
    // All of them are in use: stdin, stdout and stderr.
    let none_left = Rlimit { current: Some(3), maximum: Some(3) };
    prlimit(Pid::from_raw(started.id().parse().unwrap()), Resource::Nofile, none_left).unwrap();
    let master = UdpSocket::bind("127.0.0.1:0").unwrap();
    master.send_to(&eeprom_write(), link.trim_start_matches("udp:")).unwrap();
    started.wait_for("N1.nvm: not stored: Too many open files");
    let ended = started.interrupt();
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("help: allow this process more open files"), "{}", ended.stderr);
}
