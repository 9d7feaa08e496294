//! Steps and groups of steps, one after the other, and the groups: rounds, and sequences that are played together.

use core::slice::Iter;

use time::Instant;

use super::following::following;
use super::shared::Shared;
use super::step::StepPlay;
use super::verdict::{Looks, Origin, Progress, Verdict, Waits, failure};
use super::wait::Wait;
use crate::model::{Members, Repetition, Trigger};
use crate::run::observed::Observed;
use crate::run::scenario::{PlayedStep, WrittenGroup, WrittenStep};
use crate::run::stage::Stage;

/// A list of steps that is being played.
pub(super) struct Sequence<'a> {
    /// The steps and groups that have not begun.
    rest: Iter<'a, PlayedStep>,
    current: Option<Play<'a>>,
    /// The expectations that follow at once behind the last of its steps.
    behind: Vec<&'a WrittenStep>,
}

/// A step or a group that is being played.
enum Play<'a> {
    Step(StepPlay<'a>),
    Group(GroupPlay<'a>),
}

impl<'a> Sequence<'a> {
    pub(super) fn of(steps: &'a [PlayedStep], behind: Vec<&'a WrittenStep>) -> Self {
        Self { rest: steps.iter(), current: None, behind }
    }

    /// Takes all steps that are due.
    pub(super) fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        loop {
            let play = match &mut self.current {
                Some(play) => play,
                None => match self.rest.next() {
                    Some(next) => {
                        let (origin, trigger) = begin_of(next);
                        shared.findings.begin(origin, trigger, stage.now());
                        let following = following(self.rest.as_slice(), &self.behind);
                        self.current.insert(Play::of(next, following, stage.now()))
                    }
                    None => return Ok(Progress::Done),
                },
            };
            let progress = match play {
                Play::Step(step) => step.poll(stage, shared)?,
                Play::Group(group) => group.poll(stage, shared)?,
            };
            match progress {
                Progress::Done => self.current = None,
                waits @ Progress::Waits(_) => return Ok(waits),
            }
        }
    }
}

impl<'a> Play<'a> {
    fn of(entry: &'a PlayedStep, following: Vec<&'a WrittenStep>, now: Instant) -> Self {
        match entry {
            PlayedStep::Step(step) => Self::Step(StepPlay::of(step, following, now)),
            PlayedStep::Group(group) => Self::Group(GroupPlay::of(group, following, now)),
        }
    }
}

/// Where a step or a group is written, and when it is due.
fn begin_of(entry: &PlayedStep) -> (Origin<'_>, &Trigger) {
    match entry {
        PlayedStep::Step(step) => (step.into(), &step.step.trigger),
        PlayedStep::Group(group) => (group.into(), &group.trigger),
    }
}

/// A group that is being played.
struct GroupPlay<'a> {
    group: &'a WrittenGroup,
    state: State<'a>,
    /// The expectations that follow at once.
    following: Vec<&'a WrittenStep>,
}

/// How far a group has come.
enum State<'a> {
    /// It waits for its time, with the values at the beginning of the wait.
    Due(Wait<'a>, Observed),
    /// Its only sequence is played.
    Sequence(Box<Sequence<'a>>),
    /// Its rounds are played.
    Rounds(Box<Rounds<'a>>),
    /// Its sequences are played.
    Together(Vec<Sequence<'a>>),
}

impl<'a> GroupPlay<'a> {
    fn of(group: &'a WrittenGroup, following: Vec<&'a WrittenStep>, now: Instant) -> Self {
        let state = State::Due(Wait::for_trigger(&group.trigger, now), Observed::default());
        Self { group, state, following }
    }

    fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        if let State::Due(wait, observed) = &mut self.state {
            let origin = Origin::from(self.group);
            if let Some(until) = wait.look(origin, stage, shared.limit, observed)? {
                return Ok(Progress::Waits(Waits { origin, until, looks: wait.looks() }));
            }
            let following = core::mem::take(&mut self.following);
            self.state = State::begin(self.group, following, stage, shared);
        }
        match &mut self.state {
            State::Due(..) => Ok(Progress::Done),
            State::Sequence(sequence) => sequence.poll(stage, shared),
            State::Rounds(rounds) => rounds.poll(stage, shared),
            State::Together(sequences) => poll_all(sequences, stage, shared),
        }
    }
}

impl<'a> State<'a> {
    fn begin(
        group: &'a WrittenGroup,
        following: Vec<&'a WrittenStep>,
        stage: &mut impl Stage,
        shared: &mut Shared<'a>,
    ) -> Self {
        match &group.members {
            Members::Sequence(steps) => Self::Sequence(Box::new(Sequence::of(steps, following))),
            Members::Repeat { repetition, steps } => {
                Self::Rounds(Box::new(Rounds::begin(group, *repetition, steps, following, stage, shared)))
            }
            Members::Together(sequences) => {
                let sequence = |steps: &'a Vec<PlayedStep>| Sequence::of(steps, following.clone());
                Self::Together(sequences.iter().map(sequence).collect())
            }
        }
    }
}

/// All sequences, again and again until none of them has a step that is due: a step of one can be what another waits for.
fn poll_all<'a>(
    sequences: &mut [Sequence<'a>],
    stage: &mut impl Stage,
    shared: &mut Shared<'a>,
) -> Verdict<Progress<'a>> {
    loop {
        let performed = shared.performed;
        let mut first: Option<Waits<'a>> = None;
        for sequence in &mut *sequences {
            if let Progress::Waits(waits) = sequence.poll(stage, shared)? {
                first = Some(match first {
                    Some(first) => first.and(waits),
                    None => waits,
                });
            }
        }
        match first {
            None => return Ok(Progress::Done),
            Some(waits) if shared.performed == performed => return Ok(Progress::Waits(waits)),
            Some(_) => {}
        }
    }
}

/// The rounds of a repeated group.
struct Rounds<'a> {
    group: &'a WrittenGroup,
    repetition: Repetition,
    steps: &'a [PlayedStep],
    /// The expectations that follow at once behind the last round.
    following: Vec<&'a WrittenStep>,
    begun: Instant,
    /// The number of the present round, from 1.
    number: u64,
    /// The time at which it began.
    round_begun: Instant,
    /// The present round; none: it is over.
    round: Option<Sequence<'a>>,
    /// The time of the next round.
    next: Instant,
}

impl<'a> Rounds<'a> {
    fn begin(
        group: &'a WrittenGroup,
        repetition: Repetition,
        steps: &'a [PlayedStep],
        following: Vec<&'a WrittenStep>,
        stage: &mut impl Stage,
        shared: &mut Shared<'a>,
    ) -> Self {
        let begun = stage.now();
        let mut rounds = Self {
            group,
            repetition,
            steps,
            following,
            begun,
            number: 0,
            round_begun: begun,
            round: None,
            next: begun,
        };
        rounds.next_round(stage, shared);
        rounds
    }

    fn next_round(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) {
        self.number += 1;
        self.round_begun = stage.now();
        stage.note_step(&format!("round {} of {}", self.number, self.repetition.times));
        let is_last = self.number >= self.repetition.times;
        let behind = if is_last { self.following.clone() } else { Vec::new() };
        self.round = Some(Sequence::of(self.steps, behind));
        self.next = self.begun + shared.begin_of_round(self.repetition, self.number);
    }

    fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        loop {
            let waits = match &mut self.round {
                None => None,
                Some(round) => match round.poll(stage, shared)? {
                    Progress::Done => None,
                    Progress::Waits(waits) => Some(waits),
                },
            };
            let is_last = self.number >= self.repetition.times;
            match waits {
                Some(waits) if is_last => return Ok(Progress::Waits(waits)),
                Some(waits) if stage.has_passed(self.next) => return Err(self.too_long(&waits, stage)),
                Some(waits) => {
                    return Ok(Progress::Waits(Waits { until: waits.until.min(self.next), ..waits }));
                }
                None if is_last => return Ok(Progress::Done),
                None if stage.has_passed(self.next) => self.next_round(stage, shared),
                None => {
                    self.round = None;
                    let origin = Origin::from(self.group);
                    let looks = Looks::AtItsTime;
                    return Ok(Progress::Waits(Waits { origin, until: self.next, looks }));
                }
            }
        }
    }

    fn too_long(&self, waits: &Waits<'a>, stage: &impl Stage) -> crate::run::report::Failure {
        let Self { number, repetition: Repetition { times, every, jitter }, .. } = self;
        let Origin { line, text } = waits.origin;
        let time = self.next.saturating_since(self.round_begun);
        let cause = if jitter.is_zero() {
            String::new()
        } else {
            format!(" (every {every}, earlier or later by at most {jitter})")
        };
        let words = format!(
            "round {number} of {times} has not ended after {time}, when the next one is due{cause}: line {line} `{text}` still waits"
        );
        failure(Origin::from(self.group), stage.now(), words.into())
    }
}
