//! Reading, replacing and setting aside one file.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The contents of a file; none if there is no such file yet.
///
/// # Errors
/// The file, or the folder that it would be in, cannot be read.
pub fn read(path: &Path) -> io::Result<Option<Vec<u8>>> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        // A folder that is missing too is a mistake that the first write would only tell later.
        Err(error) if error.kind() == io::ErrorKind::NotFound => fs::metadata(folder(path)).map(|_| None),
        Err(error) => Err(error),
    }
}

/// Replaces the contents of a file. When it returns, a loss of power does not undo it; if the program is killed
/// before, the file has its old contents or the new ones.
///
/// # Errors
/// The folder cannot be written, or the disk is full; the file is as it was.
pub fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // Always the same name: what a kill leaves there is overwritten by the next write.
    let new = beside(path, ".new");
    let mut file = File::create(&new)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    drop(file);
    fs::rename(&new, path)?;
    sync_folder(path)
}

/// Gives a file that cannot be used the first free name of `NAME.damaged-1`, `NAME.damaged-2` and so on.
///
/// # Errors
/// It cannot be renamed.
pub fn set_aside(path: &Path) -> io::Result<PathBuf> {
    let mut number = 1_u32;
    loop {
        let aside = beside(path, &format!(".damaged-{number}"));
        if fs::symlink_metadata(&aside).is_err_and(|error| error.kind() == io::ErrorKind::NotFound) {
            fs::rename(path, &aside)?;
            sync_folder(path)?;
            return Ok(aside);
        }
        number = number.checked_add(1).ok_or(io::ErrorKind::AlreadyExists)?;
    }
}

fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(suffix);
    PathBuf::from(name)
}

/// The new name is on the disk only when the folder is.
fn sync_folder(path: &Path) -> io::Result<()> {
    if cfg!(unix) { File::open(folder(path))?.sync_all() } else { Ok(()) }
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A folder of one test, empty at first, gone at its end.
    pub(crate) struct Folder(PathBuf);

    impl Folder {
        pub(crate) fn of_test(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("ectwin-storage-{}-{name}", std::process::id()));
            let _ = fs::remove_dir_all(&path);
            fs::create_dir_all(&path).expect("a folder for temporary files");
            Self(path)
        }

        pub(crate) fn file(&self, name: &str) -> PathBuf {
            self.0.join(name)
        }

        fn names(&self) -> Vec<String> {
            let entries = fs::read_dir(&self.0).expect("readable");
            let mut names: Vec<_> = entries
                .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
                .collect();
            names.sort();
            names
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = Folder::of_test("replace");
        let path = folder.file("N1.nvm");
        assert_eq!(read(&path).expect("readable"), None);
        write(&path, b"a long first one").expect("writable");
        write(&path, b"second").expect("writable");
        assert_eq!(read(&path).expect("readable").as_deref(), Some(&b"second"[..]));
        assert_eq!(folder.names(), ["N1.nvm"]);
    }

    #[test]
    fn what_a_kill_has_left_does_not_matter() {
        let folder = Folder::of_test("left");
        let path = folder.file("N1.nvm");
        write(&path, b"old").expect("writable");
        fs::write(folder.file("N1.nvm.new"), b"half of a very long one").expect("writable");
        assert_eq!(read(&path).expect("readable").as_deref(), Some(&b"old"[..]));
        write(&path, b"new").expect("writable");
        assert_eq!(read(&path).expect("readable").as_deref(), Some(&b"new"[..]));
        assert_eq!(folder.names(), ["N1.nvm"]);
    }

    #[test]
    fn a_damaged_file_gets_a_name_that_is_free() {
        let folder = Folder::of_test("aside");
        let path = folder.file("N1.nvm");
        for number in 1..=3 {
            fs::write(&path, [number]).expect("writable");
            let aside = set_aside(&path).expect("renamed");
            assert_eq!(aside, folder.file(&format!("N1.nvm.damaged-{number}")));
        }
        assert_eq!(folder.names(), ["N1.nvm.damaged-1", "N1.nvm.damaged-2", "N1.nvm.damaged-3"]);
        assert_eq!(fs::read(folder.file("N1.nvm.damaged-2")).expect("readable"), [2]);
    }

    #[test]
    fn a_folder_that_is_missing_is_told_at_once() {
        let folder = Folder::of_test("missing");
        let path = folder.file("nowhere").join("N1.nvm");
        assert_eq!(read(&path).map_err(|error| error.kind()), Err(io::ErrorKind::NotFound));
        assert!(write(&path, b"x").is_err());
    }
}
