//! User-defined errors and information.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{EVERY, optional, pin, row};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::host::Alarm;

const EVENT: &[Pin] = &[
    pin("Code", Takes::Fixed(Elementary::Uint)),
    optional("Info1", Takes::Any(EVERY), 0),
    optional("Info2", Takes::Any(EVERY), 0),
];
const DONE: ResultType = ResultType::Fixed(Elementary::Bool);

/// The last code of an error; the codes after it are information.
const LAST_ERROR: i64 = 40_000;
const LAST_INFORMATION: i64 = 60_000;

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("SetAlarm", EVENT, DONE, "raises a user-defined error with a Code of 1 to 40000 and two values of any type; returns TRUE",
        |call| raise(call, 1, LAST_ERROR)),
    row("SetInfo", EVENT, DONE, "raises user-defined information with a Code of 40001 to 60000 and two values of any type; returns TRUE",
        |call| raise(call, LAST_ERROR + 1, LAST_INFORMATION)),
    row("ResetAlarm", &[optional("Code", Takes::Fixed(Elementary::Uint), 0)], DONE,
        "resets the user-defined error with this Code; 0 resets all of them; returns TRUE",
        |call| { let code = call.number(0, 0, LAST_ERROR)? as u16; call.scan.host.reset_alarm(code); Ok(1) }),
];

fn raise(call: &mut Call<'_, '_>, lower: i64, upper: i64) -> Result<u64, Fault> {
    // Both limits are those of a UINT.
    let code = call.number(0, lower, upper)? as u16;
    let (info_1, info_2) = (call.bits(1), call.bits(2));
    call.scan.host.set_alarm(Alarm { code, info_1, info_2 });
    Ok(1)
}
