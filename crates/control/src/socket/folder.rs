//! The folders of sockets: the default one, and how twins that start at the same time take turns.

use std::env;
use std::fs::{self, DirBuilder};
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use rustix::fs::{FlockOperation, Mode, OFlags, flock, open};
use rustix::io::Errno;
use rustix::process::geteuid;

use super::error::{BindError, Why};
use super::there::{There, there};

/// How long another program may hold the lock.
const PATIENCE: Duration = Duration::from_secs(5);
const TRY_AGAIN: Duration = Duration::from_millis(5);

/// The folder in which a twin makes its socket unless a path is given: `$XDG_RUNTIME_DIR/ectwin`. Without such a folder of
/// the user it is `ectwin-UID` in the folder for temporary files. It need not exist.
#[must_use]
pub fn default_folder() -> PathBuf {
    let runtime = env::var_os("XDG_RUNTIME_DIR").map(PathBuf::from).filter(|folder| folder.is_absolute());
    match runtime.filter(|folder| fs::metadata(folder).is_ok_and(|folder| is_own(&folder) && folder.is_dir()))
    {
        Some(folder) => folder.join("ectwin"),
        None => env::temp_dir().join(format!("ectwin-{}", geteuid().as_raw())),
    }
}

/// The sockets of the twins that run, in the [`default_folder`], in the order of their names.
#[must_use]
pub fn running() -> Vec<PathBuf> {
    let folder = default_folder();
    // What somebody else has prepared there is no twin of this user.
    let entries = if is_private(&folder) { fs::read_dir(folder).ok() } else { None };
    let paths = entries.into_iter().flatten().flatten().map(|entry| entry.path());
    let mut paths: Vec<PathBuf> = paths.filter(|path| matches!(there(path), Ok(There::Alive))).collect();
    paths.sort();
    paths
}

/// The default folder, made if it does not exist. Only the user reaches it.
pub(super) fn make_default() -> Result<PathBuf, BindError> {
    let folder = default_folder();
    match DirBuilder::new().mode(0o700).create(&folder) {
        Err(error) if error.kind() != io::ErrorKind::AlreadyExists => {
            return Err(BindError::new(&folder, error.into()));
        }
        _ => {}
    }
    if is_private(&folder) { Ok(folder) } else { Err(BindError::new(&folder, Why::Foreign)) }
}

/// Whether this is a folder, and no link to one, that only the user reaches.
fn is_private(folder: &Path) -> bool {
    fs::symlink_metadata(folder)
        .is_ok_and(|folder| folder.is_dir() && is_own(&folder) && folder.mode() & 0o077 == 0)
}

fn is_own(file: &fs::Metadata) -> bool {
    file.uid() == geteuid().as_raw()
}

/// The lock of a folder, until it is dropped: a lock file would be one more file to leave behind.
pub(super) struct Locked(#[expect(dead_code, reason = "closing it releases the lock")] OwnedFd);

impl Locked {
    pub(super) fn folder_of(path: &Path) -> io::Result<Self> {
        let folder = path.parent().unwrap_or(Path::new("/"));
        let flags = OFlags::RDONLY | OFlags::DIRECTORY | OFlags::CLOEXEC;
        let folder = open(folder, flags, Mode::empty())?;
        let end = Instant::now() + PATIENCE;
        loop {
            match flock(&folder, FlockOperation::NonBlockingLockExclusive) {
                Ok(()) => return Ok(Self(folder)),
                Err(Errno::WOULDBLOCK | Errno::INTR) if Instant::now() < end => thread::sleep(TRY_AGAIN),
                Err(Errno::WOULDBLOCK) => {
                    return Err(io::Error::new(
                        io::ErrorKind::TimedOut,
                        "another program has locked its folder",
                    ));
                }
                Err(error) => return Err(error.into()),
            }
        }
    }
}
