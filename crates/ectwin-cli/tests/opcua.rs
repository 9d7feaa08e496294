//! A third-party OPC UA client reads, writes and monitors variables of the built command, which leaves no files behind.

use std::net::TcpListener;
use std::path::Path;
use std::process::Command;

use testbed::{Process, in_network_namespace, ip, python_with, skip};

const PORT: &str = "4840";

#[test]
fn asyncua_reads_writes_and_watches() {
    const TEST: &str = "asyncua_reads_writes_and_watches";
    let Some(python) = python_with("asyncua") else {
        return skip(TEST, "asyncua: not installed");
    };
    in_network_namespace(TEST, || {
        ip(&["link", "set", "lo", "up"]);
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("opcua");
        std::fs::create_dir_all(&folder).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.current_dir(&folder).arg("run").arg(top.join("units/nx-ect101.toml"));
        command.args(["--link", "udp:127.0.0.1:0", "--opcua", PORT]);
        let mut ectwin = Process::start(&mut command);
        ectwin.wait_for_line("ready ");
        let client = Command::new(python).arg(top.join("tests/masters/opcua_client.py")).arg(PORT).status();
        assert!(client.unwrap().success());
        ectwin.interrupt();
        assert!(ectwin.wait().success());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0, "files in the working directory");
    });
}

#[test]
fn a_port_that_others_use_is_told() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = taken.local_addr().unwrap().to_string();
    let unit = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/nx-ect101.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    command.arg("run").arg(unit).args(["--link", "udp:127.0.0.1:0", "--opcua", &address]);
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(told.contains(&format!("OPC UA cannot be served at {address}")), "{told}");
}
