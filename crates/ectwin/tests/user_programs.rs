//! What the built command tells of a user program while it runs: on stderr, where a user looks.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, ChildStderr, Command, Stdio};

const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");

/// Ends the test where something is not as it should be.
fn must<T, E: std::fmt::Debug>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|error| panic!("{error:?}"))
}

/// `ectwin run` with a program, on a port of its own.
struct Running {
    child: Child,
    stderr: BufReader<ChildStderr>,
    program: PathBuf,
}

impl Running {
    fn start(name: &str, source: &str) -> Self {
        let program = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.st"));
        must(std::fs::write(&program, source));
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.args(["-v", "run", UNIT, "--link", "udp:127.0.0.1:0", "--program"]).arg(&program);
        let mut child = must(command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn());
        let stderr = BufReader::new(must(child.stderr.take().ok_or("no stderr")));
        Self { child, stderr, program }
    }

    /// Waits for a line with these words.
    fn wait_for(&mut self, words: &str) {
        let mut line = String::new();
        while !line.contains(words) {
            line.clear();
            let read = must(self.stderr.read_line(&mut line));
            assert_ne!(read, 0, "the command ended before it said `{words}`");
        }
    }

    fn change(&self, source: &str) {
        must(std::fs::write(&self.program, source));
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // An error means that it has ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_program_that_never_ends_is_told() {
    let mut running = Running::start("never_ends", "WHILE TRUE DO ; END_WHILE;");
    running.wait_for("task overrun: a scan had used up its 100000 statements");
}

#[test]
fn an_error_in_a_program_is_told_with_its_place() {
    let source = "VAR a : ARRAY[0..3] OF INT; i : INT; END_VAR\ni := i + 1;\na[i] := 1;\n";
    let mut running = Running::start("index", source);
    running.wait_for("line 3, column 3: index 4 lies outside 0..3");
}

#[test]
fn a_changed_program_is_loaded_and_a_wrong_one_is_not() {
    let mut running = Running::start("changed", "SetAlarm(1);");
    running.wait_for("user-defined error 16#1 ");
    running.change("SetAlarm(2, Misspelt);");
    running.wait_for("changed.st:1:13: there is no variable `Misspelt`");
    running.wait_for("the old program goes on");
    running.change("SetAlarm(3);");
    running.wait_for("a user program was loaded");
    running.wait_for("user-defined error 16#3 ");
}
