//! Too few file descriptors: a message at the start, and no panic at any number of them; later, connected
//! clients are still served.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::time::Duration;

use started::{Started, folder_of, free_link};

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
