//! Values and their tests.

use core::cmp::Ordering;

use wire::{DataType, ObjectIndex, SubIndex};

use super::acts;
use super::master::scripted;
use super::seen::{Seen, holds, lie_at};
use super::unit;
use crate::model::{Amount, Condition, Hex, Number, Quantity, Same, Test, WhichUnit, hex};
use crate::run::bench::Bench;
use crate::run::master::Received;
use crate::run::observed::{Observed, Reading};

type Check = Result<(), Seen>;

/// Whether a condition holds.
type CheckFn = fn(&Condition, &mut Observed, &mut Bench<'_>) -> Check;

/// Whether the present value passes a test. Without a value it does not.
///
/// `holds_now` says whether another condition holds.
pub(super) fn value(
    of: &Quantity,
    test: &Test,
    observed: &mut Observed,
    world: &mut Bench<'_>,
    holds_now: CheckFn,
) -> Check {
    let reading = read(of, world)?;
    if let Some(passed) = passes(test, &reading) {
        return passed;
    }
    if let Test::IsNot(text) = test {
        return is_not(of, text, &reading, |condition| holds_now(condition, observed, world));
    }
    let before = observed.since_the_beginning(of, &reading);
    holds(*before != reading, || unchanged(of, &reading))
}

/// Whether a value passes a test; none: the test compares with another condition or with an earlier value.
pub(in crate::run) fn passes(test: &Test, reading: &Reading) -> Option<Check> {
    Some(match test {
        Test::Equals(amount) => compares(reading, amount, &[Ordering::Equal]),
        Test::AtLeast(amount) => compares(reading, amount, &[Ordering::Greater, Ordering::Equal]),
        Test::AtMost(amount) => compares(reading, amount, &[Ordering::Less, Ordering::Equal]),
        Test::Above(amount) => compares(reading, amount, &[Ordering::Greater]),
        Test::Below(amount) => compares(reading, amount, &[Ordering::Less]),
        Test::Between { from, to } => compares(reading, from, &[Ordering::Greater, Ordering::Equal])
            .and_then(|()| compares(reading, to, &[Ordering::Less, Ordering::Equal])),
        Test::BeginsWith(bytes) => lie_at(&reading.bytes, 0, bytes),
        Test::HasBits(Hex(bits)) => holds(reading.bits() & bits == *bits, || reading.as_it_is()),
        Test::HasNoBits(Hex(bits)) => holds(reading.bits() & bits == 0, || reading.as_it_is()),
        Test::Is(wanted) => {
            holds(reading.bytes.iter().any(|byte| *byte != 0) == *wanted, || reading.as_it_is())
        }
        Test::IsNot(_) | Test::Changes => return None,
    })
}

fn unchanged(of: &Quantity, reading: &Reading) -> String {
    match of {
        Quantity::Acts { .. } => {
            format!("the master has not done so, and before the step {} times", reading.words)
        }
        Quantity::Object { .. }
        | Quantity::Register { .. }
        | Quantity::OutputByte { .. }
        | Quantity::InputByte { .. }
        | Quantity::Outputs { .. }
        | Quantity::Inputs { .. }
        | Quantity::Variable { .. }
        | Quantity::ProgramVariable { .. }
        | Quantity::WorkingCounter { .. }
        | Quantity::Records { .. }
        | Quantity::MeanPeriod { .. }
        | Quantity::LongestPeriod { .. }
        | Quantity::Emergencies { .. }
        | Quantity::Cycles => format!("it is still {}", reading.words),
    }
}

fn is_not(
    of: &Quantity,
    text: &str,
    reading: &Reading,
    holds_now: impl FnOnce(&Condition) -> Check,
) -> Check {
    match of.is(text) {
        Ok(Same::Condition(same)) => match holds_now(&same) {
            Ok(()) => Err(reading.as_it_is().into()),
            Err(seen) if seen.is_false() => Ok(()),
            Err(seen) => Err(seen),
        },
        Ok(Same::Number(number)) => {
            holds(reading.compare(number) != Some(Ordering::Equal), || reading.as_it_is())
        }
        Err(problem) => Err(Seen::not_there(problem.to_string())),
    }
}

fn compares(reading: &Reading, amount: &Amount, wanted: &[Ordering]) -> Check {
    match reading.compare(amount.number()) {
        Some(order) => holds(wanted.contains(&order), || reading.as_it_is()),
        None => Err(Seen::not_there(format!("it is {}, which is no number", reading.words))),
    }
}

/// The present value; otherwise why there is none.
fn read(of: &Quantity, world: &mut Bench<'_>) -> Result<Reading, Seen> {
    match of {
        Quantity::Object { unit, entry } => {
            let at = there(unit, world)?;
            unit::is_readable(world, at)?;
            let (index, sub) = (ObjectIndex(entry.index), SubIndex(entry.sub));
            let value = world.object(at, index, sub);
            let bytes = value.map_err(|code| Seen::from(format!("it is refused with {:#010X}", code.0)))?;
            let number = world.object_type(at, index, sub).and_then(|kind| number_of(&bytes, kind));
            Ok(Reading::bytes(bytes, number))
        }
        Quantity::Register { unit, register } => {
            let at = there(unit, world)?;
            unit::is_readable(world, at)?;
            Ok(Reading::unsigned(world.registers(at, register.0, register_bytes(register.0))))
        }
        Quantity::OutputByte { unit, at: first } => {
            let at = there(unit, world)?;
            unit::is_readable(world, at)?;
            byte(world.io(at).m_to_c(), *first)
        }
        Quantity::InputByte { unit, at: first } => {
            let at = there(unit, world)?;
            byte(world.inputs(at), *first)
        }
        Quantity::Outputs { unit } => {
            let at = there(unit, world)?;
            unit::is_readable(world, at)?;
            some_bytes(world.io(at).m_to_c()).map(|bytes| Reading::bytes(bytes.to_vec(), None))
        }
        Quantity::Inputs { unit } => {
            let at = there(unit, world)?;
            some_bytes(world.inputs(at)).map(|bytes| Reading::bytes(bytes.to_vec(), None))
        }
        Quantity::Variable { variable } => {
            let missing = || Seen::not_there("it is not there");
            let bytes = world.variable(variable).ok_or_else(missing)?;
            let words = world.variable_text(variable).ok_or_else(missing)?;
            Ok(Reading { bytes, number: Number::of(&words), words })
        }
        Quantity::ProgramVariable { controller, name } => {
            let words = world.program_variable(controller, name);
            let words = words.ok_or_else(|| Seen::not_there("it is not there"))?;
            Ok(Reading { bytes: Vec::new(), number: Number::of(&words), words })
        }
        Quantity::WorkingCounter { unit } => {
            let at = there(unit, world)?;
            let seen = world.working_counter(at);
            let seen = seen.ok_or_else(|| Seen::from("no process data came back".to_owned()))?;
            Ok(Reading::count(seen.into()))
        }
        Quantity::Records { unit, event } => {
            let at = there(unit, world)?;
            unit::is_readable(world, at)?;
            Ok(Reading::count(world.recorded_times(at, unit_model::EventCode(event.0))))
        }
        Quantity::Acts { act } => acts::count(world, act),
        Quantity::MeanPeriod { unit } => {
            let at = there(unit, world)?;
            acts::mean_period(world, at).map(Reading::time)
        }
        Quantity::LongestPeriod { unit } => {
            let at = there(unit, world)?;
            acts::longest_period(world, at).map(Reading::time)
        }
        Quantity::Emergencies { code } => Ok(Reading::count(emergencies(world, *code)?)),
        Quantity::Cycles => Ok(Reading::count(scripted(world)?.cycles())),
    }
}

fn emergencies(world: &Bench<'_>, wanted: Option<Hex<u16>>) -> Result<u64, Seen> {
    let received = scripted(world)?.emergencies().iter();
    let is_wanted = |received: &&Received| wanted.is_none_or(|wanted| received.emergency.code == wanted.0);
    Ok(received.filter(is_wanted).count() as u64)
}

fn there(unit: &WhichUnit, world: &Bench<'_>) -> Result<usize, Seen> {
    let at = unit.position();
    if at < world.count() { Ok(at) } else { Err(Seen::not_there(format!("{unit}: not there"))) }
}

/// Process data before their first exchange have no bytes.
fn some_bytes(bytes: &[u8]) -> Result<&[u8], Seen> {
    if bytes.is_empty() { Err(format!("they are {}", hex(bytes)).into()) } else { Ok(bytes) }
}

fn byte(bytes: &[u8], at: u16) -> Result<Reading, Seen> {
    match some_bytes(bytes)?.get(usize::from(at)) {
        Some(byte) => Ok(Reading::unsigned(vec![*byte])),
        None => Err(Seen::not_there(format!("there are {} bytes only, counted from 0", bytes.len()))),
    }
}

/// Bytes from an address to the end of its register; 1 in the RAM.
pub(crate) fn register_bytes(offset: u16) -> usize {
    let rest = |register: &esc::Register| {
        let stride = register.stride_bytes.max(1);
        let place = offset.checked_sub(register.offset)?;
        let rest = register.size_bytes.checked_sub(place % stride).filter(|rest| *rest > 0)?;
        (place / stride < register.count).then_some(usize::from(rest))
    };
    esc::REGISTERS.iter().find_map(rest).unwrap_or(1).min(8)
}

/// The number of bytes by a data type, REAL32 and REAL64 among them; none for a text and for more than 64 bits.
fn number_of(bytes: &[u8], kind: DataType) -> Option<Number> {
    match kind {
        DataType(0x0008) => Some(Number::Real(f32::from_le_bytes(bytes.try_into().ok()?).into())),
        DataType(0x0011) => Some(Number::Real(f64::from_le_bytes(bytes.try_into().ok()?))),
        kind if is_signed(kind) => {
            let bits = 64 - 8 * bytes.len() as u32;
            Some(Number::Whole((((unsigned(bytes)? << bits) as i64) >> bits).into()))
        }
        _ => unsigned(bytes).map(|number| Number::Whole(number.into())),
    }
}

/// INTEGER8, 16, 32, 24, 40, 48, 56 and 64 (ETG.1000.6, table of basic data types).
pub(crate) const fn is_signed(kind: DataType) -> bool {
    matches!(kind.0, 0x0002..=0x0004 | 0x0010 | 0x0012..=0x0015)
}

/// The little-endian number; none of no bytes, and of more than 8.
fn unsigned(bytes: &[u8]) -> Option<u64> {
    let mut octets = [0; 8];
    octets.get_mut(..bytes.len()).filter(|part| !part.is_empty())?.copy_from_slice(bytes);
    Some(u64::from_le_bytes(octets))
}

impl Reading {
    pub(in crate::run) fn unsigned(bytes: Vec<u8>) -> Self {
        let number = unsigned(&bytes).map(|number| Number::Whole(number.into()));
        Self::bytes(bytes, number)
    }

    /// All bits, of a negative number in two's complement; of what is no number those of the first four bytes.
    fn bits(&self) -> u32 {
        match self.number {
            Some(Number::Whole(whole)) => whole as u32,
            Some(Number::Real(_)) => 0,
            None => self.bytes.iter().take(4).rev().fold(0, |bits, byte| bits << 8 | u32::from(*byte)),
        }
    }

    fn as_it_is(&self) -> String {
        match self.number {
            Some(number) if number.to_string() != self.words => format!("it is {} ({number})", self.words),
            Some(_) | None => format!("it is {}", self.words),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_sign_of_their_type() {
        let words =
            |bytes: &[u8], kind: u16| number_of(bytes, DataType(kind)).map(|number| number.to_string());
        assert_eq!(words(&[0xFE, 0xFF], 0x0006).as_deref(), Some("65534"));
        assert_eq!(words(&[0xFE, 0xFF], 0x0003).as_deref(), Some("-2"));
        assert_eq!(words(&[0xFE, 0xFF, 0xFF], 0x0010).as_deref(), Some("-2"));
        assert_eq!(words(&[0xFF; 8], 0x0015).as_deref(), Some("-1"));
        assert_eq!(words(&1.5_f32.to_le_bytes(), 0x0008).as_deref(), Some("1.5"));
        assert_eq!(words(&(-2.5_f64).to_le_bytes(), 0x0011).as_deref(), Some("-2.5"));
        assert_eq!((words(&[0; 9], 0x000A), words(&[], 0x0005)), (None, None));
    }

    #[test]
    fn a_register_ends_where_the_next_one_begins() {
        let bytes = [
            (0x0130, 2),
            (0x0131, 1),
            (0x0300, 2),
            (0x0302, 2),
            (0x0303, 1),
            (0x0910, 8),
            (0x0600, 8),
            (0x060C, 4),
            (0x1000, 1),
        ];
        for (offset, expected) in bytes {
            assert_eq!(register_bytes(offset), expected, "{offset:#06X}");
        }
    }
}
