//! EEPROM images: of descriptions of any device, and damaged ones.
//!
//! For any bytes: reading and lint terminate, contents are inside the image, a controller loads the image if
//! its checksum is correct, and a master reads it word by word.

mod description;

use std::fmt::Write;

use esc::{Esc, EscConfig, Passage};
use esi::sii::{SiiContents, checksum, compare, lint, parse, try_image};
use time::Instant;

use crate::bytes;
use crate::fuzzer::{Checked, Fuzzer, Grain, Limits};
use crate::random::Random;
use crate::real_files::Seeds;

pub(crate) const FUZZER: Fuzzer = Fuzzer {
    name: "sii",
    extension: ".bin",
    seeds: || Seeds::of(&["tests/fuzz/sii"], ".bin").with(vec![nx_image()]),
    generate,
    check,
    limits: Limits {
        milliseconds: 1_000,
        milliseconds_per_kib: 20,
        memory_kib: 4 << 10,
        memory_per_byte: 512,
    },
    grains: &[Grain::Pairs, Grain::Bytes],
};

/// Words of the configuration with their checksum.
const CONFIGURATION_BYTES: usize = 14;
/// A loadable image has at least the words of the header.
const HEADER_BYTES: usize = 128;
/// The statement that a wrong checksum violates.
const CHECKSUM: &str = "C022";
/// Number of words that a master reads here.
const WORDS_READ: usize = 24;

fn nx_image() -> Vec<u8> {
    esi::sii::image(&nx_ect101::description(&nx_ect101::UnitSettings::default()))
}

fn check(input: &[u8]) -> Checked {
    let is_loaded = loads(input)?;
    let findings = lint(input);
    if findings.iter().any(|finding| finding.check.is_empty() || finding.to_string().len() > 1_000) {
        return Err(format!("a finding without a statement, or a long one: {findings:?}"));
    }
    let _differences = compare(input, &nx_ect101::description(&nx_ect101::UnitSettings::default()));
    let outcome = match parse(input) {
        Ok(contents) => {
            inside(&contents, input)?;
            if findings.iter().any(|finding| finding.check == CHECKSUM) == is_loaded {
                return Err(format!("loaded: {is_loaded}, and the findings are {findings:?}"));
            }
            if findings.is_empty() { "accepted" } else { "with findings" }
        }
        Err(error) if findings.is_empty() => return Err(format!("{error} is no finding")),
        Err(error) => {
            let mut words = String::new();
            // Writing to a String cannot fail.
            let _ = write!(words, "{error}");
            "unreadable"
        }
    };
    Ok(outcome)
}

/// The contents are those of the image, and not more.
fn inside(contents: &SiiContents, input: &[u8]) -> Result<(), String> {
    for category in &contents.categories {
        let end = category.offset_bytes + category.length_bytes;
        if end > input.len() {
            return Err(format!("category {} ends at byte {end} of {}", category.number, input.len()));
        }
    }
    let texts: usize = contents.strings.iter().map(|text| text.chars().count()).sum();
    let pdos = contents.tx_pdos.iter().chain(&contents.rx_pdos);
    let entries: usize = pdos.map(|pdo| 1 + pdo.entries.len()).sum();
    if texts + 8 * entries > input.len() {
        return Err(format!("{texts} characters and {entries} entries in {} bytes", input.len()));
    }
    Ok(())
}

/// A controller loads an image with a correct checksum, and returns the stored words to a master. Returns
/// whether it is loaded.
fn loads(input: &[u8]) -> Result<bool, String> {
    let now = Instant::ZERO;
    let mut esc = Esc::power_on(EscConfig::default(), input.to_vec(), now);
    let is_right = match input.first_chunk::<{ CONFIGURATION_BYTES + 2 }>() {
        Some([configuration @ .., low, 0]) if input.len() >= HEADER_BYTES => *low == checksum(configuration),
        _ => false,
    };
    if esc.pdi().sii_loaded() != is_right {
        return Err(format!("loaded: {}, checksum right: {is_right}", esc.pdi().sii_loaded()));
    }
    let last = (input.len() / 2).saturating_sub(WORDS_READ / 2);
    for address in (0..WORDS_READ / 2).chain(last..last + WORDS_READ / 2) {
        let read = read_word(&mut esc, address as u32, now);
        let at = 2 * address;
        let expected = input.get(at..at + 2);
        if expected.is_some_and(|expected| expected != read) {
            return Err(format!("word {address} is {read:02X?} and not {expected:02X?}"));
        }
    }
    Ok(is_right)
}

/// A word as a master reads it by register 0x0502.
fn read_word(esc: &mut Esc, address: u32, now: Instant) -> [u8; 2] {
    let mut command = [0, 1, 0, 0, 0, 0];
    command[2..].copy_from_slice(&address.to_le_bytes());
    esc.write(0x0502, &command, now);
    esc.end_of_frame(&Passage { arrival: now, returned_out: now });
    let mut word = [0; 2];
    esc.read(0x0508, &mut word, now);
    word
}

fn generate(seeds: &Seeds, random: &mut Random) -> Vec<u8> {
    let mut image = match random.below(6) {
        0 => {
            let length = random.length(1 << 12);
            random.bytes(length)
        }
        1 if !seeds.inputs.is_empty() => random.one_of(&seeds.inputs).clone(),
        _ => try_image(&description::any(random)).unwrap_or_default(),
    };
    let mends_checksum = random.once_in(2);
    if !random.once_in(4) {
        bytes::damage(&mut image, random);
    }
    if let Some(configuration) =
        image.first_chunk::<CONFIGURATION_BYTES>().copied().filter(|_| mends_checksum)
        && let Some(byte) = image.get_mut(CONFIGURATION_BYTES)
    {
        *byte = checksum(&configuration);
    }
    if mends_checksum && !random.once_in(8) {
        image.iter_mut().skip(CONFIGURATION_BYTES + 1).take(1).for_each(|high| *high = 0);
    }
    image
}
