//! Modbus TCP clients at the CPU Units of a line.

use std::io;
use std::net::TcpListener;

use modbus::{ModbusMap, Server};

use crate::Twin;

impl Twin {
    /// Lets Modbus TCP clients that come to `listener` read, write and force the variables of the CPU Units, as long
    /// as the returned server is kept. The unit identifier of a request is the position in the line, from 1. Call it
    /// before [`Twin::serve`]: in virtual time a client waits until time passes.
    ///
    /// # Errors
    /// The listener cannot be used, or there is no thread to be had.
    pub fn serve_modbus(&mut self, listener: TcpListener) -> io::Result<Server> {
        let ends = self.connect_outside();
        modbus::serve(listener, ends.into_iter().map(|end| (ModbusMap::of(end.variables()), end)))
    }
}
