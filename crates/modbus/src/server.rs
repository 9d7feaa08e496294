//! The server: it accepts clients on a thread of its own.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use plc::outside::OutsideEnd;
use tokio::net::{TcpListener, TcpStream};
use tokio::runtime::{Builder, Runtime};
use tokio::sync::{Semaphore, oneshot};

use crate::connection;
use crate::map::ModbusMap;
use crate::unit::Unit;

/// Most clients at a time; one more is hung up on.
pub const CONNECTIONS_MAX: usize = 16;

/// How long accepting rests after an error, such as no file descriptor to be had.
const REST: Duration = Duration::from_millis(100);

/// A Modbus TCP server. Dropping it closes all connections and ends its thread.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// Serves these units, in the order of the line, to clients of `listener`. Unit identifier 1 is the first; 0 and 255
/// mean the first too.
///
/// # Errors
/// The listener cannot be used, or there is no thread to be had.
pub fn serve(
    listener: std::net::TcpListener,
    units: impl IntoIterator<Item = (ModbusMap, OutsideEnd)>,
) -> io::Result<Server> {
    let units: Arc<[Unit]> = units.into_iter().map(|(map, end)| Unit::new(map, end)).collect();
    let address = listener.local_addr()?;
    listener.set_nonblocking(true)?;
    let runtime = Builder::new_current_thread().enable_io().enable_time().build()?;
    let listener = {
        let _entered = runtime.enter();
        TcpListener::from_std(listener)?
    };
    let (stop, stopped) = oneshot::channel();
    let thread = thread::Builder::new().name("modbus".to_owned());
    let thread = thread.spawn(move || run(&runtime, &listener, &units, stopped))?;
    Ok(Server { address, stop: Some(stop), thread: Some(thread) })
}

impl Server {
    /// Where it listens.
    #[must_use]
    pub const fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The thread ends when its end of the channel hears that this one has gone.
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            // What a thread that panicked had to say, it has said.
            let _ = thread.join();
        }
    }
}

fn run(runtime: &Runtime, listener: &TcpListener, units: &Arc<[Unit]>, stopped: oneshot::Receiver<()>) {
    runtime.block_on(async {
        tokio::select! {
            _ = stopped => {}
            () = accept(listener, units) => {}
        }
    });
}

async fn accept(listener: &TcpListener, units: &Arc<[Unit]>) {
    let places = Arc::new(Semaphore::new(CONNECTIONS_MAX));
    loop {
        let (stream, client) = match listener.accept().await {
            Ok(accepted) => accepted,
            Err(error) => {
                tracing::warn!("no Modbus client can be accepted: {error}");
                tokio::time::sleep(REST).await;
                continue;
            }
        };
        let Ok(place) = Arc::clone(&places).try_acquire_owned() else {
            tracing::warn!("Modbus client {client} refused: {CONNECTIONS_MAX} are connected");
            continue;
        };
        let units = Arc::clone(units);
        tokio::spawn(async move {
            attend(stream, client, &units).await;
            drop(place);
        });
    }
}

async fn attend(stream: TcpStream, client: SocketAddr, units: &[Unit]) {
    tracing::debug!("Modbus client {client} connected");
    // Answers are small, and clients wait for them.
    let ended = match stream.set_nodelay(true) {
        Ok(()) => connection::serve(stream, units).await,
        Err(error) => Err(error),
    };
    match ended {
        Ok(()) => tracing::debug!("Modbus client {client} has gone"),
        Err(error) => tracing::info!("connection of Modbus client {client} closed: {error}"),
    }
}
