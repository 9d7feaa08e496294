//! Capabilities are only for opening links and ports; the threads that answer received frames have none.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::thread;

use ectwin::user_files;
use rustix::fs::{Access, AtFlags, CWD, accessat};
use rustix::process::{getegid, geteuid};
use rustix::thread::{CapabilitySet, CapabilitySets, capabilities, set_capabilities, set_no_new_privs};

/// A file that is used while the units run.
pub(crate) enum LaterUse {
    Read(PathBuf),
    /// The files and folders of a program, which are read again when they change.
    Program(Vec<PathBuf>),
    /// Replaced completely, by a new file in its folder.
    Written(PathBuf),
}

/// Drops all capabilities, and the possibility to gain new ones, for this thread and those that it starts
/// later. The superuser keeps CAP_DAC_OVERRIDE if a file of another user is not accessible without it, and
/// CAP_CHOWN and CAP_FOWNER if such a file is replaced: the new one belongs to the same user.
pub(crate) fn give_up(files: &[LaterUse]) {
    let mut kept = CapabilitySet::empty();
    if !in_reach_without_capabilities(files) {
        kept |= CapabilitySet::DAC_OVERRIDE;
    }
    if files.iter().any(replaces_a_file_of_another) {
        kept |= CapabilitySet::CHOWN | CapabilitySet::FOWNER;
    }
    if let Err(error) = set_no_new_privs(true).and_then(|()| keep_only(kept)) {
        tracing::warn!("cannot give up privileges: {error}");
    }
}

fn keep_only(kept: CapabilitySet) -> rustix::io::Result<()> {
    let permitted = capabilities(None)?.permitted & kept;
    let inheritable = CapabilitySet::empty();
    set_capabilities(None, CapabilitySets { effective: permitted, permitted, inheritable })
}

/// Capabilities belong to a thread: one without any tries to access the files.
fn in_reach_without_capabilities(files: &[LaterUse]) -> bool {
    thread::scope(|scope| {
        let tried = scope.spawn(|| keep_only(CapabilitySet::empty()).is_ok() && files.iter().all(in_reach));
        tried.join().unwrap_or(false)
    })
}

fn replaces_a_file_of_another(file: &LaterUse) -> bool {
    let LaterUse::Written(path) = file else { return false };
    let own = (geteuid().as_raw(), getegid().as_raw());
    fs::metadata(path).is_ok_and(|found| (found.uid(), found.gid()) != own)
}

fn in_reach(file: &LaterUse) -> bool {
    match file {
        LaterUse::Read(path) => may(path, Access::READ_OK),
        LaterUse::Program(paths) => user_files::program_files(paths)
            .is_ok_and(|files| files.iter().all(|file| may(file, Access::READ_OK))),
        LaterUse::Written(path) => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            may(folder.unwrap_or(Path::new(".")), Access::WRITE_OK | Access::EXEC_OK)
                && (!path.exists() || may(path, Access::READ_OK | Access::WRITE_OK))
        }
    }
}

fn may(path: &Path, access: Access) -> bool {
    accessat(CWD, path, access, AtFlags::EACCESS).is_ok()
}
