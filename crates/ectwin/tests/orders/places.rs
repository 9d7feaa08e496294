//! Files that orders name, in a folder of the test.

use std::fs;
use std::path::{Path, PathBuf};

use ectwin::esi::sii;
use ectwin::plant::UnitFile;

/// A folder that goes with this value. `@` in a sentence is its path.
pub(crate) struct Files(PathBuf);

impl Files {
    pub(crate) fn new() -> Self {
        let name = std::thread::current().name().unwrap_or("orders").replace("::", "_");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let file = UnitFile::factory();
        let right = sii::try_image(&file.section().description()).unwrap();
        let mut broken = right.clone();
        broken[14] ^= 0xFF;
        let files = Self(folder);
        files.write("right.bin", &right);
        files.write("broken.bin", &broken);
        files.write("other.toml", b"model = \"nx-ect101\"\nname = \"N1\"\nserial = 77");
        files.write("nine.st", b"N1_UINTs_01_C_to_M[0] := 9;");
        files.write("wrong.st", b"N1_UINTs_01_C_to_M[0] := ;");
        files
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.0.join(name), bytes).unwrap();
    }

    /// The sentence with the paths of its files.
    pub(crate) fn in_place(&self, sentence: &str) -> String {
        sentence.replace('@', &format!("{}/", self.0.display()))
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
