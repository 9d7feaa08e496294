//! A cable, the built command at one end, the script of a master at the other, a capture.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use testbed::{MasterSide, Process, add_veth_pair, has_program, in_network_namespace, python_with, skip};

/// Masters run in real time: two of them at once would disturb each other.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// One run: the units of a line, and the script of the master with its arguments.
pub(crate) struct Run {
    pub(crate) test: &'static str,
    pub(crate) units: &'static [&'static str],
    pub(crate) script: &'static str,
    pub(crate) arguments: &'static [&'static str],
    /// Display filters of tshark that must match at least one frame each; without any, nothing is captured.
    pub(crate) visible: &'static [&'static str],
}

impl Run {
    /// Everything, or a counted skip.
    pub(crate) fn run(&self) {
        if !has_program("tshark") {
            return skip(self.test, "tshark is not installed");
        }
        with_pysoem(self.test, |python| self.run_inside(python));
    }

    fn run_inside(&self, python: &Path) {
        let capture = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.pcapng", self.test));
        let units: Vec<PathBuf> =
            self.units.iter().map(|unit| top_folder().join("units").join(unit)).collect();
        let captured = (!self.visible.is_empty()).then_some(capture.as_path());
        let line = Line::start(0, &units, captured);
        line.run_master(python, self.script, self.arguments);
        assert_eq!(line.end("INT"), Some(0), "ectwin after SIGINT");
        self.read_capture(&capture);
    }

    fn read_capture(&self, capture: &Path) {
        if self.visible.is_empty() {
            return;
        }
        assert_eq!(count(capture, "_ws.malformed"), 0, "malformed frames in {}", capture.display());
        for filter in self.visible {
            assert!(count(capture, filter) > 0, "no frame matches `{filter}` in {}", capture.display());
        }
    }
}

/// Runs `body` with a Python that has pysoem in a network namespace, or skips `test`.
pub(crate) fn with_pysoem(test: &str, body: impl FnOnce(&Path)) {
    with_python(test, "pysoem", body);
}

/// Runs `body` with a Python that has these modules in a network namespace, or skips `test`.
pub(crate) fn with_python(test: &str, modules: &str, body: impl FnOnce(&Path)) {
    let _alone = ONE_AT_A_TIME.lock();
    let Some(python) = python_with(modules) else {
        return skip(test, &format!("{modules}: not installed"));
    };
    in_network_namespace(test, || body(&python));
}

/// Units with power at one end of a cable.
pub(crate) struct Line {
    ectwin: Process,
    master_interface: String,
}

impl Line {
    /// Creates a cable with this number and powers on the units. A cable serves one master.
    pub(crate) fn start(cable: usize, units: &[PathBuf], capture: Option<&Path>) -> Self {
        Self::start_with(cable, units, capture, &[])
    }

    /// The same with further options of `ectwin run`.
    pub(crate) fn start_with(
        cable: usize,
        units: &[PathBuf],
        capture: Option<&Path>,
        options: &[&str],
    ) -> Self {
        let (master_interface, unit_interface) = (format!("m{cable}"), format!("u{cable}"));
        add_veth_pair(&master_interface, &unit_interface);
        let link = format!("raw:{unit_interface}");
        let mut command = Command::new(env!("CARGO_BIN_EXE_ectwin"));
        command.arg("run").args(units).args(["--link", &link]).args(options);
        if let Some(capture) = capture {
            command.arg("--pcap").arg(capture);
        }
        let mut ectwin = Process::start(&mut command);
        let ready = ectwin.wait_for_line("ready ");
        let (start, modbus) = ready.split_once(" modbus=").unwrap_or((ready, ""));
        assert_eq!(start, format!("ready link={link} units={}", units.len()));
        assert_eq!(modbus.is_empty(), !options.contains(&"--modbus"), "{ready}");
        Self { ectwin, master_interface }
    }

    /// Runs a script of tests/masters at the other end. It must succeed.
    pub(crate) fn run_master(&self, python: &Path, script: &str, arguments: &[&str]) {
        let mut master = self.start_master(python, script, arguments);
        assert_eq!(master.wait(), 0, "exit code of {script} {arguments:?}");
    }

    /// Starts a script of tests/masters at the other end.
    pub(crate) fn start_master(&self, python: &Path, script: &str, arguments: &[&str]) -> MasterSide {
        let mut master = Command::new(python);
        master.arg(top_folder().join("tests/masters").join(script));
        master.arg(&self.master_interface).args(arguments);
        MasterSide::start(&self.master_interface, &master)
    }

    /// Waits for the end of the command by itself. Returns its exit code.
    pub(crate) fn wait(mut self) -> Option<i32> {
        self.ectwin.wait().code()
    }

    /// Sends a signal to the command. Returns its exit code; none if the signal has killed it.
    pub(crate) fn end(mut self, signal: &str) -> Option<i32> {
        // The `kill` of the shell: not every machine has the program of that name.
        let kill = format!("kill -{signal} {}", self.ectwin.id());
        let sent = Command::new("sh").args(["-c", &kill]).status();
        assert!(sent.as_ref().is_ok_and(|sent| sent.success()), "{kill}: {sent:?}");
        self.ectwin.wait().code()
    }
}

/// The top folder of the checkout.
pub(crate) fn top_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Number of frames of `capture` that match the display filter, according to tshark.
fn count(capture: &Path, filter: &str) -> usize {
    let mut tshark = Command::new("tshark");
    tshark.arg("-r").arg(capture).args(["-Y", filter]).args(["-T", "fields", "-e", "frame.number"]);
    let output = tshark.output().unwrap_or_else(|error| panic!("tshark: {error}"));
    assert!(output.status.success(), "tshark: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().count()
}
