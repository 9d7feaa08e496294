//! The kind of a file that is not the requested one: a table of the kinds that users often have.

use wire::{SII_CONFIGURATION_BYTES, sii_checksum};

use crate::sample::Sample;
use crate::structured_text;

/// The kind of file that a command requires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// A unit file.
    UnitFile,
    /// A scenario file.
    Scenario,
    /// A user program in Structured Text.
    Program,
    /// A capture of frames.
    Capture,
    /// Results of a campaign.
    Results,
    /// The golden trace of a scenario.
    Trace,
    /// The image of an EEPROM.
    SiiImage,
    /// An ESI file.
    Esi,
    /// A table of values over time.
    Csv,
}

impl Wanted {
    /// Where to find such a file.
    pub(crate) const fn help(self) -> &'static str {
        match self {
            Self::UnitFile => "a unit file is TOML; the folder units has some to begin with",
            Self::Scenario => "a scenario is TOML; docs/user/write-a-scenario.md has one to begin with",
            Self::Program => "a program is Structured Text in UTF-8, such as scenarios/programs/a-3-3.st",
            Self::Capture => "give a capture of master and units, as `ectwin run --pcap` writes it",
            Self::Results => "give the files that the parts of a campaign wrote with `ectwin replay --json`",
            Self::SiiImage => "an SII image is binary, as `ectwin sii` writes it",
            Self::Esi => {
                "an ESI file is XML, from the vendor of a device or from `ectwin esi`; units/esi has some"
            }
            Self::Csv => "a table of values over time is text: times in seconds in the first column",
            Self::Trace => "`ectwin replay SCENARIO --bless` writes the trace of the scenario",
        }
    }
}

/// Why a file is not used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The kind of the file.
    pub message: String,
    /// The remedy.
    pub help: String,
}

impl Refusal {
    pub(crate) fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }
}

/// The kind of the file with this name, if it is a known kind and not the required one. A file of an unknown
/// kind is left to its reader.
#[must_use]
pub fn of_another_kind(bytes: &[u8], name: &str, wanted: Wanted) -> Option<Refusal> {
    let sample = Sample::of(bytes, name);
    let kind = KINDS.iter().find(|kind| (kind.is)(&sample))?;
    if kind.wanted_as.contains(&wanted) {
        return None;
    }
    let help = [kind.help, wanted.help()].into_iter().filter(|help| !help.is_empty());
    Some(Refusal::new(format!("this is {}", kind.name), help.collect::<Vec<_>>().join("; ")))
}

/// A kind of file.
struct Kind {
    /// With its article.
    name: &'static str,
    is: fn(&Sample<'_>) -> bool,
    /// The kinds of files that it may be.
    wanted_as: &'static [Wanted],
    /// The program that reads or writes it; empty if the name is sufficient.
    help: &'static str,
}

/// The first row that matches is used.
const KINDS: &[Kind] = &[
    Kind {
        name: "an ESI file, the description of slaves for the configuration tool of a master",
        is: |file| file.is_xml_of("EtherCATInfo"),
        wanted_as: &[Wanted::Esi],
        help: "`ectwin lint FILE.xml` checks it; `ectwin esi FILE.toml` writes the one of a unit",
    },
    Kind {
        name: "an ENI file, the configuration of a network for a master",
        is: |file| file.is_xml_of("EtherCATConfig"),
        wanted_as: &[],
        help: "masters read it, and no command does",
    },
    Kind {
        name: "a file of TwinCAT (XML), not Structured Text alone",
        is: |file| file.is_xml_of("TcPlcObject") || file.is_xml_of("TcSmProject"),
        wanted_as: &[],
        help: "copy declaration and implementation into a file FILE.st: the VAR sections, then the statements",
    },
    Kind {
        name: "a PLCopen XML file, not Structured Text",
        is: |file| file.is_xml_of("project") && file.root().is_some_and(|root| root.contains("plcopen.org")),
        wanted_as: &[],
        help: "export the program as text (ST), or copy its text into a file FILE.st",
    },
    Kind { name: "an XML file", is: |file| file.root().is_some(), wanted_as: &[], help: "" },
    Kind {
        name: "a project of Sysmac Studio (.smc2)",
        is: |file| file.ending == "smc2",
        wanted_as: &[],
        help: "copy the text of its programs into files FILE.st",
    },
    Kind {
        name: "an archive or a compressed file",
        is: |file| {
            [&b"PK\x03\x04"[..], b"\x1F\x8B", b"7z\xBC\xAF"].iter().any(|mark| file.bytes.starts_with(mark))
        },
        wanted_as: &[],
        help: "unpack it first",
    },
    Kind {
        name: "a capture of frames",
        is: |file| CAPTURES.iter().any(|mark| file.bytes.starts_with(mark)),
        wanted_as: &[Wanted::Capture],
        help: "`ectwin import CAPTURE -o SCENARIO` makes a scenario of one",
    },
    Kind {
        name: "the non-volatile memory of a unit",
        is: |file| file.bytes.starts_with(b"ectwnvm\0"),
        wanted_as: &[],
        help: "the key `storage` of a unit file names it",
    },
    Kind {
        name: "a user program in WebAssembly",
        is: |file| file.bytes.starts_with(b"\0asm"),
        wanted_as: &[],
        help: "`ectwin run --program FILE.wasm` and the key `program` of a unit file take it",
    },
    Kind {
        name: "an SII image (EEPROM)",
        is: |file| is_sii(file.bytes),
        wanted_as: &[Wanted::SiiImage],
        help: "`ectwin sii FILE.toml` writes the SII image of a unit, and no command reads one",
    },
    Kind {
        name: "a text in Markdown",
        is: |file| ["md", "markdown"].contains(&&*file.ending),
        wanted_as: &[],
        help: "",
    },
    Kind {
        name: "a file of results or another JSON file",
        is: |file| file.start().starts_with("{\""),
        wanted_as: &[Wanted::Results],
        help: "`ectwin merge` reads the results of `ectwin replay --json`",
    },
    // Its later lines may look like TOML, and no TOML file begins like a program.
    Kind {
        name: "a program in Structured Text",
        is: |file| structured_text::begins(file.start()),
        wanted_as: &[Wanted::Program],
        help: "`ectwin st check FILE` reads it",
    },
    Kind {
        name: "a scenario",
        is: |file| file.has_list("steps"),
        wanted_as: &[Wanted::Scenario],
        help: "`ectwin replay FILE` and `ectwin search FILE` read it",
    },
    Kind {
        name: "a unit file",
        is: |file| file.has_top_key("model"),
        wanted_as: &[Wanted::UnitFile],
        help: "`ectwin check FILE` and `ectwin run FILE` read it",
    },
    Kind {
        name: "a TOML file",
        is: |file| file.ending == "toml",
        wanted_as: &[Wanted::UnitFile, Wanted::Scenario],
        help: "`ectwin check FILE` reads unit files, and `ectwin replay FILE` scenarios",
    },
];

/// pcapng; pcap in both byte orders, with microseconds and with nanoseconds.
const CAPTURES: &[&[u8]] = &[
    b"\x0A\x0D\x0D\x0A",
    b"\xD4\xC3\xB2\xA1",
    b"\xA1\xB2\xC3\xD4",
    b"\x4D\x3C\xB2\xA1",
    b"\xA1\xB2\x3C\x4D",
];

/// Number of bytes of an SII image before its categories.
const SII_HEADER_BYTES: usize = 128;

fn is_sii(bytes: &[u8]) -> bool {
    let Some((configuration, rest)) = bytes.split_first_chunk::<SII_CONFIGURATION_BYTES>() else {
        return false;
    };
    // A few zeros also have a checksum, but it is not zero.
    bytes.len() >= SII_HEADER_BYTES
        && bytes.len().is_multiple_of(2)
        && rest.starts_with(&[sii_checksum(configuration), 0])
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Wanted; 8] = [
        Wanted::UnitFile,
        Wanted::Scenario,
        Wanted::Program,
        Wanted::Capture,
        Wanted::Results,
        Wanted::Trace,
        Wanted::SiiImage,
        Wanted::Esi,
    ];

    /// The header words of a real device, with its checksum 0x40 (reference 4.2).
    fn sii_of_a_drive() -> Vec<u8> {
        let mut image = vec![0; SII_HEADER_BYTES];
        image[..5].copy_from_slice(&[0x05, 0x06, 0x0B, 0x0E, 0x64]);
        image[14] = 0x40;
        image
    }

    #[test]
    fn an_sii_image_is_known_by_its_checksum() {
        let known = |image: &[u8]| of_another_kind(image, "a.bin", Wanted::UnitFile);
        assert!(known(&sii_of_a_drive()).is_some_and(|refusal| refusal.message.contains("SII image")));
        for at in [0, 13, 14, 15] {
            let mut image = sii_of_a_drive();
            image[at] ^= 1;
            assert_eq!(known(&image), None, "byte {at}");
        }
    }

    /// A small file of each row, in the order of the table.
    fn samples() -> Vec<(&'static str, Vec<u8>)> {
        vec![
            (
                "a.xml",
                b"\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- > -->\n<EtherCATInfo Version=\"1.6\">".to_vec(),
            ),
            ("a.xml", b"<!DOCTYPE x>\n<EtherCATConfig>".to_vec()),
            (
                "a.TcPOU",
                b"<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<TcPlcObject Version=\"1.1\">".to_vec(),
            ),
            ("a.xml", b"<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\">".to_vec()),
            ("a.xml", b"<svg/>".to_vec()),
            ("folder/A.SMC2", b"PK\x03\x04".to_vec()),
            ("a.gz", b"\x1F\x8B\x08".to_vec()),
            ("a.pcap", b"\xD4\xC3\xB2\xA1\x02".to_vec()),
            ("a.nvm", b"ectwnvm\0\x01".to_vec()),
            ("a", b"\0asm\x01\0\0\0".to_vec()),
            ("a.bin", sii_of_a_drive()),
            ("README.md", b"# Units\n\n```toml\nmodel = \"nx-ect101\"\n```\n".to_vec()),
            ("a.jsonl", b"{\"case\":1}\n".to_vec()),
            ("a.st", b"function_block B\n".to_vec()),
            ("a.toml", b"title = \"x\"\n[[units]]\nmodel = \"nx-ect101\"\n[[steps]]\n".to_vec()),
            ("a.toml", b"# a unit\nmodel = \"nx-ect101\"\n".to_vec()),
            ("a.toml", b"# nothing in it\n".to_vec()),
        ]
    }

    #[test]
    fn each_kind_is_known_and_refused_where_another_is_wanted() {
        assert_eq!(samples().len(), KINDS.len(), "a sample for each row");
        for ((name, bytes), kind) in samples().iter().zip(KINDS) {
            for wanted in ALL {
                let refusal = of_another_kind(bytes, name, wanted);
                if kind.wanted_as.contains(&wanted) {
                    assert_eq!(refusal, None, "{}", kind.name);
                    continue;
                }
                let refusal = refusal.unwrap_or_else(|| panic!("{} is taken for {wanted:?}", kind.name));
                assert_eq!(refusal.message, format!("this is {}", kind.name));
                assert!(refusal.help.ends_with(wanted.help()), "{}", refusal.help);
            }
        }
    }

    #[test]
    fn a_program_whose_later_lines_look_like_toml_is_a_program() {
        for program in [
            "b := a AND\nsteps = 3;",
            "b := (a +\n  1) * // twice\n2 =\nmodel = 3;",
            "IF a THEN\nb := c =\nsteps = d; END_IF;",
            "PROGRAM P\nVAR b : BOOL; END_VAR\nb :=\nmodel = 1;\nEND_PROGRAM",
            "f(x :=\nsteps = 3);",
        ] {
            assert_eq!(of_another_kind(program.as_bytes(), "a.st", Wanted::Program), None, "{program}");
            for wanted in [Wanted::Scenario, Wanted::UnitFile] {
                let refusal = of_another_kind(program.as_bytes(), "a.st", wanted);
                assert!(
                    refusal.is_some_and(|refusal| refusal.message.contains("Structured Text")),
                    "{program}"
                );
            }
        }
    }

    #[test]
    fn structured_text_is_refused_as_a_unit_file_and_as_a_scenario() {
        for wanted in [Wanted::UnitFile, Wanted::Scenario] {
            let refusal = of_another_kind("\u{feff}Main.count[3] := 4;".as_bytes(), "a", wanted);
            let message = refusal.map(|refusal| refusal.message);
            assert_eq!(message.as_deref(), Some("this is a program in Structured Text"));
        }
        assert_eq!(of_another_kind(b"Main.count[3] := 4;", "a", Wanted::Program), None);
    }

    #[test]
    fn an_ordinary_file_is_left_to_its_reader() {
        for (text, wanted) in [
            ("", Wanted::UnitFile),
            ("mode = \"nx-ect101\"", Wanted::UnitFile),
            ("name = \"steps = 3\"\nmodel = \"nx-ect101\"", Wanted::UnitFile),
            ("title = \"x\"\nsteps = []", Wanted::Scenario),
            ("x < 3", Wanted::Program),
            ("model := 1;", Wanted::Program),
            ("type = 3", Wanted::UnitFile),
            ("VAR.x = 3", Wanted::UnitFile),
            ("// a sketch\nint main() {}", Wanted::UnitFile),
            ("model := \"nx-ect101\"\n# a; b\n", Wanted::UnitFile),
            ("variable = 1", Wanted::Scenario),
        ] {
            assert_eq!(of_another_kind(text.as_bytes(), "a", wanted), None, "{text}");
        }
        assert_eq!(of_another_kind(&[0; 256], "a", Wanted::UnitFile), None);
    }
}
