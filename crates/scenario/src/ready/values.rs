//! Comparisons of values: whether the value exists, and the test can be true and can be false.

use plc::VariableType;
use st::Elementary;
use wire::{ObjectIndex, SubIndex};

use super::maker::Maker;
use super::problem::Part;
use super::programs::{Lasting, Present};
use crate::model::{Amount, Bytes, Condition, Controller, Hex, Number, Quantity, Same, Test, WhichUnit};
use crate::run::{is_signed, register_bytes};

/// The values that a quantity can have.
struct Values {
    /// What it is, such as `UINT`, or `a number from 0 to 255`.
    words: String,
    numbers: Numbers,
    /// Number of its bytes; none if it has no bytes.
    size_bytes: Option<usize>,
}

/// The numbers that a value can be.
enum Numbers {
    /// It is none, such as an array or a text.
    None,
    /// TRUE or FALSE.
    Truth,
    /// It is none, but its first four bytes have bits.
    Bits,
    /// From the first one to the last one.
    Whole(i128, i128),
    Real,
    Time,
    /// Of a program that is not known.
    Unknown,
}

impl Numbers {
    fn unsigned(bits: usize) -> Self {
        if bits <= 64 { Self::Whole(0, (1 << bits) - 1) } else { Self::None }
    }

    fn signed(bits: usize) -> Self {
        if bits <= 64 { Self::Whole(-(1 << (bits - 1)), (1 << (bits - 1)) - 1) } else { Self::None }
    }
}

impl Values {
    fn unsigned(bytes: usize) -> Self {
        let numbers = Numbers::unsigned(8 * bytes);
        let words = match numbers {
            Numbers::Whole(_, most) => format!("a number from 0 to {most}"),
            _ => format!("{bytes} bytes"),
        };
        Self { words, numbers, size_bytes: Some(bytes) }
    }

    fn process_data(bytes: usize) -> Self {
        Self { words: format!("{bytes} bytes"), numbers: Numbers::Bits, size_bytes: Some(bytes) }
    }

    fn count(most: u64) -> Self {
        let numbers = Numbers::Whole(0, most.into());
        Self { words: format!("a number from 0 to {most}"), numbers, size_bytes: None }
    }
}

impl Maker<'_> {
    /// Whether a value exists, and its test can be true and can be false.
    pub(super) fn check_value(
        &mut self,
        of: &Quantity,
        test: &mut Test,
        part: Part,
        lasting: Lasting,
    ) -> Option<()> {
        let values = self.values(of, part, lasting)?;
        match test {
            Test::IsNot(text) => self.check_is_not(of, text, part, lasting),
            Test::Equals(_)
            | Test::AtLeast(_)
            | Test::AtMost(_)
            | Test::Above(_)
            | Test::Below(_)
            | Test::Between { .. } => self.check_amounts(of, &values, test, part),
            Test::BeginsWith(bytes) => self.check_first_bytes(of, &values, bytes, part),
            Test::HasBits(bits) | Test::HasNoBits(bits) => self.check_bits(of, &values, *bits, part),
            Test::Is(_) if matches!(values.numbers, Numbers::Truth) => Some(()),
            Test::Is(_) => {
                let message = format!("{} is {}, which is neither TRUE nor FALSE", said(of), values.words);
                self.refuse(part, message, "compare it as a number or by its bytes");
                None
            }
            Test::Changes => Some(()),
        }
    }

    fn values(&mut self, of: &Quantity, part: Part, lasting: Lasting) -> Option<Values> {
        match of {
            Quantity::Object { unit, entry } => {
                self.check_object_exists(unit, *entry, part)?;
                let device = self.units.get(unit.position())?.known_device();
                let found = device.objects.entry(ObjectIndex(entry.index), SubIndex(entry.sub))?;
                let bits = usize::from(found.bit_length);
                let numbers = match found.data_type.0 {
                    0x0009..=0x000B => Numbers::None,
                    0x0008 | 0x0011 => Numbers::Real,
                    _ if is_signed(found.data_type) => Numbers::signed(bits.max(1)),
                    _ => Numbers::unsigned(bits),
                };
                let words = format!("a value of {bits} bits, named {}", found.name);
                Some(Values { words, numbers, size_bytes: Some(found.size_bytes()) })
            }
            Quantity::Register { register, .. } => Some(Values::unsigned(register_bytes(register.0))),
            Quantity::OutputByte { unit, at } => self.byte(unit, "output", *at, part),
            Quantity::InputByte { unit, at } => self.byte(unit, "input", *at, part),
            Quantity::Outputs { unit } => {
                self.byte(unit, "output", 0, part)?;
                // As in the CPU Unit.
                let bytes = self.units.get(unit.position())?.file.variables().unit().m_to_c_bytes;
                Some(Values::process_data(bytes))
            }
            Quantity::Inputs { unit } => {
                self.byte(unit, "input", 0, part)?;
                let bytes = self.units.get(unit.position())?.file.section().process_data_bytes().inputs;
                Some(Values::process_data(bytes.into()))
            }
            Quantity::Variable { variable } => {
                let kind = self.type_of_variable(variable, part)?;
                Some(Values {
                    words: kind.to_string(),
                    numbers: numbers_of(kind),
                    size_bytes: Some(kind.size_bytes()),
                })
            }
            Quantity::ProgramVariable { controller, name } => {
                self.program_variable(controller, name, part, lasting)
            }
            Quantity::WorkingCounter { .. } => Some(Values::count(u16::MAX.into())),
            Quantity::Records { .. }
            | Quantity::Acts { .. }
            | Quantity::Emergencies { .. }
            | Quantity::Cycles => Some(Values::count(u64::MAX)),
            Quantity::MeanPeriod { .. } | Quantity::LongestPeriod { .. } => {
                let words = "a time such as T#1ms".to_owned();
                Some(Values { words, numbers: Numbers::Time, size_bytes: None })
            }
        }
    }

    fn byte(&mut self, unit: &WhichUnit, kind: &'static str, at: u16, part: Part) -> Option<Values> {
        let byte = Bytes::from([0]);
        let condition = match kind {
            "output" => Condition::Outputs { unit: unit.clone(), at, bytes: byte },
            _ => Condition::Inputs { unit: unit.clone(), at, bytes: byte },
        };
        self.check_process_data(&condition, part)?;
        Some(Values::unsigned(1))
    }

    fn program_variable(
        &mut self,
        controller: &Controller,
        name: &str,
        part: Part,
        lasting: Lasting,
    ) -> Option<Values> {
        let value = String::new();
        let condition =
            Condition::ProgramVariable { controller: controller.clone(), name: name.to_owned(), value };
        self.check_controller(controller, &condition, part, lasting)?;
        let initial = match controller {
            Controller::Master => self.master.as_ref()?.instance().value(name),
            Controller::Unit(unit) => match self.present_program(unit.position()) {
                Present::File(file) => file.program.instance().value(name),
                Present::Unknown => {
                    let words = "a variable".to_owned();
                    return Some(Values { words, numbers: Numbers::Unknown, size_bytes: None });
                }
                Present::None | Present::Builtin(_) => None,
            },
        };
        let Some(initial) = initial else {
            self.refuse_missing_variable(controller, name, part);
            return None;
        };
        let is_time = initial.contains('#');
        let numbers = match Number::of(&initial) {
            Some(Number::Whole(_)) if is_time && !initial.starts_with("16#") => Numbers::Time,
            Some(Number::Whole(_)) => Numbers::Whole(i64::MIN.into(), u64::MAX.into()),
            Some(Number::Real(_)) => Numbers::Real,
            None => Numbers::None,
        };
        Some(Values { words: format!("{initial} at the beginning"), numbers, size_bytes: None })
    }

    /// The text of `is not` has to be one that `is` accepts.
    fn check_is_not(&mut self, of: &Quantity, text: &mut String, part: Part, lasting: Lasting) -> Option<()> {
        match of.is(text) {
            Ok(Same::Condition(mut same)) => {
                self.condition_there(&mut same, part, lasting)?;
                if let Condition::ProgramVariable { value, .. } = same {
                    *text = value;
                }
                Some(())
            }
            Ok(Same::Number(_)) => Some(()),
            Err(problem) => {
                self.refuse(part, format!("{problem}, found `{text}`"), "as in the sentence with `is`");
                None
            }
        }
    }

    fn check_amounts(&mut self, of: &Quantity, values: &Values, test: &Test, part: Part) -> Option<()> {
        let amounts = amounts(test);
        let (least, most) = match values.numbers {
            Numbers::None | Numbers::Truth | Numbers::Bits => {
                let help = match of {
                    Quantity::Outputs { .. } | Quantity::Inputs { .. } => {
                        "name a byte of it, such as `output byte 2`"
                    }
                    _ => "name a number, such as an element of an array",
                };
                self.refuse(part, format!("{} is {}, which is no number", said(of), values.words), help);
                return None;
            }
            Numbers::Unknown => return self.check_limits(test, part),
            Numbers::Time | Numbers::Real => (Number::Real(f64::NEG_INFINITY), Number::Real(f64::INFINITY)),
            Numbers::Whole(least, most) => (Number::Whole(least), Number::Whole(most)),
        };
        let is_time = matches!(values.numbers, Numbers::Time);
        if let Some(wrong) = amounts.iter().find(|amount| amount.is_time() != is_time) {
            let help = if is_time { "a time such as T#20ms" } else { "a number such as 5" };
            self.refuse(
                part,
                format!("{} is {}, and {wrong} is not of that kind", said(of), values.words),
                help,
            );
            return None;
        }
        self.check_limits(test, part)?;
        let (first, last) = (passes(test, least), passes(test, most));
        if first && last {
            let message = format!("it always holds: {} is {}", said(of), values.words);
            self.refuse(part, message, "compare with a value within these limits");
            return None;
        }
        if !(first || last || amounts.iter().any(|amount| is_possible(test, amount.number(), least, most))) {
            let message = format!("it can never hold: {} is {}", said(of), values.words);
            self.refuse(part, message, "compare with a value within these limits");
            return None;
        }
        Some(())
    }

    /// Whether the lower limit is not above the upper one.
    fn check_limits(&mut self, test: &Test, part: Part) -> Option<()> {
        let Test::Between { from, to } = test else { return Some(()) };
        if from.number().compare(to.number()) != Some(core::cmp::Ordering::Greater) {
            return Some(());
        }
        let message =
            format!("it can never hold: no value is between {from} and {to}, as {from} is above {to}");
        self.refuse(part, message, format!("the lower limit is first: `is between {to} and {from}`"));
        None
    }

    fn check_first_bytes(&mut self, of: &Quantity, values: &Values, bytes: &Bytes, part: Part) -> Option<()> {
        let Some(size) = values.size_bytes else {
            self.refuse(part, format!("{} has no bytes", said(of)), "compare it as a number");
            return None;
        };
        if bytes.0.len() > size {
            let message = format!("{} bytes for {}, which has {size}", bytes.0.len(), said(of));
            self.refuse(part, message, "");
            return None;
        }
        Some(())
    }

    fn check_bits(&mut self, of: &Quantity, values: &Values, Hex(bits): Hex<u32>, part: Part) -> Option<()> {
        let most = match values.numbers {
            Numbers::Whole(_, most) => most.max(0),
            Numbers::Unknown => i128::from(u64::MAX),
            Numbers::Bits => i128::from(u32::MAX),
            Numbers::None | Numbers::Truth | Numbers::Real | Numbers::Time => {
                self.refuse(part, format!("{} is {}, which has no bits", said(of), values.words), "");
                return None;
            }
        };
        // The sign has a bit too.
        let all = values.size_bytes.map_or(most, |size| if size < 8 { (1 << (8 * size)) - 1 } else { most });
        if bits == 0 || i128::from(bits) > all {
            let message = match bits {
                0 => "no bit is named, so it always holds".to_owned(),
                _ => format!("{} has no bits {:#X}", said(of), i128::from(bits) & !all),
            };
            self.refuse(part, message, format!("it is {}", values.words));
            return None;
        }
        Some(())
    }
}

fn said(of: &Quantity) -> String {
    crate::words::quantity_words(of)
}

fn amounts(test: &Test) -> Vec<&Amount> {
    match test {
        Test::Equals(amount)
        | Test::AtLeast(amount)
        | Test::AtMost(amount)
        | Test::Above(amount)
        | Test::Below(amount) => vec![amount],
        Test::Between { from, to } => vec![from, to],
        Test::IsNot(_)
        | Test::BeginsWith(_)
        | Test::HasBits(_)
        | Test::HasNoBits(_)
        | Test::Is(_)
        | Test::Changes => Vec::new(),
    }
}

/// Whether a number passes a comparison.
fn passes(test: &Test, number: Number) -> bool {
    let order = |amount: &Amount| number.compare(amount.number());
    match test {
        Test::Equals(amount) => order(amount).is_some_and(core::cmp::Ordering::is_eq),
        Test::AtLeast(amount) => order(amount).is_some_and(core::cmp::Ordering::is_ge),
        Test::AtMost(amount) => order(amount).is_some_and(core::cmp::Ordering::is_le),
        Test::Above(amount) => order(amount).is_some_and(core::cmp::Ordering::is_gt),
        Test::Below(amount) => order(amount).is_some_and(core::cmp::Ordering::is_lt),
        Test::Between { from, to } => {
            order(from).is_some_and(core::cmp::Ordering::is_ge)
                && order(to).is_some_and(core::cmp::Ordering::is_le)
        }
        Test::IsNot(_)
        | Test::BeginsWith(_)
        | Test::HasBits(_)
        | Test::HasNoBits(_)
        | Test::Is(_)
        | Test::Changes => true,
    }
}

/// Whether one of the ends of a test is a number that passes it, and that the value can be.
fn is_possible(test: &Test, end: Number, least: Number, most: Number) -> bool {
    let is_within = end.compare(least).is_some_and(core::cmp::Ordering::is_ge)
        && end.compare(most).is_some_and(core::cmp::Ordering::is_le);
    is_within && passes(test, end)
}

fn numbers_of(kind: VariableType) -> Numbers {
    let bits = 8 * kind.size_bytes();
    if kind.elements.is_some() {
        return Numbers::None;
    }
    match kind.elementary {
        Elementary::Sint | Elementary::Int | Elementary::Dint | Elementary::Lint => Numbers::signed(bits),
        Elementary::Real | Elementary::Lreal => Numbers::Real,
        Elementary::Time => Numbers::Time,
        Elementary::Date | Elementary::TimeOfDay | Elementary::DateAndTime => Numbers::None,
        Elementary::Bool => Numbers::Truth,
        Elementary::Byte
        | Elementary::Word
        | Elementary::Dword
        | Elementary::Lword
        | Elementary::Usint
        | Elementary::Uint
        | Elementary::Udint
        | Elementary::Ulint => Numbers::unsigned(bits),
    }
}
