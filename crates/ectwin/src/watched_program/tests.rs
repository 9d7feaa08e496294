//! Looks at files between saves: what is loaded, and how often.

use std::fs;

use nx_ect101::unit_file::UnitFile;

use super::*;

/// Looks behind each save: far more than it takes for a change to come to rest.
const LOOKS: usize = 10;

/// Two files of a program in a folder of the test's own, and the watch of the folder.
struct Bench {
    folder: PathBuf,
    watch: Watch,
}

impl Bench {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ectwin-watched-{}-{name}", std::process::id()));
        // What an earlier run has left is not part of this one.
        let _gone = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("block.st"), "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK")
            .expect("written");
        fs::write(folder.join("main.st"), "PROGRAM Main VAR b : B; END_VAR b(x := 1); END_PROGRAM")
            .expect("written");
        let paths = vec![folder.clone()];
        let file = UnitFile::parse("model = \"nx-ect101\"").expect("the factory setting");
        let program = WatchedProgram {
            stamps: stamps(&paths),
            text: ProgramText::read(&paths).expect("two files"),
            paths,
            variables: DeviceVariables::of_unit_file(&file),
            budget_statements: 1_000,
        };
        Self { folder, watch: Watch::new(program) }
    }

    /// How many programs so many looks give.
    fn loads(&mut self) -> usize {
        (0..LOOKS).filter(|_| self.watch.look().is_some()).count()
    }

    fn save(&self, name: &str, text: &str) {
        fs::write(self.folder.join(name), text).expect("written");
    }

    fn main(&self, x: &str) {
        self.save("main.st", &format!("PROGRAM Main VAR b : B; END_VAR b(x := {x}); END_PROGRAM"));
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        // A folder that stays hurts no one.
        let _gone = fs::remove_dir_all(&self.folder);
    }
}

#[test]
fn each_change_of_any_file_is_loaded_once() {
    let mut bench = Bench::new("once");
    assert_eq!(bench.loads(), 0);
    bench.main("12");
    assert_eq!(bench.loads(), 1);
    bench.save("block.st", "FUNCTION_BLOCK B VAR_INPUT x : DINT; END_VAR END_FUNCTION_BLOCK");
    assert_eq!(bench.loads(), 1);
    // A further file in the folder, and one that goes.
    bench.save("more.st", "TYPE Colour : (red, green); END_TYPE");
    assert_eq!(bench.loads(), 1);
    fs::remove_file(bench.folder.join("more.st")).expect("removed");
    assert_eq!(bench.loads(), 1);
}

#[test]
fn a_mistake_keeps_the_old_program_until_it_is_mended() {
    let mut bench = Bench::new("mistake");
    bench.main("missing");
    assert_eq!(bench.loads(), 0);
    bench.main("345");
    assert_eq!(bench.loads(), 1);
}

#[test]
fn a_file_that_vanishes_and_comes_back_is_loaded_if_it_differs() {
    let mut bench = Bench::new("vanishes");
    let main = bench.folder.join("main.st");
    let text = fs::read_to_string(&main).expect("it is there");
    fs::remove_file(&main).expect("removed");
    // The block alone is no program: told, and nothing is loaded.
    assert_eq!(bench.loads(), 0);
    fs::write(&main, &text).expect("written");
    assert_eq!(bench.loads(), 0, "it is as it was");
    fs::remove_file(&main).expect("removed");
    assert_eq!(bench.loads(), 0);
    bench.main("678");
    assert_eq!(bench.loads(), 1);
    bench.watch.program.paths = vec![bench.folder.join("block.st"), main.clone()];
    fs::remove_file(&main).expect("removed");
    assert_eq!(bench.loads(), 0);
    bench.main("9");
    assert_eq!(bench.loads(), 1);
}

#[test]
fn a_file_that_is_replaced_by_renaming_is_loaded_even_if_time_and_length_are_the_same() {
    let mut bench = Bench::new("renamed");
    let main = bench.folder.join("main.st");
    let written = fs::metadata(&main).and_then(|metadata| metadata.modified()).expect("a time");
    let next = bench.folder.join("main.st~");
    fs::write(&next, "PROGRAM Main VAR b : B; END_VAR b(x := 2); END_PROGRAM").expect("written");
    fs::File::options().write(true).open(&next).and_then(|file| file.set_modified(written)).expect("set");
    fs::rename(&next, &main).expect("renamed");
    assert_eq!(bench.loads(), 1);
}

#[test]
fn a_file_that_is_written_and_is_the_same_is_not_loaded() {
    let mut bench = Bench::new("same");
    bench.main("1");
    assert_eq!(bench.loads(), 0);
}
