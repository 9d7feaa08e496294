//! `ectwin explain CODE`: what a code means and what to do.

mod al_status_codes;
mod sdo_abort_codes;

use std::fmt;

use wire::{AlStatusCode, SdoAbort};

/// AL status code of the NX-ECT101 that no standard has: its manual, 8-5-2.
const CPU_UNIT_ERROR: AlStatusCode = AlStatusCode(0x8004);

/// Why a code comes, and what helps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The likely cause.
    pub cause: &'static str,
    /// What to do about it.
    pub correction: &'static str,
}

/// A code that is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The code.
    pub code: Code,
    /// What it is called.
    pub meaning: &'static str,
    /// The state in which a slave usually shows it; nothing for abort codes.
    pub state: Option<&'static str>,
    /// Cause and correction.
    pub advice: Advice,
}

/// A code, by what it is a code of. Four hex digits or fewer make an AL status code, more an abort code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// AL status code, register 0x0134.
    AlStatus(AlStatusCode),
    /// SDO abort code.
    Abort(SdoAbort),
}

impl fmt::Display for Code {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::AlStatus(code) => write!(formatter, "AL status code 0x{:04X}", code.0),
            Self::Abort(code) => {
                write!(formatter, "SDO abort code 0x{:04X}_{:04X}", code.0 >> 16, code.0 & 0xFFFF)
            }
        }
    }
}

/// A code that cannot be explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unexplained {
    /// The text is no hexadecimal number of up to eight digits.
    NotACode,
    /// No table has the code; the nearest that one has.
    Unknown(Code, Explanation),
}

impl fmt::Display for Unexplained {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotACode => formatter.write_str(
                "not a code: expected hexadecimal digits, such as 0x001B (AL status code) or 0x0602_0000 (abort code)",
            ),
            Self::Unknown(code, nearest) => {
                write!(formatter, "{code} is not known; the nearest is {}, {}", nearest.code, nearest.meaning)
            }
        }
    }
}

impl std::error::Error for Unexplained {}

impl fmt::Display for Explanation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(formatter, "{}: {}", self.code, self.meaning)?;
        if let Some(state) = self.state {
            writeln!(formatter, "  shown in    {state}")?;
        }
        writeln!(formatter, "  cause       {}", self.advice.cause)?;
        write!(formatter, "  correction  {}", self.advice.correction)
    }
}

/// Explains the code that `text` holds in hexadecimal digits, with or without `0x` and underscores.
///
/// # Errors
/// The text is no code, or no table has it.
pub fn explain(text: &str) -> Result<Explanation, Unexplained> {
    let code = parse(text).ok_or(Unexplained::NotACode)?;
    let mut known = explanations(code);
    known.find(|row| row.code == code).map_or_else(|| Err(nearest(code)), Ok)
}

fn parse(text: &str) -> Option<Code> {
    let digits = text.trim().to_ascii_lowercase().replace('_', "");
    let digits = digits.strip_prefix("0x").unwrap_or(&digits);
    if !(1..=8).contains(&digits.len()) || !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    let number = u32::from_str_radix(digits, 16).ok()?;
    Some(match u16::try_from(number) {
        Ok(number) if digits.len() <= 4 => Code::AlStatus(AlStatusCode(number)),
        _ => Code::Abort(SdoAbort(number)),
    })
}

fn nearest(code: Code) -> Unexplained {
    let distance = |row: &Explanation| number(row.code).abs_diff(number(code));
    explanations(code)
        .min_by_key(distance)
        .map_or(Unexplained::NotACode, |row| Unexplained::Unknown(code, row))
}

const fn number(code: Code) -> u32 {
    match code {
        Code::AlStatus(code) => code.0 as u32,
        Code::Abort(code) => code.0,
    }
}

/// All that is known of codes of the same kind.
fn explanations(kind: Code) -> Box<dyn Iterator<Item = Explanation>> {
    match kind {
        Code::AlStatus(_) => Box::new(al_status_codes().chain([cpu_unit_error()])),
        Code::Abort(_) => Box::new(abort_codes()),
    }
}

fn al_status_codes() -> impl Iterator<Item = Explanation> {
    al_status_codes::ADVICE.iter().filter_map(|(code, advice)| {
        let row = code.row()?;
        let (meaning, state) = (row.meaning, Some(row.state));
        Some(Explanation { code: Code::AlStatus(*code), meaning, state, advice: *advice })
    })
}

fn abort_codes() -> impl Iterator<Item = Explanation> {
    sdo_abort_codes::ADVICE.iter().filter_map(|(code, advice)| {
        let meaning = code.row()?.meaning;
        Some(Explanation { code: Code::Abort(*code), meaning, state: None, advice: *advice })
    })
}

fn cpu_unit_error() -> Explanation {
    Explanation {
        code: Code::AlStatus(CPU_UNIT_ERROR),
        meaning: "CPU Unit error (NX-ECT101)",
        state: Some("INIT + error"),
        advice: Advice {
            cause: "The hardware of the unit or of the CPU Unit failed: NX Unit Clock Not Synchronized Error.",
            correction: "Switch the power off and on; the unit stays in INIT until then.",
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_of_the_tables_has_its_advice() {
        assert!(
            al_status_codes::ADVICE
                .iter()
                .map(|row| row.0)
                .eq(AlStatusCode::TABLE.iter().map(|row| row.code))
        );
        assert!(
            sdo_abort_codes::ADVICE.iter().map(|row| row.0).eq(SdoAbort::TABLE.iter().map(|row| row.code))
        );
    }

    #[test]
    fn a_code_may_be_written_in_every_usual_way() {
        for text in ["0x001B", "001B", "1B", "0x1b", "0X001B", " 1b "] {
            assert_eq!(
                explain(text).unwrap().code,
                Code::AlStatus(AlStatusCode::SYNC_MANAGER_WATCHDOG),
                "{text}"
            );
        }
        for text in ["0x0602_0000", "06020000", "0x06020000", "6020000", "0602_0000"] {
            assert_eq!(explain(text).unwrap().code, Code::Abort(SdoAbort::OBJECT_DOES_NOT_EXIST), "{text}");
        }
        assert_eq!(explain("8004").unwrap().meaning, "CPU Unit error (NX-ECT101)");
    }

    #[test]
    fn an_unknown_code_is_told_with_the_nearest_one() {
        let text = explain("0x0099").unwrap_err().to_string();
        assert_eq!(
            text,
            "AL status code 0x0099 is not known; the nearest is AL status code 0x0083, temperature too high"
        );
        assert!(explain("06020001").unwrap_err().to_string().contains("0x0602_0000"));
        for text in ["", "0x", "hello", "123456789", "-1", "+1B"] {
            assert_eq!(explain(text), Err(Unexplained::NotACode), "{text}");
        }
    }
}
