//! The permitted changes of a frame that has passed the line.

use device::FrameFate;
use wire::{Command, FrameKind, Returned, returned_datagrams};

/// Position of the source address, and the bit that every ESC sets there.
const SOURCE_ADDRESS: usize = 6;
const PASSED: u8 = 0x02;
/// The header of Ethernet II.
const ETHERNET_BYTES: usize = 14;

/// The end from which a frame comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Master,
    /// The far end of the line, from which a frame runs back without being processed.
    Far,
}

/// Compares a frame with the frame that was sent.
pub(super) fn check(sent: &[u8], came: &[u8], end: End, fate: FrameFate, units: usize) -> Result<(), String> {
    match FrameKind::of(sent) {
        FrameKind::Datagrams(_) => {
            header(sent, came)?;
            let (sent, came) = (returned_datagrams(sent), returned_datagrams(came));
            if sent.len() != came.len() {
                return Err(format!("{} datagrams became {}", sent.len(), came.len()));
            }
            sent.iter().zip(&came).enumerate().try_for_each(|(place, (sent, came))| {
                datagram(sent, came, units).map_err(|reason| format!("datagram {place}: {reason}"))
            })
        }
        FrameKind::OtherType | FrameKind::NotEtherCat => {
            let as_sent = sent
                .iter()
                .zip(came)
                .enumerate()
                .all(|(at, (sent, came))| sent == came || at == SOURCE_ADDRESS && *came == sent | PASSED);
            if as_sent { Ok(()) } else { Err("a frame without datagrams was changed".to_owned()) }
        }
        FrameKind::Defective(defect) if came != sent => {
            Err(format!("a defective frame ({defect:?}) was changed"))
        }
        FrameKind::Defective(defect) => match (fate, end) {
            (FrameFate::Destroyed, _) | (FrameFate::CrossedOver, End::Far) => Ok(()),
            _ => Err(format!("a defective frame ({defect:?}) came back: {fate:?}")),
        },
    }
}

/// The Ethernet header is unchanged, except for the mark of the ESCs.
fn header(sent: &[u8], came: &[u8]) -> Result<(), String> {
    let heads = sent.iter().zip(came).take(ETHERNET_BYTES).enumerate();
    for (at, (sent, came)) in heads {
        if sent != came && !(at == SOURCE_ADDRESS && *came == sent | PASSED) {
            return Err(format!("byte {at} of the Ethernet header was {sent:02X} and is {came:02X}"));
        }
    }
    Ok(())
}

fn datagram(sent: &Returned, came: &Returned, units: usize) -> Result<(), String> {
    let (before, after) = (sent.header, came.header);
    let same = before.command == after.command
        && before.index == after.index
        && before.offset == after.offset
        && before.length_bytes == after.length_bytes
        && before.reserved == after.reserved
        && before.more_follow == after.more_follow;
    if !same {
        return Err(format!("the header was {before:?} and is {after:?}"));
    }
    if before.circulating && !after.circulating {
        return Err("the circulating bit is gone".to_owned());
    }
    let passed = usize::from(after.address.wrapping_sub(before.address));
    if passed > if before.command.increments_position() { units } else { 0 } {
        return Err(format!("the address went from {:04X} to {:04X}", before.address, after.address));
    }
    if before.events & !after.events != 0 {
        return Err(format!("events went from {:04X} to {:04X}", before.events, after.events));
    }
    if is_not_read(before.command) && sent.data != came.data {
        return Err(format!("the data of {:?} were changed", before.command));
    }
    let most = counter_max(before.command, units);
    let counted = usize::from(came.working_counter.wrapping_sub(sent.working_counter));
    if counted > most {
        return Err(format!(
            "{:?} counted {counted}, {most} are the most with {units} units",
            before.command
        ));
    }
    Ok(())
}

const fn is_not_read(command: Command) -> bool {
    matches!(
        command,
        Command::Nop | Command::Apwr | Command::Fpwr | Command::Bwr | Command::Lwr | Command::Other(_)
    )
}

/// The maximum that the line adds to the working counter.
const fn counter_max(command: Command, units: usize) -> usize {
    match command {
        Command::Nop | Command::Other(_) => 0,
        Command::Aprd | Command::Apwr => 1,
        Command::Aprw => 3,
        Command::Fprw | Command::Brw | Command::Lrw => 3 * units,
        _ => units,
    }
}
