//! Modbus TCP clients at the CPU Units of a line.

use std::io;
use std::net::TcpListener;

use modbus::{ModbusMap, Server};

use crate::Twin;

impl Twin {
    /// Lets Modbus TCP clients that connect to `listener` read, write and force the variables of the CPU Units,
    /// until the returned server is dropped. The unit identifier of a request is the position in the line, from
    /// 1. Call this before [`Twin::serve`]: in virtual time a client waits until time advances.
    ///
    /// # Errors
    /// The listener cannot be used, or no thread can be started.
    pub fn serve_modbus(&mut self, listener: TcpListener) -> io::Result<Server> {
        let ends = self.connect_outside();
        modbus::serve(listener, ends.into_iter().map(|end| (ModbusMap::of(end.variables()), end)))
    }
}
