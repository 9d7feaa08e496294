//! An external PLC runtime, over Modbus TCP, while a real master exchanges process data.

use std::path::Path;
use std::process::Command;

use testbed::ip;

use crate::run::{Line, top_folder, with_python};

const PORT: &str = "1502";

#[test]
fn pymodbus_reads_writes_and_forces_while_pysoem_exchanges_process_data() {
    const TEST: &str = "modbus::pymodbus_reads_writes_and_forces_while_pysoem_exchanges_process_data";
    with_python(TEST, "pysoem, pymodbus", |python| {
        ip(&["link", "set", "lo", "up"]);
        let unit = top_folder().join("tests/masters/units/mismatch.toml");
        let line = Line::start_with(0, &[unit], None, &["--modbus", PORT]);
        // They are synchronized by the process data: each waits for the other's action.
        let mut master = line.start_master(python, "modbus_master.py", &[]);
        let client = run_client(python);
        assert_eq!((client, master.wait()), (true, 0), "client, and exit code of the master");
        assert_eq!(line.end("INT"), Some(0), "ectwin after SIGINT");
    });
}

fn run_client(python: &Path) -> bool {
    let script = top_folder().join("tests/masters/modbus_client.py");
    let status = Command::new(python).arg(script).arg(PORT).status();
    status.is_ok_and(|status| status.success())
}
