//! The index finds those that a datagram means: a line with it and one without it do the same, frame by frame.

mod naive;

use esc::{Esc, EscConfig, SmIndex};
use naive::Naive;
use proptest::prelude::*;
use segment::Segment;
use time::{Duration, Instant};
use wire::{AlState, AlStatus, AlStatusCode, Command, FrameBuilder};

const OUTPUTS: u8 = 0x24;
const INPUTS: u8 = 0x20;

/// Something that happens to the line.
#[derive(Clone, Debug)]
enum Step {
    Frame(Vec<Sent>),
    /// The same, with a bit error on a cable.
    Corrupted(Vec<Sent>, usize),
    FarEnd(Vec<Sent>),
    Cable {
        number: usize,
        plugged: bool,
    },
    Application {
        position: usize,
        act: Act,
    },
}

/// A datagram.
#[derive(Clone, Debug)]
struct Sent {
    command: Command,
    address: u16,
    offset: u16,
    data: Vec<u8>,
}

/// What an application does at its ESC.
#[derive(Clone, Copy, Debug)]
enum Act {
    ShowState,
    Publish,
    Alias(u16),
    Deactivate(bool),
    Reset,
}

/// Few addresses, so that ESCs share them.
fn address() -> impl Strategy<Value = u16> {
    prop_oneof![0u16..6, (0u16..80).prop_map(u16::wrapping_neg)]
}

fn fmmu() -> impl Strategy<Value = Vec<u8>> {
    let places = (0u8..120, 0u8..12, 0u8..8, prop::sample::select(vec![0x10u8, 0x12]));
    (places, 0u8..4, prop::bool::weighted(0.9)).prop_map(|((logical, length, bit, physical), kind, on)| {
        let start_bit = if bit < 6 { 0 } else { bit };
        vec![logical, 0, 0, 0, length, 0, start_bit, 7, 0, physical, 0, kind, u8::from(on)]
    })
}

/// What masters write, and what of it changes who is meant.
fn content() -> impl Strategy<Value = (u16, Vec<u8>)> {
    let fixed = |offset: u16, data: &[u8]| Just((offset, data.to_vec()));
    prop_oneof![
        4 => (0u8..6).prop_map(|address| (0x0010, vec![address, 0])),
        2 => (0u8..6).prop_map(|address| (0x0012, vec![address, 0])),
        2 => any::<bool>().prop_map(|uses_alias| (0x0103, vec![u8::from(uses_alias)])),
        1 => prop::sample::select(vec![0u8, 0, 0, 0, 0x04, 0x05, 0x08, 0x0C]).prop_map(|loops| (0x0101, vec![loops])),
        6 => (0u16..3, fmmu()).prop_map(|(number, fmmu)| (0x0600 + 16 * number, fmmu)),
        2 => fixed(0x0800, &[0x00, 0x10, 4, 0, OUTPUTS, 0, 1, 0]),
        2 => fixed(0x0808, &[0x00, 0x12, 4, 0, INPUTS, 0, 1, 0]),
        2 => prop::sample::select(vec![0u8, 0xFF]).prop_map(|mask| (0x0200, vec![mask, mask])),
        1 => prop::sample::select(b"RES".to_vec()).prop_map(|letter| (0x0040, vec![letter])),
        1 => fixed(0x0900, &[0; 4]),
        1 => fixed(0x0910, &[7; 8]),
        1 => (0u8..2).prop_map(|on| (0x0020, vec![on])),
        1 => (0u8..2).prop_map(|on| (0x0030, vec![on])),
        3 => (prop::sample::select(vec![0x0000u16, 0x0110, 0x0120, 0x0130, 0x0210, 0x1000, 0x1200]), 1usize..12)
            .prop_map(|(offset, length_bytes)| (offset, vec![0; length_bytes])),
    ]
}

/// How a line is set up at first: an FMMU, the station address and the event mask of each ESC.
fn set_up() -> impl Strategy<Value = Vec<(Vec<u8>, u8, u8)>> {
    let mask = prop::sample::select(vec![0u8, 0, 0xFF]);
    prop::collection::vec((fmmu(), 0u8..6, mask), 70)
}

fn frames_of(set_up: &[(Vec<u8>, u8, u8)]) -> Vec<Vec<Sent>> {
    let everywhere =
        |offset: u16, data: &[u8]| Sent { command: Command::Bwr, address: 0, offset, data: data.to_vec() };
    let buffers = vec![
        everywhere(0x0800, &[0x00, 0x10, 4, 0, OUTPUTS, 0, 1, 0]),
        everywhere(0x0808, &[0x00, 0x12, 4, 0, INPUTS, 0, 1, 0]),
    ];
    let each = set_up.iter().enumerate().map(|(position, (fmmu, address, mask))| {
        let there = |offset: u16, data: &[u8]| {
            let address = (position as u16).wrapping_neg();
            Sent { command: Command::Apwr, address, offset, data: data.to_vec() }
        };
        vec![there(0x0600, fmmu), there(0x0010, &[*address, 0]), there(0x0200, &[*mask, *mask])]
    });
    core::iter::once(buffers).chain(each).collect()
}

fn datagram() -> impl Strategy<Value = Sent> {
    let physical = (prop::sample::select(PHYSICAL.to_vec()), address(), content())
        .prop_map(|(command, address, (offset, data))| Sent { command, address, offset, data });
    let logical = prop::sample::select(vec![Command::Lrd, Command::Lwr, Command::Lrw]);
    let logical = (logical, 0u16..130, prop::collection::vec(any::<u8>(), 0..16))
        .prop_map(|(command, address, data)| Sent { command, address, offset: 0, data });
    prop_oneof![3 => physical, 2 => logical]
}

/// Commands that mean one ESC are more frequent.
const PHYSICAL: [Command; 16] = [
    Command::Nop,
    Command::Aprd,
    Command::Apwr,
    Command::Apwr,
    Command::Apwr,
    Command::Aprw,
    Command::Fprd,
    Command::Fprd,
    Command::Fpwr,
    Command::Fpwr,
    Command::Fprw,
    Command::Brd,
    Command::Bwr,
    Command::Brw,
    Command::Armw,
    Command::Frmw,
];

fn step() -> impl Strategy<Value = Step> {
    let frame = || prop::collection::vec(datagram(), 1..5);
    let act = prop_oneof![
        4 => Just(Act::ShowState),
        4 => Just(Act::Publish),
        2 => (0u16..6).prop_map(Act::Alias),
        2 => any::<bool>().prop_map(Act::Deactivate),
        1 => Just(Act::Reset),
    ];
    prop_oneof![
        40 => frame().prop_map(Step::Frame),
        1 => (frame(), 0usize..80).prop_map(|(frame, cable)| Step::Corrupted(frame, cable)),
        2 => frame().prop_map(Step::FarEnd),
        1 => (0usize..80, any::<bool>()).prop_map(|(number, plugged)| Step::Cable { number, plugged }),
        12 => (0usize..80, act).prop_map(|(position, act)| Step::Application { position, act }),
    ]
}

fn bytes_of(frame: &[Sent]) -> Vec<u8> {
    let add = |builder: FrameBuilder, sent: &Sent| {
        if matches!(sent.command, Command::Lrd | Command::Lwr | Command::Lrw) {
            builder.logical(sent.command, u32::from(sent.address), &sent.data)
        } else {
            builder.physical(sent.command, sent.address, sent.offset, &sent.data)
        }
    };
    frame.iter().fold(FrameBuilder::new(), add).finish()
}

impl Act {
    fn on(self, esc: &mut Esc, now: Instant) {
        let mut pdi = esc.pdi();
        match self {
            Self::ShowState => {
                let status = AlStatus { state: AlState::PreOp, ..AlStatus::default() };
                pdi.set_al_status(status, AlStatusCode::default());
            }
            Self::Publish => drop(pdi.write_buffer(SmIndex(1), &[9; 4])),
            Self::Alias(alias) => pdi.set_station_alias(alias),
            Self::Deactivate(deactivated) => pdi.set_deactivated(SmIndex(0), deactivated),
            Self::Reset => esc.reset(now),
        }
    }
}

fn escs(count: usize) -> Vec<Esc> {
    (0..count).map(|_| Esc::power_on(EscConfig::default(), Vec::new(), Instant::ZERO)).collect()
}

/// What the wire would read anywhere.
fn registers(esc: Option<&Esc>, now: Instant) -> Vec<u8> {
    let mut bytes = vec![0; 0x1300];
    if let Some(esc) = esc {
        esc.look(0, &mut bytes, now);
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]
    #[test]
    fn a_line_with_an_index_does_what_a_walk_does(
        count in prop::sample::select(vec![1usize, 3, 9, 30, 70]),
        set_up in set_up(),
        steps in prop::collection::vec(step(), 1..60),
    ) {
        let steps: Vec<Step> = frames_of(&set_up[..count]).into_iter().map(Step::Frame).chain(steps).collect();
        let (mut segment, mut naive) = (Segment::new(escs(count)), Naive::new(escs(count)));
        for (number, step) in (1u64..).zip(&steps) {
            let now = Instant::ZERO + Duration::from_micros(10 * number);
            match step {
                Step::Frame(frame) => {
                    let mut frames = [bytes_of(frame), bytes_of(frame)];
                    segment.frame(now, &mut frames[0]);
                    naive.frame(now, &mut frames[1], None);
                    prop_assert_eq!(&frames[0][12..], &frames[1][12..], "{:?}", step);
                }
                Step::Corrupted(frame, cable) => {
                    let mut frames = [bytes_of(frame), bytes_of(frame)];
                    segment.corrupted_frame(now, &mut frames[0], *cable);
                    naive.frame(now, &mut frames[1], Some(*cable));
                    prop_assert_eq!(&frames[0][12..], &frames[1][12..], "{:?}", step);
                }
                Step::FarEnd(frame) => {
                    let mut frames = [bytes_of(frame), bytes_of(frame)];
                    segment.frame_at_far_end(now, &mut frames[0]);
                    naive.frame_at_far_end(now, &mut frames[1]);
                    let datagrams = |frame: &[u8]| {
                        let mut returned = wire::returned_datagrams(frame);
                        returned.iter_mut().for_each(|datagram| datagram.header.circulating = false);
                        returned
                    };
                    prop_assert_eq!(datagrams(&frames[0]), datagrams(&frames[1]), "{:?}", step);
                }
                Step::Cable { number, plugged } => {
                    segment.set_cable(*number % (count + 1), *plugged);
                    naive.set_cable(*number % (count + 1), *plugged);
                }
                Step::Application { position, act } => {
                    if let Some(esc) = segment.esc_mut(position % count) {
                        act.on(esc, now);
                    }
                    act.on(&mut naive.escs[position % count], now);
                    segment.follow_changed_ports();
                }
            }
        }
        prop_assert!(segment.touched().iter().eq(naive.touched));
        let now = Instant::ZERO + Duration::from_millis(1);
        for position in 0..count {
            let (one, other) = (segment.esc(position), naive.escs.get(position));
            prop_assert!(registers(one, now) == registers(other, now), "ESC {}", position);
        }
    }
}
