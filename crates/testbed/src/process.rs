//! A child process that is read line by line and does not outlive its test.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};

/// A running child: the caller reads its standard output, its standard error goes to the test's.
pub struct Process {
    child: Child,
    stdout: BufReader<ChildStdout>,
    line: String,
}

impl Process {
    /// Starts `command`.
    ///
    /// # Panics
    /// If it cannot be started.
    #[must_use]
    pub fn start(command: &mut Command) -> Self {
        let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = child.unwrap_or_else(|error| panic!("{command:?}: {error}"));
        let Some(stdout) = child.stdout.take() else { panic!("{command:?}: has no standard output") };
        Self { child, stdout: BufReader::new(stdout), line: String::new() }
    }

    /// Its process identifier.
    #[must_use]
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits for a line that begins with `start` and returns it; prints the lines before it.
    ///
    /// # Panics
    /// If the output ends before such a line.
    pub fn wait_for_line(&mut self, start: &str) -> &str {
        self.wait_for_line_of(&[start])
    }

    /// The same for a line that begins with one of these.
    ///
    /// # Panics
    /// If the output ends before such a line.
    pub fn wait_for_line_of(&mut self, starts: &[&str]) -> &str {
        loop {
            self.line.clear();
            match self.stdout.read_line(&mut self.line) {
                Ok(0) => panic!("the output ended before a line of {starts:?}: {:?}", self.child.wait()),
                Ok(_) if starts.iter().any(|start| self.line.starts_with(start)) => {
                    return self.line.trim_end();
                }
                Ok(_) => print!("{}", self.line),
                Err(error) => panic!("waiting for a line of {starts:?}: {error}"),
            }
        }
    }

    /// Writes a line to its standard input.
    ///
    /// # Panics
    /// If it has closed its input.
    pub fn say(&mut self, line: &str) {
        let said = self.child.stdin.as_mut().map(|stdin| writeln!(stdin, "{line}"));
        assert!(matches!(said, Some(Ok(()))), "could not say `{line}`: {said:?}");
    }

    /// Closes its standard input.
    pub fn close_stdin(&mut self) {
        drop(self.child.stdin.take());
    }

    /// Sends SIGINT, as Ctrl-C does.
    ///
    /// # Panics
    /// If the signal cannot be sent.
    pub fn interrupt(&self) {
        // The `kill` of the shell: not every machine has the program of that name.
        let kill = format!("kill -INT {}", self.child.id());
        let sent = Command::new("sh").args(["-c", &kill]).status();
        assert!(sent.as_ref().is_ok_and(ExitStatus::success), "kill -INT: {sent:?}");
    }

    /// Prints the rest of the output and waits for the end.
    ///
    /// # Panics
    /// If the child cannot be waited for.
    pub fn wait(&mut self) -> ExitStatus {
        let rest = std::io::read_to_string(&mut self.stdout).unwrap_or_default();
        print!("{rest}");
        self.child.wait().unwrap_or_else(|error| panic!("waiting for the child: {error}"))
    }
}

impl Drop for Process {
    /// A test that panics leaves nothing running. An error means that the child has already ended.
    fn drop(&mut self) {
        let _ended = self.child.kill().and_then(|()| self.child.wait());
    }
}
