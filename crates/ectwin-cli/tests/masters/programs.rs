//! A user program in Structured Text together with a real master.

use std::path::Path;

use crate::run::{Line, top_folder, with_pysoem};

#[test]
fn pysoem_exchanges_with_a_program_that_copies_loops_and_is_changed() {
    const TEST: &str = "programs::pysoem_exchanges_with_a_program_that_copies_loops_and_is_changed";
    with_pysoem(TEST, |python| {
        let masters = top_folder().join("tests/masters");
        // The script changes it.
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("copy_and_count.st");
        std::fs::copy(masters.join("programs/copy_and_count.st"), &program).unwrap();
        let program = program.to_str().unwrap();
        let unit = top_folder().join("units/nx-ect101.toml");
        let line = Line::start_with(0, &[unit], None, &["--program", program]);
        line.run_master(python, "programs.py", &[program]);
        assert_eq!(line.end("INT"), Some(0), "ectwin after SIGINT");
    });
}
