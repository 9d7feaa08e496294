//! The clients that are connected.

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use tokio::net::TcpStream;
use tokio::task::JoinHandle;

use crate::connection;
use crate::unit::Unit;

/// Most clients at a time. One more takes the place of the one that is silent longest.
pub const CONNECTIONS_MAX: usize = 16;

pub(super) struct Clients {
    units: Arc<[Unit]>,
    places: Vec<Place>,
    /// Counts what is heard of clients: the greater the number, the shorter ago.
    heard: Arc<AtomicU64>,
}

struct Place {
    client: SocketAddr,
    /// The number of its last request, or of its connection.
    heard: Arc<AtomicU64>,
    task: JoinHandle<()>,
}

impl Clients {
    pub(super) fn new(units: Arc<[Unit]>) -> Self {
        Self { units, places: Vec::with_capacity(CONNECTIONS_MAX), heard: Arc::default() }
    }

    /// Takes a client in. Returns the one that has lost its place to it, if there was no other place.
    pub(super) fn admit(&mut self, stream: TcpStream, client: SocketAddr) -> Option<SocketAddr> {
        self.places.retain(|place| !place.task.is_finished());
        let closed = (self.places.len() >= CONNECTIONS_MAX).then(|| self.close_most_silent()).flatten();
        let heard = Arc::new(AtomicU64::new(next(&self.heard)));
        let (units, all, own) = (Arc::clone(&self.units), Arc::clone(&self.heard), Arc::clone(&heard));
        let task = tokio::spawn(async move {
            attend(stream, client, &units, || own.store(next(&all), Ordering::Relaxed)).await;
        });
        self.places.push(Place { client, heard, task });
        closed
    }

    fn close_most_silent(&mut self) -> Option<SocketAddr> {
        let heard = |place: &Place| place.heard.load(Ordering::Relaxed);
        let (at, _) = self.places.iter().enumerate().min_by_key(|(_, place)| heard(place))?;
        let place = self.places.swap_remove(at);
        // The connection is closed with the task that holds it.
        place.task.abort();
        Some(place.client)
    }
}

fn next(counter: &AtomicU64) -> u64 {
    counter.fetch_add(1, Ordering::Relaxed)
}

async fn attend(stream: TcpStream, client: SocketAddr, units: &[Unit], heard: impl FnMut()) {
    tracing::debug!("Modbus client {client} connected");
    // Answers are small, and clients wait for them.
    let ended = match stream.set_nodelay(true) {
        Ok(()) => connection::serve(stream, units, heard).await,
        Err(error) => Err(error),
    };
    match ended {
        Ok(()) => tracing::debug!("Modbus client {client} has gone"),
        Err(error) => tracing::info!("connection of Modbus client {client} closed: {error}"),
    }
}
