//! An instance of a module: its memory, its globals, its functions.

use plc::{DeviceVariables, Io};
use wasmi::{Error, Global, Instance, Store, TrapCode, TypedFunc, TypedResumableCall, Val};

use crate::error::WasmError;
use crate::host::{Host, Phase};
use crate::image::Image;

/// The global in which compilers keep the stack pointer of the stack in memory.
const STACK_POINTER: &str = "__stack_pointer";
/// Amount of fuel after which the CPU Unit is asked whether the scan must end: some milliseconds.
const SHARE_OF_FUEL: u64 = 1 << 20;

/// A program in operation.
pub(crate) struct Running {
    store: Store<Host>,
    instance: Instance,
    start: Option<TypedFunc<(), ()>>,
    scan: TypedFunc<(), ()>,
    /// If it is exported: the global and its value between scans.
    stack_pointer: Option<(Global, Val)>,
}

impl Running {
    /// Initializes a module: memory and globals have their initial contents, and its own start function has
    /// been executed.
    pub(crate) fn begin(image: &Image, variables: DeviceVariables, fuel: u64) -> Result<Self, WasmError> {
        Self::instantiate(image, variables, fuel)
            .map_err(|error| WasmError::CannotBegin { reason: error.to_string() })
    }

    fn instantiate(image: &Image, variables: DeviceVariables, fuel: u64) -> Result<Self, Error> {
        let mut store = image.store(variables);
        store.set_fuel(fuel)?;
        let instance = image.linker().instantiate_and_start(&mut store, image.module())?;
        store.data_mut().memory = instance.get_memory(&store, "memory");
        // The image has been checked: an existing export has this type.
        let start = instance.get_typed_func(&store, "start").ok();
        let scan = instance.get_typed_func(&store, "scan")?;
        let stack_pointer = instance.get_global(&store, STACK_POINTER);
        let stack_pointer = stack_pointer.filter(|global| global.ty(&store).mutability().is_mut());
        let stack_pointer = stack_pointer.map(|global| (global, global.get(&store)));
        Ok(Self { store, instance, start, scan, stack_pointer })
    }

    /// Calls `start`, if there is one.
    pub(crate) fn start(&mut self, io: &mut Io, fuel: u64) -> Result<(), Error> {
        let start = self.start;
        self.step(start, io, fuel)
    }

    /// Calls `scan`.
    pub(crate) fn scan(&mut self, io: &mut Io, fuel: u64) -> Result<(), Error> {
        self.store.data_mut().phase = Phase::Scan;
        let scan = self.scan;
        self.step(Some(scan), io, fuel)
    }

    /// The value of a global that is exported under this name.
    pub(crate) fn global(&self, name: &str) -> Option<String> {
        match self.instance.get_global(&self.store, name)?.get(&self.store) {
            Val::I32(value) => Some(value.to_string()),
            Val::I64(value) => Some(value.to_string()),
            Val::F32(value) => Some(value.to_float().to_string()),
            Val::F64(value) => Some(value.to_float().to_string()),
            _ => None,
        }
    }

    fn step(&mut self, function: Option<TypedFunc<(), ()>>, io: &mut Io, fuel: u64) -> Result<(), Error> {
        self.store.data_mut().take_in(io);
        let result = function.map_or(Ok(()), |function| self.call(function, io, fuel));
        self.store.data_mut().give_out(io);
        if result.is_err() {
            self.give_back_stack();
        }
        result
    }

    /// Calls a function with this amount of fuel, in shares. A scan that must end is ended at the end of a share.
    fn call(&mut self, function: TypedFunc<(), ()>, io: &Io, fuel: u64) -> Result<(), Error> {
        self.fill_up(fuel, 0)?;
        let mut call = function.call_resumable(&mut self.store, ())?;
        loop {
            call = match call {
                TypedResumableCall::Finished(()) => return Ok(()),
                TypedResumableCall::HostTrap(trap) => return Err(again(trap.host_error())),
                TypedResumableCall::OutOfFuel(waiting) => {
                    let left = self.store.data().fuel_reserve + self.store.get_fuel()?;
                    if io.ends_scan() || left < waiting.required_fuel() {
                        return Err(TrapCode::OutOfFuel.into());
                    }
                    self.fill_up(left, waiting.required_fuel())?;
                    waiting.resume(&mut self.store)?
                }
            }
        }
    }

    /// Assigns the next share of `fuel`, at least `required`; the rest is kept for later shares.
    fn fill_up(&mut self, fuel: u64, required: u64) -> Result<(), Error> {
        let share = SHARE_OF_FUEL.max(required).min(fuel);
        self.store.data_mut().fuel_reserve = fuel - share;
        self.store.set_fuel(share)
    }

    /// A scan that is aborted leaves its stack in use: without this, less of it would be left after every scan.
    fn give_back_stack(&mut self) {
        if let Some((global, value)) = &self.stack_pointer {
            // It is mutable, and the value is its own.
            let _ = global.set(&mut self.store, value.clone());
        }
    }
}

/// Converts an error of the host into an owned one: a suspended call only lends it.
fn again(error: &Error) -> Error {
    error.as_trap_code().map_or_else(|| Error::new(error.to_string()), Error::from)
}
