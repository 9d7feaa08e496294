//! One frame on its way: to the units, and back.

use device::{Network, Unit};
use segment::FrameFate;
use time::Instant;
use wire::FrameKind;

use super::ends::{LineEnds, Loss};
use super::kept::{Flight, Kept, Stage};
use super::met::Met;
use super::order::{Direction, FrameFault};

/// The shortest remainder of a frame that is cut: the Ethernet header.
const CUT_BYTES_MIN: usize = 14;

/// Frames pass at one time.
pub(super) struct Passing<'a, T, U, E> {
    pub(super) now: Instant,
    pub(super) kept: &'a mut Kept<T>,
    pub(super) lost_for_room: &'a mut u64,
    pub(super) units: &'a mut Network<U>,
    pub(super) ends: &'a mut E,
}

/// How the way of a frame outward ends for now.
enum Outward {
    Ends(FrameFate),
    /// It is lost on a cable.
    IsLost(Met),
    /// It waits on this cable.
    Waits(usize, Met),
}

impl<T: Copy, U: Unit, E: LineEnds<T>> Passing<'_, T, U, E> {
    /// A frame leaves its master.
    pub(super) fn begin(&mut self, mut flight: Flight<T>) {
        if flight.met.is_empty() {
            return self.pass_without_faults(flight.ticket, flight.frame);
        }
        let mut wait = None;
        for met in flight.met.iter().filter(|met| met.way.direction == Direction::Outward && met.cable() == 0)
        {
            match met.fault {
                FrameFault::Lose => {
                    return self.ends.is_lost(self.now, Direction::Outward, &flight.frame, Loss::Fault(met));
                }
                FrameFault::Delay { .. } => wait = Some(*met),
                FrameFault::Swap => wait = wait.or(Some(*met)),
                FrameFault::Cut { length_bytes } => cut(&mut flight.frame, length_bytes),
                // These take effect when the frame passes the units.
                FrameFault::LoseAnswer
                | FrameFault::Duplicate
                | FrameFault::Corrupt { .. }
                | FrameFault::LowerWorkingCounter
                | FrameFault::LowerWorkingCounterBy { .. } => {}
            }
        }
        match wait {
            Some(met) => self.wait(&met, flight),
            None => self.pass(flight),
        }
    }

    /// The whole way of a frame that meets no fault, as most.
    fn pass_without_faults(&mut self, ticket: T, mut frame: Vec<u8>) {
        self.ends.passes(self.now, &frame, &[]);
        let fate = self.units.frame(self.now, &mut frame);
        self.units.poll(self.now);
        match fate {
            FrameFate::Returned => self.ends.returns(self.now, ticket, frame, &[]),
            FrameFate::CrossedOver | FrameFate::Destroyed => {}
        }
    }

    /// A frame that has waited continues.
    pub(super) fn resume(&mut self, flight: Flight<T>) {
        match flight.stage {
            Stage::Outside => self.pass(flight),
            Stage::OnCable(cable) => self.pass_from(cable, flight),
            Stage::Answer => self.arrive(flight),
        }
    }

    fn wait(&mut self, met: &Met, flight: Flight<T>) {
        self.ends.waits(self.now, met);
        let kept = match met.delay {
            Some(delay) => self.kept.keep(self.now + delay, flight).map(drop),
            None => self.kept.keep_for_next(self.now, flight),
        };
        if let Err(flight) = kept {
            *self.lost_for_room += 1;
            let on_way = if flight.stage == Stage::Answer { Direction::Back } else { Direction::Outward };
            self.ends.is_lost(self.now, on_way, &flight.frame, Loss::NoRoom);
        }
    }

    /// A frame goes to the units, once or twice.
    fn pass(&mut self, flight: Flight<T>) {
        let twice = flight.met.iter().find(|met| met.is(FrameFault::Duplicate, Direction::Outward));
        if let Some(twice) = twice {
            let Flight { ticket, stage, .. } = flight;
            self.pass_once(Flight { ticket, frame: flight.frame.clone(), met: vec![*twice], stage });
        }
        self.pass_once(flight);
    }

    fn pass_once(&mut self, flight: Flight<T>) {
        self.ends.passes(self.now, &flight.frame, &flight.met);
        self.pass_from(0, flight);
    }

    /// A frame continues from this cable, and the units react.
    fn pass_from(&mut self, from: usize, mut flight: Flight<T>) {
        let outward = self.go_outward(from, &mut flight);
        self.units.poll(self.now);
        match outward {
            Outward::Ends(FrameFate::Returned) => self.turn_back(flight),
            Outward::Ends(FrameFate::CrossedOver | FrameFate::Destroyed) => {}
            Outward::IsLost(met) => {
                self.ends.is_lost(self.now, Direction::Outward, &flight.frame, Loss::Fault(&met));
            }
            Outward::Waits(cable, met) => self.wait(&met, Flight { stage: Stage::OnCable(cable), ..flight }),
        }
    }

    /// The way of a frame from this cable outward, up to the next fault on a cable.
    fn go_outward(&mut self, from: usize, flight: &mut Flight<T>) -> Outward {
        let (now, frame) = (self.now, &mut flight.frame);
        let next = next_on_cable(&flight.met, flight.stage, from);
        let Some(met) = next.filter(|met| self.units.reaches_cable(met.cable())) else {
            return Outward::Ends(match from {
                0 => self.units.frame(now, frame),
                _ => self.units.frame_from_cable(now, frame, from),
            });
        };
        let cable = met.cable();
        if let FrameFault::Corrupt { .. } = met.fault {
            self.units.corrupted_frame_between(now, frame, from..cable);
            return Outward::Ends(FrameFate::Destroyed);
        }
        self.units.frame_between(now, frame, from..cable);
        if met.delay.is_some() { Outward::Waits(cable, met) } else { Outward::IsLost(met) }
    }

    /// A frame turns at the end of the line.
    fn turn_back(&mut self, mut flight: Flight<T>) {
        if let Some(met) = self.lost_on_the_way_back(&flight.met) {
            return self.ends.is_lost(self.now, Direction::Back, &flight.frame, Loss::Fault(&met));
        }
        let mut wait = None;
        for met in &flight.met {
            match met.fault {
                FrameFault::LowerWorkingCounter => lower_working_counters(&mut flight.frame, met, 1),
                FrameFault::LowerWorkingCounterBy { by } => {
                    lower_working_counters(&mut flight.frame, met, by);
                }
                FrameFault::Cut { length_bytes } if met.way.direction == Direction::Back => {
                    cut(&mut flight.frame, length_bytes);
                }
                FrameFault::Delay { .. } if met.way.direction == Direction::Back => wait = Some(*met),
                FrameFault::Swap if met.way.direction == Direction::Back => wait = wait.or(Some(*met)),
                FrameFault::Lose
                | FrameFault::LoseAnswer
                | FrameFault::Delay { .. }
                | FrameFault::Duplicate
                | FrameFault::Swap
                | FrameFault::Cut { .. }
                | FrameFault::Corrupt { .. } => {}
            }
        }
        match wait {
            Some(met) => self.wait(&met, Flight { stage: Stage::Answer, ..flight }),
            None => self.arrive(flight),
        }
    }

    /// The fault by which an answer is lost. The units before a bit error count it.
    fn lost_on_the_way_back(&mut self, met: &[Met]) -> Option<Met> {
        for met in met.iter().filter(|met| self.units.reaches_cable(met.cable())) {
            let is_back = met.way.direction == Direction::Back;
            match met.fault {
                FrameFault::Corrupt { .. } if is_back => {
                    self.units.count_bit_error_on_the_way_back(met.cable());
                    return Some(*met);
                }
                FrameFault::Lose if is_back => return Some(*met),
                FrameFault::LoseAnswer => return Some(*met),
                FrameFault::Lose
                | FrameFault::Delay { .. }
                | FrameFault::Duplicate
                | FrameFault::Swap
                | FrameFault::Cut { .. }
                | FrameFault::Corrupt { .. }
                | FrameFault::LowerWorkingCounter
                | FrameFault::LowerWorkingCounterBy { .. } => {}
            }
        }
        None
    }

    /// An answer arrives at the master, once or twice.
    fn arrive(&mut self, flight: Flight<T>) {
        let Flight { ticket, frame, met, .. } = flight;
        if met.iter().any(|met| met.is(FrameFault::Duplicate, Direction::Back)) {
            self.ends.returns(self.now, ticket, frame.clone(), &met);
        }
        self.ends.returns(self.now, ticket, frame, &met);
    }
}

/// The next fault on the way outward from this cable, at which the frame may have waited. A delay comes before other
/// faults on the same cable.
fn next_on_cable(met: &[Met], stage: Stage, from: usize) -> Option<Met> {
    let is_ahead = |met: &&Met| {
        let is_on_cable = match met.fault {
            FrameFault::Corrupt { .. } => true,
            // Before the line they have taken effect already.
            FrameFault::Lose | FrameFault::Delay { .. } => met.cable() > 0,
            FrameFault::LoseAnswer
            | FrameFault::Duplicate
            | FrameFault::Swap
            | FrameFault::Cut { .. }
            | FrameFault::LowerWorkingCounter
            | FrameFault::LowerWorkingCounterBy { .. } => false,
        };
        let has_waited = met.delay.is_some() && stage == Stage::OnCable(met.cable());
        is_on_cable && met.way.direction == Direction::Outward && met.cable() >= from && !has_waited
    };
    met.iter().filter(is_ahead).min_by_key(|met| (met.cable(), met.delay.is_none())).copied()
}

fn cut(frame: &mut Vec<u8>, length_bytes: u16) {
    frame.truncate(usize::from(length_bytes).max(CUT_BYTES_MIN));
}

fn lower_working_counters(frame: &mut [u8], met: &Met, by: u16) {
    let FrameKind::Datagrams(layout) = FrameKind::of(frame) else { return };
    for (number, mut datagram) in (0..).zip(layout.datagrams(frame)) {
        if met.is_about(number) {
            datagram.working_counter = datagram.working_counter.saturating_sub(by);
            datagram.close();
        }
    }
}
