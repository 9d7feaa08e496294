//! OPC UA clients at the CPU Units of a line.

use std::io;
use std::net::TcpListener;

use opcua::Server;

use crate::Twin;

impl Twin {
    /// Lets OPC UA clients that connect to `listener` read, write and monitor the variables of the CPU Units,
    /// until the returned server is dropped. Anyone with access to the listener may do so: there is no
    /// security. Call this before [`Twin::serve`]: in virtual time a client waits until time advances.
    ///
    /// # Errors
    /// The listener cannot be used, or no thread can be started.
    pub fn serve_opcua(&mut self, listener: TcpListener) -> io::Result<Server> {
        opcua::serve(listener, self.connect_outside())
    }
}
