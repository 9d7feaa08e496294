//! The frames of a real master are sent again in virtual time, and the answers are the same.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::run::{Line, top_folder, with_pysoem};

#[test]
fn a_capture_of_pysoem_is_imported_and_answered_as_it_was() {
    const TEST: &str = "import::a_capture_of_pysoem_is_imported_and_answered_as_it_was";
    with_pysoem(TEST, |python| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("import-of-pysoem");
        let _gone = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let unit = top_folder().join("units/nx-ect101.toml");
        let line = Line::start(0, std::slice::from_ref(&unit), Some(&folder.join("live.pcapng")));
        // To OP with SDOs and an exchange of patterns.
        line.run_master(python, "exchange.py", &["1", "factory", "500"]);
        assert_eq!(line.end("INT"), Some(0), "ectwin after SIGINT");

        let imported =
            ectwin(&folder, &["import", "live.pcapng", "-o", "again.toml", "--unit", unit.to_str().unwrap()]);
        assert_eq!(imported.status.code(), Some(0), "{}", told(&imported));
        let replayed = ectwin(&folder, &["replay", "again.toml"]);
        assert_eq!(replayed.status.code(), Some(0), "{}", told(&replayed));
    });
}

fn ectwin(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
    command.args(arguments).current_dir(folder).output().unwrap()
}

fn told(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}
