//! Each rule of lint has a file that breaks it, made from one of the project's own by one change; the files themselves
//! break none.

use std::collections::BTreeSet;

use esi::file::EsiFile;
use esi::lint::rules::RULES;

use crate::files;

/// A rule, a file, and the change that breaks the rule: all places of a text get another one.
const CASES: &[(&str, &str, &str, &str)] = &[
    ("E102", "encoder.xml", "ControlByte=\"#x64\"", "ControlByte=\"#xZZ\""),
    ("E103", "encoder.xml", "ControlByte=\"#x64\"", "ControlByte=\"#x164\""),
    ("E104", "encoder.xml", "<Id>#xEC700000", "<Id>0xEC700000"),
    ("E105", "encoder.xml", "SdoInfo=\"1\"", "SdoInfo=\"yes\""),
    ("E106", "encoder.xml", "<ConfigData>050E", "<ConfigData>05E"),
    ("E107", "sensor.xml", "sensor-dictionary", "no-such-dictionary"),
    ("E107", "sensor.xml", "sensor-dictionary", "coupler"),
    ("E201", "encoder.xml", "<Id>#xEC700000</Id>", ""),
    ("E202", "encoder.xml", "ProductCode=\"#x00034000\"", ""),
    ("E203", "encoder.xml", "RevisionNo=\"#x00010000\"", ""),
    ("E204", "digital-terminals.xml", "RevisionNo=\"#x00020000\"", "RevisionNo=\"#x00010000\""),
    ("E205", "encoder.xml", ">ENCODER</Type>", "></Type>"),
    ("E206", "encoder.xml", "Physics=\"YY\"", ""),
    ("E207", "encoder.xml", "Physics=\"YY\"", "Physics=\"YYYYY\""),
    ("E207", "encoder.xml", "Physics=\"YY\"", "Physics=\"YB\""),
    ("E207", "encoder.xml", "Physics=\"YY\"", "Physics=\"YX\""),
    ("E208", "encoder.xml", "<GroupType>Encoders", "<GroupType>Others"),
    ("E301", "encoder.xml", "<Fmmu>Inputs", "<Fmmu>OrbitaIn"),
    ("E302", "encoder.xml", ">Inputs</Sm>", ">OrbitaIn</Sm>"),
    ("E303", "encoder.xml", ">Inputs</Sm>", ">Outputs</Sm>"),
    ("E303", "encoder.xml", "ControlByte=\"#x20\"", "ControlByte=\"#x24\""),
    ("E304", "encoder.xml", "StartAddress=\"#x1180\"", ""),
    ("E305", "encoder.xml", "StartAddress=\"#x1180\"", "StartAddress=\"#x1111\""),
    ("E306", "encoder.xml", "StartAddress=\"#x1180\"", "StartAddress=\"#x2FF0\""),
    ("E306", "encoder.xml", "StartAddress=\"#x1180\"", "StartAddress=\"#x0F80\""),
    ("E307", "drive.xml", "MinSize=\"2\"", "MinSize=\"8\""),
    ("E308", "encoder.xml", "DefaultSize=\"6\"", "DefaultSize=\"7\""),
    ("E309", "boot.xml", "DefaultSize=\"128\" StartAddress=\"#x1080\"", "StartAddress=\"#x1080\""),
    ("E310", "encoder.xml", "Mailbox", "Postbox"),
    ("E401", "mixed-bits.xml", "<Index>#x1600</Index>", ""),
    ("E402", "two-input-areas.xml", "#x1A01", "#x1A00"),
    ("E403", "mixed-bits.xml", "#x1A00", "#x1C00"),
    ("E404", "mixed-bits.xml", "TxPdo Sm=\"1\"", "TxPdo Sm=\"2\""),
    ("E405", "drive.xml", "<RxPdo>", "<RxPdo Sm=\"2\">"),
    ("E406", "drive.xml", "<Exclude>#x1601", "<Exclude>#x1602"),
    ("E407", "mixed-bits.xml", "TxPdo Sm=\"1\"", "TxPdo"),
    ("E409", "mixed-bits.xml", "<BitLen>24</BitLen>", "<BitLen>0</BitLen>"),
    ("E410", "mixed-bits.xml", "<SubIndex>3</SubIndex>", ""),
    ("E411", "mixed-bits.xml", "UINT24", "UINT8"),
    ("E412", "mixed-bits.xml", "<BitLen>24</BitLen>", "<BitLen>32</BitLen>"),
    (
        "E413",
        "encoder.xml",
        "<Index>#x6000</Index>\n            <SubIndex>3",
        "<Index>#x6000</Index>\n            <SubIndex>4",
    ),
    ("E414", "encoder.xml", "<PdoMapping>T", "<PdoMapping>R"),
    ("E415", "encoder.xml", "<BitLen>32</BitLen>", "<BitLen>16</BitLen>"),
    ("E501", "encoder.xml", "<CoE ", "<XoE "),
    ("E502", "analog-inputs.xml", "<Transition>PS", "<Transition>XY"),
    ("E502", "analog-inputs.xml", "<Index>#x8000</Index>", ""),
    (
        "E503",
        "encoder.xml",
        "/>\n        </Mailbox>",
        "><InitCmd><Transition>PS</Transition><Index>#x9000</Index><SubIndex>0</SubIndex><Data>00</Data></InitCmd></CoE></Mailbox>",
    ),
    (
        "E503",
        "encoder.xml",
        "/>\n        </Mailbox>",
        "><InitCmd><Transition>PS</Transition><Index>#x1000</Index><SubIndex>0</SubIndex><Data>00000000</Data></InitCmd></CoE></Mailbox>",
    ),
    (
        "E504",
        "encoder.xml",
        "/>\n        </Mailbox>",
        "><InitCmd><Transition>PS</Transition><Index>#x8000</Index><SubIndex>0</SubIndex><Data>00</Data></InitCmd></CoE></Mailbox>",
    ),
    ("E505", "encoder.xml", "/>\n        </Mailbox>", "/><EoE/></Mailbox>"),
    ("E601", "encoder.xml", "<Name>FreeRun", "<Name>DcSync"),
    ("E602", "encoder.xml", "<AssignActivate>#x0300</AssignActivate>", ""),
    ("E603", "encoder.xml", "<ShiftTimeSync0>0</ShiftTimeSync0>", "<Sm No=\"4\"/>"),
    ("E603", "encoder.xml", "<ShiftTimeSync0>0</ShiftTimeSync0>", "<Sm No=\"2\"><Pdo>#x1601</Pdo></Sm>"),
    ("E701", "modular.xml", "ModuleIdent=\"#x00001002\"", "ModuleIdent=\"#x00001001\""),
    ("E702", "modular.xml", "ModuleIdent=\"#x00001002\"", "ModuleIdent=\"#x00001003\""),
    ("E702", "modular.xml", "ModuleClass=\"IO\"", "ModuleClass=\"OI\""),
    ("E703", "modular.xml", "SlotPdoIncrement=\"1\"", ""),
    ("E704", "modular.xml", "MinInstances=\"0\"", "MinInstances=\"9\""),
    ("E801", "encoder.xml", "<Index>#x8000", "<Index>#x0800"),
    ("E802", "encoder.xml", "<Index>#x8000", "<Index>#x7000"),
    ("E802", "encoder.xml", "<SubIdx>3</SubIdx>", "<SubIdx>2</SubIdx>"),
    ("E802", "encoder.xml", "<Name>DT7000</Name>", "<Name>DT6000</Name>"),
    ("E803", "encoder.xml", "<Type>UDINT</Type>", "<Type>UINT32</Type>"),
    ("E804", "encoder.xml", "<Type>UDINT</Type>", "<Type>UINT</Type>"),
    ("E805", "encoder.xml", "<BitSize>16</BitSize>", "<BitSize>70000</BitSize>"),
    ("E806", "encoder.xml", "<SubIdx>0</SubIdx>", "<SubIdx>9</SubIdx>"),
    (
        "E807",
        "encoder.xml",
        "<Name>Set value</Name>\n                    <Info>",
        "<Name>Set value</Name><Info/></SubItem><SubItem><Name>More</Name><Info>",
    ),
    ("E808", "encoder.xml", "<DefaultData>89130000", "<DefaultData>8913000000"),
    ("E808", "encoder.xml", "<DefaultData>89130000", "<DefaultData>8913"),
    ("E809", "encoder.xml", "<MinData>0100", "<MinData>0030"),
    ("E810", "encoder.xml", "<Access>rw", "<Access>write"),
    ("E811", "encoder.xml", "<PdoMapping>T", "<PdoMapping>Tx"),
    ("E812", "encoder.xml", "<DefaultData>00400300", "<DefaultData>00500300"),
    ("E813", "encoder.xml", "<Index>#x1C00", "<Index>#x2C00"),
    ("E901", "boot.xml", "<BootStrap>", "<Category><CatNo>1</CatNo></Category><BootStrap>"),
    ("E902", "encoder.xml", "<ConfigData>050E0344640000000000</ConfigData>", ""),
    ("E902", "encoder.xml", "<ConfigData>", "<ConfigData>0000000000000000"),
    ("E903", "encoder.xml", "<ByteSize>2048", "<ByteSize>2000"),
    ("E903", "encoder.xml", "<ByteSize>2048", "<ByteSize>256"),
    ("E904", "boot.xml", "<BootStrap>0010", "<BootStrap>001000"),
    ("E905", "boot.xml", "<ByteSize>2048</ByteSize>", "<Data>00</Data>"),
    ("E906", "encoder.xml", "<ConfigData>050E", "<ConfigData>050F"),
];

#[test]
fn a_change_breaks_its_rule() {
    let missed =
        CASES.iter().filter(|(code, name, from, to)| !codes(&files::bytes(name), from, to).contains(code));
    assert_eq!(missed.collect::<Vec<_>>(), Vec::<&(&str, &str, &str, &str)>::new());
}

#[test]
fn a_character_set_that_is_not_the_declared_one_is_found() {
    let found = codes(&files::bytes("drive.xml"), "ISO-8859-1", "UTF-8");
    assert!(found.contains("E101"), "{found:?}");
}

#[test]
fn a_file_of_too_many_devices_keeps_the_first_ones() {
    let devices = "<Device/>".repeat(10_001);
    let text =
        format!("<EtherCATInfo><Descriptions><Devices>{devices}</Devices></Descriptions></EtherCATInfo>");
    let file = EsiFile::read(text.as_bytes(), &files::external).unwrap();
    assert_eq!(file.devices.len(), 10_000);
    assert!(file.findings.list().iter().any(|finding| finding.rule.code == "E108"));
}

#[test]
fn a_pdo_of_too_many_entries_is_found() {
    let entries = "<Entry><Index>#x6000</Index><SubIndex>1</SubIndex><BitLen>1</BitLen></Entry>".repeat(256);
    let found =
        codes(&files::bytes("minimal.xml"), "<Index>6656</Index>", &format!("<Index>6656</Index>{entries}"));
    assert!(found.contains("E408"), "{found:?}");
}

/// Those of network files have `tests/network_files.rs`.
#[test]
fn every_rule_has_a_file_that_breaks_it() {
    let elsewhere = ["E101", "E108", "E408"];
    let covered: BTreeSet<&str> = CASES.iter().map(|(code, ..)| *code).chain(elsewhere).collect();
    assert_eq!(
        covered,
        RULES.iter().filter(|rule| rule.code.starts_with('E')).map(|rule| rule.code).collect()
    );
}

/// The codes of the findings that a change adds.
fn codes(bytes: &[u8], from: &str, to: &str) -> BTreeSet<&'static str> {
    let latin: String = bytes.iter().map(|byte| char::from(*byte)).collect();
    assert!(latin.contains(from), "{from}");
    let changed: Vec<u8> = latin.replace(from, to).chars().map(|c| c as u8).collect();
    let of = |bytes: &[u8]| -> BTreeSet<&'static str> {
        let file = EsiFile::read(bytes, &files::external).unwrap();
        file.findings.list().iter().map(|finding| finding.rule.code).collect()
    };
    &of(&changed) - &of(bytes)
}
