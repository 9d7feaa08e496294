//! The line: which ESCs a frame reaches, and its fate.

mod cables;

use core::ops::Range;

use esc::{Esc, LoopState, Port};
use time::Instant;
use wire::{Defect, FrameKind, Layout, mark_source_address};

use crate::activity::{Activity, PortActivity};
use crate::datagram::Stretch;
use crate::index::Index;
use crate::positions::{Gathered, Positions};

/// The fate of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameFate {
    /// It returned to the end from which it was sent.
    Returned,
    /// It left at the other end of the line, to the master's second port.
    CrossedOver,
    /// It was destroyed, or a master's network interface would drop it for its FCS.
    Destroyed,
}

/// A line of ESCs behind a master.
#[derive(Clone, Debug)]
pub struct Segment {
    escs: Vec<Esc>,
    way: Way,
    activity: Activity,
    index: Index,
    /// ESCs that wait for the end of the frame that is passing.
    waiting: Positions,
    /// ESCs at which something took effect at the end of a frame, since [`Segment::take_touched`].
    touched: Positions,
    overlong_frames: u64,
}

/// The path of a frame that arrives from the master's end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Way {
    /// ESCs that it passes.
    reach: usize,
    /// Cables that it passes, including the one to the master.
    cables: usize,
    end: WayEnd,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WayEnd {
    Turns,
    CrossesOver,
    /// DL control keeps a loop open where there is no cable.
    Lost,
    /// Port IN of the next ESC is closed.
    Blocked,
}

impl Segment {
    /// A line of these ESCs, all cables plugged in, the far end open.
    #[must_use]
    pub fn new(mut escs: Vec<Esc>) -> Self {
        let last = escs.len().saturating_sub(1);
        for (position, esc) in escs.iter_mut().enumerate() {
            esc.set_link(Port::In, true);
            esc.set_link(Port::Out, position < last);
        }
        let mut segment = Self {
            way: Way { reach: 0, cables: 0, end: WayEnd::Lost },
            activity: Activity::new(escs.len()),
            index: Index::new(&escs),
            waiting: Positions::new(escs.len()),
            touched: Positions::new(escs.len()),
            overlong_frames: 0,
            escs,
        };
        segment.settle();
        segment
    }

    /// Number of ESCs in the line, powered or not.
    #[must_use]
    pub fn len(&self) -> usize {
        self.escs.len()
    }

    /// Whether there are no ESCs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.escs.is_empty()
    }

    /// The ESC at a position, counted from the master.
    #[must_use]
    pub fn esc(&self, position: usize) -> Option<&Esc> {
        self.escs.get(position)
    }

    /// The ESC at a position, for its application.
    #[must_use]
    pub fn esc_mut(&mut self, position: usize) -> Option<&mut Esc> {
        self.index.has_changed(position);
        self.escs.get_mut(position)
    }

    /// The ESCs at which frames have handed over data or written registers since [`Segment::take_touched`]: those
    /// whose slave may have something to do. The others are as they were.
    #[must_use]
    pub const fn touched(&self) -> &Positions {
        &self.touched
    }

    /// Moves the touched ESCs to `positions`.
    pub fn take_touched(&mut self, positions: &mut Positions) {
        positions.take_all(&mut self.touched);
    }

    /// Plugs or pulls the cable in front of the ESC at `position`; 0 is the cable to the master, the
    /// number of ESCs is the cable from the far end to the master's second port.
    pub fn set_cable(&mut self, position: usize, plugged: bool) {
        if let Some(esc) = self.esc_mut(position) {
            esc.set_link(Port::In, plugged);
        }
        if let Some(esc) = position.checked_sub(1).and_then(|before| self.esc_mut(before)) {
            esc.set_link(Port::Out, plugged);
        }
        self.settle();
    }

    /// The inputs of the L/A indicator for a port of the ESC at `position`; none beyond the line. A cable
    /// counts as active for every frame that was sent on it, including broken frames.
    #[must_use]
    pub fn port_activity(&self, position: usize, port: Port) -> Option<PortActivity> {
        let link = self.escs.get(position)?.port(port).link;
        let cable = match port {
            Port::In => position,
            Port::Out => position + 1,
        };
        Some(PortActivity { link, last_frame: self.activity.last_frame(cable, self.way.cables) })
    }

    /// Frames from the master whose EtherCAT header announced more bytes than they had. They were accepted:
    /// their datagrams were all complete.
    #[must_use]
    pub const fn overlong_frames(&self) -> u64 {
        self.overlong_frames
    }

    /// A frame arrives from the master at `now`, from its destination address on, without FCS.
    pub fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.settle();
        let way = self.way;
        let kind = FrameKind::of(frame);
        if way.reach == 0 || !matches!(kind, FrameKind::NotEtherCat) {
            self.activity.on_way(now);
        }
        if way.reach == 0 {
            if !matches!(kind, FrameKind::Defective(_)) {
                self.arrive_at_closed_port(0, Port::In);
            }
            return FrameFate::Destroyed;
        }
        let fate = match kind {
            FrameKind::Datagrams(layout) => {
                self.overlong_frames += u64::from(layout.is_overlong());
                self.pass_datagrams(0..way.reach, now, frame, &layout);
                layout.mark_passed(frame);
                FrameFate::Returned
            }
            FrameKind::OtherType => {
                mark_source_address(frame);
                FrameFate::Returned
            }
            FrameKind::NotEtherCat => self.pass_foreign(way.reach, now, frame),
            FrameKind::Defective(defect) => self.pass_defective(way.reach, defect),
        };
        match (fate, way.end) {
            (FrameFate::Returned, WayEnd::CrossesOver) => FrameFate::CrossedOver,
            (FrameFate::Returned, WayEnd::Lost) => FrameFate::Destroyed,
            (FrameFate::Returned, WayEnd::Blocked) => {
                self.arrive_at_closed_port(way.reach, Port::In);
                FrameFate::Destroyed
            }
            (fate, _) => fate,
        }
    }

    /// A frame arrives from the master's second port, at the far end. It runs back without being processed
    /// until it reaches a closed port 0; there it is marked as circulating, and destroyed if it was already
    /// marked. A closed port 1 destroys it.
    pub fn frame_at_far_end(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.settle();
        let far_cable = self.escs.len();
        if !self.escs.last().is_some_and(|esc| esc.port(Port::Out).link) {
            return FrameFate::Destroyed;
        }
        let is_closed = |esc: &Esc, port: Port| esc.port(port).loop_state == LoopState::Closed;
        let closed = self.escs.iter().rposition(|esc| is_closed(esc, Port::Out) || is_closed(esc, Port::In));
        let blocked = closed.filter(|&position| is_closed(&self.escs[position], Port::Out));
        self.activity.over(closed.map_or(0, |position| position + 1)..far_cable + 1, now);
        if let Some(position) = blocked {
            if !matches!(FrameKind::of(frame), FrameKind::Defective(_)) {
                self.arrive_at_closed_port(position, Port::Out);
            }
            return FrameFate::Destroyed;
        }
        let Some(first) = closed else { return FrameFate::CrossedOver };
        let FrameKind::Datagrams(layout) = FrameKind::of(frame) else { return FrameFate::Destroyed };
        if layout.datagrams(frame).any(|datagram| datagram.header.circulating) {
            self.escs[first].count_processing_unit_error();
            return FrameFate::Destroyed;
        }
        for mut datagram in layout.datagrams(frame) {
            datagram.header.circulating = true;
            datagram.close();
        }
        self.pass_datagrams(first..self.escs.len(), now, frame, &layout);
        layout.mark_passed(frame);
        FrameFate::Returned
    }

    /// A valid frame at a closed port: in auto-close mode the loop opens, for the next frame.
    fn arrive_at_closed_port(&mut self, position: usize, port: Port) {
        if let Some(esc) = self.esc_mut(position) {
            esc.frame_at_closed_port(port);
        }
        self.settle();
    }

    /// Datagram by datagram along the line: the ESCs share nothing but the datagram, so the result is the same
    /// as ESC by ESC.
    fn pass_datagrams(&mut self, positions: Range<usize>, now: Instant, frame: &mut [u8], layout: &Layout) {
        let first = positions.start;
        let Some(escs) = self.escs.get_mut(positions) else { return };
        let (index, waiting) = (&mut self.index, Gathered::new(&mut self.waiting));
        let mut stretch = Stretch { first, escs, index, waiting, walked: false, now };
        for mut datagram in layout.datagrams(frame) {
            stretch.pass(&mut datagram);
            datagram.close_passed();
        }
        if stretch.end_of_frame(&mut self.touched) {
            self.settle();
        }
    }

    /// A frame that is not EtherCAT: the first ESC whose forwarding rule requires it destroys the frame.
    fn pass_foreign(&mut self, reach: usize, now: Instant, frame: &mut [u8]) -> FrameFate {
        mark_source_address(frame);
        for (position, esc) in self.escs[..reach].iter_mut().enumerate() {
            if esc.destroys_foreign_frames() {
                esc.count_processing_unit_error();
                self.activity.over(0..position + 1, now);
                return FrameFate::Destroyed;
            }
        }
        self.activity.on_way(now);
        FrameFate::Returned
    }

    /// A broken frame passes all ESCs without effect, and is counted: by the first ESC as an error where it
    /// arrived, by the others as an error that was already marked.
    fn pass_defective(&mut self, reach: usize, defect: Defect) -> FrameFate {
        let (first, others) = match self.escs[..reach].split_first_mut() {
            Some((first, others)) => (first, others),
            None => return FrameFate::Destroyed,
        };
        match defect {
            Defect::TooShort | Defect::TooLong => first.count_invalid_frame(Port::In),
            Defect::Truncated | Defect::DatagramBeyondEnd => first.count_processing_unit_error(),
        }
        others.iter_mut().for_each(|esc| esc.count_forwarded_error(Port::In));
        FrameFate::Destroyed
    }

    /// Recalculates the path of frames after an ESC was reset.
    pub fn follow_changed_ports(&mut self) {
        self.settle();
    }

    /// Follows up what was done to ESCs.
    #[inline]
    fn settle(&mut self) {
        if self.index.settle(&mut self.escs) {
            self.take_new_way();
        }
    }

    fn take_new_way(&mut self) {
        let way = self.find_way();
        if way.cables != self.way.cables {
            self.activity.way_changes(self.way.cables);
        }
        self.way = way;
    }

    fn find_way(&self) -> Way {
        for (position, esc) in self.escs.iter().enumerate() {
            if esc.port(Port::In).loop_state == LoopState::Closed {
                // A closed port with a partner still receives what arrives over the cable.
                let cables = position + usize::from(esc.port(Port::In).link);
                return Way { reach: position, cables, end: WayEnd::Blocked };
            }
            let out = esc.port(Port::Out);
            let reach = position + 1;
            match (out.loop_state, out.link) {
                (LoopState::Closed, _) => return Way { reach, cables: reach, end: WayEnd::Turns },
                (LoopState::Open, false) => return Way { reach, cables: reach, end: WayEnd::Lost },
                (LoopState::Open, true) => {}
            }
        }
        let end = if self.escs.is_empty() { WayEnd::Lost } else { WayEnd::CrossesOver };
        Way { reach: self.escs.len(), cables: self.escs.len() + 1, end }
    }
}
