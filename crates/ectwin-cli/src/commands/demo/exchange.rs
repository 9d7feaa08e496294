//! The cyclic part of the demo: values are sent, and checked when they return.

use std::fmt;
use std::ops::RangeInclusive;
use std::time::Duration;

use ethercrab::MainDevice;
use ethercrab::subdevice_group::{HasPdi, Op, PreOp, SafeOp};
use tokio::time::MissedTickBehavior;

use super::group::Group;
use super::step::{failed, master_failed};
use super::story::Story;
use crate::failure::Failure;

const CYCLE: Duration = Duration::from_millis(1);
const CYCLES: u16 = 3000;
/// More than the time-out in the ESI.
const OP_PATIENCE_CYCLES: u16 = 10_000;
const CYCLES_BETWEEN_LINES: u16 = 500;
/// By then the first values must have returned; according to the manual they take 7 ms.
const PATIENCE_CYCLES: u16 = 1000;
/// One unit that processes an LRW: 1 for the inputs, 2 for the outputs.
const WORKING_COUNTER: u16 = 3;

const TX_PDO_ASSIGNMENT: u16 = 0x1C13;
/// TxPDO with the UINT arrays of the CPU Unit.
const UINTS_TX_PDO: u16 = 0x1A01;

/// The result of the exchange.
pub(super) struct Exchanged {
    cycles: u16,
    /// Number of cycles until a value returned.
    delays: Option<RangeInclusive<u16>>,
}

impl fmt::Display for Exchanged {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} cycles, working counter {WORKING_COUNTER} in each of them", self.cycles)?;
        if let Some(delays) = &self.delays {
            write!(formatter, "; values came back after {} to {} cycles", delays.start(), delays.end())?;
        }
        Ok(())
    }
}

/// Byte of the inputs at which the UINT arrays begin, calculated like in a master: from the assignment and the
/// mappings before it.
pub(super) async fn position_of_data(
    master: &MainDevice<'static>,
    group: &Group<PreOp>,
) -> Result<usize, Failure> {
    let unit = group.subdevice(master, 0).map_err(master_failed("finding the unit"))?;
    let assigned = unit.sdo_read_array::<u16, 16>(TX_PDO_ASSIGNMENT).await;
    let assigned = assigned.map_err(master_failed("reading the TxPDO assignment 0x1C13"))?;
    let mut bits = 0;
    for pdo in assigned.into_iter().take_while(|pdo| *pdo != UINTS_TX_PDO) {
        let entries = unit.sdo_read_array::<u32, 40>(pdo).await;
        let entries = entries.map_err(master_failed("reading a TxPDO mapping"))?;
        bits += entries.iter().map(|entry| (entry & 0xFF) as usize).sum::<usize>();
    }
    Ok(bits / 8)
}

/// Lengths of outputs and inputs in bytes.
pub(super) fn sizes<S: HasPdi>(
    master: &MainDevice<'static>,
    group: &Group<S>,
) -> Result<(usize, usize), Failure> {
    let unit = group.subdevice(master, 0).map_err(master_failed("finding the unit"))?;
    let io = unit.io_raw();
    Ok((io.outputs().len(), io.inputs().len()))
}

/// Requests OP and sends process data until the unit is in OP: it waits for outputs.
pub(super) async fn into_op(
    master: &MainDevice<'static>,
    group: Group<SafeOp>,
) -> Result<Group<Op>, Failure> {
    let group = group.request_into_op(master).await.map_err(master_failed("SAFE-OP to OP"))?;
    let mut ticks = tokio::time::interval(CYCLE);
    for _ in 0..OP_PATIENCE_CYCLES {
        ticks.tick().await;
        if group.tx_rx(master).await.map_err(master_failed("SAFE-OP to OP"))?.all_op() {
            return Ok(group);
        }
    }
    Err(failed("SAFE-OP to OP", "the unit does not come"))
}

/// Exchanges process data for [`CYCLES`].
pub(super) async fn run(
    master: &MainDevice<'static>,
    group: &Group<Op>,
    first_input: usize,
    story: &Story,
) -> Result<Exchanged, Failure> {
    let mut ticks = tokio::time::interval(CYCLE);
    ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let mut watch = Watch::default();
    for cycle in 1..=CYCLES {
        ticks.tick().await;
        write(master, group, cycle)?;
        let response = group.tx_rx(master).await.map_err(master_failed("exchanging process data"))?;
        if response.working_counter != WORKING_COUNTER {
            let found = response.working_counter;
            return Err(failed(
                "exchanging process data",
                format_args!("working counter {found} in cycle {cycle}"),
            ));
        }
        let back = read(master, group, first_input)?;
        watch.see(cycle, back).map_err(|reason| failed("comparing what came back", reason))?;
        if cycle % CYCLES_BETWEEN_LINES == 0 {
            story.more(format_args!(
                "cycle {cycle:>4}: wrote {cycle:>4} to every word, {back:>4} came back"
            ))?;
        }
    }
    Ok(Exchanged { cycles: CYCLES, delays: watch.delays })
}

/// Writes the number of the cycle to every word: an inconsistent image would contain two numbers.
fn write(master: &MainDevice<'static>, group: &Group<Op>, cycle: u16) -> Result<(), Failure> {
    let unit = group.subdevice(master, 0).map_err(master_failed("finding the unit"))?;
    for word in unit.outputs_raw_mut().chunks_exact_mut(2) {
        word.copy_from_slice(&cycle.to_le_bytes());
    }
    Ok(())
}

/// The returned number; all words must be equal.
fn read(master: &MainDevice<'static>, group: &Group<Op>, first_input: usize) -> Result<u16, Failure> {
    let unit = group.subdevice(master, 0).map_err(master_failed("finding the unit"))?;
    let io = unit.io_raw();
    let outputs_bytes = io.outputs().len();
    let data = io.inputs().get(first_input..first_input + outputs_bytes).unwrap_or_default();
    let mut words = data.chunks_exact(2).map(|word| u16::from_le_bytes([word[0], word[1]]));
    let first = words.next().ok_or_else(|| failed("reading the inputs", "they are too short"))?;
    match words.find(|word| *word != first) {
        None => Ok(first),
        Some(other) => Err(failed(
            "comparing what came back",
            format_args!("{first} and {other} in one image: it is torn"),
        )),
    }
}

/// Checks the returned numbers.
#[derive(Default)]
struct Watch {
    newest: u16,
    delays: Option<RangeInclusive<u16>>,
}

impl Watch {
    fn see(&mut self, cycle: u16, back: u16) -> Result<(), String> {
        if back < self.newest || back > cycle {
            return Err(format!("{back} after {} in cycle {cycle}", self.newest));
        }
        if back == 0 {
            let waits = cycle < PATIENCE_CYCLES;
            return if waits { Ok(()) } else { Err(format!("nothing has come back after {cycle} cycles")) };
        }
        if back > self.newest {
            let delay = cycle - back;
            let (least, most) = self.delays.clone().map_or((delay, delay), RangeInclusive::into_inner);
            self.delays = Some(least.min(delay)..=most.max(delay));
        }
        self.newest = back;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_may_come_late_but_never_out_of_order() {
        let mut watch = Watch::default();
        assert_eq!(watch.see(1, 0), Ok(()));
        assert_eq!(watch.see(6, 2), Ok(()));
        assert_eq!(watch.see(7, 2), Ok(()));
        assert_eq!(watch.see(8, 5), Ok(()));
        assert_eq!(watch.delays, Some(3..=4));
        assert!(watch.see(9, 4).is_err());
        assert!(watch.see(10, 11).is_err());
    }

    #[test]
    fn nothing_that_ever_comes_back_is_a_failure() {
        assert!(Watch::default().see(PATIENCE_CYCLES, 0).is_err());
    }
}
