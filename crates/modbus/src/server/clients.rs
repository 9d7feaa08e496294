//! The connected clients.

use std::fmt::{self, Display, Formatter};
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use tokio::net::TcpStream;
use tokio::task::{JoinHandle, yield_now};

use crate::connection;
use crate::unit::Unit;

/// Maximum number of clients at a time. A further client replaces a client that has never sent a request, the
/// oldest first; if there is none, the one whose last request is longest ago. The same applies if the file
/// descriptors are used up before.
pub const CONNECTIONS_MAX: usize = 16;

pub(super) struct Clients {
    units: Arc<[Unit]>,
    places: Vec<Place>,
    /// Counts connections and requests of all clients: a greater number is more recent.
    count: Arc<AtomicU64>,
}

struct Place {
    client: SocketAddr,
    /// The number of its connection.
    connected: u64,
    /// The number of its last request; [`NEVER`] before the first.
    requested: Arc<AtomicU64>,
    task: JoinHandle<()>,
}

/// Numbers of connections and requests are always greater than this.
const NEVER: u64 = 0;

/// A client that was replaced by another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Closed {
    pub(super) client: SocketAddr,
    /// Whether it has ever sent a request.
    pub(super) has_requested: bool,
}

impl Display for Closed {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let why = if self.has_requested { "silent longest" } else { "without a request so far" };
        write!(f, "{}, {why},", self.client)
    }
}

impl Clients {
    pub(super) fn new(units: Arc<[Unit]>) -> Self {
        Self { units, places: Vec::with_capacity(CONNECTIONS_MAX), count: Arc::default() }
    }

    /// Admits a client. Returns the client that it has replaced, if there was no free place.
    pub(super) async fn admit(&mut self, stream: TcpStream, client: SocketAddr) -> Option<Closed> {
        if self.is_full() {
            // Requests that have arrived count, including those of clients that have just arrived in the same burst.
            yield_now().await;
        }
        let closed = if self.is_full() { self.close_one().await } else { None };
        let (connected, requested) = (next(&self.count), Arc::new(AtomicU64::new(NEVER)));
        let (units, count, own) = (Arc::clone(&self.units), Arc::clone(&self.count), Arc::clone(&requested));
        let task = tokio::spawn(async move {
            attend(stream, client, &units, || own.store(next(&count), Ordering::Relaxed)).await;
        });
        self.places.push(Place { client, connected, requested, task });
        closed
    }

    /// Closes a client, so that another one can use its file descriptor. None: there is no client.
    pub(super) async fn free_descriptor(&mut self) -> Option<Closed> {
        // As above: requests that have arrived count.
        yield_now().await;
        self.forget_gone();
        self.close_one().await
    }

    fn is_full(&mut self) -> bool {
        self.forget_gone();
        self.places.len() >= CONNECTIONS_MAX
    }

    fn forget_gone(&mut self) {
        self.places.retain(|place| !place.task.is_finished());
    }

    async fn close_one(&mut self) -> Option<Closed> {
        let requested = |place: &Place| place.requested.load(Ordering::Relaxed);
        let rank = |place: &Place| (requested(place), place.connected);
        let (at, _) = self.places.iter().enumerate().min_by_key(|(_, place)| rank(place))?;
        let place = self.places.swap_remove(at);
        let closed = Closed { client: place.client, has_requested: requested(&place) != NEVER };
        // The connection is closed with the task that holds it.
        place.task.abort();
        let _ = place.task.await;
        Some(closed)
    }
}

fn next(counter: &AtomicU64) -> u64 {
    counter.fetch_add(1, Ordering::Relaxed) + 1
}

async fn attend(stream: TcpStream, client: SocketAddr, units: &[Unit], requested: impl FnMut()) {
    tracing::debug!("Modbus client {client} connected");
    // Answers are small, and clients wait for them.
    let ended = match stream.set_nodelay(true) {
        Ok(()) => connection::serve(stream, units, requested).await,
        Err(error) => Err(error),
    };
    match ended {
        Ok(()) => tracing::debug!("Modbus client {client} has gone"),
        Err(error) => tracing::info!("connection of Modbus client {client} closed: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use tokio::net::TcpListener;
    use tokio::runtime::Builder;

    use super::*;

    #[test]
    fn a_request_that_has_arrived_counts_before_a_place_is_taken() {
        let runtime = Builder::new_current_thread().enable_io().enable_time().build().unwrap();
        runtime.block_on(async {
            let listener = TcpListener::bind(("127.0.0.1", 0)).await.unwrap();
            let address = listener.local_addr().unwrap();
            // All of them wait to be accepted, one after the other; no task runs between two of them.
            let connect = |_| std::net::TcpStream::connect(address).unwrap();
            let mut burst: Vec<_> = (0..=CONNECTIONS_MAX).map(connect).collect();
            burst[0].write_all(&[0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1]).unwrap();
            let mut clients = Clients::new(Arc::new([]));
            let mut closed = Vec::new();
            for _ in &burst {
                let (stream, client) = listener.accept().await.unwrap();
                closed.extend(clients.admit(stream, client).await);
            }
            let second = burst[1].local_addr().unwrap();
            assert_eq!(closed, [Closed { client: second, has_requested: false }]);
        });
    }
}
