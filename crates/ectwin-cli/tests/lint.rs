//! `ectwin lint`: findings as text and as JSON, exit codes.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

use std::path::Path;
use std::process::{Command, Output};

fn lint(arguments: &[&str]) -> Output {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/esi");
    Command::new(env!("CARGO_BIN_EXE_ectwin"))
        .arg("lint")
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

#[test]
fn a_file_without_findings_and_one_with_notes_pass() {
    for (file, result) in [
        ("encoder.xml", "encoder.xml: 1 device, no problems\n"),
        ("boot.xml", "boot.xml: 1 device, 1 note\n"),
        ("sensor.xml", "sensor.xml: 1 device, no problems\n"),
    ] {
        let output = lint(&[file]);
        assert_eq!(output.status.code(), Some(0), "{file}");
        assert!(String::from_utf8(output.stdout).unwrap().ends_with(result), "{file}");
    }
}

#[test]
fn a_finding_has_rule_place_element_and_correction() {
    let output = lint(&["minimal.xml", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&document["devices"], &document["omitted"]), (&1.into(), &0.into()));
    let finding = &document["findings"][0];
    assert_eq!(finding["rule"], "E203");
    assert_eq!(finding["level"], "warning");
    assert_eq!((&finding["line"], &finding["column"]), (&9.into(), &7.into()));
    assert_eq!(finding["path"], "/EtherCATInfo/Descriptions/Devices/Device");
    assert_eq!(finding["correction"], "add the attribute RevisionNo to Type");
    assert!(finding["file"].is_null());
}

/// That of the device itself, of another one, and one with a changed byte.
#[test]
fn an_image_is_checked_and_compared_with_the_device_of_its_identity() {
    let folder = tempfile::tempdir().unwrap();
    let image = folder.path().join("image.bin");
    let unit = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/nx-ect101.toml");
    let ectwin = |arguments: &[&std::ffi::OsStr]| {
        Command::new(env!("CARGO_BIN_EXE_ectwin")).args(arguments).output().unwrap()
    };
    let xml = folder.path().join("unit.xml");
    for (command, output) in [("sii", &image), ("esi", &xml)] {
        assert!(ectwin(&[command.as_ref(), unit.as_ref(), "-o".as_ref(), output.as_ref()]).status.success());
    }
    let compared = |esi: &Path| ectwin(&["lint".as_ref(), esi.as_ref(), "--sii".as_ref(), image.as_ref()]);
    let same = compared(&xml);
    assert_eq!(same.status.code(), Some(0), "{}", String::from_utf8_lossy(&same.stdout));
    let other = compared(&unit.parent().unwrap().join("esi/encoder.xml"));
    assert_eq!(other.status.code(), Some(1));
    let text = String::from_utf8(other.stdout).unwrap();
    assert!(text.contains("identity: 0x83, 0x17C, 0x10000"), "{text}");
    let mut bytes = std::fs::read(&image).unwrap();
    bytes[0] ^= 1;
    std::fs::write(&image, bytes).unwrap();
    let changed = String::from_utf8(compared(&xml).stdout).unwrap();
    assert!(changed.contains("(C022)") && changed.contains("(C026)"), "{changed}");
}

#[test]
fn what_is_no_esi_file_is_refused_with_its_place() {
    for (file, message, line) in [
        ("sensor-dictionary.xml", "the root element is `EtherCATDict`", Some(3)),
        ("../nx-ect101.toml", "the file is not well-formed XML", Some(1)),
        ("no-such-file.xml", "cannot read", None),
    ] {
        let output = lint(&[file, "--json"]);
        assert_eq!(output.status.code(), Some(2), "{file}");
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let problem = &document["problems"][0];
        assert!(problem["message"].as_str().unwrap().contains(message), "{document}");
        assert_eq!(problem["line"].as_u64(), line, "{document}");
    }
}
