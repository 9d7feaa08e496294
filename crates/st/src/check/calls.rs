//! Calls of functions and function blocks of the program.

use std::rc::Rc;
use std::sync::Arc;

use super::expressions::Body;
use super::numbers::{Fitting, coerce, converted};
use super::scope::{Located, Symbol, key};
use super::unknown_names::nearest;
use super::value::{Kind, Value};
use super::{Named, Signature};
use crate::code::{
    Assign, BlockCall, BlockOutput, Code, FunctionCall, FunctionResult, Place, Put, SlotCopy, StatementKind,
};
use crate::convert::widens;
use crate::elementary::{Class, Elementary};
use crate::host::NX_OBJECT_BYTES_MAX;
use crate::layout::Layout;
use crate::library;
use crate::machine::ARGUMENTS_MAX;
use crate::problem::{Problem, Span};
use crate::syntax::ast::{Argument, BinaryOperator, Call, Expression, ExpressionKind, Name};
use crate::types::{Block, Member, Role, Type, member};

/// Maximum number of values of a variable that is passed as ANY: more than the bytes of an NX object.
const ANY_SLOTS_MAX: u32 = 256;

/// An argument with its pin.
enum Given<'a> {
    Input(&'a Expression),
    Output { to: &'a Expression, negated: bool, span: Span },
}

impl<'t> Body<'_, 't> {
    /// A call in an expression.
    pub(super) fn call(&mut self, call: &Call, wanted: Option<Elementary>) -> Option<Value> {
        let ExpressionKind::Name(name) = &call.callee.kind else {
            return self.refuse_block_value(call);
        };
        if self.symbol(name).is_some_and(
            |symbol| matches!(&symbol, Symbol::Variable(located) if matches!(located.type_, Type::Block(_))),
        ) {
            return self.refuse_block_value(call);
        }
        if matches!(self.symbol(name), Some(Symbol::Wrong)) {
            return None;
        }
        if let Some(signature) = self.function(name, call.callee.span)? {
            return self.call_function(&signature, call);
        }
        if name.eq_ignore_ascii_case("EnumToNum") {
            return self.number_of_enumeration(call);
        }
        for (is_upper, own) in [(false, "LOWER_BOUND"), (true, "UPPER_BOUND")] {
            if name.eq_ignore_ascii_case(own) {
                return self.bound_of_array(is_upper, call);
            }
        }
        if let Some(conversion) = library::Conversion::named(name) {
            return self.convert(conversion, call);
        }
        match library::function(name).filter(|native| self.is_library() || !native.0.name.starts_with('_')) {
            Some(native) => self.call_native(native, call, wanted),
            None => self.unknown_function(name, call.callee.span),
        }
    }

    fn refuse_block_value(&mut self, call: &Call) -> Option<Value> {
        self.checker.refuse(
            Problem::new(call.span, "a function block is called as a statement and has no value")
                .help("take an output of the instance: instance.Q"),
        )
    }

    /// The function of the program with this name, if there is one.
    fn function(&mut self, name: &str, span: Span) -> Option<Option<Rc<Signature>>> {
        match self.checker.named.get(&key(name)) {
            Some(Named::Signature(signature)) => Some(Some(signature.clone())),
            Some(Named::Function(pou)) => {
                let pou = *pou;
                self.checker.named.insert(key(name), Named::Wrong);
                let signature = self.checker.signature(pou)?;
                self.checker.named.insert(key(name), Named::Signature(signature.clone()));
                Some(Some(signature))
            }
            Some(Named::Wrong) => None,
            Some(Named::Block(..) | Named::Shape(_) | Named::Type(_) | Named::Resolving) => {
                self.checker.refuse(
                    Problem::new(span, format!("`{name}` is a type and cannot be called"))
                        .help("declare an instance of the block and call that"),
                )
            }
            Some(Named::Program) => {
                self.checker.refuse(Problem::new(span, format!("`{name}` is a program: the task runs it")))
            }
            None => Some(None),
        }
    }

    fn unknown_function<T>(&mut self, name: &str, span: Span) -> Option<T> {
        let own = self
            .checker
            .named
            .iter()
            .filter(|(_, named)| matches!(named, Named::Function(_) | Named::Signature(_)));
        let names = own.map(|(name, _)| name.clone()).chain(self.scope.symbols.keys().cloned());
        let names = names.chain(library::functions().map(|function| function.name.to_owned()));
        let problem = Problem::new(span, format!("there is no function `{name}`"));
        let problem = match nearest(name, names) {
            Some(near) => problem.did_you_mean(near),
            None => problem,
        };
        self.checker.refuse(problem)
    }

    /// A call as a statement.
    pub(super) fn call_statement(&mut self, call: &Call) -> Option<StatementKind> {
        if let Some((block, located)) = self.instance(&call.callee)? {
            return self.call_block(&block, located, call);
        }
        self.call(call, None).map(|value| StatementKind::Evaluate(value.code))
    }

    /// The function block instance that is called, if the name is a variable.
    fn instance(&mut self, callee: &Expression) -> Option<Option<(Arc<Block>, Located)>> {
        let located = match &callee.kind {
            ExpressionKind::Name(name) => match self.symbol(name) {
                Some(Symbol::Variable(located)) if matches!(located.type_, Type::Block(_)) => located,
                Some(Symbol::Wrong) => return None,
                // The result variable of a function has its name, and a function cannot call itself.
                _ => return Some(None),
            },
            _ => self.place(callee)?,
        };
        if let Type::Block(block) = &located.type_ {
            return Some(Some((block.clone(), located)));
        }
        let message = format!("this is {}, and only function blocks are called", located.type_);
        self.checker.refuse(Problem::new(callee.span, message))
    }

    fn call_function(&mut self, signature: &Signature, call: &Call) -> Option<Value> {
        self.note_call(signature.unit, call.span);
        let given = self.assign_pins(&signature.name, &signature.pins, call)?;
        let (mut inputs, mut outputs, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        let mut targets_call = false;
        for (pin, given) in signature.pins.iter().zip(given) {
            match given {
                Some(Given::Input(expression)) => {
                    inputs.extend(self.pin_input(pin, expression)?);
                }
                Some(Given::Output { to, negated, span }) => {
                    let calls = self.checker.calls.len();
                    outputs.push((pin, self.function_output(pin, to, negated, span)?));
                    targets_call |= self.checker.calls.len() > calls;
                }
                None => self.required(pin, &signature.name, call.span)?,
            }
        }
        self.limit_arguments(inputs.len().max(outputs.len()), call.span)?;
        // An index may call the same function, which overwrites its outputs.
        if targets_call {
            for (pin, output) in outputs.iter_mut().filter(|(_, output)| output.put != Put::Value) {
                let copy = self.keep(pin, call.span)?;
                output.value = Code::Address(Place::in_memory(copy.to));
                kept.push(copy);
            }
        }
        let outputs = outputs.into_iter().map(|(_, output)| output).collect();
        let (kind, result) = self.function_result(signature, call.span)?;
        let code = Code::Call(Box::new(FunctionCall { unit: signature.unit, inputs, kept, outputs, result }));
        Some(Value { kind, code, span: call.span })
    }

    /// A copy of an output, for a call in which an index of a target could change it.
    fn keep(&mut self, pin: &Member, span: Span) -> Option<SlotCopy> {
        let slots = pin.type_.slots();
        let to = self.checker.allocate(&vec![0; slots as usize], span)?;
        Some(SlotCopy { from: pin.offset, to, slots })
    }

    fn limit_arguments(&mut self, count: usize, span: Span) -> Option<()> {
        if count <= ARGUMENTS_MAX {
            return Some(());
        }
        let message = format!("a call has {ARGUMENTS_MAX} arguments at most");
        self.checker.refuse(Problem::new(span, message))
    }

    fn function_result(&mut self, signature: &Signature, span: Span) -> Option<(Kind, FunctionResult)> {
        let Some((slot, type_)) = &signature.result else {
            return Some((Kind::Nothing, FunctionResult::None));
        };
        let result = match type_ {
            Type::Elementary(_) | Type::Enum(_) => FunctionResult::Value(*slot),
            _ => {
                let slots = type_.slots();
                let to = self.checker.allocate(&vec![0; slots as usize], span)?;
                FunctionResult::Copied(SlotCopy { from: *slot, to, slots })
            }
        };
        Some((Kind::Type(type_.clone()), result))
    }

    fn function_output(
        &mut self,
        pin: &Member,
        to: &Expression,
        negated: bool,
        span: Span,
    ) -> Option<Assign> {
        let target = self.target(to)?;
        let located = Located {
            place: Place::in_memory(pin.offset),
            type_: pin.type_.clone(),
            access: super::scope::Access::Write,
            is_element: false,
        };
        let mut value = super::expressions::load(&located, span);
        if negated {
            self.negatable(&pin.type_, span)?;
            let (operator, elementary) = (crate::operators::Unary::Not, Elementary::Bool);
            value.code = Code::Unary { operator, elementary, operand: Box::new(value.code) };
        }
        let fitting = coerce(self.checker, value, &target.type_)?;
        Some(Assign { to: target.place, value: fitting.code, put: fitting.put })
    }

    fn call_block(&mut self, block: &Block, instance: Located, call: &Call) -> Option<StatementKind> {
        self.note_call(block.unit, call.span);
        // Running an instance writes it.
        self.checker.written(&instance, call.callee.span)?;
        let pins = block.members.iter().filter(|pin| pin.role != Role::Internal).cloned().collect::<Vec<_>>();
        let given = self.assign_pins(&block.name, &pins, call)?;
        let (mut inputs, mut outputs, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        let mut targets_call = false;
        for (pin, given) in pins.iter().zip(given) {
            match given {
                Some(Given::Input(expression)) => {
                    inputs.extend(self.pin_input(pin, expression)?);
                }
                Some(Given::Output { to, negated, span }) => {
                    let calls = self.checker.calls.len();
                    outputs.push((pin, self.block_output(pin, to, negated, span)?));
                    targets_call |= self.checker.calls.len() > calls;
                }
                None => self.required(pin, &block.name, call.span)?,
            }
        }
        self.limit_arguments(inputs.len(), call.span)?;
        // A function in an index may execute the same instance.
        if targets_call {
            for (pin, output) in &mut outputs {
                let copy = self.keep(pin, call.span)?;
                output.kept = Some(copy.to);
                kept.push(copy);
            }
        }
        let outputs = outputs.into_iter().map(|(_, output)| output).collect();
        let call = BlockCall { unit: block.unit, instance: instance.place, inputs, kept, outputs };
        Some(StatementKind::CallBlock(call))
    }

    fn block_output(
        &mut self,
        pin: &Member,
        to: &Expression,
        negated: bool,
        span: Span,
    ) -> Option<BlockOutput> {
        let target = self.target(to)?;
        if negated {
            self.negatable(&pin.type_, span)?;
        }
        let (convert, put) = match (&pin.type_, &target.type_) {
            (Type::Elementary(from), Type::Elementary(into)) if widens(*from, *into) => {
                ((from != into).then_some((*from, *into)), Put::Value)
            }
            (Type::String(_), Type::String(capacity)) => (None, Put::Text(*capacity)),
            (Type::Enum(_), _) if pin.type_ == target.type_ => (None, Put::Value),
            (Type::Array(_) | Type::Struct(_), _)
                if pin.type_ == target.type_ && !pin.type_.holds_blocks() =>
            {
                (None, Put::Slots(pin.type_.slots()))
            }
            (from, into) => {
                let message = format!("the output `{}` is {from}, and cannot be stored in {into}", pin.name);
                return self.checker.refuse(Problem::new(to.span, message));
            }
        };
        Some(BlockOutput { offset: pin.offset, kept: None, convert, negated, to: target.place, put })
    }

    fn negatable(&mut self, type_: &Type, span: Span) -> Option<()> {
        if *type_ == Type::BOOL {
            return Some(());
        }
        self.checker.refuse(Problem::new(span, format!("NOT is for a BOOL output, and this is {type_}")))
    }

    /// The argument of an input or in-out: its position in the unit, and its value.
    fn pin_input(&mut self, pin: &Member, expression: &Expression) -> Option<Vec<(u32, Code, Put)>> {
        let at_pin = |fitting: Fitting| vec![(pin.offset, fitting.code, fitting.put)];
        if pin.role != Role::InOut {
            let value = self.expression_for(expression, &pin.type_)?;
            return coerce(self.checker, value, &pin.type_).map(at_pin);
        }
        let located = self.target(expression)?;
        match &pin.type_ {
            Type::Any => self.any(&located, expression.span).map(at_pin),
            Type::Open(array) => self.open(pin, array, &located, expression.span),
            own if *own == located.type_ => {
                Some(at_pin(Fitting { code: Code::Address(located.place), put: Put::Value }))
            }
            own => {
                let message = format!("`{}` is a variable of {own}, not {}", pin.name, located.type_);
                let problem = Problem::new(expression.span, message);
                self.checker.refuse(problem.help("a VAR_IN_OUT requires a variable of exactly its type"))
            }
        }
    }

    fn any(&mut self, located: &Located, span: Span) -> Option<Fitting> {
        // For a variable that is slightly too long, the instruction returns an ErrorID; a huge one is not laid
        // out at all.
        if located.type_.slots() > ANY_SLOTS_MAX {
            let message = format!(
                "{} is far longer than an NX object, which has {NX_OBJECT_BYTES_MAX} bytes at most",
                located.type_
            );
            return self.checker.refuse(Problem::new(span, message));
        }
        let Some(values) = super::places::flatten(&located.type_) else {
            let message = format!("{} has no bytes to send: a STRING or a block is in it", located.type_);
            return self.checker.refuse(Problem::new(span, message));
        };
        let layouts = &mut self.checker.out.layouts;
        if layouts.last().is_none_or(|last| last.values != values) {
            layouts.push(Layout { values });
        }
        let layout = (layouts.len() - 1) as u32;
        Some(Fitting { code: Code::Address(located.place.clone()), put: Put::Any { layout } })
    }

    /// The value of a pin without an argument: an in-out must have one, every other pin keeps its value.
    fn required(&mut self, pin: &Member, name: &str, span: Span) -> Option<()> {
        if pin.role != Role::InOut {
            return Some(());
        }
        let message = format!("`{name}` needs its in-out `{}`", pin.name);
        self.checker.refuse(Problem::new(span, message))
    }

    /// Assigns the arguments to the pins.
    fn assign_pins<'a>(
        &mut self,
        name: &str,
        pins: &[Member],
        call: &'a Call,
    ) -> Option<Vec<Option<Given<'a>>>> {
        let mut given: Vec<Option<Given<'a>>> = pins.iter().map(|_| None).collect();
        let mut next = 0;
        for argument in &call.arguments {
            let (place, value, span) = match argument {
                Argument::Positional(expression) => {
                    let Some(pin) = pins.get(next) else {
                        let message =
                            format!("`{name}` has {} pins, but more arguments are given", pins.len());
                        return self.checker.refuse(Problem::new(expression.span, message));
                    };
                    self.refuse_comparison(expression, |name| member(pins, name).is_some())?;
                    next += 1;
                    let value = if pin.role == Role::Output {
                        Given::Output { to: expression, negated: false, span: expression.span }
                    } else {
                        Given::Input(expression)
                    };
                    (next - 1, value, expression.span)
                }
                Argument::Input { name: pin, value } => {
                    let place = self.pin(name, pins, pin, Role::Input)?;
                    (place, Given::Input(value), pin.span)
                }
                Argument::Output { to: None, name: pin, .. } => {
                    self.pin(name, pins, pin, Role::Output)?;
                    continue;
                }
                Argument::Output { name: pin, negated, to: Some(to) } => {
                    let place = self.pin(name, pins, pin, Role::Output)?;
                    (place, Given::Output { to, negated: *negated, span: pin.span }, pin.span)
                }
            };
            if given[place].replace(value).is_some() {
                let message = format!("the pin `{}` is given twice", pins[place].name);
                return self.checker.refuse(Problem::new(span, message));
            }
        }
        Some(given)
    }

    /// Refuses `Target = 80` as an argument, where `Target` is a pin and not a variable: a comparison is not meant.
    pub(super) fn refuse_comparison(
        &mut self,
        argument: &Expression,
        is_pin: impl Fn(&str) -> bool,
    ) -> Option<()> {
        let ExpressionKind::Binary { operator: BinaryOperator::Equal, left, .. } = &argument.kind else {
            return Some(());
        };
        let ExpressionKind::Name(name) = &left.kind else { return Some(()) };
        if !is_pin(name) || self.symbol(name).is_some() {
            return Some(());
        }
        let problem = Problem::new(argument.span, format!("expected `:=` after the pin `{name}`, found `=`"));
        self.checker.refuse(problem.help(format!("write {name} := value")))
    }

    /// The position of the pin with this name, if it is an output or, as `role` requires, not one.
    fn pin(&mut self, of: &str, pins: &[Member], name: &Name, role: Role) -> Option<usize> {
        let wanted = library::block_pin(of, &name.text).unwrap_or(&name.text);
        let place =
            member(pins, wanted).and_then(|pin| pins.iter().position(|other| core::ptr::eq(pin, other)));
        let Some(place) = place else {
            return self.unknown_pin(of, pins.iter().map(|pin| pin.name.clone()), name);
        };
        let is_output = pins[place].role == Role::Output;
        match (is_output, role) {
            (true, Role::Output) | (false, Role::Input) => Some(place),
            (true, _) => self.checker.refuse(
                Problem::new(name.span, format!("`{}` is an output", name.text))
                    .help(format!("write {} => variable", name.text)),
            ),
            (false, _) => self.checker.refuse(
                Problem::new(name.span, format!("`{}` is an input", name.text))
                    .help(format!("write {} := value", name.text)),
            ),
        }
    }

    pub(super) fn unknown_pin<T>(
        &mut self,
        of: &str,
        pins: impl Iterator<Item = String>,
        name: &Name,
    ) -> Option<T> {
        let pins = pins.collect::<Vec<_>>();
        let problem = Problem::new(name.span, format!("`{of}` has no pin `{}`", name.text));
        let enables = ["EN", "ENO"].iter().any(|enable| enable.eq_ignore_ascii_case(&name.text));
        let problem = match nearest(&name.text, pins.iter().cloned()) {
            _ if enables => problem.help("EN and ENO are not supported: put the call into an IF"),
            Some(near) => problem.did_you_mean(near),
            None => problem.help(format!("its pins are {}", pins.join(", "))),
        };
        self.checker.refuse(problem)
    }

    fn note_call(&mut self, callee: u32, span: Span) {
        if let Some(unit) = self.unit {
            self.checker.calls.push((unit, callee, span));
        } else {
            self.checker.refuse::<()>(Problem::new(
                span,
                "the result of a function is not known before the program runs",
            ));
        }
    }

    /// `EnumToNum(x)`: the number of an enumeration's value, a DINT.
    fn number_of_enumeration(&mut self, call: &Call) -> Option<Value> {
        let [Argument::Positional(expression) | Argument::Input { value: expression, .. }] =
            call.arguments.as_slice()
        else {
            return self.checker.refuse(Problem::new(call.span, "EnumToNum has one input"));
        };
        let value = self.expression(expression)?;
        if matches!(value.kind, Kind::Type(Type::Enum(_))) {
            let dint = Type::Elementary(Elementary::Dint);
            return Some(Value::of(dint, value.code, call.span));
        }
        let message = format!("EnumToNum requires an enumeration, not {}", value.kind);
        self.checker.refuse(Problem::new(value.span, message))
    }

    /// `INT_TO_REAL(x)` and similar functions.
    fn convert(&mut self, conversion: library::Conversion, call: &Call) -> Option<Value> {
        let [argument] = call.arguments.as_slice() else {
            return self.checker.refuse(Problem::new(call.span, "a conversion has one argument"));
        };
        let (Argument::Positional(expression) | Argument::Input { value: expression, .. }) = argument else {
            return self.checker.refuse(Problem::new(call.span, "a conversion has one input"));
        };
        let value = self.expression(expression)?;
        let value = match conversion.from {
            Some(library::Of::Elementary(from)) => {
                let code = super::numbers::elementary_of(self.checker, value, from)?;
                Value::of(Type::Elementary(from), code, expression.span)
            }
            Some(library::Of::Text) if !matches!(value.kind, Kind::Type(Type::String(_))) => {
                let message = format!("this is {}, where a STRING is needed", value.kind);
                return self.checker.refuse(Problem::new(value.span, message));
            }
            Some(library::Of::Text) | None => self.typed(value),
        };
        match (conversion.to, &value.kind) {
            (library::Of::Elementary(to), Kind::Type(Type::Elementary(from))) => {
                if let Some((what, help)) = no_conversion(*from, to) {
                    let message = format!("{what}: {from} to {to}");
                    return self.checker.refuse(Problem::new(call.span, message).help(help));
                }
                let code = converted(value.code, *from, to);
                Some(Value::of(Type::Elementary(to), code, call.span))
            }
            (library::Of::Elementary(to), Kind::Type(Type::String(_))) => {
                self.value_of_text(to, value, call.span)
            }
            (library::Of::Text, Kind::Type(Type::Elementary(from))) => {
                let from = *from;
                self.text_of_value(from, value, call.span)
            }
            (_, kind) => {
                let message = format!("{kind} cannot be converted by `{}`", name_of(&call.callee));
                self.checker.refuse(Problem::new(value.span, message))
            }
        }
    }
}

/// Why values of one type cannot be converted to the other, and the remedy.
fn no_conversion(from: Elementary, to: Elementary) -> Option<(&'static str, &'static str)> {
    const OF_DATES: &str = "use DT_TO_DATE, DT_TO_TOD, CONCAT_DATE_TOD, DtToSec, SecToDt and their like";
    const OF_TIME: &str = "use TimeToNanoSec, TimeToSec, NanoSecToTime or SecToTime";
    match (from.class(), to.class()) {
        _ if from == to || (from == Elementary::DateAndTime && to.class() == Class::Date) => None,
        (Class::Date, _) | (_, Class::Date) => Some(("a date is neither a number nor a duration", OF_DATES)),
        (Class::Time, _) | (_, Class::Time) => Some(("a TIME has no number without a unit", OF_TIME)),
        _ => None,
    }
}

fn name_of(callee: &Expression) -> &str {
    match &callee.kind {
        ExpressionKind::Name(name) => name,
        _ => "",
    }
}
