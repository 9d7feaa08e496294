//! What there is at the path of a socket.

use std::fs;
use std::io;
use std::os::unix::fs::FileTypeExt;
use std::path::Path;

use rustix::io::Errno;
use rustix::net::{AddressFamily, SocketAddrUnix, SocketFlags, SocketType, connect, socket_with};

/// What there is at a path.
pub(super) enum There {
    Nothing,
    /// A socket of a process that accepts clients.
    Alive,
    /// A socket of a process that has ended.
    Dead,
    /// Something else.
    Other,
}

pub(super) fn there(path: &Path) -> io::Result<There> {
    let file = match fs::symlink_metadata(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(There::Nothing),
        Err(error) => return Err(error),
    };
    if !file.file_type().is_socket() {
        return Ok(There::Other);
    }
    Ok(if is_alive(path)? { There::Alive } else { There::Dead })
}

/// Whether a process accepts clients at this socket. This does not wait, however many wait there.
fn is_alive(path: &Path) -> io::Result<bool> {
    let flags = SocketFlags::CLOEXEC | SocketFlags::NONBLOCK;
    let socket = socket_with(AddressFamily::UNIX, SocketType::STREAM, flags, None)?;
    match connect(&socket, &SocketAddrUnix::new(path)?) {
        Ok(()) | Err(Errno::AGAIN) => Ok(true),
        Err(Errno::CONNREFUSED | Errno::NOENT) => Ok(false),
        Err(error) => Err(error.into()),
    }
}
