//! The servers of `run`: their ports are opened with the initial privileges, and served later.

use std::net::{SocketAddr, TcpListener};
use std::path::Path;

#[cfg(feature = "opcua")]
use ectwin::OpcUaServer;
use ectwin::control::{self, Publisher, Server, Socket};
use ectwin::happenings::KINDS;
use ectwin::{Handle, ModbusServer, Twin};

use crate::failure::Failure;

/// A listener, and the requested address.
pub(super) type Listener = (SocketAddr, TcpListener);

pub(super) fn listen_for_modbus(address: SocketAddr) -> Result<Listener, Failure> {
    let listener = TcpListener::bind(address).map_err(|source| Failure::Modbus { address, source })?;
    Ok((address, listener))
}

pub(super) fn serve_modbus(twin: &mut Twin, (address, listener): Listener) -> Result<ModbusServer, Failure> {
    let server = twin.serve_modbus(listener).map_err(|source| Failure::Modbus { address, source })?;
    tracing::info!("Modbus TCP is served at {}", server.address());
    Ok(server)
}

/// The socket of the control channel, at this path or at the default one.
pub(super) fn listen_for_control(path: Option<&Path>) -> Result<Socket, Failure> {
    path.map_or_else(Socket::bind_default, Socket::bind).map_err(Failure::Control)
}

pub(super) fn serve_control(
    socket: Socket,
    units: &Handle,
    link: String,
) -> Result<(Server, Publisher), Failure> {
    let served = control::serve(socket, units.steered(link), KINDS.iter().map(|kind| kind.name));
    let (server, publisher) = served.map_err(Failure::LinkLost)?;
    tracing::info!("the control channel is served at {}", server.path().display());
    Ok((server, publisher))
}

#[cfg(feature = "opcua")]
pub(super) fn listen_for_opcua(address: SocketAddr) -> Result<Listener, Failure> {
    let listener = TcpListener::bind(address).map_err(|source| Failure::OpcUa { address, source })?;
    Ok((address, listener))
}

#[cfg(feature = "opcua")]
pub(super) fn serve_opcua(twin: &mut Twin, (address, listener): Listener) -> Result<OpcUaServer, Failure> {
    let server = twin.serve_opcua(listener).map_err(|source| Failure::OpcUa { address, source })?;
    tracing::info!("OPC UA is served at opc.tcp://{}", server.address());
    Ok(server)
}
