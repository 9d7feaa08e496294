//! The folder of the control socket: only the user reaches it, and each run has its own.

use std::fs;
use std::io;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use ectwin::control::{Socket, default_folder};

use crate::failure::Failure;

const SOCKET: &str = "control.sock";

/// The folder, removed when it is dropped.
pub(super) struct ControlFolder(PathBuf);

impl ControlFolder {
    /// Makes a folder beside the default one, or in /tmp if the path of a socket in it would be too long.
    pub(super) fn make() -> Result<Self, Failure> {
        let beside = default_folder().parent().map(Path::to_owned).unwrap_or_default();
        let folder = make_in(&beside).map_err(Failure::System)?;
        if Socket::has_room(&socket_in(&folder.0)) {
            return Ok(folder);
        }
        make_in(Path::new("/tmp")).map_err(Failure::System)
    }

    /// The folder that another process has made. It is removed with this value too: each process can be the last one.
    pub(super) const fn made_outside(path: PathBuf) -> Self {
        Self(path)
    }

    pub(super) fn path(&self) -> &Path {
        &self.0
    }

    /// The path of the socket.
    pub(super) fn socket(&self) -> PathBuf {
        socket_in(&self.0)
    }
}

impl Drop for ControlFolder {
    fn drop(&mut self) {
        // The units remove their socket, unless they were killed; what somebody else has put there is kept.
        let _removed = fs::remove_file(self.socket());
        let _removed = fs::remove_dir(&self.0);
    }
}

fn socket_in(folder: &Path) -> PathBuf {
    folder.join(SOCKET)
}

fn make_in(parent: &Path) -> io::Result<ControlFolder> {
    let only_the_user = fs::Permissions::from_mode(0o700);
    let folder =
        tempfile::Builder::new().prefix("ectwin-exec-").permissions(only_the_user).tempdir_in(parent)?;
    Ok(ControlFolder(folder.keep()))
}
