//! The module `ectwin`: the functions that a program may call.

use wasmi::ValType::{I32, I64};
use wasmi::errors::LinkerError;
use wasmi::{Caller, Engine, Error, Linker, TrapCode, ValType};

use crate::host::{Host, Phase, Refusal};

/// Name of the module.
pub(crate) const MODULE: &str = "ectwin";

/// Cost of a call in addition to its instructions, in fuel: about as much as instructions that take the same time.
const CALL_FUEL: u64 = 40;
/// Cost of looking up a name.
const LOOK_UP_FUEL: u64 = 4_000;
/// Longest name that is looked up, in bytes: longer than that of any variable.
const NAME_BYTES_MAX: u32 = 512;

/// A function of the module.
pub(crate) struct Import {
    pub(crate) name: &'static str,
    /// Its parameters and results, as text.
    pub(crate) signature: &'static str,
    pub(crate) takes: &'static [ValType],
    pub(crate) gives: &'static [ValType],
}

const fn import(
    name: &'static str,
    signature: &'static str,
    takes: &'static [ValType],
    gives: &'static [ValType],
) -> Import {
    Import { name, signature, takes, gives }
}

/// All of them.
pub(crate) const IMPORTS: &[Import] = &[
    import("variable", "(name_ptr: i32, name_len: i32) -> i32", &[I32, I32], &[I32]),
    import("read", "(id: i32, element: i32) -> i64", &[I32, I32], &[I64]),
    import("write", "(id: i32, element: i32, value: i64) -> i32", &[I32, I32, I64], &[I32]),
    import("read_bytes", "(id: i32, ptr: i32, len: i32) -> i32", &[I32, I32, I32], &[I32]),
    import("write_bytes", "(id: i32, ptr: i32, len: i32) -> i32", &[I32, I32, I32], &[I32]),
    import("now_ns", "() -> i64", &[], &[I64]),
    import("report", "(ptr: i32, len: i32)", &[I32, I32], &[]),
];

/// The functions for the names.
///
/// # Errors
/// A name occurs twice.
pub(crate) fn linker(engine: &Engine) -> Result<Linker<Host>, LinkerError> {
    let mut linker = Linker::new(engine);
    linker
        .func_wrap(MODULE, "variable", variable)?
        .func_wrap(MODULE, "read", read)?
        .func_wrap(MODULE, "write", write)?
        .func_wrap(MODULE, "read_bytes", read_bytes)?
        .func_wrap(MODULE, "write_bytes", write_bytes)?
        .func_wrap(MODULE, "now_ns", |caller: Caller<'_, Host>| caller.data().now_ns())?
        .func_wrap(MODULE, "report", report)?;
    Ok(linker)
}

fn variable(mut caller: Caller<'_, Host>, start: u32, length_bytes: u32) -> Result<i32, Error> {
    charge(&mut caller, LOOK_UP_FUEL)?;
    if caller.data().phase != Phase::Start {
        return Err(Error::new("variable: a program asks for its variables in `start`"));
    }
    if length_bytes > NAME_BYTES_MAX {
        return Ok(-1);
    }
    let (octets, host) = memory(&mut caller, "variable", start, length_bytes)?;
    let found = core::str::from_utf8(octets).ok().and_then(|name| host.find(name));
    Ok(found.unwrap_or(-1))
}

fn read(mut caller: Caller<'_, Host>, id: i32, element: u32) -> Result<i64, Error> {
    charge(&mut caller, CALL_FUEL)?;
    // Each number may be a value, so no number is left to indicate that there is no value.
    let refused = |refusal: Refusal| Error::new(format!("read({id}, {element}): {refusal}"));
    caller.data().read(id, element).map_err(refused)
}

fn write(mut caller: Caller<'_, Host>, id: i32, element: u32, value: i64) -> Result<i32, Error> {
    charge(&mut caller, CALL_FUEL)?;
    Ok(number(caller.data_mut().write(id, element, value)))
}

fn read_bytes(mut caller: Caller<'_, Host>, id: i32, start: u32, length_bytes: u32) -> Result<i32, Error> {
    charge(&mut caller, CALL_FUEL)?;
    let (octets, host) = memory(&mut caller, "read_bytes", start, length_bytes)?;
    Ok(number(host.bytes(id).and_then(|value| {
        if value.len() != octets.len() {
            return Err(Refusal::WrongLength);
        }
        octets.copy_from_slice(&value);
        Ok(())
    })))
}

fn write_bytes(mut caller: Caller<'_, Host>, id: i32, start: u32, length_bytes: u32) -> Result<i32, Error> {
    charge(&mut caller, CALL_FUEL)?;
    let (octets, host) = memory(&mut caller, "write_bytes", start, length_bytes)?;
    Ok(number(host.write_bytes(id, octets)))
}

fn report(mut caller: Caller<'_, Host>, start: u32, length_bytes: u32) -> Result<(), Error> {
    charge(&mut caller, CALL_FUEL)?;
    let (octets, host) = memory(&mut caller, "report", start, length_bytes)?;
    host.report(octets);
    Ok(())
}

const fn number(result: Result<(), Refusal>) -> i32 {
    match result {
        Ok(()) => 0,
        Err(refusal) => refusal.number(),
    }
}

/// A part of the program's memory, and the host.
fn memory<'a>(
    caller: &'a mut Caller<'_, Host>,
    function: &str,
    start: u32,
    length_bytes: u32,
) -> Result<(&'a mut [u8], &'a mut Host), Error> {
    let memory = caller.data().memory;
    let memory = memory.ok_or_else(|| Error::new(format!("{function}: the module has not begun yet")))?;
    let (octets, host) = memory.data_and_store_mut(caller);
    let start = start as usize;
    let range = start..start.saturating_add(length_bytes as usize);
    let part = octets.get_mut(range).ok_or_else(|| Error::new(format!("{function}: outside of the memory")));
    part.map(|part| (part, host))
}

/// Consumes fuel for the work of the host.
fn charge(caller: &mut Caller<'_, Host>, fuel: u64) -> Result<(), Error> {
    let share = caller.get_fuel()?;
    // Fuel missing in the present share is taken from the reserve.
    let borrowed = fuel.saturating_sub(share).min(caller.data().fuel_reserve);
    caller.data_mut().fuel_reserve -= borrowed;
    let left = share + borrowed;
    caller.set_fuel(left.saturating_sub(fuel))?;
    if left < fuel { Err(TrapCode::OutOfFuel.into()) } else { Ok(()) }
}
