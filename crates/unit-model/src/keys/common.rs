//! All keys that every model has.

use device::StartUp;
use time::Duration;
use user_file::{Located, Reader, Section, values};

use super::slave::{Shape, SlaveKeys};
use super::times;
use super::timing::{self, Timing};

/// The keys and sections of every model, in addition to `model`, `storage` and `cpu`.
pub const KEYS: [&str; 10] = [
    "name",
    "serial",
    "alias",
    "timing",
    "start_up",
    "refresh_phase",
    "outputs_before_op",
    "blank_sii",
    "times",
    "refuse",
];

/// The values of the keys of every model in a unit file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CommonKeys {
    /// Name of the unit, an IEC 61131-3 identifier of up to 127 characters.
    pub name: Option<Located<String>>,
    /// Serial number.
    pub serial: Option<Located<u32>>,
    /// Configured station alias, or the ID that is set by software: 1 to 65535.
    pub alias: Option<Located<u16>>,
    /// Exact or fast; exact if left out.
    pub timing: Located<Timing>,
    /// Start-up time, 0 s to 60 s; that of the model if left out.
    pub start_up: Option<Located<Duration>>,
    /// From the first step of the unit to its first refresh, 0 s to 2 ms.
    pub refresh_phase: Option<Located<Duration>>,
    /// Its behaviour as an EtherCAT slave.
    pub slave: SlaveKeys,
}

impl CommonKeys {
    /// Reads the keys of a model of this shape. Other keys belong to the model, which refuses unknown ones.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>, shape: Shape) -> Self {
        Self {
            name: reader.value(file, "name", values::identifier),
            serial: reader.value(file, "serial", |place, value| {
                values::integer(place, value, 0..=u32::MAX.into(), "0 to 4294967295")
            }),
            alias: reader
                .value(file, "alias", |place, value| values::integer(place, value, 1..=0xFFFF, "1 to 65535")),
            timing: reader
                .value(file, "timing", |place, value| values::choice(place, value, &timing::WORDS))
                .unwrap_or_default(),
            start_up: reader.value(file, "start_up", times::start_up),
            refresh_phase: reader.value(file, "refresh_phase", times::refresh_phase),
            slave: SlaveKeys::read(reader, file, shape),
        }
    }

    /// The start-up time in the file, or that of the model ([`Timing::start_up`]).
    #[must_use]
    pub fn start_up(&self, of_model: Duration) -> StartUp {
        self.timing.value.start_up(self.start_up.as_ref().map(|start_up| start_up.value), of_model)
    }
}
