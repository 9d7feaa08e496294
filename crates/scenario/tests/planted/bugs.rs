//! The planted bugs.

use device::{Action, Check, Start};
use time::{Duration, Instant};
use unit_model::EventCode;
use wire::{AlStatusCode, SdoAbort};

use crate::spoiled::{Bug, SpoiledModel};

/// A bug, and the search that finds it.
pub(crate) struct Planted {
    pub(crate) name: &'static str,
    /// The file in `scenarios/search`.
    pub(crate) file: &'static str,
    pub(crate) model: SpoiledModel,
}

macro_rules! planted {
    ($($test:ident $bug:ident $name:literal $file:literal,)*) => {
        $(#[test]
        fn $test() {
            static PLANTED: Planted = Planted {
                name: $name,
                file: $file,
                model: SpoiledModel { make: || Box::<$bug>::default() },
            };
            crate::is_found(&PLANTED);
        })*
    };
}

planted! {
    counter_not_reset CounterNotReset "counter of messages not reset by a clear" "diagnosis",
    record_kept RecordKept "record kept after a clear" "diagnosis",
    log_overflow LogOverflow "log overflow" "diagnosis",
    emergency_twice EmergencyTwice "emergency sent twice" "diagnosis",
    two_causes TwoCauses "two causes, of which the end of one ends both" "two-causes",
    torn_input TornInput "torn input after a pulled cable" "unit",
    late_fall_back LateFallBack "late fall-back from the second time on" "unit",
    alias_lost AliasLost "alias lost by a restart" "unit",
    held_outputs HeldOutputs "outputs held for one refresh too long" "unit",
    wrong_part WrongPart "wrong part of a mismatch" "mapping",
    wrong_value_read WrongValueRead "wrong value read after three downloads" "messages",
    brown_out BrownOut "brown-out during the start" "start-up",
}

/// 10F3:01 never gets smaller.
#[derive(Debug, Default)]
struct CounterNotReset(u8);

impl Bug for CounterNotReset {
    fn restarts(&mut self, _: Instant, _: Start) {
        self.0 = 0;
    }
    fn read(&mut self, entry: (u16, u8), value: &mut [u8], _: u8) {
        if entry == (0x10F3, 1) {
            self.0 = self.0.max(value[0]);
            value[0] = self.0;
        }
    }
}

/// The first message is still there when the history is empty.
#[derive(Debug, Default)]
struct RecordKept(Vec<u8>);

impl Bug for RecordKept {
    fn read(&mut self, entry: (u16, u8), value: &mut [u8], count: u8) {
        if entry != (0x10F3, 6) {
            return;
        }
        if count > 0 {
            self.0 = value.to_vec();
        } else if self.0.len() == value.len() {
            value.copy_from_slice(&self.0);
        }
    }
}

/// There is no place for the 33rd event.
#[derive(Debug, Default)]
struct LogOverflow {
    slots: [u32; 32],
    next: usize,
}

impl Bug for LogOverflow {
    fn event(&mut self, event: EventCode) -> EventCode {
        self.slots[self.next] = event.0;
        self.next += 1;
        event
    }
}

/// An emergency with the code of the one before it is sent twice.
#[derive(Debug, Default)]
struct EmergencyTwice {
    before: Option<u16>,
    again: Option<Action>,
}

impl Bug for EmergencyTwice {
    fn action(&mut self, action: Option<Action>) -> Option<Action> {
        if let Some(Action::Emergency(emergency)) = action
            && self.before.replace(emergency.code) == Some(emergency.code)
        {
            self.again = action;
        }
        action.or_else(|| self.again.take())
    }
}

/// When a fault is repaired, errors of other causes go too.
#[derive(Debug, Default)]
struct TwoCauses(bool);

impl Bug for TwoCauses {
    fn restarts(&mut self, _: Instant, _: Start) {
        self.0 = false;
    }
    fn fault(&mut self, _: &str, is_present: bool) {
        self.0 = !is_present;
    }
    fn hides_errors(&self) -> bool {
        self.0
    }
}

/// After the link was away, the second half of the inputs keeps its values.
#[derive(Debug, Default)]
struct TornInput {
    had_no_link: bool,
    old: Vec<u8>,
}

impl Bug for TornInput {
    fn restarts(&mut self, _: Instant, _: Start) {
        self.had_no_link = false;
    }
    fn inputs(&mut self, inputs: &mut [u8], has_link: bool) {
        self.had_no_link |= !has_link && !inputs.is_empty();
        let half = inputs.len() / 2;
        if self.had_no_link && self.old.len() == inputs.len() {
            inputs[half..].copy_from_slice(&self.old[half..]);
        } else if !inputs.is_empty() {
            self.old = inputs.to_vec();
        }
    }
}

/// Keeps outputs for a time after they have ended.
#[derive(Debug, Default)]
struct Hold {
    outputs: Vec<u8>,
    until: Option<Instant>,
}

impl Hold {
    fn outputs<'a>(
        &'a mut self,
        now: Instant,
        outputs: Option<&'a [u8]>,
        time: Duration,
    ) -> Option<&'a [u8]> {
        if let Some(outputs) = outputs {
            (self.outputs, self.until) = (outputs.to_vec(), Some(now + time));
            return Some(outputs);
        }
        let is_held = self.until.is_some_and(|until| now <= until);
        is_held.then_some(self.outputs.as_slice())
    }
}

/// The second and each further fall-back leaves the outputs valid for 300 ms.
#[derive(Debug, Default)]
struct LateFallBack {
    times: u32,
    hold: Hold,
}

impl Bug for LateFallBack {
    fn restarts(&mut self, _: Instant, _: Start) {
        self.times = 0;
    }
    fn al_error(&mut self, code: AlStatusCode) {
        self.times += u32::from(code.0 == 0x001B);
    }
    fn outputs<'a>(&'a mut self, now: Instant, outputs: Option<&'a [u8]>) -> Option<&'a [u8]> {
        let time = if self.times > 1 { Duration::from_millis(300) } else { Duration::ZERO };
        if time.is_zero() && outputs.is_none() {
            return None;
        }
        self.hold.outputs(now, outputs, Duration::from_millis(300))
    }
}

/// Outputs are used for one refresh more.
#[derive(Debug, Default)]
struct HeldOutputs(Hold);

impl Bug for HeldOutputs {
    fn outputs<'a>(&'a mut self, now: Instant, outputs: Option<&'a [u8]>) -> Option<&'a [u8]> {
        self.0.outputs(now, outputs, Duration::from_millis(2))
    }
}

/// The station alias is gone after a restart that is no power-on.
#[derive(Debug, Default)]
struct AliasLost(bool);

impl Bug for AliasLost {
    fn restarts(&mut self, _: Instant, start: Start) {
        self.0 = start == Start::Restart;
    }
    fn action(&mut self, action: Option<Action>) -> Option<Action> {
        action.map(|action| match action {
            Action::StationAlias(_) if self.0 => Action::StationAlias(0),
            action => action,
        })
    }
}

/// A mismatch M to C is recorded as one C to M.
#[derive(Debug, Default)]
struct WrongPart;

impl Bug for WrongPart {
    fn event(&mut self, event: EventCode) -> EventCode {
        if event.0 == 0x3917_0000 { EventCode(0x3916_0000) } else { event }
    }
}

/// From the third SDO download on, the product code reads as 0.
#[derive(Debug, Default)]
struct WrongValueRead(u32);

impl Bug for WrongValueRead {
    fn wrote(&mut self, _: (u16, u8), _: &[u8], result: Result<(), SdoAbort>) {
        self.0 += u32::from(result.is_ok());
    }
    fn read(&mut self, entry: (u16, u8), value: &mut [u8], _: u8) {
        if entry == (0x1018, 2) && self.0 > 2 {
            value.fill(0);
        }
    }
}

/// A unit that starts again within 200 ms refuses SAFE-OP until its next start.
#[derive(Debug, Default)]
struct BrownOut {
    before: Option<Instant>,
    refuses: bool,
}

impl Bug for BrownOut {
    fn restarts(&mut self, now: Instant, _: Start) {
        let before = self.before.replace(now);
        self.refuses = before.is_some_and(|before| now.saturating_since(before) < Duration::from_millis(200));
    }
    fn check_transition(&mut self, check: Check) -> Result<(), AlStatusCode> {
        if self.refuses && check == Check::ProcessData { Err(AlStatusCode(0x0024)) } else { Ok(()) }
    }
}
