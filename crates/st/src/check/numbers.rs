//! Which value is converted to which type implicitly.

use super::Checker;
use super::value::{Kind, Value};
use crate::code::{Base, Code, Put};
use crate::convert::{convert, fits, natural, widens};
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::problem::Problem;
use crate::types::Type;
use crate::value::{range, real, real_bits};

/// A value that fits its target, and how it is stored there.
#[derive(Debug)]
pub(super) struct Fitting {
    pub(super) code: Code,
    pub(super) put: Put,
}

/// Converts a value to a type; refuses a value that cannot be converted implicitly.
pub(super) fn coerce(checker: &mut Checker<'_>, value: Value, target: &Type) -> Option<Fitting> {
    match (&value.kind, target) {
        (_, Type::Elementary(elementary)) => {
            let code = elementary_of(checker, value, *elementary)?;
            Some(Fitting { code, put: Put::Value })
        }
        (Kind::Type(Type::String(characters)), Type::String(capacity)) => {
            if characters > capacity && is_text_literal(checker, &value.code) {
                let problem =
                    Fault::TextTooLong { characters: usize::from(*characters), capacity: *capacity };
                return checker.refuse(Problem::new(value.span, problem.to_string()));
            }
            Some(Fitting { code: value.code, put: Put::Text(*capacity) })
        }
        (Kind::Type(type_), _) if type_ == target => match target {
            Type::Enum(_) => Some(Fitting { code: value.code, put: Put::Value }),
            Type::Array(_) | Type::Struct(_) if !target.holds_blocks() => {
                Some(Fitting { code: value.code, put: Put::Slots(target.slots()) })
            }
            _ => checker.refuse(
                Problem::new(value.span, format!("an instance of {target} cannot be copied"))
                    .help("pass it as VAR_IN_OUT"),
            ),
        },
        _ => {
            let message = format!("this is {}, where {target} is needed", value.kind);
            checker.refuse(Problem::new(value.span, message))
        }
    }
}

/// Whether a text is known before the program runs.
fn is_text_literal(checker: &Checker<'_>, code: &Code) -> bool {
    matches!(code, Code::Address(place) if place.base == Base::Memory && checker.is_literal(place.offset))
}

/// Converts a value to an elementary type.
pub(super) fn elementary_of(checker: &mut Checker<'_>, value: Value, target: Elementary) -> Option<Code> {
    match value.kind {
        Kind::Integer(number) => integer_of(checker, number, target, &value),
        Kind::Real(number) if target.class() == Class::Real => real_of(checker, number, target, &value),
        Kind::Type(Type::Elementary(from)) if widens(from, target) => {
            Some(converted(value.code, from, target))
        }
        Kind::Type(Type::Elementary(from)) => {
            let message = format!("{from} is not converted to {target} implicitly");
            let problem = Problem::new(value.span, message);
            checker.refuse(problem.help(conversion_help(from, target)))
        }
        Kind::Real(_) => {
            let message = format!("a number with a fraction is not a value of type {target}");
            checker.refuse(
                Problem::new(value.span, message).help(format!("use LREAL_TO_{target}(…) or TRUNC(…)")),
            )
        }
        Kind::Type(type_) => {
            let message = format!("this is {type_}, where {target} is needed");
            let problem = Problem::new(value.span, message);
            checker.refuse(match type_ {
                Type::String(_) => problem.help(format!("use STRING_TO_{target}(…)")),
                Type::Enum(_) => problem.help("use EnumToNum(…)"),
                Type::Array(_) => problem.help("an element needs an index: [0]"),
                _ => problem,
            })
        }
        Kind::Nothing => checker
            .refuse(Problem::new(value.span, "this function has no result").help("call it as a statement")),
    }
}

/// Converts an operand to the common type of the operands: together with an unsigned one, a negative number
/// without a type keeps its bits, as a signed variable does.
pub(super) fn operand_of(checker: &mut Checker<'_>, value: Value, target: Elementary) -> Option<Code> {
    match value.kind {
        Kind::Integer(number) if number < 0 && target.class() == Class::Unsigned => match natural(number) {
            Some(own) if widens(own, target) => Some(converted(Code::Constant(number as u64), own, target)),
            _ => integer_of(checker, number, target, &value),
        },
        _ => elementary_of(checker, value, target),
    }
}

fn real_of(checker: &mut Checker<'_>, number: f64, target: Elementary, value: &Value) -> Option<Code> {
    let bits = real_bits(target, number);
    if real(target, bits).is_infinite() && number.is_finite() {
        let message = format!("{number:e} does not fit {target}");
        return checker.refuse(Problem::new(value.span, message));
    }
    Some(Code::Constant(bits))
}

fn integer_of(checker: &mut Checker<'_>, number: i128, target: Elementary, value: &Value) -> Option<Code> {
    let span = value.span;
    match target.class() {
        Class::Real => Some(Code::Constant(real_bits(target, number as f64))),
        Class::Bool if !fits(target, number) => {
            let problem = Problem::new(span, format!("{number} is not a BOOL"));
            checker.refuse(problem.help("use TRUE or FALSE, which are 1 and 0"))
        }
        Class::Time => checker.refuse(Problem::new(span, "a number is not a TIME").help("use T#10ms")),
        Class::Date => checker.refuse(
            Problem::new(span, format!("a number is not a value of type {target}"))
                .help("use D#…, TOD#… or DT#…"),
        ),
        _ if fits(target, number) => Some(Code::Constant(number as u64)),
        _ => {
            let (least, greatest) = range(target);
            let message = format!("{number} does not fit {target}, which holds {least} to {greatest}");
            checker.refuse(Problem::new(span, message))
        }
    }
}

fn conversion_help(from: Elementary, target: Elementary) -> String {
    match (from.class(), target.class()) {
        (Class::Date, _) | (_, Class::Date) => {
            "use DT_TO_DATE(…), DT_TO_TOD(…) or CONCAT_DATE_TOD(…)".to_owned()
        }
        (Class::Time, _) => "use TimeToNanoSec(…) or TimeToSec(…)".to_owned(),
        (_, Class::Time) => "use NanoSecToTime(…) or SecToTime(…)".to_owned(),
        (_, Class::Bool) => format!("use {from}_TO_BOOL(…), or a comparison"),
        _ => format!("use {from}_TO_{target}(…)"),
    }
}

/// The code of a conversion; a constant is converted immediately.
pub(super) fn converted(code: Code, from: Elementary, to: Elementary) -> Code {
    match code {
        _ if from == to => code,
        Code::Constant(bits) => Code::Constant(convert(from, to, bits)),
        _ => Code::Convert { from, to, operand: Box::new(code) },
    }
}
