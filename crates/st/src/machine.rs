//! Executes the code of a program on its memory.

mod places;

use arrayvec::ArrayVec;

use crate::code::*;
use crate::convert::convert;
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::library::Call;
use crate::memory::{Slot, slot_of};
use crate::operators::{Binary, binary, compare, unary};
use crate::problem::Span;
use crate::scan::Scan;
use crate::value::{integer, wrap};

/// Maximum number of argument slots of a call.
pub(crate) const ARGUMENTS_MAX: usize = 64;
const _: () = assert!(ARGUMENTS_MAX <= u64::BITS as usize, "a call marks its ULINTs by bits");

/// Number of steps to copy a slot.
const STEPS_FOR_SLOT: u64 = 2;

/// A program during a scan.
pub(crate) struct Machine<'m> {
    pub(crate) scan: Scan<'m>,
    pub(crate) initial: &'m [u64],
    pub(crate) units: &'m [Unit],
    /// The start of the function block instance whose body is executed.
    pub(crate) instance: Slot,
    /// The statement or index that is executed, as the position of a fault.
    pub(crate) at: Span,
}

/// How a statement has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flow {
    Next,
    Exit,
    Continue,
    Return,
}

impl Machine<'_> {
    /// Executes the body of a program organization unit on the instance that is set.
    pub(crate) fn run(&mut self, unit: u32) -> Result<(), Fault> {
        self.freshen(unit)?;
        let units = self.units;
        self.body(&units[unit as usize].body).map(|_| ())
    }

    /// Initializes the variables that get their initial values at each call.
    fn freshen(&mut self, unit: u32) -> Result<(), Fault> {
        for range in &self.units[unit as usize].fresh {
            let slots = range.end - range.start;
            self.scan.step(STEPS_FOR_SLOT * u64::from(slots) + 1)?;
            let initial = &self.initial[range.start as usize..range.end as usize];
            self.scan.memory.slice_mut(range.start, slots).copy_from_slice(initial);
        }
        Ok(())
    }

    fn body(&mut self, body: &[Statement]) -> Result<Flow, Fault> {
        for statement in body {
            self.at = statement.span;
            self.scan.spend_one()?;
            match self.statement(&statement.kind)? {
                Flow::Next => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &StatementKind) -> Result<Flow, Fault> {
        match statement {
            StatementKind::Assign(assign) => self.assign(assign)?,
            StatementKind::Evaluate(code) => {
                self.value(code)?;
            }
            StatementKind::CallBlock(call) => self.call_block(call)?,
            StatementKind::If { branches, otherwise } => return self.choose(branches, otherwise),
            StatementKind::Case { selector, arms, otherwise } => return self.case(selector, arms, otherwise),
            StatementKind::For(ring) => return self.count(ring),
            StatementKind::While { condition, body } => return self.repeat_while(condition, body),
            StatementKind::Repeat { body, until } => return self.repeat_until(body, until),
            StatementKind::Exit => return Ok(Flow::Exit),
            StatementKind::Continue => return Ok(Flow::Continue),
            StatementKind::Return => return Ok(Flow::Return),
        }
        Ok(Flow::Next)
    }

    fn assign(&mut self, assign: &Assign) -> Result<(), Fault> {
        let value = self.value(&assign.value)?;
        let to = self.slot(&assign.to)?;
        self.put(to, value, assign.put)
    }

    fn put(&mut self, to: Slot, value: u64, put: Put) -> Result<(), Fault> {
        match put {
            Put::Value => self.scan.memory.set(to, value),
            Put::Slots(slots) => self.copy(SlotCopy { from: slot_of(value), to, slots })?,
            Put::Text(capacity) => self.put_text(to, slot_of(value), capacity)?,
            Put::Any { layout } => {
                self.scan.memory.set(to, value);
                self.scan.memory.set(to + 1, layout.into());
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn put_text(&mut self, to: Slot, from: Slot, capacity: u16) -> Result<(), Fault> {
        let text = self.scan.memory.text(from);
        self.scan.spend(text.len() as u64 / 128)?;
        self.scan.memory.put_text(to, capacity, &text)
    }

    fn choose(
        &mut self,
        branches: &[(Code, Vec<Statement>)],
        otherwise: &[Statement],
    ) -> Result<Flow, Fault> {
        for (condition, body) in branches {
            if self.value(condition)? != 0 {
                return self.body(body);
            }
        }
        self.body(otherwise)
    }

    fn case(&mut self, selector: &Case, arms: &[CaseArm], otherwise: &[Statement]) -> Result<Flow, Fault> {
        let value = integer(selector.elementary, self.value(&selector.value)?);
        for arm in arms {
            self.scan.step(arm.labels.len() as u64)?;
            if arm.labels.iter().any(|(from, to)| (from..=to).contains(&&value)) {
                return self.body(&arm.body);
            }
        }
        self.body(otherwise)
    }

    /// FOR: the limit and the step are evaluated once; the variable is beyond the limit at the end. If the
    /// range of the variable's type ends, the loop ends too.
    fn count(&mut self, ring: &For) -> Result<Flow, Fault> {
        let (at, elementary) = (self.at, ring.elementary);
        let from = self.value(&ring.from)?;
        let to = integer(elementary, self.value(&ring.to)?);
        let by = integer(elementary, self.value(&ring.by)?);
        if by == 0 {
            return Err(Fault::StepOfZero);
        }
        let variable = self.slot(&ring.variable)?;
        self.scan.memory.set(variable, from);
        loop {
            let present = integer(elementary, self.scan.memory.get(variable));
            if if by > 0 { present > to } else { present < to } {
                return Ok(Flow::Next);
            }
            match self.body(&ring.body)? {
                Flow::Exit => return Ok(Flow::Next),
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            self.scan.spend_one()?;
            self.at = at;
            let next = integer(elementary, self.scan.memory.get(variable)) + by;
            self.scan.memory.set(variable, wrap(elementary, next as u64));
            if integer(elementary, self.scan.memory.get(variable)) != next {
                return Ok(Flow::Next);
            }
        }
    }

    fn repeat_while(&mut self, condition: &Code, body: &[Statement]) -> Result<Flow, Fault> {
        let at = self.at;
        while self.value(condition)? != 0 {
            match self.body(body)? {
                Flow::Exit => break,
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            self.scan.spend_one()?;
            // The position of a fault in the condition is the loop, not its last statement.
            self.at = at;
        }
        Ok(Flow::Next)
    }

    fn repeat_until(&mut self, body: &[Statement], until: &Code) -> Result<Flow, Fault> {
        let at = self.at;
        loop {
            match self.body(body)? {
                Flow::Exit => break,
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            self.scan.spend_one()?;
            self.at = at;
            if self.value(until)? != 0 {
                break;
            }
        }
        Ok(Flow::Next)
    }

    /// The value of an expression.
    pub(crate) fn value(&mut self, code: &Code) -> Result<u64, Fault> {
        self.scan.step(1)?;
        match code {
            Code::Constant(value) => Ok(*value),
            Code::Load(place) => self.slot(place).map(|slot| self.scan.memory.get(slot)),
            Code::Address(place) => self.slot(place).map(u64::from),
            Code::Unary { operator, elementary, operand } => {
                Ok(unary(*operator, *elementary, self.value(operand)?))
            }
            Code::Binary { operator, elementary, operands } => {
                let left = self.value(&operands.0)?;
                let right = self.value(&operands.1)?;
                binary(*operator, *elementary, left, right)
            }
            Code::Decide { stop_at, operands } => {
                let left = self.value(&operands.0)?;
                if (left != 0) == *stop_at { Ok(left) } else { self.value(&operands.1) }
            }
            Code::CompareText { operator, operands } => {
                self.compare_text(*operator, &operands.0, &operands.1)
            }
            Code::Convert { from, to, operand } => Ok(convert(*from, *to, self.value(operand)?)),
            Code::Call(call) => self.call_function(call),
            Code::Native(call) => self.call_native(call),
        }
    }

    fn compare_text(&mut self, operator: Binary, left: &Code, right: &Code) -> Result<u64, Fault> {
        let (left, right) = (self.value(left)?, self.value(right)?);
        let (left, right) = (slot_of(left), slot_of(right));
        self.scan
            .step((self.scan.memory.text_length(left) + self.scan.memory.text_length(right)) as u64 / 4)?;
        Ok(self.order_of_texts(operator, left, right).into())
    }

    // Its texts are large: they must not be in the stack frames of the surrounding evaluation.
    #[inline(never)]
    fn order_of_texts(&self, operator: Binary, left: Slot, right: Slot) -> bool {
        compare(operator, Some(self.scan.memory.text(left).cmp(&self.scan.memory.text(right))))
    }

    /// All inputs are evaluated before the first is stored: one of them may call the same function.
    fn call_function(&mut self, call: &FunctionCall) -> Result<u64, Fault> {
        let at = self.at;
        let mut values = ArrayVec::<u64, ARGUMENTS_MAX>::new();
        for (_, code, _) in &call.inputs {
            values.push(self.value(code)?);
        }
        self.freshen(call.unit)?;
        for ((slot, _, put), value) in call.inputs.iter().zip(values) {
            self.put(*slot, value, *put)?;
        }
        self.scan.spend_one()?;
        let units = self.units;
        self.body(&units[call.unit as usize].body)?;
        self.at = at;
        let result = self.result(call.result)?;
        for copy in &call.kept {
            self.copy(*copy)?;
        }
        let mut values = ArrayVec::<u64, ARGUMENTS_MAX>::new();
        for output in &call.outputs {
            values.push(self.value(&output.value)?);
        }
        // An index of an output's target may call the same function again: its elementary values have been read by
        // now, and all others copied.
        for (output, value) in call.outputs.iter().zip(values) {
            let to = self.slot(&output.to)?;
            self.put(to, value, output.put)?;
        }
        Ok(result)
    }

    fn result(&mut self, result: FunctionResult) -> Result<u64, Fault> {
        Ok(match result {
            FunctionResult::None => 0,
            FunctionResult::Value(slot) => self.scan.memory.get(slot),
            FunctionResult::Copied(copy) => {
                self.copy(copy)?;
                copy.to.into()
            }
        })
    }

    fn copy(&mut self, SlotCopy { from, to, slots }: SlotCopy) -> Result<(), Fault> {
        self.scan.step(STEPS_FOR_SLOT * u64::from(slots))?;
        self.scan.memory.copy(from, to, slots);
        Ok(())
    }

    fn call_native(&mut self, call: &NativeCall) -> Result<u64, Fault> {
        let mut arguments = ArrayVec::<u64, ARGUMENTS_MAX>::new();
        let mut ulints = 0;
        for argument in &call.arguments {
            match argument {
                NativeArgument::Value(code) => arguments.push(self.value(code)?),
                NativeArgument::Ulint(code) => {
                    ulints |= 1 << arguments.len();
                    arguments.push(self.value(code)?);
                }
                NativeArgument::Reference(place) => arguments.push(self.slot(place)?.into()),
                NativeArgument::Elements { place, element_slots, in_array } => {
                    let (slot, behind) = self.elements(place)?;
                    let elements = if *in_array { behind } else { 1 };
                    arguments.extend([slot.into(), elements.into(), (*element_slots).into()]);
                }
                NativeArgument::Any(place) => {
                    let slot = self.slot(place)?;
                    arguments.extend([self.scan.memory.get(slot), self.scan.memory.get(slot + 1)]);
                }
            }
        }
        let (elementary, text) = (call.elementary, call.text);
        (call.native.0.run)(&mut Call {
            scan: &mut self.scan,
            arguments: &arguments,
            elementary,
            ulints,
            text,
        })
    }

    fn call_block(&mut self, call: &BlockCall) -> Result<(), Fault> {
        let (caller, at) = (self.instance, self.at);
        let instance = self.slot(&call.instance)?;
        let mut values = ArrayVec::<u64, ARGUMENTS_MAX>::new();
        for (_, code, _) in &call.inputs {
            values.push(self.value(code)?);
        }
        for ((offset, _, put), value) in call.inputs.iter().zip(values) {
            self.put(instance + offset, value, *put)?;
        }
        self.instance = instance;
        let ran = self.run(call.unit);
        self.instance = caller;
        if ran.is_ok() || self.units[call.unit as usize].is_library {
            self.at = at;
        }
        ran?;
        for copy in &call.kept {
            self.copy(SlotCopy { from: instance + copy.from, ..*copy })?;
        }
        for output in &call.outputs {
            let value = self.block_output(output.kept.unwrap_or(instance + output.offset), output);
            let to = self.slot(&output.to)?;
            self.put(to, value, output.put)?;
        }
        Ok(())
    }

    fn block_output(&self, slot: Slot, output: &BlockOutput) -> u64 {
        if output.put != Put::Value {
            return slot.into();
        }
        let value = self.scan.memory.get(slot);
        let value = output.convert.map_or(value, |(from, to)| convert(from, to, value));
        if output.negated { unary(crate::operators::Unary::Not, Elementary::Bool, value) } else { value }
    }
}
