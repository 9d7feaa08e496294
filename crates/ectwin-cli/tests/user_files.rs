//! Whatever file a user gives: each command ends with a message, soon, and without much memory.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[path = "replay/bench.rs"]
#[expect(dead_code, reason = "each test uses a part of the bench")]
mod bench;

use std::fs;
use std::process::Command;

use bench::{Bench, Ended};

/// Placeholder for the file in the arguments of a command.
const FILE: &str = "FILE";
/// Each command that reads user files, at each position of such a file.
const COMMANDS: &[&[&str]] = &[
    &["check", FILE],
    &["check", "names.toml"],
    &["map", FILE],
    &["esi", FILE],
    &["sii", FILE],
    &["run", FILE, "--link", "udp:127.0.0.1:0"],
    &["run", "unit.toml", "--program", FILE, "--link", "udp:127.0.0.1:0"],
    &["run", "names.toml", "--link", "udp:127.0.0.1:0"],
    &["st", "check", FILE],
    &["st", "check", "program.st", FILE],
    &["st", "check", "program.st", "--unit", FILE],
    &["replay", FILE],
    &["replay", "names-unit.toml"],
    &["replay", "names-program.toml"],
    &["replay", "names-capture.toml"],
    &["search", FILE],
    &["import", FILE, "-o", "out.toml"],
    &["merge", FILE],
];
/// Maximum length of a message in bytes.
const MESSAGE_BYTES_MAX: usize = 20_000;
/// Address space of a command, in KiB: many times what a small file takes.
const ADDRESS_SPACE_KIB: u32 = 1 << 20;
/// Time after which a command counts as hanging.
const SECONDS_MAX: &str = "120";

fn bench(name: &str) -> Bench {
    let bench = Bench::new(&format!("user-files-{name}"));
    bench.put("unit.toml", "model = \"nx-ect101\"\n");
    bench.put("program.st", "PROGRAM Main ; END_PROGRAM\n");
    bench.put("names.toml", "model = \"nx-ect101\"\ncpu.program = \"FILE\"\n");
    let scenario = |head: &str| format!("title = \"t\"\n{head}\nsteps = [{{ line = \"be quiet\" }}]\n");
    bench.put("names-unit.toml", &scenario("units = [\"FILE\"]"));
    bench.put("names-program.toml", &scenario("units = [{ file = \"unit.toml\", program = \"FILE\" }]"));
    bench.put("names-capture.toml", &scenario("capture = \"FILE\""));
    bench
}

/// Runs the command with limited memory and time.
fn bounded(bench: &Bench, arguments: &[&str]) -> Ended {
    let script = format!("ulimit -v {ADDRESS_SPACE_KIB}; exec timeout {SECONDS_MAX} \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_ectwin")]).args(arguments);
    let output = command.current_dir(&bench.folder).env("NO_COLOR", "1").output().unwrap();
    Ended {
        code: output.status.code(),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// Each command refuses the file with a short message.
fn all_refuse(bench: &Bench, what: &str) {
    for arguments in COMMANDS {
        let ended = bounded(bench, arguments);
        let Ended { code, stdout, stderr } = &ended;
        assert!(matches!(code, Some(1 | 2)), "{what}: {arguments:?} ends with {code:?}\n{stderr}");
        let length = stdout.len() + stderr.len();
        assert!((1..MESSAGE_BYTES_MAX).contains(&length), "{what}: {arguments:?} says {length} bytes");
        assert!(!stderr.contains("panicked"), "{what}: {arguments:?}\n{stderr}");
        assert!(!stderr.contains('\u{1b}'), "{what}: {arguments:?}\n{stderr}");
    }
}

fn shell(bench: &Bench, script: &str) {
    let status = Command::new("sh").args(["-c", script]).current_dir(&bench.folder).status().unwrap();
    assert!(status.success(), "{script}");
}

#[test]
fn what_is_no_regular_file_is_refused_by_every_command() {
    let bench = bench("irregular");
    for (make, what) in [
        ("ln -s /dev/zero FILE", "a device without an end"),
        ("mkfifo FILE", "a pipe that nobody writes"),
        ("ln -s FILE FILE", "a link to itself"),
        ("mkdir FILE; ln -s . FILE/FILE", "a folder that lies in itself"),
    ] {
        shell(&bench, &format!("rm -rf FILE out.toml; {make}"));
        all_refuse(&bench, what);
    }
}

#[test]
fn a_large_file_is_refused_by_every_command() {
    let bench = bench("large");
    for size in ["100M", "3M"] {
        shell(&bench, &format!("rm -f FILE; truncate -s {size} FILE"));
        all_refuse(&bench, size);
    }
    let ended = bounded(&bench, &["check", "FILE"]);
    assert!(ended.stderr.contains("binary"), "{}", ended.stderr);
    shell(&bench, "truncate -s 100M FILE");
    let ended = bounded(&bench, &["check", "FILE"]);
    assert!(ended.stderr.contains("it is larger than 4 MiB"), "{}", ended.stderr);
}

#[test]
fn text_full_of_mistakes_is_refused_in_few_words_by_every_command() {
    let bench = bench("mistakes");
    let lines = |line: fn(usize) -> String| (0..20_000).map(line).collect::<String>();
    for (what, text) in [
        ("unknown keys", format!("model = \"nx-ect101\"\n{}", lines(|at| format!("key_{at} = 1\n")))),
        ("no TOML", lines(|_| "= ] [ \"\n".to_owned())),
        ("one long line", format!("model = \"nx-ect101\"\nx = \"{}\" y\n", "long ".repeat(100_000))),
        ("a long key", format!("model = \"nx-ect101\"\n{} = 1\n", "k".repeat(500_000))),
        ("statements without an end", lines(|at| format!("x{at} := y{at}\n"))),
        ("control characters", "model = \"\u{1b}[2J\u{7}\"\n\u{1b}]0;title\u{7}\n".repeat(100)),
        (
            "wrong steps",
            format!("title = \"t\"\nsteps = [\n{}]\n", lines(|_| "{ line = \"sing\" },\n".to_owned())),
        ),
    ] {
        bench.put("FILE", &text);
        all_refuse(&bench, what);
    }
}

#[test]
fn twenty_thousand_unknown_keys_are_twenty_mistakes_and_a_number() {
    let bench = bench("unknown-keys");
    let keys: String = (0..20_000).map(|at| format!("key_{at} = 1\n")).collect();
    bench.put("FILE", &format!("model = \"nx-ect101\"\n{keys}"));
    let ended = bounded(&bench, &["check", "FILE"]);
    assert_eq!(ended.code, Some(2));
    assert_eq!(ended.stderr.matches("unknown key").count(), 20);
    assert_eq!(ended.stderr.lines().last(), Some("and 19980 more"));
    assert_eq!(
        ended.stderr.matches("`storage`").count(),
        1,
        "the keys that there are, once:\n{}",
        ended.stderr
    );
    // Each still gets the nearest name.
    bench.put("FILE", "model = \"nx-ect101\"\nstorag = 1\nseriel = 2\n[cpu]\nmodes = 3\n");
    let ended = bounded(&bench, &["check", "FILE"]);
    for name in ["storage", "serial", "mode"] {
        assert!(ended.stderr.contains(&format!("did you mean `{name}`?")), "{}", ended.stderr);
    }
}

#[test]
fn unknown_keys_of_a_scenario_are_twenty_mistakes_and_a_number() {
    let bench = bench("unknown-keys-of-a-scenario");
    let keys: String = (0..20_000).map(|at| format!("key_{at} = 1\n")).collect();
    for text in [
        format!("title = \"t\"\nsteps = [{{ line = \"be quiet\" }}]\n{keys}"),
        format!(
            "title = \"t\"\nsteps = [{{ line = \"be quiet\" }}]\n[[units]]\nmodel = \"nx-ect101\"\n{keys}"
        ),
        format!("title = \"t\"\n[[steps]]\nline = \"be quiet\"\n{keys}"),
        format!("title = \"t\"\n[[steps]]\n[steps.unit.restart]\nunits = 1\n{keys}"),
    ] {
        bench.put("FILE", &text);
        let ended = bounded(&bench, &["replay", "FILE"]);
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert_eq!(ended.stderr.matches("unknown key").count(), 20, "{}", ended.stderr);
        assert_eq!(ended.stderr.lines().last(), Some("and 19980 more"));
    }
}

#[test]
fn wrong_and_right_steps_are_read_in_one_pass() {
    let bench = bench("many-steps");
    let steps = |step: &str| format!("title = \"t\"\nsteps = [\n{}]\n", step.repeat(180_000));
    // With a search from the start of the file for each step this takes minutes.
    bench.put("FILE", &steps("{ line = \"sing\" },\n"));
    let ended = bounded(&bench, &["replay", "FILE"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.ends_with("and 179980 more\n"), "{}", ended.stderr);
    bench.put("FILE", &steps("{ line = \"be quiet\" },\n").replace("be quiet\" },\n]", "sing\" }]"));
    let ended = bounded(&bench, &["replay", "FILE"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(ended.stderr.contains("[FILE:180002:"), "{}", ended.stderr);
}

#[test]
fn a_file_of_another_kind_is_told_what_it_is() {
    let bench = bench("kinds");
    for (command, output) in [("esi", "unit.xml"), ("sii", "unit.bin")] {
        assert_eq!(bench.ectwin(&[command, "unit.toml", "-o", output]).code, Some(0));
    }
    bench.put("eni.xml", "<?xml version=\"1.0\"?><EtherCATConfig><Config/></EtherCATConfig>");
    bench.put("Main.TcPOU", "<?xml version=\"1.0\"?><TcPlcObject><POU Name=\"Main\"/></TcPlcObject>");
    bench.put("plc.xml", "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\"/>");
    bench.put("README.md", "# Units\n\nSee [the first](unit.toml).\n");
    bench.put("empty.toml", "# to do\n");
    bench.put("machine.smc2", "PK\u{3}\u{4}");
    bench.put("scenario.toml", "title = \"t\"\nsteps = [{ line = \"be quiet\" }]\n");
    fs::write(bench.folder.join("latin.st"), b"(* Z\xE4hler f\xFCr die Gr\xF6\xDFe *)\n;").unwrap();
    fs::write(bench.folder.join("shift-jis.st"), b"(* \x83\x76\x83\x8D\x83\x4F\x83\x89\x83\x80 *)\n;")
        .unwrap();
    fs::write(bench.folder.join("wide.st"), b"\xFF\xFE;\0\n\0").unwrap();
    fs::write(bench.folder.join("wide.toml"), b"\0m\0 \0=\0 \0x").unwrap();
    for (arguments, fragments) in [
        (&["check", "unit.xml"][..], &["this is an ESI file", "`ectwin esi FILE.toml`"][..]),
        (
            &["run", "unit.bin", "--link", "udp:127.0.0.1:0"],
            &["this is an SII image", "`ectwin sii FILE.toml`"],
        ),
        (&["replay", "unit.xml"], &["this is an ESI file", "a scenario is TOML"]),
        (&["replay", "unit.bin"], &["this is an SII image"]),
        (&["map", "eni.xml"], &["this is an ENI file"]),
        (&["st", "check", "Main.TcPOU"], &["a file of TwinCAT", "FILE.st"]),
        (&["st", "check", "plc.xml"], &["a PLCopen XML file", "FILE.st"]),
        (&["st", "check", "machine.smc2"], &["a project of Sysmac Studio"]),
        (
            &["st", "check", "latin.st"],
            &["looks like Latin-1: byte 0xE4 in line 1", "iconv -f Latin-1 -t UTF-8"],
        ),
        (&["st", "check", "shift-jis.st"], &["looks like Shift_JIS: byte 0x83 in line 1"]),
        (&["st", "check", "wide.st"], &["looks like UTF-16"]),
        (&["check", "wide.toml"], &["looks like UTF-16BE", "iconv -f UTF-16BE -t UTF-8"]),
        (&["check", "scenario.toml"], &["this is a scenario", "`ectwin replay FILE`"]),
        (&["replay", "unit.toml"], &["this is a unit file", "`ectwin check FILE`"]),
        (&["check", "program.st"], &["a program in Structured Text", "`ectwin st check FILE`"]),
        (&["import", "unit.toml", "-o", "out.toml"], &["this is a unit file", "ectwin run --pcap"]),
        (&["merge", "unit.toml"], &["this is a unit file"]),
        (&["check", "README.md"], &["this is a text in Markdown", "a unit file is TOML"]),
        (&["import", "empty.toml", "-o", "out.toml"], &["this is a TOML file", "`ectwin check FILE`"]),
        (&["st", "check", "empty.toml"], &["this is a TOML file", "a program is Structured Text"]),
    ] {
        let ended = bench.ectwin(arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.stderr);
        for fragment in fragments {
            assert!(
                ended.stderr.contains(fragment),
                "{arguments:?}: `{fragment}` is not in:\n{}",
                ended.stderr
            );
        }
    }
}

#[test]
fn stdin_is_no_input_of_any_command() {
    let bench = bench("stdin");
    // Not this file either: `-` of an output means stdout too.
    bench.put("-", "model = \"nx-ect101\"\n");
    for arguments in COMMANDS.iter().filter(|arguments| arguments.contains(&FILE)) {
        let with_stdin = |argument: &&'static str| if *argument == FILE { "-" } else { argument };
        let arguments: Vec<&str> = arguments.iter().map(with_stdin).collect();
        let ended = bounded(&bench, &arguments);
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.stderr);
        for fragment in ["stdin, which no command reads", "one of this name is ./-"] {
            assert!(ended.stderr.contains(fragment), "{arguments:?}: {}", ended.stderr);
        }
    }
    assert_eq!(bench.ectwin(&["check", "./-"]).code, Some(0));
}

#[test]
fn a_text_with_a_byte_order_mark_or_with_crlf_is_read() {
    let bench = bench("marks");
    bench.put("unit.toml", "\u{feff}model = \"nx-ect101\"\r\n");
    bench.put("program.st", "\u{feff}PROGRAM Main\r\n;\r\nEND_PROGRAM\r\n");
    let ended = bench.ectwin(&["st", "check", "program.st", "--unit", "unit.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""));
}

#[test]
fn the_mistakes_of_all_unit_files_are_told_in_their_order() {
    let bench = bench("several-units");
    bench.put(
        "live.toml",
        "title = \"live\"\nsteps = [ { master = \"take unit 1 to PRE-OP\" }, \
        { expect = \"unit 1 is in PRE-OP\", within = \"1s\" } ]\n",
    );
    assert_eq!(bench.ectwin(&["replay", "live.toml", "--pcap", "live.pcapng"]).code, Some(0));
    bench.put("x1.toml", "model = \"nx-ect101\"\nserail = 1\n");
    bench.put("x2.toml", "model = \"nx-ect101\"\nnaem = \"N2\"\n");
    bench.put("good.toml", "model = \"nx-ect101\"\n");
    bench.put("wrong.st", "PROGRAM P\nMisspelt := 1;\nEND_PROGRAM\n");
    for arguments in [
        &["run", "x1.toml", "good.toml", "gone.toml", "x2.toml", "--link", "udp:127.0.0.1:0"][..],
        &[
            "import",
            "live.pcapng",
            "-o",
            "out.toml",
            "--unit",
            "x1.toml",
            "--unit",
            "gone.toml",
            "--unit",
            "x2.toml",
        ],
    ] {
        let ended = bounded(&bench, arguments);
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        let places = ["serail", "cannot read gone.toml", "naem"].map(|words| ended.stderr.find(words));
        assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{}", ended.stderr);
    }
    // The program that all units run is reported once.
    let arguments = ["run", "good.toml", "good.toml", "--program", "wrong.st", "--link", "udp:127.0.0.1:0"];
    let ended = bounded(&bench, &arguments);
    assert_eq!(ended.stderr.matches("there is no variable").count(), 1, "{}", ended.stderr);
}

#[test]
fn a_file_name_cannot_begin_a_line_of_a_result() {
    let bench = bench("forged");
    let name = |ending: &str| format!("a\nok      b.{ending}");
    bench.put(&name("toml"), "title = \"x\"\nsteps = [ { expect = \"unit 1 is in OP\" } ]\n");
    bench.put(&format!("unit{}", name("toml")), "model = \"nx-ect101\"\n");
    bench.put(&name("st"), "PROGRAM P\nEND_PROGRAM\n");
    for arguments in [
        &["replay", &name("toml")][..],
        &["check", &format!("unit{}", name("toml"))],
        &["st", "check", &name("st")],
    ] {
        let ended = bounded(&bench, arguments);
        assert!(ended.stdout.contains(r"a\nok      b."), "{}{}", ended.stdout, ended.stderr);
        assert!(!ended.stdout.contains("\nok "), "{}", ended.stdout);
    }
}
