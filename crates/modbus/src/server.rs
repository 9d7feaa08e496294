//! The server: it accepts clients on a separate thread.

mod clients;
mod notices;

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use plc::outside::OutsideEnd;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;
use tokio::net::TcpListener;
use tokio::runtime::{Builder, Runtime};
use tokio::sync::oneshot;

use crate::map::ModbusMap;
use crate::unit::Unit;

use clients::{Clients, Closed};
use notices::{Notice, Notices};

pub use clients::CONNECTIONS_MAX;

/// How long accepting rests after an error, such as no file descriptor left where no client has one.
const REST: Duration = Duration::from_millis(100);
/// File descriptors that the runtime opens at its start, with a margin. It panics if it gets too few for its signals.
const RUNTIME_DESCRIPTORS: usize = 8;

/// A Modbus TCP server. Dropping it closes all connections and ends its thread.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

/// Serves these units, in the order of the line, to clients of `listener`. Unit identifier 1 is the first; 0
/// and 255 also mean the first.
///
/// # Errors
/// The listener cannot be used, there are too few file descriptors, or no thread can be started.
pub fn serve(
    listener: std::net::TcpListener,
    units: impl IntoIterator<Item = (ModbusMap, OutsideEnd)>,
) -> io::Result<Server> {
    let units: Arc<[Unit]> = units.into_iter().map(|(map, end)| Unit::new(map, end)).collect();
    let address = listener.local_addr()?;
    let room = (0..RUNTIME_DESCRIPTORS).map(|_| listener.try_clone()).collect::<io::Result<Vec<_>>>()?;
    drop(room);
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

fn run(runtime: &Runtime, listener: &TcpListener, units: &Arc<[Unit]>, stopped: oneshot::Receiver<()>) {
    runtime.block_on(async {
        tokio::select! {
            _ = stopped => {}
            () = accept(listener, units) => {}
        }
    });
}

/// Accepts clients, and reports its errors once a second.
async fn accept(listener: &TcpListener, units: &Arc<[Unit]>) {
    let mut clients = Clients::new(Arc::clone(units));
    let mut notices = Notices::default();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            () = notices.due() => {
                notices.report();
                continue;
            }
        };
        match accepted {
            Ok((stream, client)) => {
                if let Some(closed) = clients.admit(stream, client).await {
                    notices.add(Notice::Closed { closed, for_client: client });
                }
            }
            Err(error) => match make_room(&mut clients, listener, &error).await {
                Room::Made(closed) => notices.add(Notice::NoDescriptor(closed)),
                Room::NotWanted => tokio::time::sleep(REST).await,
                Room::None => {
                    notices.add(Notice::NotAccepted(error.to_string()));
                    tokio::time::sleep(REST).await;
                }
            },
        }
    }
}

/// What can be done for a client that was not accepted.
enum Room {
    /// This client was closed; its file descriptor is free.
    Made(Closed),
    /// There was no client to accept: the system looks for a descriptor first, and only then for a client.
    NotWanted,
    /// Nothing.
    None,
}

async fn make_room(clients: &mut Clients, listener: &TcpListener, error: &io::Error) -> Room {
    if !descriptors_are_exhausted(error) {
        return Room::None;
    }
    if !has_waiting_client(listener) {
        return Room::NotWanted;
    }
    clients.free_descriptor().await.map_or(Room::None, Room::Made)
}

fn has_waiting_client(listener: &TcpListener) -> bool {
    let mut listeners = [PollFd::new(listener, PollFlags::IN)];
    poll(&mut listeners, Some(&Timespec::default())).is_ok_and(|ready| ready > 0)
}

/// Whether there was no file descriptor left, in this process or in the system.
fn descriptors_are_exhausted(error: &io::Error) -> bool {
    [Errno::MFILE, Errno::NFILE].iter().any(|errno| error.raw_os_error() == Some(errno.raw_os_error()))
}
