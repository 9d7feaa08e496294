//! A reader at a shell, who enters the commands of a page.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;
use testbed::{Process, ip, python_with, skip};

use crate::pages::top_folder;

/// In an expected output: any text. Alone on its line: any lines.
const ANYTHING: &str = "…";
/// The parts of the checkout that the pages use.
const FOLDERS: [&str; 3] = ["scenarios", "tests", "units"];

/// One page being followed, in a separate folder.
pub(crate) struct Session {
    test: &'static str,
    folder: PathBuf,
    /// Where twins make their sockets: no other twin of this user is there.
    runtime: TempDir,
    path: OsString,
    has_pysoem: bool,
    has_pymodbus: bool,
    has_tshark: bool,
    /// `ectwin run`, until `kill %1` or the end of the page.
    running: Option<Process>,
    last_exit_code: i32,
    /// A command was skipped because a tool is missing: later commands of the page may need its results.
    skipped: bool,
    /// The page has made the cable from m0 to u0.
    has_cable: bool,
}

impl Session {
    pub(crate) fn begin(test: &'static str, page: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("docs").join(page.replace('/', "-"));
        // A reader does not have the files of an earlier run.
        let _gone = std::fs::remove_dir_all(&folder);
        must(std::fs::create_dir_all(&folder), &folder);
        for name in FOLDERS {
            must(std::os::unix::fs::symlink(top_folder().join(name), folder.join(name)), &folder);
        }
        let python = python_with("pysoem");
        let (has_pysoem, has_tshark) = (python.is_some(), testbed::has_program("tshark"));
        // The first Python with both is the first with one of them: they are installed together.
        let has_pymodbus = python_with("pysoem, pymodbus") == python && has_pysoem;
        let path = path(python.as_deref());
        Self {
            test,
            folder,
            runtime: must(tempfile::tempdir(), Path::new("a folder of sockets")),
            path,
            has_pysoem,
            has_pymodbus,
            has_tshark,
            running: None,
            last_exit_code: 0,
            skipped: false,
            has_cable: false,
        }
    }

    /// A file that the page shows.
    pub(crate) fn put(&self, file_name: &Path, text: &str) {
        must(std::fs::write(self.folder.join(file_name), text), file_name);
    }

    /// Enters the commands of a block, and compares the output of each with the lines below it.
    pub(crate) fn run(&mut self, place: &str, block: &str) {
        let commands: Vec<&str> = block.split("\n$ ").collect();
        for (number, text) in commands.iter().enumerate() {
            let text = if number == 0 { text.strip_prefix("$ ") } else { Some(*text) };
            let Some(text) = text else { panic!("{place}: a console block begins with `$ `") };
            let (command, expected) = text.split_once('\n').unwrap_or((text, ""));
            let next = commands.get(number + 1).copied().unwrap_or_default();
            self.type_in(&format!("{place}: {command}"), command, expected, next);
        }
    }

    /// Ends running processes, and removes the cable: the next page creates its own.
    pub(crate) fn end(mut self) {
        self.kill();
        if self.has_cable {
            ip(&["link", "delete", "m0"]);
        }
    }

    fn kill(&mut self) {
        if let Some(mut process) = self.running.take() {
            process.interrupt();
            assert!(process.wait().success(), "ectwin run after SIGINT");
        }
    }

    fn type_in(&mut self, place: &str, command: &str, expected: &str, next: &str) {
        if let Some(missing) = self.missing(command).filter(|_| !self.skipped) {
            self.skipped = true;
            skip(self.test, &format!("{missing} is not installed"));
        }
        if self.skipped {
            return;
        }
        if command == "unshare -Urn" {
            // This is already in a namespace.
        } else if command == "kill %1" {
            self.kill();
        } else if command.starts_with("ectwin run") && expected.starts_with("ready") {
            self.start(place, command, expected);
        } else {
            let printed = self.finish(place, command, next);
            self.has_cable |= command.starts_with("ip link add m0 ");
            let loose = command.starts_with("ectwin demo");
            assert!(
                matches(expected, &printed, loose),
                "{place}\nexpected:\n{expected}\nprinted:\n{printed}"
            );
        }
    }

    fn missing(&self, command: &str) -> Option<&'static str> {
        let word = |name| command.split_whitespace().any(|word| word == name);
        let script = command.split_whitespace().find(|word| word.ends_with(".py"));
        let text = script.and_then(|script| std::fs::read_to_string(self.folder.join(script)).ok());
        let text = text.unwrap_or_default();
        if (text.contains("pysoem") || text.contains("import bench")) && !self.has_pysoem {
            return Some("pysoem");
        }
        if text.contains("pymodbus") && !self.has_pymodbus {
            return Some("pymodbus");
        }
        (word("tshark") && !self.has_tshark).then_some("tshark")
    }

    fn start(&mut self, place: &str, command: &str, expected: &str) {
        self.kill();
        // `exec`: the signal is for ectwin, not for its shell.
        let command = format!("exec {}", command.trim_end_matches('&'));
        let mut process = Process::start(&mut self.shell(&command));
        let ready = process.wait_for_line("ready").to_owned();
        assert!(matches(expected, &ready, false), "{place}\nexpected:\n{expected}\nprinted:\n{ready}");
        self.running = Some(process);
    }

    /// Runs a command to its end. It must succeed, unless the next one checks its exit code.
    fn finish(&mut self, place: &str, command: &str, next: &str) -> String {
        // tshark's warning to the superuser does not concern the reader.
        let stderr = if command.starts_with("tshark") { "/dev/null" } else { "&1" };
        let command = format!("exec 2>{stderr}; (exit {}); {command}", self.last_exit_code);
        let output = self.shell(&command).output().unwrap_or_else(|error| panic!("{place}: {error}"));
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        self.last_exit_code = output.status.code().unwrap_or(-1);
        assert!(output.status.success() || next.contains("$?"), "{place}: {}\n{printed}", output.status);
        printed
    }

    fn shell(&self, command: &str) -> Command {
        let mut shell = Command::new("sh");
        shell.args(["-c", command]).current_dir(&self.folder).env("PATH", &self.path).env("NO_COLOR", "1");
        shell.env("XDG_RUNTIME_DIR", self.runtime.path()).env_remove("ECTWIN_CONTROL").env_remove("RUST_LOG");
        shell
    }
}

/// The built command and the Python with pysoem before all others.
fn path(python: Option<&Path>) -> OsString {
    let folders = [Some(Path::new(env!("CARGO_BIN_EXE_ectwin"))), python].into_iter().flatten();
    let folders = folders.filter_map(Path::parent).filter(|folder| !folder.as_os_str().is_empty());
    let usual = std::env::var_os("PATH").unwrap_or_default();
    let all = folders.map(Path::to_path_buf).chain(std::env::split_paths(&usual));
    must(std::env::join_paths(all), Path::new("PATH"))
}

fn must<T, E: std::fmt::Display>(result: Result<T, E>, path: &Path) -> T {
    result.unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Whether the page's lines equal the output. Runs of blanks are equal; with `loose` all numbers are equal.
fn matches(expected: &str, printed: &str, loose: bool) -> bool {
    let lines = |text: &str| -> Vec<String> {
        let lines = text.lines().map(|line| plain(line, loose));
        lines.filter(|line| !line.is_empty()).collect()
    };
    matches_lines(&lines(expected), &lines(printed))
}

fn matches_lines(expected: &[String], printed: &[String]) -> bool {
    match expected.split_first() {
        None => printed.is_empty(),
        Some((line, rest)) if line == ANYTHING => {
            (0..=printed.len()).any(|skipped| matches_lines(rest, &printed[skipped..]))
        }
        Some((line, rest)) => match printed.split_first() {
            Some((first, others)) => matches_line(line, first) && matches_lines(rest, others),
            None => false,
        },
    }
}

fn matches_line(expected: &str, printed: &str) -> bool {
    let mut parts = expected.split(ANYTHING);
    let first = parts.next().unwrap_or_default();
    let Some(mut left) = printed.strip_prefix(first) else { return false };
    let parts: Vec<&str> = parts.collect();
    let Some((last, between)) = parts.split_last() else { return left.is_empty() };
    for part in between {
        let Some((_, behind)) = left.split_once(part) else { return false };
        left = behind;
    }
    left.ends_with(last)
}

fn plain(line: &str, loose: bool) -> String {
    let words: Vec<&str> = line.split_whitespace().collect();
    let line = words.join(" ");
    if !loose {
        return line;
    }
    let mut plain = String::new();
    for letter in line.chars().map(|letter| if letter.is_ascii_digit() { '0' } else { letter }) {
        if !(letter == '0' && plain.ends_with('0')) {
            plain.push(letter);
        }
    }
    plain
}

#[test]
fn an_output_matches_what_a_page_says_of_it() {
    assert!(matches("a  b\n…\nz\n", "a b\nc\nd\nz\n", false));
    assert!(matches("a … c … e", "a b c d e", false));
    assert!(matches("…", "", false));
    assert!(matches("cycle 7", "cycle 1234", true));
    for (expected, printed) in
        [("a", "b"), ("a", "a\nb"), ("a\n…\nz", "a\ny"), ("7", "8"), ("a … c", "a b d")]
    {
        assert!(!matches(expected, printed, false), "{expected:?} {printed:?}");
    }
}
