//! The servers of `run`: their ports are opened with the initial privileges, and served later.

use std::net::{SocketAddr, TcpListener};

#[cfg(feature = "opcua")]
use ectwin::OpcUaServer;
use ectwin::{ModbusServer, Twin};

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
