//! The names of the files of a case: its number, scenario, parameters and seed.

use std::path::Path;

/// Most bytes of the name of a scenario, and of the values of its parameters, in the name of a file. With the rest it has
/// less than the 255 bytes of file systems.
const SCENARIO_BYTES_MAX: usize = 110;
const PARAMETERS_BYTES_MAX: usize = 80;
/// Fewest digits of the number of a case.
const DIGITS: usize = 4;
const SEED: &str = "-seed-";

/// The name of the files of a case without its ending: `0003-line-loss-1-state-OP-seed-7`.
pub(super) fn file_stem(number: u64, file: &Path, parameters: Option<&str>, seed: u64) -> String {
    let scenario = file.file_stem().unwrap_or_default().to_string_lossy();
    let scenario = cut(&scenario.replace(char::is_control, "-"), SCENARIO_BYTES_MAX).to_owned();
    let parameters = parameters.map(|parameters| format!("-{}", plain(parameters))).unwrap_or_default();
    format!("{number:0DIGITS$}-{scenario}{parameters}{SEED}{seed}")
}

/// The number of the case whose files have this name without its ending; none if it is another name.
pub(super) fn case_of(stem: &str) -> Option<u64> {
    let (rest, seed) = stem.rsplit_once(SEED)?;
    let (number, _) = rest.split_once('-')?;
    let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_number(number) || !is_number(seed) || number.len() < DIGITS || seed.is_empty() {
        return None;
    }
    number.parse().ok()
}

/// `loss = 1, state = PRE-OP` as `loss-1-state-PRE-OP`.
fn plain(parameters: &str) -> String {
    let is_other = |letter: char| !letter.is_alphanumeric() && !"._+-".contains(letter);
    let words: Vec<&str> = parameters.split(is_other).filter(|word| !word.is_empty()).collect();
    cut(&words.join("-"), PARAMETERS_BYTES_MAX).to_owned()
}

/// The first bytes of a text, without half a letter.
fn cut(text: &str, bytes_max: usize) -> &str {
    let ends = text.char_indices().map(|(at, letter)| at + letter.len_utf8());
    let end = ends.take_while(|&end| end <= bytes_max).last().unwrap_or_default();
    &text[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_number_scenario_parameters_and_seed() {
        let stem = |file: &str, parameters| file_stem(3, Path::new(file), parameters, 7);
        assert_eq!(stem("s/line.toml", None), "0003-line-seed-7");
        assert_eq!(
            stem("it's.toml", Some("loss = 1, state = PRE-OP")),
            "0003-it's-loss-1-state-PRE-OP-seed-7"
        );
        assert_eq!(stem("a\nb.toml", Some("text = a/../b")), "0003-a-b-text-a-..-b-seed-7");
        let long = "ä".repeat(300);
        let stem = file_stem(u64::MAX / 2, Path::new(&long), Some(&long), u64::MAX);
        assert!(stem.len() + ".trace.txt".len() <= 255, "{}", stem.len());
    }

    #[test]
    fn the_number_of_a_name_is_found_again_and_other_names_are_not_ours() {
        assert_eq!(case_of(&file_stem(12, Path::new("a-seed-b.toml"), Some("x = 1"), 7)), Some(12));
        assert_eq!(case_of(&file_stem(123_456, Path::new("a.toml"), None, 7)), Some(123_456));
        for other in [
            "notes",
            "0001-notes",
            "1-a-seed-1",
            "0001-a-seed-",
            "0001-a-seed-x",
            "x0001-a-seed-1",
            "-a-seed-1",
        ] {
            assert_eq!(case_of(other), None, "{other}");
        }
    }
}
