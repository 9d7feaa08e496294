//! Network namespaces for tests, created without root if the kernel permits it.

use std::env;
use std::process::{Command, ExitStatus};

use crate::process::Process;
use crate::skip::{skip, succeeds};

/// Set inside the namespace to the name of the test that was started there.
const INSIDE_VARIABLE: &str = "ECTWIN_INSIDE_NAMESPACE";

/// How to enter a new network namespace: as root, and as an ordinary user through a user namespace.
const WAYS: [&[&str]; 2] = [&["--net"], &["--user", "--map-root-user", "--net"]];

/// Runs `body` in a separate network namespace, or reports that `test` was skipped.
///
/// `test` is the path of the test function inside its binary. The test binary is started again inside the
/// namespace with this test alone; `body` runs there.
///
/// # Panics
/// If the test fails in its namespace.
pub fn in_network_namespace(test: &str, body: impl FnOnce()) {
    if env::var(INSIDE_VARIABLE).is_ok_and(|inside| inside == test) {
        return body();
    }
    let Some(way) = WAYS.into_iter().find(|way| succeeds(Command::new("unshare").args(*way).arg("true")))
    else {
        return skip(test, "no network namespace: `unshare -Urn` is not permitted here");
    };
    let Ok(binary) = env::current_exe() else { panic!("{test}: the test binary has no path") };
    let mut command = Command::new("unshare");
    command.args(way).arg(binary).args(["--exact", test, "--nocapture"]).env(INSIDE_VARIABLE, test);
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = String::from_utf8_lossy(&output.stdout);
    // A name that matches no test would pass without running anything.
    assert!(printed.contains("running 1 test"), "{test}: no such test in its binary\n{printed}");
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{test} failed in its namespace\n{printed}");
}

/// Runs `ip` (iproute2) with these arguments.
///
/// # Panics
/// If it fails.
pub fn ip(arguments: &[&str]) {
    let status = Command::new("ip").args(arguments).status();
    assert!(status.as_ref().is_ok_and(ExitStatus::success), "ip {arguments:?}: {status:?}");
}

/// Adds a cable with an interface at each end, both up, to this namespace.
///
/// # Panics
/// If the kernel refuses.
pub fn add_veth_pair(one: &str, other: &str) {
    ip(&["link", "add", "name", one, "type", "veth", "peer", "name", other]);
    ip(&["link", "set", one, "up"]);
    ip(&["link", "set", other, "up"]);
    // The kernel finishes this later, and drops frames that are sent before: one frame in a hundred on a busy machine.
    [one, other].into_iter().for_each(wait_until_up);
}

fn wait_until_up(interface: &str) {
    const LOOKS: usize = 1000;
    let is_up = || {
        let shown = Command::new("ip").args(["-oneline", "link", "show", interface]).output();
        shown.is_ok_and(|shown| String::from_utf8_lossy(&shown.stdout).contains("state UP"))
    };
    assert!((0..LOOKS).any(|_| is_up()), "{interface} does not come up");
}

/// A second network namespace, for the master, with one interface moved into it.
///
/// The namespace is kept until this value is dropped: otherwise the cable would be removed with it, for the
/// other side too.
pub struct MasterSide {
    shell: Process,
    /// The exit code of the program, once it is known.
    ended: Option<i32>,
}

/// The shell around a program prints its exit code.
const ENDED: &str = "ended ";

impl MasterSide {
    /// Makes the namespace, moves `interface` into it, and starts `program` there once it is up.
    ///
    /// # Panics
    /// If the kernel refuses, or the program cannot be started.
    #[must_use]
    pub fn start(interface: &str, program: &Command) -> Self {
        // The shell waits until the interface has arrived, and continues to run after the program.
        let script =
            "echo in && read -r _ && ip link set \"$0\" up && { \"$@\"; echo \"ended $?\"; read -r _; }";
        let mut command = Command::new("unshare");
        command
            .args(["--net", "sh", "-c", script, interface])
            .arg(program.get_program())
            .args(program.get_args());
        for (name, value) in program.get_envs() {
            if let Some(value) = value {
                command.env(name, value);
            }
        }
        let mut shell = Process::start(&mut command);
        shell.wait_for_line("in");
        ip(&["link", "set", interface, "netns", &shell.id().to_string()]);
        shell.say("go");
        Self { shell, ended: None }
    }

    /// Waits until the program prints a line that begins with `start`, and returns the rest of it; none if the program
    /// has ended.
    ///
    /// # Panics
    /// If the shell around it has ended.
    #[must_use]
    pub fn next_line(&mut self, start: &str) -> Option<String> {
        let line = self.shell.wait_for_line_of(&[start, ENDED]);
        self.ended = exit_code(line);
        if self.ended.is_some() { None } else { line.strip_prefix(start).map(str::to_owned) }
    }

    /// Writes a line to the standard input of the program.
    ///
    /// # Panics
    /// If it has closed its input.
    pub fn say(&mut self, line: &str) {
        self.shell.say(line);
    }

    /// Waits until the program has ended, and returns its exit code.
    ///
    /// # Panics
    /// If the shell around it has ended.
    #[must_use]
    pub fn wait(&mut self) -> i32 {
        let code = self.ended.or_else(|| exit_code(self.shell.wait_for_line(ENDED)));
        code.unwrap_or_else(|| panic!("the program has no exit code"))
    }
}

/// The exit code of the program, if the shell prints it in this line.
fn exit_code(line: &str) -> Option<i32> {
    line.strip_prefix(ENDED)?.parse().ok()
}
