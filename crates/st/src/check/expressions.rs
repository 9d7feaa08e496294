//! Expressions: their types by the rules of the language, their code.

use super::numbers::{converted, elementary_of, operand_of};
use super::operands::{
    classes, code_of, date_operation, is_comparison, operand_type, sign, suits, time_operator,
};
use super::scope::{Located, Scope, Symbol, key};
use super::value::{Kind, Value};
use super::{Checker, Origin};
use crate::code::{Base, Code, Place};
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::memory::Slot;
use crate::operators::{self, Binary, Unary};
use crate::problem::{Problem, Span};
use crate::syntax::ast::{
    BinaryOperator, Expression, ExpressionKind, Literal, Name, TypedValue, UnaryOperator,
};
use crate::types::{Type, string_slots};
use crate::value::{real_bits, wrap};

/// The context of a unit while it is checked.
pub(super) struct Body<'c, 't> {
    pub(super) checker: &'c mut Checker<'t>,
    pub(super) scope: &'c Scope,
    /// The unit to which the code belongs; none for constant expressions.
    pub(super) unit: Option<u32>,
    pub(super) loops: u32,
    /// The type that the context of the next expression requires: numbers without a type in a function call
    /// become this type.
    pub(super) wanted: Option<Elementary>,
    /// Nesting depth of the expression or statement that is being checked, and the maximum so far: it has the
    /// same depth at run time.
    pub(super) depth: u32,
    pub(super) deepest: u32,
}

impl<'c, 't> Body<'c, 't> {
    pub(super) const fn for_constants(checker: &'c mut Checker<'t>, scope: &'c Scope) -> Self {
        Self::new(checker, scope, None)
    }

    pub(super) const fn new(checker: &'c mut Checker<'t>, scope: &'c Scope, unit: Option<u32>) -> Self {
        Self { checker, scope, unit, loops: 0, wanted: None, depth: 0, deepest: 0 }
    }

    /// Increments the nesting depth.
    pub(super) fn nested<T>(&mut self, check: impl FnOnce(&mut Self) -> T) -> T {
        self.depth += 1;
        self.deepest = self.deepest.max(self.depth);
        let checked = check(self);
        self.depth -= 1;
        checked
    }

    pub(super) fn is_library(&self) -> bool {
        self.checker.origin == Origin::Library
    }

    /// Checks an expression; none if it is wrong, which has been reported.
    pub(super) fn expression(&mut self, expression: &Expression) -> Option<Value> {
        self.nested(|body| body.expression_here(expression))
    }

    /// The same, for a context that requires a value of a type.
    pub(super) fn expression_for(&mut self, expression: &Expression, type_: &Type) -> Option<Value> {
        self.wanted = type_.elementary();
        self.expression(expression)
    }

    fn expression_wanted(&mut self, expression: &Expression, wanted: Option<Elementary>) -> Option<Value> {
        self.wanted = wanted;
        self.expression(expression)
    }

    fn expression_here(&mut self, expression: &Expression) -> Option<Value> {
        let span = expression.span;
        let wanted = self.wanted.take();
        match &expression.kind {
            ExpressionKind::Literal(literal) => self.literal(literal, span),
            ExpressionKind::Name(name) => self.name(name, span),
            ExpressionKind::Member { .. } | ExpressionKind::Index { .. } => {
                let located = self.place(expression)?;
                Some(load(&located, span))
            }
            ExpressionKind::EnumValue { type_name, value } => self.enum_value(type_name, value, span),
            ExpressionKind::Unary { operator, operand } => {
                let operand = self.expression_wanted(operand, wanted)?;
                self.unary(*operator, operand, wanted, span)
            }
            ExpressionKind::Binary { .. } => self.chain(expression, wanted),
            ExpressionKind::Call(call) => self.call(call, wanted),
        }
    }

    /// A chain of operators, `a + b + c`: a loop, because there may be hundreds. The first two operands are the
    /// most deeply nested. All operands are checked, so that every mistake in them is reported. A function that
    /// has only numbers without a type gets the type of the operand on its left, or else the required one.
    fn chain(&mut self, expression: &Expression, wanted: Option<Elementary>) -> Option<Value> {
        let mut operations = Vec::new();
        let mut first = expression;
        while let ExpressionKind::Binary { operator, left, right } = &first.kind {
            operations.push((*operator, right, first.span));
            first = left;
        }
        let own_depth = self.depth;
        self.depth += operations.len().saturating_sub(1) as u32;
        let mut value = self.expression_wanted(first, wanted);
        for (operator, right, span) in operations.into_iter().rev() {
            let on_the_left = value.as_ref().and_then(Value::type_if_elementary);
            let operands = value.zip(self.expression_wanted(right, on_the_left.or(wanted)));
            value = operands.and_then(|(left, right)| self.binary(operator, left, right, span));
            self.depth = self.depth.saturating_sub(1).max(own_depth);
        }
        value
    }

    /// A condition: a BOOL.
    pub(super) fn condition(&mut self, expression: &Expression) -> Option<Code> {
        let value = self.expression_for(expression, &Type::BOOL)?;
        if matches!(value.kind, Kind::Type(Type::BOOL) | Kind::Integer(0 | 1)) {
            return elementary_of(self.checker, value, Elementary::Bool);
        }
        let message = format!("a condition is a BOOL, not {}", value.kind);
        self.checker.refuse(Problem::new(value.span, message).help("compare it: … <> 0"))
    }

    fn literal(&mut self, literal: &Literal, span: Span) -> Option<Value> {
        Some(match literal {
            Literal::Bool(value) => Value::constant(Elementary::Bool, u64::from(*value), span),
            Literal::Integer(number) => Value::untyped(Kind::Integer((*number).into()), span),
            Literal::Real(number) => Value::untyped(Kind::Real(*number), span),
            Literal::Typed { elementary, value: TypedValue::Integer(number) } => {
                Value::constant(*elementary, wrap(*elementary, *number as u64), span)
            }
            Literal::Typed { elementary, value: TypedValue::Real(number) } => {
                Value::constant(*elementary, real_bits(*elementary, *number), span)
            }
            Literal::Time(nanoseconds) => Value::constant(Elementary::Time, *nanoseconds as u64, span),
            Literal::String(text) => {
                let (slot, length) = self.checker.text_literal(text, span)?;
                let place = Place { base: Base::Memory, offset: slot, indices: Vec::new() };
                Value::of(Type::String(length), Code::Address(place), span)
            }
        })
    }

    fn name(&mut self, name: &str, span: Span) -> Option<Value> {
        match self.symbol(name) {
            Some(Symbol::Variable(located)) => return Some(load(&located, span)),
            Some(Symbol::Constant(type_, bits)) => return Some(Value::of(type_, Code::Constant(bits), span)),
            Some(Symbol::Wrong) => return None,
            None => {}
        }
        match self.checker.enum_values.get(&key(name)).map(Vec::as_slice) {
            Some([(enumeration, number)]) => {
                Some(Value::of(Type::Enum(enumeration.clone()), Code::Constant(*number as u64), span))
            }
            Some([(first, _), (second, _), ..]) => {
                let message = format!("`{name}` is a value of {} and of {}", first.name, second.name);
                let help = format!("write {}#{name}", first.name);
                self.checker.refuse(Problem::new(span, message).help(help))
            }
            _ if crate::library::function(name).is_some() => {
                let message = format!("`{name}` is a function");
                self.checker.refuse(Problem::new(span, message).help(format!("call it: {name}(…)")))
            }
            _ => self.unknown(name, span),
        }
    }

    fn enum_value(&mut self, type_name: &Name, value: &Name, span: Span) -> Option<Value> {
        let shape = self.checker.named_shape(&type_name.text, type_name.span)?;
        let Type::Enum(enumeration) = &shape.type_ else {
            let message = format!("`{}` is not an enumeration", type_name.text);
            return self.checker.refuse(Problem::new(type_name.span, message));
        };
        let found = enumeration.values.iter().find(|(name, _)| name.eq_ignore_ascii_case(&value.text));
        let Some((_, number)) = found else {
            let names = enumeration.values.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>();
            let message = format!("{} has no value `{}`", enumeration.name, value.text);
            let help = format!("it has {}", names.join(", "));
            return self.checker.refuse(Problem::new(value.span, message).help(help));
        };
        Some(Value::of(shape.type_.clone(), Code::Constant(*number as u64), span))
    }

    fn unary(
        &mut self,
        operator: UnaryOperator,
        operand: Value,
        wanted: Option<Elementary>,
        span: Span,
    ) -> Option<Value> {
        let negated = operator == UnaryOperator::Minus;
        match (&operand.kind, operator) {
            (Kind::Integer(number), UnaryOperator::Not) => self.complement(*number, operand, wanted, span),
            (Kind::Integer(number), UnaryOperator::Minus | UnaryOperator::Plus) => {
                Some(Value::untyped(Kind::Integer(if negated { -number } else { *number }), span))
            }
            (Kind::Real(number), UnaryOperator::Minus | UnaryOperator::Plus) => {
                Some(Value::untyped(Kind::Real(if negated { -number } else { *number }), span))
            }
            (Kind::Type(Type::Elementary(elementary)), _) => {
                let elementary = *elementary;
                let class = elementary.class();
                match operator {
                    UnaryOperator::Not if matches!(class, Class::Bool | Class::BitString) => {
                        Some(unary(Unary::Not, elementary, operand.code, span))
                    }
                    UnaryOperator::Minus if matches!(class, Class::Signed | Class::Real | Class::Time) => {
                        Some(unary(Unary::Negate, elementary, operand.code, span))
                    }
                    UnaryOperator::Plus if !matches!(class, Class::Bool | Class::BitString | Class::Date) => {
                        Some(Value::elementary(elementary, operand.code, span))
                    }
                    _ => self.refuse_unary(operator, &operand.kind, span),
                }
            }
            (kind, _) => self.refuse_unary(operator, kind, span),
        }
    }

    /// NOT of a number without a type: how many bits it has depends on the type that the context requires.
    fn complement(
        &mut self,
        number: i128,
        operand: Value,
        wanted: Option<Elementary>,
        span: Span,
    ) -> Option<Value> {
        let Some(elementary) =
            wanted.filter(|wanted| matches!(wanted.class(), Class::Bool | Class::BitString))
        else {
            let message =
                format!("NOT {number} has no type: the number may be a BOOL or a bit string of any width");
            let help = format!("give the number its type, such as WORD#{number} or BOOL#0");
            return self.checker.refuse(Problem::new(span, message).help(help));
        };
        let code = elementary_of(self.checker, operand, elementary)?;
        Some(unary(Unary::Not, elementary, code, span))
    }

    fn refuse_unary(&mut self, operator: UnaryOperator, kind: &Kind, span: Span) -> Option<Value> {
        let (sign, help) = match operator {
            UnaryOperator::Not => ("NOT", "NOT is for BOOL and bit strings"),
            UnaryOperator::Minus => ("-", "a sign is for signed numbers and TIME"),
            UnaryOperator::Plus => ("+", "a sign is for numbers and TIME"),
        };
        self.checker.refuse(Problem::new(span, format!("there is no operator {sign} for {kind}")).help(help))
    }

    fn binary(&mut self, operator: BinaryOperator, left: Value, right: Value, span: Span) -> Option<Value> {
        let code = code_of(operator);
        match (&left.kind, &right.kind) {
            (Kind::Integer(a), Kind::Integer(b)) => self.fold_integers(code, *a, *b, span),
            (Kind::Integer(_) | Kind::Real(_), Kind::Integer(_) | Kind::Real(_)) => {
                if !suits(code, Class::Real) {
                    return self.refuse_binary(operator, &left, &right, span);
                }
                let a = elementary_of(self.checker, left, Elementary::Lreal)?;
                let b = elementary_of(self.checker, right, Elementary::Lreal)?;
                let value = self.combine(code, Elementary::Lreal, a, b, span)?;
                Some(as_untyped_real(value))
            }
            (Kind::Type(Type::String(_)), Kind::Type(Type::String(_))) if is_comparison(code) => {
                let operands = Box::new((left.code, right.code));
                Some(Value::elementary(
                    Elementary::Bool,
                    Code::CompareText { operator: code, operands },
                    span,
                ))
            }
            (Kind::Type(Type::Enum(a)), Kind::Type(Type::Enum(b))) if a == b && is_comparison(code) => {
                self.combine(code, Elementary::Lint, left.code, right.code, span)
            }
            _ => self.elementary_binary(operator, left, right, span),
        }
    }

    fn elementary_binary(
        &mut self,
        operator: BinaryOperator,
        left: Value,
        right: Value,
        span: Span,
    ) -> Option<Value> {
        let code = code_of(operator);
        if let Some(time) = time_operator(code, &left.kind, &right.kind) {
            return self.time_binary(time, left, right, span);
        }
        if let Some(result) = date_operation(code, &left.kind, &right.kind) {
            return self.combine(code, result, left.code, right.code, span);
        }
        let Some(elementary) = operand_type(code, &left.kind, &right.kind) else {
            return self.refuse_binary(operator, &left, &right, span);
        };
        if !suits(code, elementary.class()) {
            return self.refuse_binary(operator, &left, &right, span);
        }
        let left = self.operand(code, left, elementary)?;
        let right = self.operand(code, right, elementary)?;
        self.combine(code, elementary, left, right, span)
    }

    /// An operand as the type of the operation; the power of integers is a power of LREALs, to which they are
    /// converted here.
    fn operand(&mut self, operator: Binary, value: Value, elementary: Elementary) -> Option<Code> {
        match value.kind {
            Kind::Type(Type::Elementary(from)) if operator == Binary::Power => {
                Some(converted(value.code, from, elementary))
            }
            _ => operand_of(self.checker, value, elementary),
        }
    }

    fn time_binary(&mut self, operator: Binary, left: Value, right: Value, span: Span) -> Option<Value> {
        // A number times a TIME is the TIME times the number.
        let swapped = left.kind != Kind::Type(Type::Elementary(Elementary::Time));
        let (time, other) = if swapped { (right, left) } else { (left, right) };
        let time = elementary_of(self.checker, time, Elementary::Time)?;
        let other_type = match operator {
            Binary::MultiplyTime | Binary::DivideTime => Elementary::Lreal,
            Binary::Multiply | Binary::Divide => Elementary::Lint,
            _ => Elementary::Time,
        };
        let other = elementary_of(self.checker, other, other_type)?;
        self.combine(operator, Elementary::Time, time, other, span)
    }

    /// The code of an operation; for two constants, its result.
    fn combine(
        &mut self,
        operator: Binary,
        elementary: Elementary,
        left: Code,
        right: Code,
        span: Span,
    ) -> Option<Value> {
        let result = if is_comparison(operator) { Elementary::Bool } else { elementary };
        if let Code::Constant(divisor) = right
            && operators::binary(operator, elementary, 1, divisor) == Err(Fault::DivisionByZero)
        {
            return self.checker.refuse(Problem::new(span, Fault::DivisionByZero.to_string()));
        }
        let code = match (operator, elementary, left, right) {
            (_, _, Code::Constant(a), Code::Constant(b)) => {
                match operators::binary(operator, elementary, a, b) {
                    Ok(bits) => Code::Constant(bits),
                    Err(fault) => return self.checker.refuse(Problem::new(span, fault.to_string())),
                }
            }
            (Binary::And, Elementary::Bool, left, right) => {
                Code::Decide { stop_at: false, operands: Box::new((left, right)) }
            }
            (Binary::Or, Elementary::Bool, left, right) => {
                Code::Decide { stop_at: true, operands: Box::new((left, right)) }
            }
            (_, _, left, right) => Code::Binary { operator, elementary, operands: Box::new((left, right)) },
        };
        Some(Value::elementary(result, code, span))
    }

    /// Numbers without types: with as many bits as necessary.
    fn fold_integers(&mut self, operator: Binary, a: i128, b: i128, span: Span) -> Option<Value> {
        let number = match operator {
            Binary::Add => a.checked_add(b),
            Binary::Subtract => a.checked_sub(b),
            Binary::Multiply => a.checked_mul(b),
            Binary::Divide | Binary::Modulo if b == 0 => {
                return self.checker.refuse(Problem::new(span, "division by zero"));
            }
            Binary::Divide => a.checked_div(b),
            Binary::Modulo => a.checked_rem(b),
            Binary::And => Some(a & b),
            Binary::Or => Some(a | b),
            Binary::Xor => Some(a ^ b),
            Binary::Power => return Some(Value::untyped(Kind::Real(libm::pow(a as f64, b as f64)), span)),
            _ => {
                let holds = operators::compare(operator, Some(a.cmp(&b)));
                return Some(Value::constant(Elementary::Bool, holds.into(), span));
            }
        };
        match number.filter(|number| (i128::from(i64::MIN)..=u64::MAX.into()).contains(number)) {
            Some(number) => Some(Value::untyped(Kind::Integer(number), span)),
            None => self.checker.refuse(Problem::new(span, "the number exceeds every type")),
        }
    }

    fn refuse_binary(
        &mut self,
        operator: BinaryOperator,
        left: &Value,
        right: &Value,
        span: Span,
    ) -> Option<Value> {
        let (sign, class) = (sign(operator), classes(&left.kind, &right.kind));
        let message = format!("there is no operator {sign} for {} and {}", left.kind, right.kind);
        let help = match (operator, class) {
            (BinaryOperator::Add, [None, None]) => "texts are joined by CONCAT(…)",
            (BinaryOperator::And | BinaryOperator::Or | BinaryOperator::Xor, _) => {
                "it is for BOOL and bit strings: convert integers by …_TO_WORD(…)"
            }
            (_, [Some(Class::BitString), _] | [_, Some(Class::BitString)]) => {
                "bit strings are not numbers: convert them by …_TO_UINT(…)"
            }
            (_, [Some(Class::Bool), _] | [_, Some(Class::Bool)]) => "a BOOL is compared with TRUE or FALSE",
            _ => "convert one of them",
        };
        self.checker.refuse(Problem::new(span, message).help(help))
    }
}

impl Checker<'_> {
    /// A text in the memory, and its length.
    fn text_literal(&mut self, text: &[u8], span: Span) -> Option<(Slot, u16)> {
        let Some(length) = u16::try_from(text.len())
            .ok()
            .filter(|length| usize::from(*length) <= crate::types::STRING_CHARACTERS_MAX)
        else {
            let message = format!("a text has {} characters at most", crate::types::STRING_CHARACTERS_MAX);
            return self.refuse(Problem::new(span, message));
        };
        let mut memory = crate::memory::Memory::new(vec![0; string_slots(length) as usize]);
        memory.put_text(0, length, text).ok()?;
        let slot = self.allocate(memory.slice(0, string_slots(length)), span)?;
        self.literals.insert(slot);
        Some((slot, length))
    }

    /// Whether there is a text literal at `slot`.
    pub(super) fn is_literal(&self, slot: Slot) -> bool {
        self.literals.contains(&slot)
    }
}

/// The value of a variable.
pub(super) fn load(located: &Located, span: Span) -> Value {
    let place = located.place.clone();
    let code = match located.type_ {
        Type::Elementary(_) | Type::Enum(_) => Code::Load(place),
        _ => Code::Address(place),
    };
    Value::of(located.type_.clone(), code, span)
}

fn unary(operator: Unary, elementary: Elementary, operand: Code, span: Span) -> Value {
    let code = match operand {
        Code::Constant(bits) => Code::Constant(operators::unary(operator, elementary, bits)),
        operand => Code::Unary { operator, elementary, operand: Box::new(operand) },
    };
    Value::elementary(elementary, code, span)
}

/// The result of two LREAL constants remains a number without a type, unless it is a comparison.
fn as_untyped_real(value: Value) -> Value {
    match (&value.kind, &value.code) {
        (Kind::Type(Type::Elementary(Elementary::Lreal)), Code::Constant(bits)) => {
            Value::untyped(Kind::Real(f64::from_bits(*bits)), value.span)
        }
        _ => value,
    }
}
