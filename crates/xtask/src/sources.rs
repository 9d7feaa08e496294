//! The files of the checkout, according to git.

use std::path::PathBuf;
use std::process::Command;

use crate::tools::root;

/// One text file of the project.
pub(crate) struct Source {
    /// Its path from the top folder, with `/`.
    pub(crate) path: String,
    pub(crate) text: String,
}

impl Source {
    /// The extension of the path.
    pub(crate) fn extension(&self) -> &str {
        self.path.rsplit_once('.').map_or("", |(_, extension)| extension)
    }

    /// Whether the whole file exists only for tests.
    pub(crate) fn is_test(&self) -> bool {
        let in_folder = |name: &str| {
            self.path.starts_with(&format!("{name}/")) || self.path.contains(&format!("/{name}/"))
        };
        in_folder("tests") || in_folder("benches") || self.path.ends_with("tests.rs")
    }

    /// The lines that are not tests, numbered from 1: without declarations of modules of tests, and up to the
    /// module of tests at the end of a file.
    pub(crate) fn code_lines(&self) -> impl Iterator<Item = (usize, &str)> {
        let lines: Vec<&str> = self.text.lines().collect();
        let is_for_tests = |line: &&str| line.trim() == "#[cfg(test)]";
        let declares =
            |at: usize| lines.get(at).is_some_and(|line| line.contains("mod ") && line.ends_with(';'));
        let opens = |at: usize| is_for_tests(&lines[at]) && !declares(at + 1);
        let end = (0..lines.len()).find(|at| opens(*at)).unwrap_or(lines.len());
        let is_left_out = |at: usize| is_for_tests(&lines[at]) || (at > 0 && is_for_tests(&lines[at - 1]));
        let code: Vec<(usize, &str)> =
            (0..end).filter(|at| !is_left_out(*at)).map(|at| (at + 1, lines[at])).collect();
        code.into_iter()
    }
}

/// Every text file that is tracked, or would be after `git add`.
///
/// # Errors
/// If git cannot list the files.
pub(crate) fn read() -> Result<Vec<Source>, String> {
    let mut command = Command::new("git");
    command.args(["ls-files", "--cached", "--others", "--exclude-standard", "-z"]).current_dir(root());
    let output = command.output().map_err(|error| format!("git ls-files: {error}"))?;
    if !output.status.success() {
        return Err(format!("git ls-files: {}", String::from_utf8_lossy(&output.stderr)));
    }
    let paths = String::from_utf8_lossy(&output.stdout);
    // Files that are not text (captures), and files that were removed without `git rm`, are left out.
    let read = |path: &str| {
        let text = std::fs::read_to_string(root().join(PathBuf::from(path))).ok()?;
        Some(Source { path: path.to_string(), text })
    };
    Ok(paths.split('\0').filter(|path| !path.is_empty()).filter_map(read).collect())
}
