use std::os::unix::fs::{PermissionsExt, symlink};

use super::*;

/// The folder of one test, empty at first, removed at the end.
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

    pub(crate) fn claim(&self, name: &str) -> io::Result<StoredFile> {
        StoredFile::claim(&self.file(name))
    }

    pub(crate) fn contents(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.file(name)).ok()
    }

    pub(crate) fn names(&self) -> Vec<String> {
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

/// Why a claim is refused.
fn refused(claim: io::Result<StoredFile>) -> io::ErrorKind {
    claim.map(|_| ()).expect_err("refused").kind()
}

#[test]
fn a_file_is_replaced_as_a_whole() {
    let folder = Folder::of_test("replace");
    let mut file = folder.claim("N1.nvm").expect("free");
    assert_eq!(file.read().expect("readable"), None);
    for contents in [&b"a long first one"[..], b"second"] {
        file.write(contents).expect("writable");
        assert_eq!(file.read().expect("readable").as_deref(), Some(contents));
    }
    drop(file);
    assert_eq!(
        folder.claim("N1.nvm").expect("free").read().expect("readable").as_deref(),
        Some(&b"second"[..])
    );
    assert_eq!(folder.names(), ["N1.nvm"]);
}

#[test]
fn a_second_owner_is_refused_by_whatever_path_until_the_first_one_ends() {
    let folder = Folder::of_test("owners");
    fs::write(folder.file("N1.nvm"), "old").expect("writable");
    fs::hard_link(folder.file("N1.nvm"), folder.file("hard")).expect("linked");
    symlink("N1.nvm", folder.file("soft")).expect("linked");
    symlink(&folder.0, folder.file("folder")).expect("linked");
    for path in ["N1.nvm", "hard", "soft", "folder/N1.nvm", "folder/../soft"] {
        let before = folder.names();
        let first = folder.claim("N1.nvm").expect("free");
        let folder_of_test = Path::new(&folder.0).join(path.replace("folder/..", "."));
        assert_eq!(refused(StoredFile::claim(&folder_of_test)), io::ErrorKind::ResourceBusy, "{path}");
        drop(first);
        folder.claim(path.trim_start_matches("folder/../")).expect("free again");
        assert_eq!(folder.names(), before, "nothing is left");
    }
}

#[test]
fn a_file_that_is_replaced_stays_claimed() {
    let folder = Folder::of_test("replaced");
    let mut first = folder.claim("N1.nvm").expect("free");
    for generation in 0..3 {
        first.write(&[generation]).expect("writable");
        assert_eq!(refused(folder.claim("N1.nvm")), io::ErrorKind::ResourceBusy);
        let other_name = format!("hard-{generation}");
        fs::hard_link(folder.file("N1.nvm"), folder.file(&other_name)).expect("linked");
        assert_eq!(refused(folder.claim(&other_name)), io::ErrorKind::ResourceBusy);
    }
    fs::remove_file(folder.file("N1.nvm")).expect("removed");
    assert_eq!(refused(folder.claim("N1.nvm")), io::ErrorKind::ResourceBusy, "the name is claimed");
}

#[test]
fn what_a_kill_has_left_is_removed_and_nothing_else_is() {
    let folder = Folder::of_test("left");
    let others = [".N1.nvm.ectwin-12", ".N1.nvm.ectwin-wxyz", "N1.nvm.new", ".N2.nvm.ectwin-12ab"];
    for name in others.into_iter().chain(["N1.nvm", ".N1.nvm.ectwin-12ab"]) {
        fs::write(folder.file(name), "half of a very long one").expect("writable");
    }
    fs::write(folder.file(".N1.nvm.ectwin-lock"), "").expect("writable");
    let mut file = folder.claim("N1.nvm").expect("free");
    file.write(b"new").expect("writable");
    drop(file);
    let mut expected: Vec<&str> = others.into_iter().chain(["N1.nvm"]).collect();
    expected.sort_unstable();
    assert_eq!(folder.names(), expected);
    assert_eq!(folder.contents("N1.nvm.new").as_deref(), Some(&b"half of a very long one"[..]));
}

#[test]
fn a_link_in_the_way_of_a_new_file_is_not_followed() {
    let folder = Folder::of_test("in-the-way");
    fs::write(folder.file("precious"), "precious").expect("writable");
    let mut file = folder.claim("N1.nvm").expect("free");
    let first = std::process::id() as u16;
    for number in 0..3 {
        let name = format!(".N1.nvm.ectwin-{:04x}", first.wrapping_add(number));
        symlink("precious", folder.file(&name)).expect("linked");
    }
    file.write(b"new").expect("there are more names");
    assert_eq!(folder.contents("precious").as_deref(), Some(&b"precious"[..]));
    drop(file);
}

#[test]
fn what_is_no_lock_is_refused_by_its_name_and_not_removed() {
    let folder = Folder::of_test("no-lock");
    fs::write(folder.file("precious"), "precious").expect("writable");
    fs::write(folder.file(".file.nvm.ectwin-lock"), "my notes").expect("writable");
    symlink("precious", folder.file(".link.nvm.ectwin-lock")).expect("linked");
    symlink("gone", folder.file(".dangling.nvm.ectwin-lock")).expect("linked");
    fs::create_dir(folder.file(".folder.nvm.ectwin-lock")).expect("writable");
    let before = folder.names();
    for name in ["file", "link", "dangling", "folder"] {
        let refused = folder.claim(&format!("{name}.nvm")).expect_err(name).to_string();
        assert!(refused.contains(&format!("its lock .{name}.nvm.ectwin-lock is not a lock")), "{refused}");
        assert_eq!(folder.names(), before);
    }
    assert_eq!(folder.contents(".file.nvm.ectwin-lock").as_deref(), Some(&b"my notes"[..]));
}

#[test]
fn what_is_put_in_its_place_is_not_replaced_until_it_is_moved_away() {
    let folder = Folder::of_test("another");
    fs::write(folder.file("precious"), "precious").expect("writable");
    let (file, aside) = (folder.file("N1.nvm"), folder.file("aside"));
    let mut stored = folder.claim("N1.nvm").expect("free");
    for (contents, generation) in [(&b"first"[..], 0), (b"second", 1), (b"third", 2), (b"fourth", 3)] {
        match generation {
            0 | 1 => fs::write(&aside, "another").and_then(|()| fs::rename(&aside, &file)).expect("writable"),
            2 => fs::remove_file(&file).and_then(|()| symlink("precious", &file)).expect("linked"),
            _ => fs::remove_file(&file).and_then(|()| fs::create_dir(&file)).expect("made"),
        }
        let refused = stored.write(contents).expect_err("it is not this file").to_string();
        assert!(refused.contains("is in its place, and is not replaced; move it away"), "{refused}");
        assert_eq!(folder.contents("precious").as_deref(), Some(&b"precious"[..]));
        fs::rename(&file, &aside).expect("moved away");
        stored.write(contents).expect("nothing is in the way");
        assert_eq!(folder.contents("N1.nvm").as_deref(), Some(contents));
        let _gone = fs::remove_file(&aside).or_else(|_| fs::remove_dir(&aside));
    }
    assert_eq!(folder.names(), [".N1.nvm.ectwin-lock", "N1.nvm", "precious"]);
}

#[test]
fn a_link_stays_a_link_and_permissions_stay() {
    let folder = Folder::of_test("links");
    fs::create_dir(folder.file("far")).expect("writable");
    symlink("far/away.nvm", folder.file("second")).expect("linked");
    symlink("second", folder.file("first")).expect("linked");
    let mut file = folder.claim("first").expect("a link to nothing yet");
    file.write(b"made").expect("writable");
    fs::set_permissions(folder.file("far/away.nvm"), fs::Permissions::from_mode(0o640)).expect("ours");
    drop(file);
    let mut file = folder.claim("first").expect("free");
    for contents in [&b"one"[..], b"two"] {
        file.write(contents).expect("writable");
        assert_eq!(folder.contents("far/away.nvm").as_deref(), Some(contents));
        let mode = fs::metadata(folder.file("first")).expect("there").permissions().mode();
        assert_eq!(mode & 0o7777, 0o640);
    }
    assert_eq!(fs::read_link(folder.file("first")).expect("a link"), Path::new("second"));
    assert_eq!(fs::read_link(folder.file("second")).expect("a link"), Path::new("far/away.nvm"));
}

#[test]
fn a_damaged_file_gets_a_name_that_is_free() {
    let folder = Folder::of_test("aside");
    for number in 1..=3 {
        fs::write(folder.file("N1.nvm"), [number]).expect("writable");
        let aside = folder.claim("N1.nvm").expect("free").set_aside().expect("renamed");
        assert!(aside.ends_with(format!("N1.nvm.damaged-{number}")), "{}", aside.display());
    }
    assert_eq!(folder.names(), ["N1.nvm.damaged-1", "N1.nvm.damaged-2", "N1.nvm.damaged-3"]);
    assert_eq!(folder.contents("N1.nvm.damaged-2"), Some(vec![2]));
}

#[test]
fn without_a_free_name_nothing_is_set_aside() {
    let folder = Folder::of_test("no-name");
    for number in 1..=ASIDE_MAX {
        fs::write(folder.file(&format!("N1.nvm.damaged-{number}")), "").expect("writable");
    }
    fs::write(folder.file("N1.nvm"), "damaged").expect("writable");
    let refused = folder.claim("N1.nvm").expect("free").set_aside().expect_err("no name").to_string();
    assert!(refused.contains("remove some"), "{refused}");
    assert_eq!(folder.contents("N1.nvm").as_deref(), Some(&b"damaged"[..]));
}

#[test]
fn what_is_no_file_is_refused_at_once() {
    let folder = Folder::of_test("no-file");
    fs::create_dir(folder.file("folder")).expect("writable");
    symlink("circle", folder.file("circle")).expect("linked");
    symlink("/dev/zero", folder.file("device")).expect("linked");
    let long = "n".repeat(250);
    for name in ["folder", "circle", "device", "nowhere/N1.nvm", "..", &long] {
        let before = folder.names();
        folder.claim(name).expect_err(name);
        assert_eq!(folder.names(), before);
    }
}

#[test]
fn what_is_larger_than_any_memory_is_not_read() {
    let folder = Folder::of_test("large");
    let large = File::create(folder.file("N1.nvm")).expect("writable");
    large.set_len(BYTES_MAX + 1).expect("a hole takes no room");
    let claimed = folder.claim("N1.nvm").expect("free");
    assert_eq!(claimed.read().expect_err("too large").kind(), io::ErrorKind::FileTooLarge);
}

#[test]
fn a_look_at_a_file_sees_its_contents_or_why_it_cannot_be_claimed_and_makes_nothing() {
    let folder = Folder::of_test("peek");
    fs::create_dir(folder.file("folder")).expect("writable");
    fs::write(folder.file("N1.nvm"), "contents").expect("writable");
    let (before, long) = (folder.names(), "n".repeat(250));
    let peek = |name: &str| StoredFile::peek(&folder.file(name));
    assert_eq!(peek("N1.nvm").expect("readable").as_deref(), Some(&b"contents"[..]));
    assert_eq!(peek("N2.nvm").expect("could be made"), None);
    for name in ["folder", "nowhere/N1.nvm", "..", &long] {
        assert_eq!(peek(name).expect_err(name).kind(), refused(folder.claim(name)), "{name}");
    }
    let claimed = folder.claim("N1.nvm").expect("nothing is claimed");
    assert!(peek("N1.nvm").is_ok(), "an owner is no reason");
    drop(claimed);
    assert_eq!(folder.names(), before);
}
