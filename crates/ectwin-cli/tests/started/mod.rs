//! The built command under limits of a shell, with both its outputs.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::net::UdpSocket;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdout, Command, ExitStatus, Stdio};

/// A running command.
pub(crate) struct Started {
    child: Child,
    stdout: BufReader<ChildStdout>,
    stderr: BufReader<ChildStderr>,
}

/// The result of a command.
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) stderr: String,
}

/// The folder of one test, empty at first.
pub(crate) fn folder_of(test: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME")).join(test);
    // Files of an earlier run are not part of this one.
    let _gone = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// A link that can be opened: the port of another socket that has been closed.
pub(crate) fn free_link() -> String {
    format!("udp:{}", UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap())
}

/// The command in `folder`, with `limits` of the shell such as `ulimit -n 20;`.
pub(crate) fn command(folder: &Path, limits: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", &format!("{limits} exec \"$0\" \"$@\""), env!("CARGO_BIN_EXE_ectwin")]);
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1");
    command
}

/// Runs the command to its end.
pub(crate) fn ended(folder: &Path, limits: &str, arguments: &[&str]) -> Ended {
    let output = command(folder, limits, arguments).output().unwrap();
    Ended { code: output.status.code(), stderr: String::from_utf8_lossy(&output.stderr).into_owned() }
}

impl Started {
    pub(crate) fn new(folder: &Path, limits: &str, arguments: &[&str]) -> Self {
        let mut command = command(folder, limits, arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let stdout = BufReader::new(child.stdout.take().unwrap());
        let stderr = BufReader::new(child.stderr.take().unwrap());
        Self { child, stdout, stderr }
    }

    /// Waits until it is ready; returns its result if it never is.
    pub(crate) fn try_ready(mut self) -> Result<Self, Ended> {
        let mut line = String::new();
        self.stdout.read_line(&mut line).unwrap();
        if line.starts_with("ready ") { Ok(self) } else { Err(self.wait()) }
    }

    pub(crate) fn ready(self) -> Self {
        self.try_ready().unwrap_or_else(|ended| panic!("it ended with {:?}: {}", ended.code, ended.stderr))
    }

    /// Waits for a line with these words on stderr.
    pub(crate) fn wait_for(&mut self, words: &str) -> String {
        let mut line = String::new();
        while !line.contains(words) {
            line.clear();
            assert_ne!(self.stderr.read_line(&mut line).unwrap(), 0, "it ended before it said `{words}`");
        }
        line
    }

    pub(crate) fn id(&self) -> String {
        self.child.id().to_string()
    }

    /// Ends it like Ctrl-C does.
    pub(crate) fn interrupt(self) -> Ended {
        let kill = format!("kill -INT {}", self.child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().as_ref().is_ok_and(ExitStatus::success));
        self.wait()
    }

    /// Waits for its end.
    pub(crate) fn wait(mut self) -> Ended {
        let mut stderr = String::new();
        self.stderr.read_to_string(&mut stderr).unwrap();
        Ended { code: self.child.wait().unwrap().code(), stderr }
    }
}

impl Drop for Started {
    /// A test that panics leaves nothing running. An error means that it has already ended.
    fn drop(&mut self) {
        let _ended = self.child.kill().and_then(|()| self.child.wait());
    }
}
