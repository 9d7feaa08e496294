//! `ectwin run` with a user program, and its reports on stderr, which a user sees.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Stdio};

pub(crate) const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");

/// The value of a result; an error fails the test.
pub(crate) fn must<T, E: std::fmt::Display>(result: Result<T, E>) -> T {
    result.unwrap_or_else(|error| panic!("{error}"))
}

/// The command, on a free port.
pub(crate) struct Running {
    child: Child,
    stderr: BufReader<ChildStderr>,
}

impl Running {
    pub(crate) fn start(program: &Path) -> Self {
        Self::start_all(&[program])
    }

    /// With a program of several files.
    pub(crate) fn start_all(programs: &[impl AsRef<Path>]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.args(["-v", "run", UNIT, "--link", "udp:127.0.0.1:0"]);
        for program in programs {
            command.arg("--program").arg(program.as_ref());
        }
        let mut child = must(command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn());
        let stderr = BufReader::new(must(child.stderr.take().ok_or("it has a pipe")));
        Self { child, stderr }
    }

    /// Its process id.
    pub(crate) fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits for a line with these words.
    pub(crate) fn wait_for(&mut self, words: &str) {
        let _line = self.line_with(|line| line.contains(words), words);
    }

    /// Waits for a line with these words; no line before it may contain `those`.
    pub(crate) fn wait_for_before(&mut self, words: &str, those: &str) {
        let line = self.line_with(|line| line.contains(words) || line.contains(those), words);
        assert!(line.contains(words), "{line}");
    }

    fn line_with(&mut self, is_awaited: impl Fn(&str) -> bool, words: &str) -> String {
        let mut line = String::new();
        while !is_awaited(&line) {
            line.clear();
            let read = must(self.stderr.read_line(&mut line));
            assert_ne!(read, 0, "the command ended before it said `{words}`");
        }
        line
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // An error means that it has already ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
