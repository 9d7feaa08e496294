//! The player on a stage whose time the test advances, without a world.

use plant::line::LineRefusal;
use time::{Duration, Instant};

use super::{Looks, Next, Player};
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, Step, UnitOrder};
use crate::run::check::Seen;
use crate::run::master::OrderNumber;
use crate::run::observed::Observed;
use crate::run::scenario::{PlayedStep, WrittenStep};
use crate::run::stage::Stage;

/// A stage on which the master is idle when the test wants it to be.
#[derive(Default)]
struct Desk {
    now: Instant,
    is_idle: bool,
    story: Vec<String>,
}

impl Stage for Desk {
    fn now(&self) -> Instant {
        self.now
    }

    fn has_passed(&self, time: Instant) -> bool {
        self.now >= time
    }

    fn check(&mut self, condition: &Condition, _: &mut Observed) -> Result<(), Seen> {
        assert_eq!(*condition, Condition::MasterIdle);
        if self.is_idle { Ok(()) } else { Err("busy".to_owned().into()) }
    }

    fn master_order(&mut self, _: &MasterOrder) {
        self.is_idle = false;
    }

    fn unit_order(&mut self, _: &UnitOrder) {}

    fn cpu_order(&mut self, _: &CpuOrder) {}

    fn line_order(&mut self, _: &LineOrder) -> Result<(), LineRefusal> {
        Ok(())
    }

    fn unfinished(&self) -> Option<String> {
        None
    }

    fn is_unsettled(&mut self) -> bool {
        false
    }

    fn frames_to_come(&mut self) -> u64 {
        0
    }

    fn shows_until(&mut self) -> Instant {
        self.now()
    }

    fn mark(&mut self) {}

    fn last_order(&self) -> Option<OrderNumber> {
        None
    }

    fn last_fault(&self) -> Option<u32> {
        None
    }

    fn note_step(&mut self, words: &str) {
        self.story.push(format!("{} {words}", self.now.as_nanos() / 1_000_000));
    }
}

/// The steps of a file.
fn steps(text: &str) -> Vec<PlayedStep> {
    #[derive(serde::Deserialize)]
    struct File {
        steps: Vec<Step>,
    }
    let File { steps } = toml::from_str(text).unwrap_or_else(|error| panic!("{error}"));
    let written = |(at, step): (usize, Step)| {
        PlayedStep::Step(WrittenStep { step, line: at + 1, text: format!("step {}", at + 1) })
    };
    steps.into_iter().enumerate().map(written).collect()
}

/// The time until which the player waits, in milliseconds; none at the end.
fn waits(player: &mut Player<'_>, desk: &mut Desk) -> Option<u64> {
    match player.advance(desk) {
        Ok(Next::Wait { until, .. }) => Some(until.as_nanos() / 1_000_000),
        Ok(Next::End) => None,
        Err(failure) => panic!("{failure}"),
    }
}

#[test]
fn the_player_takes_what_is_due_and_returns_until_when_it_waits() {
    let steps = steps(
        r#"steps = [
            { master = { behave = {} } },
            { when = { master_idle = {} }, line = { be_quiet = {} } },
            { after = "20ms", line = { be_quiet = {} }, repeat = 2, every = "5ms" },
            { expect = { master_idle = {} }, within = "7ms" },
        ]"#,
    );
    let mut desk = Desk::default();
    let limit = Duration::from_secs(1);
    let mut player = Player::new(&steps, 1, Instant::ZERO + limit);
    let mut at = |ms, is_idle| {
        (desk.now, desk.is_idle) = (Instant::ZERO + Duration::from_millis(ms), is_idle);
        waits(&mut player, &mut desk)
    };
    assert_eq!(at(0, true), Some(1_000), "the order makes the master busy");
    assert_eq!(at(3, false), Some(1_000), "an event without effect");
    assert_eq!(at(4, true), Some(24));
    assert_eq!(at(24, true), Some(29));
    assert_eq!(at(29, false), Some(36));
    assert_eq!(at(35, true), None);
    assert_eq!(desk.story, ["0 step 1", "4 step 2", "24 step 3", "29 step 3"]);
}

#[test]
fn only_what_waits_for_the_time_alone_is_not_called_after_each_event() {
    let steps = steps(
        r#"steps = [
            { after = "5ms", line = { be_quiet = {} } },
            { when = { master_idle = {} }, line = { be_quiet = {} } },
            { expect = { master_idle = {} }, while = { master_idle = {} } },
            { after = "5ms", line = { be_quiet = {} } },
        ]"#,
    );
    let mut desk = Desk::default();
    let mut player = Player::new(&steps, 1, Instant::ZERO + Duration::from_secs(1));
    let mut at = |ms, is_idle| {
        (desk.now, desk.is_idle) = (Instant::ZERO + Duration::from_millis(ms), is_idle);
        match player.advance(&mut desk) {
            Ok(Next::Wait { looks, .. }) => looks,
            Ok(Next::End) => panic!("the end"),
            Err(failure) => panic!("{failure}"),
        }
    };
    assert_eq!(at(0, false), Looks::AtItsTime, "the first step waits for its time");
    assert_eq!(at(5, false), Looks::EachEvent, "the second one for a condition");
    assert_eq!(at(6, true), Looks::EachEvent, "the last one for its time, but an expectation is open");
}
