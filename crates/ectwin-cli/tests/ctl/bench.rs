//! A twin with a control channel in a folder of its own, and `ectwin ctl` beside it.

use std::fs;
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use testbed::Process;

const UNIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../units/nx-ect101.toml");

/// A folder of runtime files that only its user reaches. It is short: the path of a socket has a limit.
pub(crate) struct Bench {
    pub(crate) folder: PathBuf,
}

/// The end of a command.
#[derive(Debug)]
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Bench {
    pub(crate) fn new(test: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ectwin-ctl-{}-{test}", std::process::id()));
        fs::DirBuilder::new().mode(0o700).create(&folder).unwrap();
        Self { folder }
    }

    /// The command in the environment of this bench.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.args(arguments).env("XDG_RUNTIME_DIR", &self.folder).env("NO_COLOR", "1");
        command.env_remove("RUST_LOG").env_remove("ECTWIN_CONTROL");
        command
    }

    /// A twin of one unit, ready.
    pub(crate) fn twin(&self) -> Process {
        let mut twin = Process::start(&mut self.command(&[
            "run",
            UNIT,
            "--link",
            "udp:127.0.0.1:0",
            "--control",
            "--fast",
        ]));
        twin.wait_for_line("ready ");
        twin
    }

    /// The socket of a twin.
    pub(crate) fn socket(&self, twin: &Process) -> String {
        self.folder.join(format!("ectwin/{}.sock", twin.id())).display().to_string()
    }

    /// Runs `ectwin ctl` to its end.
    pub(crate) fn ctl(&self, arguments: &[&str]) -> Ended {
        ended(self.command(&[&["ctl"], arguments].concat()).stdin(Stdio::null()))
    }

    /// The output of a successful `ectwin ctl`.
    pub(crate) fn told(&self, arguments: &[&str]) -> String {
        let ended = self.ctl(arguments);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{arguments:?}: {}", ended.stdout);
        ended.stdout
    }

    /// The JSON document of an `ectwin ctl`.
    pub(crate) fn document(&self, arguments: &[&str]) -> serde_json::Value {
        let Ended { stdout, stderr, .. } = self.ctl(&[arguments, &["--json"]].concat());
        serde_json::from_str(&stdout).unwrap_or_else(|error| panic!("{error}: {stdout}{stderr}"))
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        // A twin that was killed leaves its socket.
        let _ = fs::remove_dir_all(&self.folder);
    }
}

pub(crate) fn ended(command: &mut Command) -> Ended {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let [stdout, stderr] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    Ended { code: status.code(), stdout, stderr }
}
