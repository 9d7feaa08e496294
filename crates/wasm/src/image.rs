//! A module that has been read and checked: the source of instances.

use plc::DeviceVariables;
use wasmi::{Config, Engine, ExternType, FuncType, Linker, Module, Store, StoreLimitsBuilder, ValType};

use crate::error::WasmError;
use crate::host::Host;
use crate::imports::{self, IMPORTS};

/// Largest module in bytes.
pub const MODULE_BYTES_MAX: usize = 4 << 20;
/// Maximum memory of a program, in bytes; `memory.grow` beyond it returns -1.
pub const MEMORY_BYTES_MAX: usize = 16 << 20;
/// Maximum number of elements of a table.
pub const TABLE_ELEMENTS_MAX: usize = 10_000;
/// Maximum depth of nested calls.
pub const RECURSION_MAX: usize = 1_000;

/// Maximum number of tables of a module.
const TABLES_MAX: usize = 4;
const PAGE_BYTES: u64 = 1 << 16;
const FUNCTION: &str = "a function without parameters and results";
const MEMORY: &str = "a memory";

/// A module that can be initialized repeatedly.
pub(crate) struct Image {
    engine: Engine,
    module: Module,
    linker: Linker<Host>,
}

impl Image {
    /// Reads and checks a module in binary form.
    pub(crate) fn read(octets: &[u8]) -> Result<Self, WasmError> {
        let (size_bytes, limit_bytes) = (octets.len(), MODULE_BYTES_MAX);
        if size_bytes > limit_bytes {
            return Err(WasmError::TooLarge { size_bytes, limit_bytes });
        }
        let engine = Engine::new(&config());
        let not_a_module =
            |error: &dyn core::fmt::Display| WasmError::NotAModule { reason: error.to_string() };
        let module = Module::new(&engine, octets).map_err(|error| not_a_module(&error))?;
        let linker = imports::linker(&engine).map_err(|error| not_a_module(&error))?;
        let image = Self { engine, module, linker };
        image.check_imports()?;
        image.check_exports()?;
        Ok(image)
    }

    pub(crate) const fn module(&self) -> &Module {
        &self.module
    }

    pub(crate) const fn linker(&self) -> &Linker<Host> {
        &self.linker
    }

    /// A store for one instance, on a CPU Unit that has these variables.
    pub(crate) fn store(&self, variables: DeviceVariables) -> Store<Host> {
        let limits = StoreLimitsBuilder::new()
            .memory_size(MEMORY_BYTES_MAX)
            .memories(1)
            .table_elements(TABLE_ELEMENTS_MAX)
            .tables(TABLES_MAX)
            .instances(1);
        let mut store = Store::new(&self.engine, Host::new(variables, limits.build()));
        store.limiter(|host| &mut host.limits);
        store
    }

    fn check_imports(&self) -> Result<(), WasmError> {
        for import in self.module.imports() {
            let row =
                IMPORTS.iter().find(|row| import.module() == imports::MODULE && row.name == import.name());
            let Some(row) = row else {
                let (module, name) = (import.module().to_owned(), import.name().to_owned());
                return Err(WasmError::UnknownImport { module, name });
            };
            let has_its_type = match import.ty() {
                ExternType::Func(function) => {
                    function.params() == row.takes && function.results() == row.gives
                }
                _ => false,
            };
            if !has_its_type {
                return Err(WasmError::WrongImport { name: row.name, expected: row.signature });
            }
        }
        Ok(())
    }

    fn check_exports(&self) -> Result<(), WasmError> {
        let missing = |name, expected| WasmError::MissingExport { name, expected };
        let is_step = |export: &ExternType| {
            let step = FuncType::new::<[ValType; 0], [ValType; 0]>([], []);
            matches!(export, ExternType::Func(function) if *function == step)
        };
        let scan = self.module.get_export("scan").ok_or(missing("scan", FUNCTION))?;
        let start = self.module.get_export("start");
        for (name, export) in [("scan", Some(scan)), ("start", start)] {
            if export.is_some_and(|export| !is_step(&export)) {
                return Err(WasmError::WrongExport { name, expected: FUNCTION });
            }
        }
        match self.module.get_export("memory") {
            None => Err(missing("memory", MEMORY)),
            Some(ExternType::Memory(memory)) => {
                let size_bytes = memory.minimum().saturating_mul(PAGE_BYTES);
                let limit_bytes = MEMORY_BYTES_MAX as u64;
                if size_bytes > limit_bytes {
                    return Err(WasmError::MemoryTooLarge { size_bytes, limit_bytes });
                }
                Ok(())
            }
            Some(_) => Err(WasmError::WrongExport { name: "memory", expected: MEMORY }),
        }
    }
}

/// The permitted features. Everything is compiled when it is loaded, so that no scan waits for that.
fn config() -> Config {
    let mut config = Config::default();
    config
        .consume_fuel(true)
        .compilation_mode(wasmi::CompilationMode::Eager)
        .set_max_recursion_depth(RECURSION_MAX)
        .wasm_multi_memory(false)
        .ignore_custom_sections(true);
    config
}
