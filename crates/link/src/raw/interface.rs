//! The state of an interface, apart from its frames: its carrier, its index, and the frames that the kernel drops.
//!
//! A separate thread monitors it, so that no frame waits for that: the kernel wakes it when an interface
//! changes, and it checks once a second in any case.

use std::io;
use std::os::unix::net::UnixStream;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Instant;

use pnet_datalink::NetworkInterface;

use super::bell::Bell;
use super::socket::{HELP_FOR_BUFFER, PacketSocket};
use crate::claim::Claim;

/// `IFF_LOWER_UP` of netdevice(7): the interface is up, and there is a signal on the cable.
const LOWER_UP: u32 = 1 << 16;

/// An interface by its name, whatever device has this name.
pub(super) struct Interface {
    name: String,
    socket: PacketSocket,
    bound: Mutex<Bound>,
    carrier: AtomicBool,
    dropped: AtomicU64,
}

/// The interface to which the socket is bound.
struct Bound {
    /// Nothing while no interface has the name, or another ectwin has the interface.
    claimed: Option<(u32, Claim)>,
    /// Since when there has been no carrier.
    lost_at: Option<Instant>,
    /// No interface has the name.
    is_gone: bool,
    /// The last refusal to bind, so that it is logged only once.
    refusal: Option<io::ErrorKind>,
}

impl Interface {
    /// Binds `socket` to the interface that has this name at present.
    pub(super) fn bind(found: &NetworkInterface, socket: PacketSocket) -> io::Result<Self> {
        let claim = Claim::take(found.index)?;
        socket.bind(found.index)?;
        let carrier = has_carrier(found);
        let lost_at = (!carrier).then(Instant::now);
        Ok(Self {
            name: found.name.clone(),
            socket,
            bound: Mutex::new(Bound {
                claimed: Some((found.index, claim)),
                lost_at,
                is_gone: false,
                refusal: None,
            }),
            carrier: AtomicBool::new(carrier),
            dropped: AtomicU64::new(0),
        })
    }

    /// Whether there was a carrier at the last check.
    pub(super) fn carrier(&self) -> bool {
        // No other data depend on it: the frames are in the kernel.
        self.carrier.load(Ordering::Relaxed)
    }

    /// Frames for which the kernel had no room.
    pub(super) fn dropped(&self) -> u64 {
        self.count_dropped();
        self.dropped.load(Ordering::Relaxed)
    }

    /// Follows the interface: binds again if its name has another index, and stores the carrier.
    pub(super) fn look(&self) {
        let mut bound = self.bound();
        let interfaces = pnet_datalink::interfaces();
        let found = interfaces.iter().find(|interface| interface.name == self.name);
        let index = found.map(|found| found.index);
        let renamed = interfaces.iter().find(|interface| Some(interface.index) == bound.index());
        let new_name = renamed.map(|interface| &*interface.name).filter(|name| *name != self.name);
        if index != bound.index() {
            let before = bound.claimed.take().map(|(index, _)| index);
            if let Some(before) = before {
                self.socket.leave(before);
            }
            if let Some(index) = index {
                if before.is_some() {
                    tracing::warn!("{} is another interface now", self.name);
                }
                self.bind_again(&mut bound, index);
            }
        }
        let carrier = bound.claimed.is_some() && found.is_some_and(has_carrier);
        self.log(&mut bound, found.is_some(), new_name, carrier);
        self.carrier.store(carrier, Ordering::Relaxed);
    }

    /// The same name is another interface now. An interface with another claim is left alone.
    fn bind_again(&self, bound: &mut Bound, index: u32) {
        let claimed = Claim::take(index).and_then(|claim| self.socket.bind(index).map(|()| claim));
        match claimed {
            Ok(claim) => (bound.claimed, bound.refusal) = (Some((index, claim)), None),
            Err(error) => {
                if bound.refusal.replace(error.kind()) != Some(error.kind()) {
                    tracing::warn!("cannot answer on the new interface {}: {error}", self.name);
                }
            }
        }
    }

    fn log(&self, bound: &mut Bound, is_there: bool, new_name: Option<&str>, carrier: bool) {
        let name = &self.name;
        // An interface can lose its carrier first, and its name later.
        let was_gone = core::mem::replace(&mut bound.is_gone, !is_there);
        if bound.is_gone && !was_gone {
            match new_name {
                Some(new_name) => tracing::warn!(
                    "{name} is gone: it has the name {new_name} now; waiting for an interface of the name {name}, such as \
                     by `ip link set {new_name} name {name}`"
                ),
                None => tracing::warn!("{name} is gone; waiting for an interface of this name"),
            }
        }
        match (bound.lost_at, carrier) {
            (None, false) => {
                bound.lost_at = Some(Instant::now());
                if is_there {
                    tracing::warn!("{name} has lost its carrier: the cable to the master is pulled");
                }
            }
            (Some(lost_at), true) => {
                bound.lost_at = None;
                tracing::warn!("{name} is up again after {:.1} s", lost_at.elapsed().as_secs_f64());
            }
            (None, true) | (Some(_), false) => {}
        }
    }

    fn count_dropped(&self) {
        let more = self.socket.take_dropped();
        if more > 0 {
            let all = self.dropped.fetch_add(more, Ordering::Relaxed) + more;
            tracing::warn!(
                "{}: the kernel has dropped {more} frames, {all} in all: the receive buffer of {} KiB was full; \
                 {HELP_FOR_BUFFER}",
                self.name,
                self.socket.receive_buffer_bytes() >> 11,
            );
        }
    }

    /// A thread that panicked with the lock left the state consistent: each change is one assignment.
    fn bound(&self) -> MutexGuard<'_, Bound> {
        self.bound.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Bound {
    fn index(&self) -> Option<u32> {
        self.claimed.as_ref().map(|(index, _)| *index)
    }
}

fn has_carrier(interface: &NetworkInterface) -> bool {
    interface.flags & LOWER_UP != 0
}

/// The thread that monitors an interface, until this value is dropped.
pub(super) struct Watch {
    hang_up: Option<UnixStream>,
    thread: Option<JoinHandle<()>>,
}

impl Watch {
    pub(super) fn start(interface: Arc<Interface>, bell: Bell) -> io::Result<Self> {
        let (hang_up, hung_up) = UnixStream::pair()?;
        let thread = std::thread::Builder::new().name("interface".to_owned());
        let thread = thread.spawn(move || {
            // Changes between opening and now.
            interface.look();
            while bell.wait(&hung_up) {
                interface.look();
                interface.count_dropped();
            }
        })?;
        Ok(Self { hang_up: Some(hang_up), thread: Some(thread) })
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.hang_up.take());
        if let Some(Err(_)) = self.thread.take().map(JoinHandle::join) {
            tracing::warn!("the thread that looks after an interface panicked");
        }
    }
}
