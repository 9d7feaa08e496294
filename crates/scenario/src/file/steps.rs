//! Steps: who is told what, when, and whether it can be.

use toml::Spanned;

use core::ops::Range;

use super::entries::StepEntry;
use super::error::ScenarioError;
use super::reader::Reader;
use crate::model::{Condition, Expectation, FrameFault, LineOrder, Mode, Order, Trigger};
use crate::ready::{line_of, unit_of_cpu, unit_of_master, unit_of_unit};
use crate::run::Step;
use crate::words::{self, CONDITIONS, CPU, LINE, MASTER, NoSentence, UNIT};

impl Reader<'_> {
    pub(crate) fn step(&mut self, entry: StepEntry, span: Range<usize>) -> Option<Step> {
        let trigger = self.trigger(&entry, span.clone());
        let mode = self.mode(&entry);
        let tellers = [
            entry.master.map(|text| (text, Teller::Master)),
            entry.unit.map(|text| (text, Teller::Unit)),
            entry.cpu.map(|text| (text, Teller::Cpu)),
            entry.line.map(|text| (text, Teller::Line)),
            entry.expect.map(|text| (text, Teller::Expect)),
            entry.never.map(|text| (text, Teller::Never)),
        ];
        let mut told: Vec<_> = tellers.into_iter().flatten().collect();
        if told.len() != 1 {
            let message = format!(
                "a step tells one of master, unit, cpu, line, expect or never; this one {}",
                told.len()
            );
            self.refuse(span, message, "");
            return None;
        }
        let (text, teller) = told.remove(0);
        let fits = match (&mode, teller) {
            (None, _) | (Some(_), Teller::Expect) | (Some(Mode::Until(_)), Teller::Never) => true,
            (Some(_), _) => false,
        };
        if !fits {
            self.refuse(span, "`within` and `for` belong to `expect`, `until` to `expect` and `never`", "");
            return None;
        }
        let line = self.line(span.start);
        let order = self.order(&text, teller, mode.unwrap_or(Mode::Now))?;
        Some(Step { trigger: trigger?, order, line, text: text.into_inner() })
    }

    fn trigger(&mut self, entry: &StepEntry, span: Range<usize>) -> Option<Trigger> {
        match (&entry.at, &entry.after, &entry.when) {
            (None, None, None) => Some(Trigger::AtOnce),
            (Some(at), None, None) => self.duration(at).map(Trigger::At),
            (None, Some(after), None) => self.duration(after).map(Trigger::After),
            (None, None, Some(when)) => self.condition(when).map(Trigger::When),
            _ => {
                self.refuse(span, "a step has one of at, after and when", "");
                None
            }
        }
    }

    /// What the step says of when an expectation has to hold.
    fn mode(&mut self, entry: &StepEntry) -> Option<Mode> {
        match (&entry.within, &entry.r#for, &entry.until) {
            (Some(within), None, None) => self.duration(within).map(Mode::Within),
            (None, Some(span), None) => self.duration(span).map(Mode::For),
            (None, None, Some(until)) => self.condition(until).map(Mode::Until),
            (None, None, None) => None,
            (first, second, third) => {
                let span = [first, second, third]
                    .into_iter()
                    .flatten()
                    .map(Spanned::span)
                    .next()
                    .unwrap_or_default();
                self.refuse(span, "`within`, `for` and `until` contradict each other", "");
                None
            }
        }
    }

    fn order(&mut self, text: &Spanned<String>, teller: Teller, mode: Mode) -> Option<Order> {
        let order = match teller {
            Teller::Master => self.sentence(MASTER, text).map(Order::Master),
            Teller::Unit => self.sentence(UNIT, text).map(Order::Unit),
            Teller::Cpu => self.sentence(CPU, text).map(Order::Cpu),
            Teller::Line => self.sentence(LINE, text).map(Order::Line),
            Teller::Expect | Teller::Never => {
                let condition = self.condition(text)?;
                let mode = match (teller, mode) {
                    (Teller::Never, Mode::Until(until)) => Mode::NeverUntil(until),
                    (Teller::Never, _) => Mode::Never,
                    (_, mode) => mode,
                };
                Some(Order::Expect(Expectation { condition, mode }))
            }
        }?;
        if self.is_ground_missing {
            return Some(order);
        }
        if !self.exists(&order) {
            let help = line_of(self.units.len());
            self.refuse(text.span(), "it names a unit or a cable that is not there", help);
            return None;
        }
        if let Order::Cpu(order) = &order {
            self.check_variables(order, text.span())?;
        }
        Some(order)
    }

    fn exists(&self, order: &Order) -> bool {
        let units = self.units.len();
        match order {
            Order::Master(order) => unit_of_master(order).is_none_or(|set| set.exists(units)),
            Order::Unit(order) => unit_of_unit(order).exists(units),
            Order::Cpu(order) => unit_of_cpu(order).is_none_or(|set| set.exists(units)),
            Order::Line(LineOrder::Cable { number, .. }) => *number <= units,
            Order::Line(LineOrder::Disturb(disturbance)) => match disturbance.fault {
                FrameFault::Corrupt(cable) => cable < units,
                _ => true,
            },
            Order::Line(_) | Order::Expect(_) => true,
        }
    }

    fn condition(&mut self, text: &Spanned<String>) -> Option<Condition> {
        let condition = self.sentence(CONDITIONS, text)?;
        if self.is_ground_missing {
            return Some(condition);
        }
        let units = self.units.len();
        let exists = condition.units().is_none_or(|set| set.exists(units));
        if !exists {
            self.refuse(text.span(), "it names a unit that is not there", line_of(units));
            return None;
        }
        self.resolve(condition, text.span())
    }

    fn sentence<T>(&mut self, table: &[words::Sentence<T>], text: &Spanned<String>) -> Option<T> {
        let (file, span) = (self.text, text.span());
        let read = words::try_read(table, text.get_ref());
        let refuse = |problem: words::Misfit<'_, T>| {
            self.errors.note(span.start, || {
                let NoSentence { message, help } = problem.words();
                ScenarioError::new(file, span, message, help)
            });
        };
        read.map_err(refuse).ok()
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Teller {
    Master,
    Unit,
    Cpu,
    Line,
    Expect,
    Never,
}
