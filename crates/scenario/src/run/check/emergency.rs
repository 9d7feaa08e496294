//! Conditions of emergencies: those that the master has received, and those that a unit has lost.

use user_file::times as times_words;
use wire::Emergency;

use super::master::scripted;
use super::seen::{Seen, holds, is_often_enough};
use super::unit::has_power;
use crate::model::{Bytes, Hex, WhichUnit, hex};
use crate::run::bench::Bench;
use crate::run::master::Received;

/// What an emergency has to be; what is left out is not compared.
pub(super) struct Wanted<'a> {
    pub(super) code: u16,
    pub(super) unit: Option<&'a WhichUnit>,
    pub(super) register: Option<Hex<u8>>,
    pub(super) data: Option<&'a Bytes>,
}

impl Wanted<'_> {
    fn is_met_by(&self, Received { unit, emergency }: &Received) -> bool {
        let Emergency { code, error_register, manufacturer } = emergency;
        self.code == *code
            && self.unit.is_none_or(|wanted| wanted.position() == *unit)
            && self.register.is_none_or(|register| register.0 == *error_register)
            && self.data.is_none_or(|data| data.0 == *manufacturer)
    }

    /// Whether it says more than a code.
    const fn is_of_a_unit(&self) -> bool {
        self.unit.is_some() || self.register.is_some() || self.data.is_some()
    }
}

pub(super) fn received(world: &Bench<'_>, wanted: &Wanted<'_>, times: Option<u64>) -> Result<(), Seen> {
    let received = scripted(world)?.emergencies();
    let seen = received.iter().filter(|received| wanted.is_met_by(received)).count() as u64;
    holds(is_often_enough(seen, times), || {
        let all: Vec<String> = received.iter().map(|one| words(one, wanted.is_of_a_unit())).collect();
        format!("it came {}; all that came: [{}]", times_words(seen), all.join(", "))
    })
}

fn words(Received { unit, emergency }: &Received, is_long: bool) -> String {
    let Emergency { code, error_register, manufacturer } = emergency;
    if is_long {
        let data = hex(manufacturer);
        format!("{code:04X} from unit {} with register {error_register:#04X} and data {data}", unit + 1)
    } else {
        format!("{code:04X}")
    }
}

pub(super) fn lost(world: &mut Bench<'_>, at: usize, times: u64) -> Result<(), Seen> {
    has_power(world, at)?;
    let seen = world.emergencies_lost(at);
    holds(seen == times, || format!("unit {} has lost {seen}", at + 1))
}
