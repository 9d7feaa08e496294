//! Orders of every kind by their sentences: those to the scripted master too, which say themselves who carries them out.

use super::sentence::{NEAR, NoSentence, Sentence, likenesses};
use super::spoken::{Say, Spoken};
use super::tables::{CONDITIONS, CPU, LINE, MASTER, UNIT};
use crate::model::{CpuOrder, LineOrder, MasterOrder, Order, UnitOrder};

/// Maximum number of sentences that are named as near.
const NEAREST_MAX: usize = 3;

/// The order of a sentence.
fn read(text: &str) -> Result<Order, NoSentence> {
    if let Ok(order) = UnitOrder::from_sentence(text) {
        return Ok(Order::Unit(order));
    }
    if let Ok(order) = CpuOrder::from_sentence(text) {
        return Ok(Order::Cpu(order));
    }
    if let Ok(order) = LineOrder::from_sentence(text) {
        return Ok(Order::Line(order));
    }
    MasterOrder::from_sentence(text).map(Order::Master).map_err(|_| mistake(text))
}

/// The mistake, in the words of the table that has the nearest sentence.
fn mistake(text: &str) -> NoSentence {
    let best = [best(UNIT, text), best(CPU, text), best(LINE, text), best(MASTER, text)];
    let first = best.iter().copied().fold(0.0, f64::max);
    let mistakes = [
        UnitOrder::from_sentence(text).err(),
        CpuOrder::from_sentence(text).err(),
        LineOrder::from_sentence(text).err(),
        MasterOrder::from_sentence(text).err(),
    ];
    let mut mistakes = mistakes.into_iter().zip(best);
    let nearest = mistakes.find_map(|(mistake, likeness)| mistake.filter(|_| likeness >= first));
    nearest.unwrap_or_else(|| NoSentence { message: format!("`{text}` is no order"), help: String::new() })
}

fn best<T>(table: &[Sentence<T>], text: &str) -> f64 {
    likenesses(table, text).map(|(likeness, _)| likeness).fold(0.0, f64::max)
}

/// The examples of orders to units, CPU Units and the line that are like a text, the nearest first.
pub(crate) fn nearest_orders(text: &str) -> Vec<String> {
    let all = likenesses(UNIT, text).chain(likenesses(CPU, text)).chain(likenesses(LINE, text));
    nearest(all)
}

/// The examples of conditions that are like a text, the nearest first.
pub(crate) fn nearest_conditions(text: &str) -> Vec<String> {
    nearest(likenesses(CONDITIONS, text))
}

fn nearest(examples: impl Iterator<Item = (f64, &'static str)>) -> Vec<String> {
    let mut examples: Vec<_> = examples.filter(|(likeness, _)| *likeness >= NEAR).collect();
    examples.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    examples.into_iter().take(NEAREST_MAX).map(|(_, example)| example.to_owned()).collect()
}

impl Say<Order> for &str {
    fn value(self) -> Result<Order, NoSentence> {
        read(self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

impl Say<Order> for &String {
    fn value(self) -> Result<Order, NoSentence> {
        read(self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

impl Say<Order> for String {
    fn value(self) -> Result<Order, NoSentence> {
        read(&self)
    }

    fn text(&self) -> Option<&str> {
        Some(self)
    }
}

impl Say<Self> for Order {
    fn value(self) -> Result<Self, NoSentence> {
        Ok(self)
    }
}

macro_rules! orders {
    ($($order:ident: $kind:ident;)*) => {$(
        impl Say<Order> for $order {
            fn value(self) -> Result<Order, NoSentence> {
                Ok(Order::$kind(self))
            }
        }
    )*};
}

orders! {
    MasterOrder: Master;
    UnitOrder: Unit;
    CpuOrder: Cpu;
    LineOrder: Line;
}
