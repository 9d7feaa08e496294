//! The server: it answers clients on a separate thread.

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::thread::{self, JoinHandle};

use opcua::server::address_space::AddressSpace;
use opcua::server::node_manager::ServerContext;
use opcua::server::node_manager::memory::InMemoryNodeManagerBuilder;
use opcua::server::{Server as UaServer, ServerBuilder};
use plc::outside::OutsideEnd;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::oneshot;
use tracing::subscriber::{NoSubscriber, with_default};

use crate::nodes::{Line, NAMESPACE_URI};
use crate::unit::Unit;

/// An OPC UA server. Dropping it closes all connections and ends its thread.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// Serves these units, in the order of the line, to clients of `listener`: anonymous ones, without security.
///
/// # Errors
/// The listener cannot be used, or no thread can be started.
pub fn serve(listener: TcpListener, units: impl IntoIterator<Item = OutsideEnd>) -> io::Result<Server> {
    let units: Vec<Unit> = units.into_iter().map(Unit::new).collect();
    let address = listener.local_addr()?;
    listener.set_nonblocking(true)?;
    let runtime = Builder::new_current_thread().enable_io().enable_time().build()?;
    let entered = runtime.enter();
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let server = build(address, units)?;
    drop(entered);
    let (stop, stopped) = oneshot::channel();
    let thread = thread::Builder::new().name("opcua".to_owned());
    let thread = thread.spawn(move || run(&runtime, server, listener, stopped))?;
    Ok(Server { address, stop: Some(stop), thread: Some(thread) })
}

impl Server {
    /// The address on which it listens.
    #[must_use]
    pub const fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The thread ends when its end of the channel detects that this end has been dropped.
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has already reported it.
            let _ = thread.join();
        }
    }
}

fn run(
    runtime: &Runtime,
    server: UaServer,
    listener: tokio::net::TcpListener,
    stopped: oneshot::Receiver<()>,
) {
    runtime.block_on(async {
        tokio::select! {
            _ = stopped => {}
            ended = server.run_with(listener) => {
                if let Err(reason) = ended {
                    tracing::warn!("the OPC UA server has ended: {reason}");
                }
            }
        }
    });
}

fn build(address: SocketAddr, units: Vec<Unit>) -> io::Result<UaServer> {
    let line = move |context: ServerContext, address_space: &mut AddressSpace| {
        Line::new(units, &context, address_space)
    };
    let certificates = certificate_folder();
    let builder = ServerBuilder::new_anonymous("ectwin")
        .application_uri("urn:ectwin:server")
        .product_uri(NAMESPACE_URI)
        .create_sample_keypair(false)
        .pki_dir(&certificates)
        .host(address.ip().to_string())
        .port(address.port())
        .with_node_manager(InMemoryNodeManagerBuilder::new(line));
    // It would report that it has no certificate; without security there is none.
    let built = with_default(NoSubscriber::default(), || builder.build());
    // The library requires this folder and stores nothing in it.
    let _ = std::fs::remove_dir_all(&certificates);
    built.map(|(server, _)| server).map_err(io::Error::other)
}

/// A unique folder: a process may have several servers.
fn certificate_folder() -> PathBuf {
    use std::sync::atomic::{AtomicU32, Ordering};
    static SERVERS: AtomicU32 = AtomicU32::new(0);
    let server = SERVERS.fetch_add(1, Ordering::Relaxed);
    std::env::temp_dir().join(format!("ectwin-opcua-{}-{server}", std::process::id()))
}
