//! The server: one thread moves lines between clients and the other one, which carries out requests.
//!
//! Neither thread of the twin waits for one of these. The thread of the lines waits for no client, and the thread of the
//! requests for no line: what a client does not receive in time is kept for it within limits, and then dropped and counted.

mod client;
mod expectations;
mod lines;
mod notices;
mod outbox;
mod pace;
mod postbox;
mod publisher;
mod sockets;
mod subscription;
mod variables;
mod work;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::thread::{self, JoinHandle};

use rustix::process::setpriority_process;
use rustix::thread::gettid;

use crate::socket::Socket;
use crate::twin::Twin;

use postbox::Postbox;
use sockets::Sockets;
use subscription::Kinds;
use work::Work;

pub use publisher::Publisher;
pub use sockets::CLIENTS_MAX;

/// The niceness of both threads.
const NICE: i32 = 10;

/// The server of a twin. Dropping it closes all connections, removes the socket and ends its threads.
#[derive(Debug)]
pub struct Server {
    path: PathBuf,
    postbox: Arc<Postbox>,
    threads: Vec<JoinHandle<()>>,
}

/// Serves clients of a socket. `kinds` are the kinds of records that can be subscribed; they come from the [`Publisher`].
///
/// # Errors
/// No thread can be started, or there are too few file descriptors.
pub fn serve(
    socket: Socket,
    twin: impl Twin + 'static,
    kinds: impl IntoIterator<Item = &'static str>,
) -> io::Result<(Server, Publisher)> {
    let kinds = Arc::new(Kinds::of(kinds));
    let postbox = Arc::new(Postbox::new()?);
    let path = socket.path().to_owned();
    let (jobs, work) = channel();
    let publisher = Publisher::new(Arc::clone(&kinds), Arc::clone(&postbox));
    let mut server = Server { path, postbox: Arc::clone(&postbox), threads: Vec::new() };

    let work = Work::new(twin, work, Arc::clone(&postbox), kinds);
    server.threads.push(thread::Builder::new().name("control-work".to_owned()).spawn(move || {
        give_way();
        work.run();
    })?);
    let sockets = Sockets::new(socket, jobs, postbox);
    server.threads.push(thread::Builder::new().name("control".to_owned()).spawn(move || {
        give_way();
        sockets.run();
    })?);
    Ok((server, publisher))
}

/// On a machine that is busy the calling thread runs after those that answer frames and run tasks.
fn give_way() {
    if let Err(error) = setpriority_process(Some(gettid()), NICE) {
        tracing::debug!("control: the threads have the priority of the others: {error}");
    }
}

impl Server {
    /// The absolute path of its socket.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // The thread of the lines ends, and with it the queue of the other one.
        self.postbox.stop();
        for thread in self.threads.drain(..) {
            // A thread that panicked has already reported it.
            let _ = thread.join();
        }
    }
}
