//! Checks of files between saves: what is loaded, and how often.

use std::fs;
use std::io;
use std::os::unix::fs::{MetadataExt, symlink};
use std::path::Path;
use std::sync::Mutex;

use nx_ect101::unit_file::UnitFile;

use super::*;

/// Number of checks after each save: many more than a change needs to settle.
const LOOKS: usize = 10;

/// Two files of a program in a folder of the test, and the watch of the folder.
struct Bench {
    folder: PathBuf,
    watch: Watch,
}

impl Bench {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("ectwin-watched-{}-{name}", std::process::id()));
        // Files of an earlier run are not part of this one.
        let _gone = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        fs::write(folder.join("block.st"), "FUNCTION_BLOCK B VAR_INPUT x : INT; END_VAR END_FUNCTION_BLOCK")
            .expect("written");
        fs::write(folder.join("main.st"), "PROGRAM Main VAR b : B; END_VAR b(x := 1); END_PROGRAM")
            .expect("written");
        let watch = watches(&[&folder], &["N1"]).pop().expect("one");
        Self { folder, watch }
    }

    /// Number of programs loaded in this number of checks.
    fn loads(&mut self) -> usize {
        (0..LOOKS).map(|_| loaded(&mut self.watch).len()).sum()
    }

    fn save(&self, name: &str, text: &str) {
        fs::write(self.folder.join(name), text).expect("written");
    }

    fn main(&self, x: &str) {
        self.save("main.st", &format!("PROGRAM Main VAR b : B; END_VAR b(x := {x}); END_PROGRAM"));
    }
}

/// The positions of the units that load what a look finds, as its report says.
fn loaded(watch: &mut Watch) -> Vec<usize> {
    let Some(Change { programs, report }) = watch.look() else { return Vec::new() };
    report.log();
    programs.into_iter().map(|(position, _)| position).collect()
}

/// The watches of units that run the program in these files and folders, each by one spelling of its path.
fn watches(paths: &[&Path], names: &[&str]) -> Vec<Watch> {
    let programs = names.iter().enumerate().map(|(position, name)| {
        let paths = vec![paths[position % paths.len()].to_owned()];
        let file = UnitFile::parse(&format!("model = \"nx-ect101\"\nname = \"{name}\"")).expect("a name");
        let program = WatchedProgram {
            stamps: stamps(&paths).ok(),
            text: ProgramText::read(&paths).expect("two files"),
            paths,
            variables: DeviceVariables::of(file.variable_table()),
            budget_statements: 1_000,
        };
        (position, program)
    });
    Watch::all(programs)
}

/// The logged lines, for later checks.
#[derive(Clone, Default)]
struct Log(Arc<Mutex<Vec<u8>>>);

impl io::Write for Log {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().expect("unlocked").write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The lines that are logged meanwhile.
fn logged(run: impl FnOnce()) -> Vec<String> {
    let log = Log::default();
    let writer = log.clone();
    let subscriber = tracing_subscriber::fmt().with_ansi(false).with_writer(move || writer.clone());
    tracing::subscriber::with_default(subscriber.finish(), run);
    let bytes = log.0.lock().expect("unlocked");
    String::from_utf8_lossy(&bytes).lines().map(str::to_owned).collect()
}

impl Drop for Bench {
    fn drop(&mut self) {
        // A remaining folder does no harm.
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
    // The block alone is not a program: reported, and nothing is loaded.
    assert_eq!(bench.loads(), 0);
    fs::write(&main, &text).expect("written");
    assert_eq!(bench.loads(), 0, "it is as it was");
    fs::remove_file(&main).expect("removed");
    assert_eq!(bench.loads(), 0);
    bench.main("678");
    assert_eq!(bench.loads(), 1);
    bench.watch.paths = vec![bench.folder.join("block.st"), main.clone()];
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

#[test]
fn a_file_that_is_rewritten_in_place_is_loaded_even_if_time_and_length_are_the_same() {
    let mut bench = Bench::new("in-place");
    let main = bench.folder.join("main.st");
    let written = fs::metadata(&main).and_then(|metadata| metadata.modified()).expect("a time");
    let changed =
        || fs::metadata(&main).map(|metadata| (metadata.ctime(), metadata.ctime_nsec())).expect("a time");
    for x in 2..5 {
        let before = changed();
        // The system's clock of changes has steps of some milliseconds.
        while changed() == before {
            bench.main(&x.to_string());
            fs::File::options()
                .write(true)
                .open(&main)
                .and_then(|file| file.set_modified(written))
                .expect("set");
        }
        assert_eq!(bench.loads(), 1, "{x}");
    }
}

#[test]
fn a_link_to_nothing_in_the_folder_is_logged_once_and_the_program_is_loaded_when_it_leads_somewhere() {
    let mut bench = Bench::new("link");
    let (link, target) = (bench.folder.join("link.st"), bench.folder.join("target"));
    for x in ["2", "3"] {
        symlink("target", &link).expect("a link");
        bench.main(x);
        let mut loads = 0;
        let lines = logged(|| loads = bench.loads());
        assert_eq!((loads, lines.len()), (0, 1), "{lines:?}");
        assert!(lines[0].contains("link.st cannot be read: ") && lines[0].contains("continues"), "{lines:?}");
        fs::write(&target, format!("TYPE T{x} : INT; END_TYPE")).expect("written");
        let lines = logged(|| loads = bench.loads());
        assert_eq!((loads, lines.len()), (1, 1), "{lines:?}");
        fs::remove_file(&target).expect("removed");
        fs::remove_file(&link).expect("removed");
        assert_eq!(bench.loads(), 1, "a file less");
    }
}

#[test]
fn a_link_to_nothing_that_goes_again_loads_nothing() {
    let mut bench = Bench::new("passing-link");
    let link = bench.folder.join("link.st");
    for _ in 0..2 {
        symlink("nothing", &link).expect("a link");
        let lines = logged(|| assert_eq!(bench.loads(), 0));
        assert_eq!(lines.len(), 1, "{lines:?}");
        fs::remove_file(&link).expect("removed");
        let lines = logged(|| assert_eq!(bench.loads(), 0));
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert!(lines[0].ends_with("is correct again, and is the program that runs"), "{lines:?}");
    }
}

#[test]
fn a_folder_that_goes_and_comes_back_is_logged_both_times() {
    let mut bench = Bench::new("moved");
    let elsewhere = bench.folder.with_extension("elsewhere");
    let _gone = fs::remove_dir_all(&elsewhere);
    for is_wrong in [false, true] {
        if is_wrong {
            bench.save("main.st", "PROGRAM Main Misspelt := 1; END_PROGRAM");
            assert_eq!(bench.loads(), 0);
        }
        for _ in 0..2 {
            fs::rename(&bench.folder, &elsewhere).expect("moved");
            let lines = logged(|| assert_eq!(bench.loads(), 0));
            assert_eq!(lines.len(), 1, "{lines:?}");
            assert!(lines[0].contains("cannot be read: "), "{lines:?}");
            fs::rename(&elsewhere, &bench.folder).expect("moved back");
            let lines = logged(|| assert_eq!(bench.loads(), 0));
            let end = if is_wrong {
                "is wrong: the old program continues in unit 1"
            } else {
                "is the program that runs"
            };
            assert!(lines.last().is_some_and(|line| line.ends_with(end)), "{lines:?}");
        }
    }
}

#[test]
fn units_that_share_a_program_log_a_change_once_with_all_of_them() {
    let bench = Bench::new("shared");
    let dotted = bench.folder.join(".");
    let mut watches = watches(&[&bench.folder, &dotted], &["N1", "N2", "N3"]);
    assert_eq!(watches.len(), 1);
    let mut change = |program: &str| {
        bench.save("main.st", program);
        let mut positions = Vec::new();
        let lines = logged(|| {
            for _ in 0..LOOKS {
                positions.extend(loaded(&mut watches[0]));
            }
        });
        (positions, lines)
    };
    let (loaded, lines) = change("PROGRAM Main VAR b : B; END_VAR b(x := 22); END_PROGRAM");
    assert_eq!((loaded.as_slice(), lines.len()), (&[0, 1, 2][..], 1), "{lines:?}");
    assert!(lines[0].ends_with("has changed, and is loaded in units 1 to 3"), "{lines:?}");
    let (loaded, lines) = change("PROGRAM Main Misspelt := 1; END_PROGRAM");
    assert_eq!((loaded.len(), lines.len()), (0, 2), "{lines:?}");
    assert!(lines[0].contains("there is no variable `Misspelt`"), "{lines:?}");
    assert!(lines[1].ends_with("the old program continues in units 1 to 3"), "{lines:?}");
    // A variable that one of them has: only that one loads the program.
    let (loaded, lines) = change("PROGRAM Main N2_UINTs_01_C_to_M[0] := 1; END_PROGRAM");
    assert_eq!((loaded.as_slice(), lines.len()), (&[1][..], 5), "{lines:?}");
    assert!(lines[4].ends_with("is correct again, and is loaded in unit 2"), "{lines:?}");
    for line in [1, 3] {
        assert!(lines[line].contains("is wrong: the old program continues in unit "), "{lines:?}");
    }
    // Back again: units 1 and 3 already run this text, and their timers with it.
    let (loaded, lines) = change("PROGRAM Main VAR b : B; END_VAR b(x := 22); END_PROGRAM");
    assert_eq!(loaded, [1], "{lines:?}");
}
