//! docs/user/modbus.md: a Modbus TCP client beside a unit in a test.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};

use ectwin::Twin;
use ectwin::link::memory;

#[test]
fn a_client_writes_an_output_and_reads_it_back() {
    let mut twin = Twin::from_toml("model = \"nx-ect101\"").unwrap();
    let modbus = twin.serve_modbus(TcpListener::bind("127.0.0.1:0").unwrap()).unwrap();
    let (_master, units) = memory::pair();
    let live = twin.serve(units).unwrap();

    let mut client = TcpStream::connect(modbus.address()).unwrap();
    // Write Single Register: 0x1234 to holding register 15, N1_UINTs_02_C_to_M[0].
    let request = [0, 1, 0, 0, 0, 6, 1, 0x06, 0, 15, 0x12, 0x34];
    client.write_all(&request).unwrap();
    let mut answer = [0; 12];
    client.read_exact(&mut answer).unwrap();
    assert_eq!(answer, request, "the answer comes when it is written");

    let written = live.look(0, |unit| unit.io().c_to_m()[30..32].to_vec());
    assert_eq!(written, [0x34, 0x12]);
}
