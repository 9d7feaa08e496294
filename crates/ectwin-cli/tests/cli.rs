//! The command refuses impossible requests with the place, the reason and the remedy, and the correct exit code.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const BAD_FILE: i32 = 2;
const NO_LINK: i32 = 3;

fn ectwin() -> Command {
    Command::new(env!("CARGO_BIN_EXE_ectwin"))
}

fn factory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/nx-ect101.toml")
}

/// `ectwin run` with a unit file with this text; the link is never opened.
fn run_unit_file(name: &str, text: &str) -> Output {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let written = std::fs::write(&file, text);
    assert!(written.is_ok(), "{}: {written:?}", file.display());
    output_of(ectwin().arg("run").arg(&file).args(["--link", "raw:no-such-link"]))
}

fn output_of(command: &mut Command) -> Output {
    command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"))
}

/// The exit code, and every fragment on standard error; standard output is empty.
fn expect(output: &Output, code: i32, fragments: &[&str]) {
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{told}");
    assert!(output.stdout.is_empty(), "standard output is for results: {:?}", output.stdout);
    for fragment in fragments {
        assert!(told.contains(fragment), "`{fragment}` is not in:\n{told}");
    }
    assert!(!told.contains("panicked"), "{told}");
}

#[test]
fn an_unknown_key_is_refused_with_its_place_and_the_nearest_name() {
    let output = run_unit_file("unknown-key.toml", "model = \"nx-ect101\"\nserail = 1\n");
    expect(&output, BAD_FILE, &["unknown-key.toml", "2:1", "serail", "serial"]);
}

#[test]
fn an_unknown_model_is_refused_with_its_place() {
    let output = run_unit_file("unknown-model.toml", "model = \"nx-ect102\"\n");
    expect(&output, BAD_FILE, &["unknown-model.toml", "1:9", "nx-ect101"]);
}

#[test]
fn a_value_out_of_range_is_refused_with_its_place() {
    let text = "model = \"nx-ect101\"\n\n[cpu]\ntask_period = \"1s\"\n";
    expect(&run_unit_file("too-long.toml", text), BAD_FILE, &["too-long.toml", "4:15", "125us", "32ms"]);
}

#[test]
fn a_value_of_the_wrong_type_is_refused_with_its_place() {
    let text = "model = \"nx-ect101\"\nserial = \"one\"\n";
    expect(&run_unit_file("wrong-type.toml", text), BAD_FILE, &["wrong-type.toml", "2:10"]);
}

#[test]
fn a_file_that_is_no_toml_is_refused_with_its_place() {
    let text = "model = \"nx-ect101\"\nserial =\n";
    expect(&run_unit_file("no-toml.toml", text), BAD_FILE, &["no-toml.toml", "2:9"]);
}

#[test]
fn a_file_that_is_not_there_is_refused_by_name() {
    let output = output_of(ectwin().args(["run", "no-such-unit.toml", "--link", "raw:lo"]));
    expect(&output, BAD_FILE, &["no-such-unit.toml"]);
}

#[test]
fn an_interface_that_is_not_there_is_refused_by_name() {
    let output = output_of(ectwin().arg("run").arg(factory()).args(["--link", "raw:no-such-link"]));
    expect(&output, NO_LINK, &["no-such-link"]);
}

#[test]
fn a_link_of_no_known_kind_is_refused_with_the_kinds_that_there_are() {
    let output = output_of(ectwin().arg("run").arg(factory()).args(["--link", "usb:eth0"]));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success(), "{told}");
    assert!(["raw:", "udp:", "tap:"].iter().all(|kind| told.contains(kind)), "{told}");
}

#[test]
fn a_user_without_permission_is_told_which_one_is_missing() {
    let output = output_of(without_raw_sockets().arg("run").arg(factory()).args(["--link", "raw:lo"]));
    expect(&output, NO_LINK, &["lo", "CAP_NET_RAW"]);
}

/// ectwin as started by an ordinary user, whichever user runs the tests.
fn without_raw_sockets() -> Command {
    let id = output_of(Command::new("id").arg("--user"));
    if id.stdout.trim_ascii() != b"0" {
        return ectwin();
    }
    let mut command = Command::new("setpriv");
    command.args(["--bounding-set=-net_raw,-net_admin", env!("CARGO_BIN_EXE_ectwin")]);
    command
}
