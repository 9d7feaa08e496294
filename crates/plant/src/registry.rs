//! The models. No other file above the models names one.

use std::sync::LazyLock;

use unit_model::{ModelUnit, SlaveView, UnitFiles};

pub use nx_ect101::unit_file;
pub use nx_ect101::{ErrorLog, Fault, Indicators, Lights, LogRecord};

/// All models, in the order in which they are shown. The first one is the default.
const MODELS: &[&dyn UnitFiles] = &[&nx_ect101::MODEL, &digital::MODEL];

/// All models.
#[must_use]
pub const fn models() -> &'static [&'static dyn UnitFiles] {
    MODELS
}

/// The model that is used where none is named.
#[must_use]
pub const fn default_model() -> &'static dyn UnitFiles {
    MODELS[0]
}

/// Both logs of a unit; empty for a model without logs.
#[must_use]
pub fn error_log(unit: &dyn ModelUnit) -> &ErrorLog {
    static EMPTY: LazyLock<ErrorLog> = LazyLock::new(ErrorLog::default);
    unit.as_model::<nx_ect101::NxEct101>().map_or(&EMPTY, nx_ect101::NxEct101::error_log)
}

/// What each indicator does; dark for one that the model does not have.
#[must_use]
pub fn indicators(unit: &dyn ModelUnit, slave: &SlaveView) -> Indicators {
    let of = |name| unit.indicator(name, slave).unwrap_or_default();
    Indicators {
        run: of("RUN"),
        err: of("ERR"),
        la_in: of("L/A IN"),
        la_out: of("L/A OUT"),
        ts_green: of("TS green"),
        ts_red: of("TS red"),
    }
}
