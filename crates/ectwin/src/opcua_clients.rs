//! OPC UA clients at the CPU Units of a line.

use std::io;
use std::net::TcpListener;

use opcua::Server;

use crate::Twin;

impl Twin {
    /// Lets OPC UA clients that come to `listener` read, write and watch the variables of the CPU Units, as long as the
    /// returned server is kept. Whoever reaches the listener may do so: there is no security. Call it before
    /// [`Twin::serve`]: in virtual time a client waits until time passes.
    ///
    /// # Errors
    /// The listener cannot be used, or there is no thread to be had.
    pub fn serve_opcua(&mut self, listener: TcpListener) -> io::Result<Server> {
        opcua::serve(listener, self.connect_outside())
    }
}
