//! The socket of a twin: only its user reaches it, one twin has it, and it is removed with the twin.

mod error;
mod folder;
mod there;

use std::fs;
use std::io;
use std::os::unix::fs::MetadataExt;
use std::os::unix::net::UnixListener;
use std::path::{Path, PathBuf};

use rustix::fs::{Mode, fchmod};
use rustix::net::{AddressFamily, SocketAddrUnix, SocketFlags, SocketType, bind, listen, socket_with};

pub use error::BindError;
pub use folder::{default_folder, running};

use error::Why;
use folder::Locked;
use there::{There, there};

/// Longest path of a socket: `sun_path` without its last zero.
const PATH_BYTES_MAX: usize = 107;
/// Clients that wait to be accepted.
const BACKLOG: i32 = 128;

/// A socket in the file system on which clients are awaited. Dropping it removes the file.
#[derive(Debug)]
pub struct Socket {
    pub(crate) listener: UnixListener,
    path: PathBuf,
    /// Device and inode of the file, so that the one of another twin is never removed.
    file: (u64, u64),
}

impl Socket {
    /// Makes the socket at this path. A socket that a twin has left is replaced.
    ///
    /// # Errors
    /// [`BindError`]: a twin uses the path, there is something else, or the system refuses it.
    pub fn bind(path: &Path) -> Result<Self, BindError> {
        let path = std::path::absolute(path).map_err(|error| BindError::new(path, error.into()))?;
        Self::bind_absolute(&path).map_err(|why| BindError::new(&path, why))
    }

    /// Makes a socket in the [`default_folder`], with the number of this process as its name.
    ///
    /// # Errors
    /// [`BindError`].
    pub fn bind_default() -> Result<Self, BindError> {
        Self::bind(&folder::make_default()?.join(format!("{}.sock", std::process::id())))
    }

    /// Whether a socket can have this absolute path: the system limits its length.
    #[must_use]
    pub fn has_room(path: &Path) -> bool {
        path.as_os_str().len() <= PATH_BYTES_MAX
    }

    /// Its absolute path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn bind_absolute(path: &Path) -> Result<Self, Why> {
        if !Self::has_room(path) {
            return Err(Why::TooLong { limit_bytes: PATH_BYTES_MAX });
        }
        // Twins that start at the same time decide one after the other what there is.
        let _locked = Locked::folder_of(path)?;
        match there(path)? {
            There::Nothing => {}
            There::Dead => fs::remove_file(path)?,
            There::Alive => return Err(Why::InUse),
            There::Other => return Err(Why::NoSocket),
        }
        let listener = listener(path)?;
        let file = fs::symlink_metadata(path).map(|file| (file.dev(), file.ino()))?;
        Ok(Self { listener, path: path.to_owned(), file })
    }
}

impl Drop for Socket {
    fn drop(&mut self) {
        // Without the lock another twin could replace the file between the two steps; but a living socket is not replaced.
        let _locked = Locked::folder_of(&self.path);
        let is_own = fs::symlink_metadata(&self.path).is_ok_and(|file| (file.dev(), file.ino()) == self.file);
        if is_own && let Err(error) = fs::remove_file(&self.path) {
            tracing::warn!("{}: the socket cannot be removed: {error}", self.path.display());
        }
    }
}

/// The mode of the socket is the mode of its file, so that nobody else reaches it, not even for a moment.
fn listener(path: &Path) -> io::Result<UnixListener> {
    let flags = SocketFlags::CLOEXEC | SocketFlags::NONBLOCK;
    let socket = socket_with(AddressFamily::UNIX, SocketType::STREAM, flags, None)?;
    fchmod(&socket, Mode::RUSR | Mode::WUSR)?;
    bind(&socket, &SocketAddrUnix::new(path)?)?;
    listen(&socket, BACKLOG)?;
    Ok(socket.into())
}
