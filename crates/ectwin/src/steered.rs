//! A line in real time behind the control channel.

mod faults;
mod report;
mod sentences;
mod values;

use core::ops::Range;

use control::messages::{ActiveFault, ObjectReport, Refusal, SentenceRow, UnitReport, VariableReport};
use control::{Change, Twin};
use scenario::model::CpuOrder;
use scenario::{Brought, Look, ReadyOrder, Refused};
use serde_json::Value;
use time::{Duration, Instant};
use wire::{ObjectIndex, SubIndex};

use crate::files_here::FilesHere;
use crate::runtime::Handle;

/// A line in real time, to be given to [`control::serve`].
#[derive(Debug)]
pub struct Steered {
    handle: Handle,
    link: String,
}

impl Handle {
    /// The line for clients of the control channel. `link` is shown to them.
    #[must_use]
    pub fn steered(&self, link: impl Into<String>) -> Steered {
        Steered { handle: self.clone(), link: link.into() }
    }
}

impl Twin for Steered {
    type Look = Look;

    fn now(&self) -> Instant {
        self.handle.now()
    }

    fn time_taken(&self) -> Duration {
        self.handle.lent()
    }

    fn link(&self) -> &str {
        &self.link
    }

    fn count(&self) -> usize {
        self.handle.len()
    }

    fn order(&mut self, sentence: &str) -> Result<Instant, Refusal> {
        self.carry_out(sentence).map_err(refusal)
    }

    fn look_for(&mut self, condition: &str, within: Duration) -> Result<Look, Refusal> {
        let condition = self.handle.known().condition(condition, within).map_err(refusal)?;
        self.handle.with_bench(&Brought::default(), |bench| Look::of(condition, bench)).map_err(refusal)
    }

    fn look(&mut self, looks: &mut [&mut Look]) -> (Instant, Vec<Result<(), String>>) {
        self.handle.with_bench(&Brought::default(), |bench| {
            (bench.now(), looks.iter_mut().map(|look| look.look(bench)).collect())
        })
    }

    fn report(&mut self, units: Range<usize>) -> (Instant, Vec<UnitReport>) {
        let names = self.handle.known().names().to_vec();
        self.handle.with_units(|line, cpus, now| {
            let named = units.filter_map(|position| Some((position, names.get(position)?)));
            let reports = named
                .map(|(position, name)| report::of_unit(&mut line.unit(cpus, position, now), position, name));
            (now, reports.collect())
        })
    }

    fn read(&mut self, names: &[&str]) -> (Instant, Vec<Result<VariableReport, Refusal>>) {
        let known: Vec<Result<(), Refused>> =
            names.iter().map(|name| self.handle.known().variable(name)).collect();
        let (at, found) = self.handle.with_cpus(|cpus, now| {
            (now, names.iter().map(|name| values::find(cpus, name)).collect::<Vec<_>>())
        });
        let reports = known.into_iter().zip(found).map(|(known, found)| {
            known.map_err(refusal)?;
            found
                .map(values::Found::report)
                .ok_or_else(|| Refusal::new("the CPU Unit has no such variable", ""))
        });
        (at, reports.collect())
    }

    fn change(&mut self, changes: &[(&str, Change)]) -> Result<Instant, Refusal> {
        let orders: Result<Vec<CpuOrder>, Refusal> =
            changes.iter().map(|(name, change)| order_of(name, change)).collect();
        let mut ready = Vec::new();
        for order in orders? {
            ready.push(self.handle.known().order(order, &mut FilesHere).map_err(refusal)?.order);
        }
        self.handle.carry_out_together(&ready).map_err(refusal)
    }

    fn object(&mut self, unit_and_entry: &str) -> Result<(Instant, ObjectReport), Refusal> {
        let (position, entry) = self.handle.known().object(unit_and_entry).map_err(refusal)?;
        let (index, sub) = (ObjectIndex(entry.index), SubIndex(entry.sub));
        let (now, data_type, value) = self.handle.with_bench(&Brought::default(), |bench| {
            (bench.now(), bench.object_type(position, index, sub), bench.object(position, index, sub))
        });
        match (data_type, value) {
            (Some(data_type), Ok(value)) => Ok((now, values::object(unit_and_entry, data_type, &value))),
            (_, Err(abort)) => {
                Err(Refusal::new(format!("the unit refuses to read {unit_and_entry}: {abort}"), ""))
            }
            (None, Ok(_)) => Err(Refusal::new(format!("the unit has no {unit_and_entry}"), "")),
        }
    }

    fn faults(&mut self) -> (Instant, Vec<ActiveFault>) {
        (self.now(), faults::at_work(&self.handle))
    }

    fn clear(&mut self, fault: &str) -> Result<Instant, Refusal> {
        let mut at = self.now();
        for sentence in faults::sentences_that_end(fault, &faults::at_work(&self.handle))? {
            at = self.carry_out(&sentence).map_err(refusal)?;
        }
        Ok(at)
    }

    fn sentences(&self) -> Vec<SentenceRow> {
        sentences::all()
    }
}

impl Steered {
    fn carry_out(&self, sentence: &str) -> Result<Instant, Refused> {
        let ReadyOrder { order, brought } = self.handle.known().order(sentence, &mut FilesHere)?;
        self.handle.carry_out(&order, &brought)
    }
}

fn order_of(name: &str, change: &Change) -> Result<CpuOrder, Refusal> {
    let variable = name.to_owned();
    let text = |value: &Value| values::text(name, value);
    Ok(match change {
        Change::Write(value) => CpuOrder::Write { variable, value: text(value)? },
        Change::Force(value) => CpuOrder::Force { variable, value: text(value)? },
        Change::Release => CpuOrder::Release { variable },
    })
}

fn refusal(refused: Refused) -> Refusal {
    let Refused { reason: _, message, help, nearest } = refused;
    Refusal { message, help, nearest }
}
