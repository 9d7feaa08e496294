//! New contents of a file that get its name when they are complete, so that it has the old contents or all the new ones,
//! also after a kill and with a full disk.

use std::fs::File;
use std::io::{self, Write};
use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

/// Without the bits that the user's mask removes.
const EVERYBODY: u32 = 0o666;

/// The new contents, in a file beside the one that they replace. Unless they are complete, that file is removed.
pub(crate) struct WholeFile {
    /// After all symbolic links, so that they are kept.
    target: PathBuf,
    contents: NamedTempFile,
}

impl WholeFile {
    /// For the file at this path. If it exists, it is `like`, whose owner and permissions are kept.
    pub(crate) fn beside(path: &Path, like: Option<&File>) -> io::Result<Self> {
        let target = storage::resolve(path)?;
        let folder = target.parent().unwrap_or(Path::new("/"));
        let everybody = std::fs::Permissions::from_mode(EVERYBODY);
        let contents = Builder::new().prefix(".ectwin-").permissions(everybody).tempfile_in(folder)?;
        if let Some(like) = like {
            resemble(contents.as_file(), like)?;
        }
        Ok(Self { target, contents })
    }

    /// The contents are complete: they get the name of the file.
    pub(crate) fn complete(mut self) -> io::Result<()> {
        self.flush()?;
        self.contents.persist(self.target).map(drop).map_err(|refused| refused.error)
    }
}

fn resemble(own: &File, like: &File) -> io::Result<()> {
    let (is, wanted) = (own.metadata()?, like.metadata()?);
    if (is.uid(), is.gid()) != (wanted.uid(), wanted.gid()) {
        // Only root may change the owner. The contents are more important than their owner.
        let _ = fchown(own, Some(wanted.uid()), Some(wanted.gid()));
    }
    own.set_permissions(wanted.permissions())
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // The file itself: errors of the library name a path that nobody knows.
        self.contents.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.contents.as_file_mut().flush()
    }
}
